// Decay with exp(-(c1 c2 + c3) t), as decks say it of a scalar. c2 is one number, or a field: a
// table of points and values, each for the cell of the coarsest level that holds the point (the
// mean of several; 0 in cells without any). Cells of finer levels have that of the cell they lie
// in.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/grid/level.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

// Numbers of the cells of a level.
class CellNumbers {
 public:
  CellNumbers(const Level& level, const std::string& file);  // InputError
  double at(Vec3 point) const {
    std::size_t n = 0;
    for (int d = 2; d >= 0; --d) {
      const int i = static_cast<int>(std::floor((point[d] - low_[d]) * inverse_[d]));
      n = n * size_[d] + std::min(std::max(i, 0), size_[d] - 1);
    }
    return values_[n];
  }

 private:
  Vec3 low_{}, inverse_{};
  IntVec3 size_{};
  std::vector<double> values_;
};

struct Decay {
  bool any = false;
  double c1 = 0, c2 = 0, c3 = 0;             // c1 c2 and c3: 1/s
  std::string file;                          // of a field; empty: c2 is the same everywhere
  std::shared_ptr<const CellNumbers> field;  // once it is read
  Location where;

  double rate(double coefficient) const { return c1 * coefficient + c3; }  // 1/time
  double coefficient(Vec3 point) const { return field ? field->at(point) : c2; }
};

TagSpec exponential_decay_tag();
// Of a scalar without the tag: none.
Decay read_decay(const DeckNode& scalar);
// The field, where there is one, in cells of the coarsest level.
void read_field(Decay& decay, const Level& coarsest, std::vector<Fault>& faults);

}  // namespace sluice::models

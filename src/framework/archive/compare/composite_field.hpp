// A label of one material on all levels of a step, for comparisons between resolutions: at each
// place the finest cell counts.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

// How the cells of a level lie in those of a coarser one, or in equal ones: fine index f is in the
// coarse one (f + shift) / ratio. A direction that is flat in both runs has ratio 1.
struct Nesting {
  IntVec3 ratio{1, 1, 1}, shift{};
  bool equal() const { return ratio == IntVec3{1, 1, 1}; }
  // Whether index f has a counterpart, which it fills in: faces and nodes have one where they
  // coincide with one of the coarse level.
  bool to_coarse(IntVec3 f, Centring centring, IntVec3& coarse) const;
  // The first of the fine indices of a coarse one, of cells; faces and nodes: the one there.
  IntVec3 to_fine(IntVec3 coarse) const;
};

enum class Nested { no, yes };
// Nested::no: `fine` is not as fine along each direction. InputError where cells of neither level
// are whole numbers of cells of the other, or their faces do not meet.
Nested nest(const Level& coarse, const Level& fine, Nesting& nesting);

class CompositeField {
 public:
  // `fields`: by level.
  CompositeField(const ArchiveStep& step, const std::vector<FieldInfo>& fields);

  struct OnLevel {
    FieldInfo info;
    const Level* level;
    DenseField values;
    std::int64_t weight;         // of an index, in those of the finest level: a face by its area
    std::vector<Nesting> finer;  // to the following levels of this field
  };
  const std::vector<OnLevel>& levels() const { return levels_; }
  const FieldInfo& info() const { return levels_.front().info; }
  // Whether a finer level holds the place.
  bool covered(std::size_t level, IntVec3 c) const;

 private:
  std::vector<OnLevel> levels_;
};

}  // namespace sluice

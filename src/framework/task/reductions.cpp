// Merging of per-thread reductions.
#include "framework/task/reductions.hpp"

#include <tuple>

namespace sluice {

bool before(const CellFault& a, const CellFault& b) {
  return std::tie(a.level, a.cell.z, a.cell.y, a.cell.x, a.material, a.kind) <
         std::tie(b.level, b.cell.z, b.cell.y, b.cell.x, b.material, b.kind);
}

void Reductions::fault(const CellFault& f) {
  faults_.push_back(f);
}

void Reductions::clear() {
  for (std::int64_t& m : maxima_) m = 0;
  for (ExactSum& s : sums_) s = ExactSum{};
  faults_.clear();
}

void Reductions::merge(const Reductions& other) {
  for (std::size_t s = 0; s < maxima_.size(); ++s)
    maxima_[s] = other.maxima_[s] > maxima_[s] ? other.maxima_[s] : maxima_[s];
  for (std::size_t s = 0; s < sums_.size(); ++s) sums_[s].merge(other.sums_[s]);
  faults_.insert(faults_.end(), other.faults_.begin(), other.faults_.end());
}

}  // namespace sluice

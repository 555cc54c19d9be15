// Which sums and maxima of a step belong to whom. Each part of a component registers its own once
// and keeps the group that it is given: by it the part finds its numbers among all of a step.
#pragma once
#include <span>
#include <vector>

namespace sluice {

// Numbers of one part, in its units, among the sums (or the maxima) of a step; an empty group:
// none.
template <class Kind>
class ReductionGroup {
 public:
  ReductionGroup() = default;

  int first() const { return first_; }
  int count() const { return count_; }
  bool empty() const { return count_ == 0; }
  // This part's of all; `all` has as many as the layout.
  std::span<const double> of(const std::vector<double>& all) const {
    return std::span(all).subspan(first_, count_);
  }
  std::span<double> of(std::vector<double>& all) const {
    return std::span(all).subspan(first_, count_);
  }

 private:
  friend class ReductionLayout;
  ReductionGroup(int first, int count) : first_(first), count_(count) {}
  int first_ = 0, count_ = 0;
};
using SumGroup = ReductionGroup<struct SumKind>;
using MaximumGroup = ReductionGroup<struct MaximumKind>;

class ReductionLayout {
 public:
  SumGroup add_sums(int count) {
    sums_ += count;
    return {sums_ - count, count};
  }
  // Of stages alone, which reduce them over ranks by themselves: no sweep adds to them.
  SumGroup add_sums_of_stages(int count) {
    of_stages_.push_back(add_sums(count));
    return of_stages_.back();
  }
  bool is_of_stages(int sum) const {
    for (const SumGroup& group : of_stages_)
      if (sum >= group.first() && sum < group.first() + group.count()) return true;
    return false;
  }
  MaximumGroup add_maxima(int count) {
    maxima_ += count;
    return {maxima_ - count, count};
  }
  int sums() const { return sums_; }
  int maxima() const { return maxima_; }

 private:
  int sums_ = 0, maxima_ = 0;
  std::vector<SumGroup> of_stages_;
};

}  // namespace sluice

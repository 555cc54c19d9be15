// What burning has done in a step, for the books: exact sums over particles and ranks.
#pragma once
#include <span>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/base/reduction.hpp"
#include "framework/task/reduction_layout.hpp"

namespace sluice::mpmice {

// Among the sums of a step: what burned, and which switches of outputs were passed.
struct BurnReductions {
  SumGroup burned, switches;
};

class BurnedSums {
 public:
  // Behind the masses that materials gain, solids first.
  enum CommonSum { energy, burned, heat, common_sum_count };
  static int count(int materials) { return materials + common_sum_count; }

  void begin(int materials) { sums_.assign(count(materials), {}); }
  // Mass in kg; the heat of this reaction and the energy in J. `new_energy`: what the budgets did
  // not hold before: the heat of solids, and the work of the reference pressure on their volume,
  // which the budgets take from what solids have.
  void add(int from, int to, double mass, double heat_of_reaction, double new_energy) {
    sums_[from].add(-mass);
    sums_[to].add(mass);
    const std::size_t beside = sums_.size() - common_sum_count;
    sums_[beside + energy].add(new_energy);
    sums_[beside + burned].add(mass);
    sums_[beside + heat].add(heat_of_reaction);
  }
  // Collective: adds to those of the step.
  template <class Ranks>
  void add_to(Ranks& ranks, std::span<double> sums) const {
    Reduction all;
    std::vector<Reduction::Sum> slots;
    for (const ExactSum& s : sums_) slots.push_back(all.add_sum(s));
    ranks.reduce(all);
    for (std::size_t n = 0; n < slots.size(); ++n) sums[n] += all.sum(slots[n]).value();
  }

 private:
  std::vector<ExactSum> sums_;
};

}  // namespace sluice::mpmice

// What the coupling of fluid and solids adds to the books of a step: exact sums of this rank, made
// those of all ranks in one reduction.
#pragma once
#include <array>
#include <span>

#include "framework/base/exact_sum.hpp"
#include "framework/base/reduction.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpmice {

class CouplingBooks {
 public:
  using Of = mpm::StepSums;
  // Of forces: what a pass of a semi-implicit step books, the next one books anew.
  void clear_forces() { forces_ = {}; }
  // Of what surfaces work: booked again where cells are shared again.
  void clear_work() { work_ = {}; }
  void clear_exchange() { exchange_ = {}; }
  // `index`: one of StepSums.
  ExactSum& of_forces(int index) { return forces_[place(index)]; }
  ExactSum& of_work(int index) { return work_[place(index)]; }
  ExactSum& of_exchange(int index) { return exchange_[place(index)]; }

  // Adds all sums to a reduction, then from it to those of the step.
  void add_to(Reduction& all) {
    for (std::size_t n = 0; n < booked.size(); ++n) {
      ExactSum sum = forces_[n];
      sum.merge(work_[n]);
      sum.merge(exchange_[n]);
      slots_[n] = all.add_sum(sum);
    }
  }
  void take(const Reduction& all, std::span<double> sums) const {
    for (std::size_t n = 0; n < booked.size(); ++n)
      sums[static_cast<std::size_t>(booked[n])] += all.sum(slots_[n]).value();
  }

 private:
  static constexpr std::array booked{
      int{Of::impulse_x},     int{Of::impulse_y},   int{Of::impulse_z},  int{Of::work},
      int{Of::reaction_x},    int{Of::reaction_y},  int{Of::reaction_z}, int{Of::heat_from_fluid},
      int{Of::exchange_gain}, int{Of::surface_work}};
  static std::size_t place(int index) {
    std::size_t n = 0;
    while (booked[n] != index) ++n;
    return n;
  }

  std::array<ExactSum, booked.size()> forces_, work_, exchange_;
  std::array<Reduction::Sum, booked.size()> slots_;
};

}  // namespace sluice::mpmice

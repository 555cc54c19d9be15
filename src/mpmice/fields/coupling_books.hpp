// What the coupling of fluid and solids adds to the books of a step: exact sums of this rank, made
// those of all ranks in one reduction.
#pragma once
#include <array>
#include <span>

#include "framework/base/exact_sum.hpp"
#include "framework/base/reduction.hpp"
#include "solids/coupled_solids.hpp"

namespace sluice::mpmice {

// Impulse and reaction: the first of three (solids::BookedSums has meanings and units).
enum class Booked {
  impulse,
  reaction = 3,
  work = 6,
  heat_from_fluid,
  exchange_gain,
  surface_work,
  count
};

class CouplingBooks {
 public:
  // Of forces: what a pass of a semi-implicit step books, the next one books anew.
  void clear_forces() { forces_ = {}; }
  // Of what surfaces work: booked again where cells are shared again.
  void clear_work() { work_ = {}; }
  void clear_exchange() { exchange_ = {}; }
  // `direction`: of the grid, of impulse and reaction.
  ExactSum& of_forces(Booked what, int direction = 0) { return forces_[place(what, direction)]; }
  ExactSum& of_work(Booked what) { return work_[place(what, 0)]; }
  ExactSum& of_exchange(Booked what, int direction = 0) {
    return exchange_[place(what, direction)];
  }

  // Adds all sums to a reduction, then from it to those of the step.
  void add_to(Reduction& all) {
    for (std::size_t n = 0; n < count; ++n) {
      ExactSum sum = forces_[n];
      sum.merge(work_[n]);
      sum.merge(exchange_[n]);
      slots_[n] = all.add_sum(sum);
    }
  }
  void take(const Reduction& all, const solids::BookedSums& to, std::span<double> sums) const {
    const auto add = [&](Booked what, int direction, int index) {
      sums[static_cast<std::size_t>(index)] += all.sum(slots_[place(what, direction)]).value();
    };
    for (int d = 0; d < 3; ++d) {
      add(Booked::impulse, d, to.impulse + d);
      add(Booked::reaction, d, to.reaction + d);
    }
    add(Booked::work, 0, to.work);
    add(Booked::heat_from_fluid, 0, to.heat_from_fluid);
    add(Booked::exchange_gain, 0, to.exchange_gain);
    add(Booked::surface_work, 0, to.surface_work);
  }

 private:
  static constexpr auto count = static_cast<std::size_t>(Booked::count);
  static std::size_t place(Booked what, int direction) {
    return static_cast<std::size_t>(what) + static_cast<std::size_t>(direction);
  }

  std::array<ExactSum, count> forces_, work_, exchange_;
  std::array<Reduction::Sum, count> slots_;
};

}  // namespace sluice::mpmice

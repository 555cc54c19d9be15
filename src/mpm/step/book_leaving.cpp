#include "mpm/step/book_leaving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {
namespace {

using LeftSums = std::vector<ExactSum>;  // in the order of StepSums from left_x on

void add(const ParticleSet& set, const Columns& c, double reference_pressure,
         const std::vector<std::uint32_t>& leaving, std::size_t material, LeftSums& sums) {
  const double *mass = set.column(static_cast<std::size_t>(c.mass)),
               *energy = set.column(static_cast<std::size_t>(c.energy)),
               *volume = set.column(static_cast<std::size_t>(c.volume));
  const double* heat =
      c.lost_heat >= 0 ? set.column(static_cast<std::size_t>(c.lost_heat)) : nullptr;
  const double* open =
      c.open_energy >= 0 ? set.column(static_cast<std::size_t>(c.open_energy)) : nullptr;
  const auto v = read_columns<3>(set, c.velocity);
  const auto to = [&](std::size_t index) -> ExactSum& { return sums[index - StepSums::left_x]; };
  for (const std::uint32_t p : leaving) {
    double v2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      to(StepSums::left_x + d).add(mass[p] * v[d][p]);
      v2 += v[d][p] * v[d][p];
    }
    to(StepSums::left_kinetic).add(0.5 * mass[p] * v2);
    to(StepSums::left_internal).add(energy[p]);
    if (heat != nullptr) to(StepSums::left_internal).add(heat[p] + open[p]);
    to(StepSums::left_reference).add(-reference_pressure * volume[p]);
    to(StepSums::count + material).add(mass[p]);
  }
  if (c.water_mass < 0) return;
  const double* water = set.column(static_cast<std::size_t>(c.water_mass));
  const auto v_w = read_columns<3>(set, c.water_velocity);
  for (const std::uint32_t p : leaving) {
    for (std::size_t d = 0; d < 3; ++d) {
      to(StepSums::left_x + d).add(water[p] * v_w[d][p]);
      to(StepSums::left_kinetic).add(0.5 * water[p] * v_w[d][p] * v_w[d][p]);
    }
    to(StepSums::count + material).add(water[p]);
  }
}

// The side through which it goes stands in place of a task.
void tell(const Level& level, const ParticleSet& set, const std::vector<std::uint32_t>& leaving,
          int material, EventLedger& events) {
  for (const std::uint32_t p : leaving) {
    const Vec3 x = set.position(p);
    EventPlace place;
    place.level = level.index;
    place.material = material;
    place.value = static_cast<double>(set.id(p));
    IntVec3 cell{};
    for (int d = 0; d < 3; ++d) {
      const int at = static_cast<int>(std::floor((x[d] - level.anchor[d]) / level.spacing[d]));
      cell[d] = std::clamp(at, level.domain.lower[d], level.domain.upper[d] - 1);
      if (at != cell[d] && level.active[static_cast<std::size_t>(d)])
        place.task = fmt::format("through side {}{}", "xyz"[d], at < cell[d] ? '-' : '+');
    }
    place.cell = cell;
    events.record("particle left the domain", place);
  }
}

}  // namespace

void book_leaving(const MpmScene& solids, const std::vector<Carried>& carried,
                  const std::vector<Level>& levels, const ParticleCloud& cloud, Communicator& ranks,
                  std::vector<double>& sums, EventLedger& events) {
  LeftSums left(StepSums::count - StepSums::left_x + solids.materials.size());
  for (std::size_t m = 0; m < solids.materials.size(); ++m) {
    const int kind = static_cast<int>(m);
    for (int l = 0; l < cloud.store(kind).level_count(); ++l)
      for (int b = 0; b < cloud.store(kind).box_count(l); ++b) {
        tell(levels[static_cast<std::size_t>(l)], cloud.store(kind).set(l, b),
             cloud.leaving(kind, l, b), kind, events);
        add(cloud.store(kind).set(l, b), carried[m].columns,
            solids.materials[m].constants.reference_pressure, cloud.leaving(kind, l, b), m, left);
      }
  }
  Reduction reduction;
  std::vector<Reduction::Sum> slots;
  for (const ExactSum& s : left) slots.push_back(reduction.add_sum(s));
  ranks.reduce(reduction);
  for (std::size_t s = 0; s < slots.size(); ++s)
    sums[StepSums::left_x + s] += reduction.sum(slots[s]).value();
}

}  // namespace sluice::mpm

// Horizons against spacings of points and the domain.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "peridynamics/start/family_bound.hpp"

namespace sluice::peridynamics {
namespace {

void check_horizon(const Level& level, const PeriScene& s, const PeriMaterial& m,
                   std::vector<Fault>& faults) {
  for (const mpm::SeedObject& object :
       s.seeds.materials[static_cast<std::size_t>(m.index)].objects) {
    if (object.piece == nullptr) continue;
    const double dx = spacing_of(s, level, object), ratio = m.horizon / dx;
    const std::string what = fmt::format("the horizon {:g} m is {:.3g} spacings of points ({:g} m)",
                                         m.horizon, ratio, dx);
    if (ratio < 1.5 && s.partial_volume != PartialVolume::none)
      add_error(faults, object.where, what + "; at least 1.5 are needed",
                "a longer <horizon>, or more points (res)");
    else if (ratio < 2.5 && s.partial_volume != PartialVolume::none)
      add_warning(faults, object.where, what + "; 3 are the default");
    else if (ratio > 6)
      add_warning(faults, object.where, what + ": each point has thousands of bonds");
  }
  for (int d = 0; d < 3; ++d) {
    const double length = level.domain.size()[d] * level.spacing[d];
    const bool mirrored = std::any_of(s.mirrors.begin(), s.mirrors.end(),
                                      [&](Side side) { return direction_of(side) == d; });
    if (level.active[static_cast<std::size_t>(d)] &&
        (level.periodic[static_cast<std::size_t>(d)] ? 2.5
         : mirrored                                  ? 1.25
                                                     : 0) *
                m.horizon >
            length)
      add_error(faults, m.where,
                fmt::format("the horizon {:g} m reaches across the domain, {:g} m along {}, whose "
                            "sides are {}",
                            m.horizon, length, "xyz"[d],
                            level.periodic[static_cast<std::size_t>(d)] ? "periodic" : "symmetric"),
                "a shorter <horizon>, or a longer domain");
  }
}

}  // namespace

void check_horizons(const Level& level, const PeriScene& s, std::vector<Fault>& faults) {
  for (const PeriMaterial& m : s.materials) check_horizon(level, s, m, faults);
}

}  // namespace sluice::peridynamics

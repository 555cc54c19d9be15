#include "ice/budgets/step_limit.hpp"

#include "ice/internal_energy_form/limits.hpp"
#include "ice/step/step_bounds.hpp"

namespace sluice::ice {

namespace {

// threshold: share of sum |u| dt/dx, what flows out of a cell in a step, of its volume; unit: 1;
//   test: none
constexpr double flow_share = 0.9;
// threshold: dt 2 D sum 1/dx^2 of explicit steps: friction along its own direction acts with 4/3
//   mu, and steps bear 0.75; unit: 1; test: none
constexpr double explicit_diffusion_share = 0.7;
// threshold: the same of semi-implicit steps: parabolas at walls (viscous_stress.cpp) are stiffer
//   by a half, and in corners 0.8 is too much; unit: 1; test:
//   ImplicitManufacturedFlow.VorticesPassOpenSidesAtSecondOrder
constexpr double implicit_diffusion_share = 0.6;
// threshold: cells that sound crosses in a semi-implicit step: beyond, the pressure of a closed
//   box is hardly determined; unit: 1; test: ImplicitLimits.NearlySingularBoxGoesOn
constexpr double max_cells_of_sound = 2e4;

}  // namespace

StepLimit step_limit(const SchemeOptions& o, std::span<const double> maxima) {
  const double diffusion_share =
      o.scheme.implicit ? implicit_diffusion_share : explicit_diffusion_share;
  const double sound_share = o.scheme.internal_energy_form
                                 ? internal_energy_form::sound_share(o.grid.axes.count)
                                 : max_in_one_direction;
  StepLimit limit{o.scheme.cfl / maxima[StepSlots::deck_rate], o.scheme.conservative_time_step
                                                                   ? "deck: conservative rule"
                                                                   : "deck: cfl dx/(|u| + knob c)"};
  auto at_most = [&](double dt, const char* reason) {
    if (dt < limit.dt) limit = {dt, reason};
  };
  at_most(flow_share / maxima[StepSlots::flow_rate], "scheme: 0.9/sum |u|/dx");
  if (o.scheme.implicit) {
    at_most(max_cells_of_sound / maxima[StepSlots::sound_rate],
            "scheme: sound crosses 20,000 cells");
    if (maxima[StepSlots::flow_rate] == 0)
      at_most(o.scheme.cfl / maxima[StepSlots::sound_rate], "start from rest: cfl dx/c");
  } else
    at_most(sound_share / maxima[StepSlots::sound_rate],
            o.scheme.internal_energy_form ? "scheme: 0.98/sqrt(2 axes) dx/(|u| + c)"
                                          : "scheme: 0.8 dx/(|u| + c), 1/sum (|u| + c)/dx");
  const double diffusion = maxima[StepSlots::diffusion_rate];
  at_most(o.scheme.cfl / (o.scheme.diffusion_factor * diffusion),
          "deck: cfl/(2 knob D sum 1/dx^2)");
  at_most(diffusion_share / diffusion,
          o.scheme.implicit ? "scheme: 0.6/(2 D sum 1/dx^2)" : "scheme: 0.7/(2 D sum 1/dx^2)");
  return limit;
}

}  // namespace sluice::ice

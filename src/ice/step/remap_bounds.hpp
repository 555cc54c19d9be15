// Bounds of what the remap takes from a cell (docs/theory/ice_step.md, ice_materials.md).
#pragma once

namespace sluice::ice {

// threshold: outflow number that bounds divide by at least, so that they stay finite where little
//   flows out; unit: 1; test: RiemannProblem.SmallStepsDoNotCostAccuracy
constexpr double min_outflow = 0.05;
// threshold: share of the density, the internal energy and the pressure (above the lowest of the
//   law) of the donor that its face has at least; unit: 1; test:
//   RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double face_floor = 0.1;
constexpr double face_drop = 1.0 - face_floor;
// threshold: share of its density that what stays in a donor keeps at least; unit: 1; test:
//   RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double density_left = 0.05;
// threshold: share of its internal energy that what stays in a donor keeps at least; unit: 1;
//   test: RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double energy_left = 0.25;
// threshold: share of the mass of the donor that counts as passing at most, so that 1/(1 - f)
//   stays finite; unit: 1; test: none
constexpr double max_mass_passing = 0.99;

// What passes may have at most (gone + left N)/N of the density (internal energy) of the donor, N
// its outflow number.
constexpr double density_gone = 1.0 - density_left;
constexpr double energy_gone = 1.0 - energy_left;

}  // namespace sluice::ice

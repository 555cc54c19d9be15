// Bounds of what the remap takes from a cell (docs/theory/ice_step.md, ice_materials.md).
#pragma once

namespace sluice::ice {

// threshold: outflow number that bounds divide by at least, so that they stay finite where little
//   flows out; unit: 1; test: RiemannProblem.SmallStepsDoNotCostAccuracy
constexpr double min_outflow = 0.05;
// threshold: smallest share of the donor's density, internal energy and pressure (above the lowest
//   of the equation of state) that its face has; unit: 1; test:
//   RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double face_floor = 0.1;
constexpr double face_drop = 1.0 - face_floor;
// threshold: smallest share of its density that remains in a donor; unit: 1; test:
//   RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double density_left = 0.05;
// threshold: smallest share of its internal energy that remains in a donor; unit: 1; test:
//   RiemannProblem.ErrorIsThatOfAGoodGodunovCode
constexpr double energy_left = 0.25;
// threshold: largest share of the donor's mass that counts as passing, so that 1/(1 - f) stays
//   finite; unit: 1; test: none
constexpr double max_mass_passing = 0.99;

// threshold: share of its internal energy with which what passes may pay for the kinetic energy
//   that its slope gives it; unit: 1; test: ColdFlow.NeedsNoStepRedone
constexpr double cold_pays = 0.9;

// What passes may have at most (gone + left N)/N of the density (internal energy) of the donor, N
// its outflow number.
constexpr double density_gone = 1.0 - density_left;
constexpr double energy_gone = 1.0 - energy_left;

}  // namespace sluice::ice

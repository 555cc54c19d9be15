// What counts as an interface between materials, and what binds materials there.
#pragma once

namespace sluice::ice::mixture {

// threshold: distance of a volume fraction from 0 and 1 within which a cell has no interface, or
//   a trace; unit: 1; test: InterfaceSeeds.AreNotWhereThereAreTracesOrSmoothMixturesOfThem
constexpr double interface_band = 0.01;
// threshold: jump of a volume fraction from cell to cell up to which there is no interface
//   between materials that move apart; unit: 1; test: SlipSurface.HoldsAcrossAndSlipsAlong
constexpr double loose_jump = 0.25;
// threshold: jump of a volume fraction from cell to cell above which there is only an interface;
//   unit: 1; test: SlipSurface.HoldsAcrossAndSlipsAlong
constexpr double tight_jump = 0.75;
// threshold: largest strength s/(1 - s) of the coupling of materials; unit: 1; test: none
constexpr double strongest_bond = 1e12;

}  // namespace sluice::ice::mixture

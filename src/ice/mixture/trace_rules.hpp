// What is so little of a material that it passes a face at once or not at all (face_shares.cpp).
#pragma once

namespace sluice::ice::mixture {

// threshold: volume of a material, of that of the cell, that enters a cell without it at least;
//   unit: 1; test: CompactSupport.FragmentsStayTogether
constexpr double min_entry = 1e-16;
// threshold: share of the volume of a material that may stay behind in a cell that it leaves by
//   its only outlet; less leaves too; unit: 1; test: CompactSupport.FragmentsStayTogether
constexpr double min_rest = 1e-10;
// threshold: volume fraction below which a material leaves a cell by the main outlet alone; unit:
//   1; test: CompactSupport.NothingStaysBehindInObliqueFlow
constexpr double tiny = 1e-14;
// threshold: share of the volume fraction behind it to which a cell is filled before the front of
//   a material moves on; unit: 1; test: CompactSupport.FragmentsStayTogether
constexpr double min_fill = 0.5;
// threshold: volume fraction in a cell and in both of its neighbours below which its density and
//   energy have no slope; unit: 1; test: none
constexpr double min_sloped = 1e-10;
// threshold: outflow number below which a cell counts as one that nothing leaves; unit: 1; test:
//   none
constexpr double no_outflow = 1e-12;

}  // namespace sluice::ice::mixture

// What is so little of a material that it passes a face at once or not at all (face_shares.cpp).
#pragma once

namespace sluice::ice::mixture {

// threshold: smallest volume of a material, as a fraction of the cell's, that enters a cell without
//   it; unit: 1; test: CompactSupport.FragmentsStayTogether
constexpr double min_entry = 1e-16;
// threshold: fraction of a material in a cell below which a remainder leaves too, if the cell has
//   only one face with an outflow of it; unit: 1; test: CompactSupport.FragmentsStayTogether
constexpr double min_rest = 1e-10;
// threshold: volume fraction below which a material leaves a cell only through the face with
//   its largest outflow; unit: 1; test: CompactSupport.NothingStaysBehindInObliqueFlow
constexpr double tiny = 1e-14;
// threshold: volume fraction of a material in the donor cell, divided by that in the next cell
//   upstream, below which its front does not enter an empty cell; unit: 1; test:
//   CompactSupport.FragmentsStayTogether
constexpr double min_fill = 0.5;
// threshold: volume fraction in a cell and in both of its neighbours below which its density and
//   energy have no slope; unit: 1; test: none
constexpr double min_sloped = 1e-10;
// threshold: outflow number below which a cell counts as one without outflow; unit: 1; test: none
constexpr double no_outflow = 1e-12;

}  // namespace sluice::ice::mixture

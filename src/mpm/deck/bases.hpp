// The table of shape functions: how decks name them, and what each can do.
//
// Rules and readers ask the columns, never the word. A new basis is a row here and the weights in
// mpm/transfer.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/deck.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

struct BasisRow {
  Basis basis = Basis::linear;
  std::string_view word = {};      // <interpolator>
  std::string_view spelling = {};  // another one; empty: none
  std::string_view name = {};      // in lists of effects
  bool corners = false;            // particles are areas with corners, which follow the deformation
  bool cut_by_length = false;      // <cpdi_lcrit> acts
  bool moving_corners = false;     // corners move with the grid, and are shared
  bool points = false;             // particles have no width
  bool one_second_moment = false;  // of the weights, whatever the place: <transfer> apic
  bool needs_three_directions = false;  // of more than one cell
  bool axisymmetric = false;            // has a form with <axisymmetric>
  bool total_lagrangian = false;        // may stay as it is at the start
  bool implicit = false;                // has a form in implicit steps
  bool pore_water = false;              // has a form with water in pores
};

std::span<const BasisRow> basis_rows();
const BasisRow& row_of(Basis basis);
// Of <interpolator> in <MPM>; where it is absent or bad, the default.
const BasisRow& basis_of(const DeckNode& flags);

// Words of the rows for which a column is true, as "linear, gimp, ...".
std::string bases_with(bool BasisRow::*column);
// Words of all rows, in the order of the table.
std::vector<std::string> basis_words();

}  // namespace sluice::mpm

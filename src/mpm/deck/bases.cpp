#include "mpm/deck/bases.hpp"

#include <algorithm>

namespace sluice::mpm {
namespace {

constexpr BasisRow rows[] = {
    {.basis = Basis::linear,
     .word = "linear",
     .name = "linear",
     .points = true,
     .axisymmetric = true,
     .total_lagrangian = true,
     .implicit = true,
     .pore_water = true},
    {.basis = Basis::gimp,
     .word = "gimp",
     .name = "GIMP",
     .axisymmetric = true,
     .total_lagrangian = true,
     .implicit = true,
     .pore_water = true},
    {.basis = Basis::cpgimp, .word = "cpgimp", .name = "GIMP", .axisymmetric = true},
    {.basis = Basis::cpdi,
     .word = "cpdi",
     .name = "CPDI",
     .corners = true,
     .cut_by_length = true,
     .axisymmetric = true},
    {.basis = Basis::fast_cpdi,
     .word = "fast_cpdi",
     .name = "CPDI",
     .corners = true,
     .cut_by_length = true,
     .axisymmetric = true},
    {.basis = Basis::cpti,
     .word = "cpti",
     .name = "CPTI",
     .corners = true,
     .needs_three_directions = true},
    {.basis = Basis::quadratic,
     .word = "3rdorderBS",
     .spelling = "quadraticBS",
     .name = "quadratic B-spline",
     .one_second_moment = true,
     .total_lagrangian = true,
     .implicit = true,
     .pore_water = true},
    {.basis = Basis::cubic,
     .word = "4thorderBS",
     .spelling = "cubicBS",
     .name = "cubic B-spline",
     .one_second_moment = true,
     .total_lagrangian = true,
     .implicit = true,
     .pore_water = true},
    {.basis = Basis::carried,
     .word = "carried_corners",
     .name = "carried corners",
     .corners = true,
     .moving_corners = true},
};

}  // namespace

std::span<const BasisRow> basis_rows() {
  return rows;
}

const BasisRow& row_of(Basis basis) {
  return *std::find_if(std::begin(rows), std::end(rows),
                       [&](const BasisRow& row) { return row.basis == basis; });
}

const BasisRow& basis_of(const DeckNode& flags) {
  const DeckNode* node = flags.child("interpolator");
  if (node == nullptr) return rows[0];
  const auto* at = std::find_if(std::begin(rows), std::end(rows),
                                [&](const BasisRow& row) { return row.word == node->text; });
  return at != std::end(rows) ? *at : rows[0];
}

std::string bases_with(bool BasisRow::*column) {
  std::string text;
  for (const BasisRow& row : rows) {
    if (!(row.*column)) continue;
    text += text.empty() ? "" : ", ";
    text += row.word;
  }
  return text;
}

std::vector<std::string> basis_words() {
  std::vector<std::string> words;
  for (const BasisRow& row : rows) words.emplace_back(row.word);
  return words;
}

}  // namespace sluice::mpm

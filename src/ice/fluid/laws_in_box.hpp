// The laws of all materials in the cells of one box, for those who work on views of a state.
#pragma once
#include <vector>

#include "framework/field/array_view.hpp"
#include "ice/fluid/law_row.hpp"
#include "ice/fluid/mixed_gas.hpp"

namespace sluice::ice {

struct LawsInBox {
  const std::vector<Fluid>& fluids;
  const models::MixedGas* gas = nullptr;  // null: all laws are plain
  std::vector<RealView> fractions{};      // of the gas

  // Whether the law of a material is the same in all cells.
  bool plain(std::size_t m) const { return !is_mixed(gas, m); }
  bool all_plain() const { return gas == nullptr; }

  LawRow row(IntVec3 cell, std::size_t m) const {
    return plain(m) ? LawRow(fluids[m]) : LawRow(*gas, rows(cell));
  }
  // `room` holds a law that is made for the cell.
  const Fluid& at(IntVec3 cell, std::size_t m, Fluid& room) const {
    return plain(m) ? fluids[m] : row(cell, m).at(0, room);
  }
  // Gives a closure of one cell (Equilibration, CellClosure) those laws that are not plain.
  template <class Closure>
  void set(Closure& closure, IntVec3 cell) const {
    if (gas != nullptr) closure.set_law(gas->material, fluid_of(*gas, rows(cell)));
  }
  FractionRows rows(IntVec3 cell) const {
    FractionRows rows;
    for (std::size_t k = 0; k < fractions.size(); ++k) rows.of[k] = &fractions[k](cell);
    return rows;
  }
};

}  // namespace sluice::ice

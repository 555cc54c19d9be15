// The laws of all materials in the cells of a task: the one way in which a kernel asks for them.
//
// A task makes it while it is declared, so that it reads what the laws need; its kernel then asks
// for the law of a material along the row at hand (fluid/law_row.hpp).
#pragma once
#include <vector>

#include "ice/fluid/law_row.hpp"
#include "ice/fluid/mixed_gas.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Whether the law of material m differs from cell to cell.
inline bool is_mixed(const SchemeOptions& o, std::size_t m) {
  return is_mixed(o.materials.mixed, m);
}

class LawsOfCells {
 public:
  enum class When { old_state, new_state };

  LawsOfCells() = default;
  // Of all materials of a graph of several, of the one material otherwise.
  LawsOfCells(TaskBuilder& task, TaskList& list, const SchemeOptions& o,
              When when = When::old_state, Stencil stencil = Stencil::point());

  // Whether the law of a material is the same in all cells.
  bool plain(std::size_t m) const { return !is_mixed(gas_, m); }
  bool all_plain() const { return gas_ == nullptr; }

  // Shifted by `shift` cells along `axis`.
  LawRow of(const Row& row, std::size_t m, int axis = 0, int shift = 0) const {
    if (plain(m)) return LawRow(fluids_[m - first_]);
    return {*gas_, rows(row, axis, shift)};
  }
  // Of the one material of a graph.
  LawRow of_one(const Row& row, int axis = 0, int shift = 0) const {
    return of(row, first_, axis, shift);
  }
  // In cell i of the row; `room` holds a law that is made for it.
  const Fluid& at(const Row& row, std::size_t m, int i, Fluid& room) const {
    return of(row, m).at(i, room);
  }
  // Gives a closure of one cell (closure/cell_closure.hpp) those laws that are not plain.
  template <class Closure>
  void set(Closure& closure, const Row& row, int i) const {
    if (gas_ != nullptr) closure.set_law(gas_->material, fluid_of(*gas_, rows(row), i));
  }

 private:
  FractionRows rows(const Row& row, int axis = 0, int shift = 0) const {
    FractionRows rows;
    for (std::size_t k = 0; k < fractions_.size(); ++k)
      rows.of[k] = row(fractions_[k], 0, axis, shift);
    return rows;
  }

  std::vector<Fluid> fluids_;
  std::size_t first_ = 0;  // the material of the first of them
  const models::MixedGas* gas_ = nullptr;
  std::vector<In> fractions_;  // of the gas
};

// The scalar f of two streams among those of the scene, and its old and new state.
const models::TransportedScalar& fraction_of(const SchemeOptions& o);
VariableId old_fraction(TaskList& list, const SchemeOptions& o);
VariableId new_fraction(TaskList& list, const SchemeOptions& o);
// Of all fractions of the gas, in its order.
std::vector<const models::TransportedScalar*> fractions_of(const SchemeOptions& o);

}  // namespace sluice::ice

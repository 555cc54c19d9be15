// The end of a semi-implicit step where several materials may meet.
#pragma once
#include "ice/mixture/variables.hpp"
#include "ice/pressure/variables.hpp"

namespace sluice::ice::pressure {

struct EndOfMixtureInput {
  CutCellErrorInput error;
  mixture::MaterialStates state;
  std::vector<VariableId> mass_new, energy_new;
  VariableId pure, rho_L, energy_L, specific_energy_L, stretch, strain, new_pressure;
  VariableId cut, cut_volume, cut_energy;  // where solids cut cells

  static EndOfMixtureInput of(const mixture::Variables& v) {
    const SchemeVariables& c = v.common;
    return {.error = CutCellErrorInput::of(c),
            .state = mixture::MaterialStates::of(v),
            .mass_new = v.mass_new,
            .energy_new = v.energy_new,
            .pure = v.pure,
            .rho_L = c.rho_L,
            .energy_L = c.energy_L,
            .specific_energy_L = v.specific_energy_L,
            .stretch = v.stretch,
            .strain = v.strain,
            .new_pressure = c.new_pressure,
            .cut = v.cut,
            .cut_volume = v.cut_volume,
            .cut_energy = v.cut_energy};
  }
};
// With or without solids beside them.
void add_end_of_mixture(TaskList&, const EndOfMixtureInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice::pressure

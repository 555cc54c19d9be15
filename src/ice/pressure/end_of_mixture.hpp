// The end of a semi-implicit step where several materials may meet.
#pragma once
#include "ice/mixture/variables.hpp"
#include "ice/pressure/variables.hpp"

namespace sluice::ice::pressure {

struct EndOfMixtureInput {
  CutCellErrorInput error;
  mixture::StateOfEach state;
  std::vector<VariableId> mass_new, energy_new;
  VariableId pure, rho_L, energy_L, specific_energy_L, stretch, strain, new_pressure;
  VariableId cut, cut_volume, cut_energy;  // where solids cut cells

  static EndOfMixtureInput of(const mixture::Variables& v) {
    const SchemeVariables& c = v.common;
    return {CutCellErrorInput::of(c),
            mixture::StateOfEach::of(v),
            v.mass_new,
            v.energy_new,
            v.pure,
            c.rho_L,
            c.energy_L,
            v.specific_energy_L,
            v.stretch,
            v.strain,
            c.new_pressure,
            v.cut,
            v.cut_volume,
            v.cut_energy};
  }
};
// With or without solids beside them.
void add_end_of_mixture(TaskList&, const EndOfMixtureInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice::pressure

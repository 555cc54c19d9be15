// Transport in the graph of a step: what is off is not there, what is on only as much as it needs.
#include "ice/transport/viscosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ice/ice.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice::viscosity_test {
namespace {

SchemeOptions cube() {
  SchemeOptions o;
  o.grid.axes = {3, {0, 1, 2}};
  o.grid.components = 3;
  o.materials.fluid = ideal_gas(1.4, 1.0);
  return o;
}

// Names of the tasks of transport, joined.
std::string tasks(const SchemeOptions& o) {
  TaskList list;
  const SchemeVariables v = declare_conservative_variables(list, o);
  add_transport(list, TransportInput::of(v), o, effect_viscosity, effect_turbulence);
  add_viscous_stress(list, ViscousStressInput::of(v), o, effect_viscosity);
  add_heat_flux(list, HeatFluxInput::of(v), o, effect_conduction);
  std::string names;
  for (const Task& task : list.tasks()) names += task.name + "; ";
  return names;
}

std::size_t variables(const SchemeOptions& o) {
  TaskList list;
  declare_conservative_variables(list, o);
  return list.variables().size();
}

TEST(Transport, WhatIsOffAddsNothing) {
  EXPECT_EQ(tasks(cube()), "");
}

TEST(Transport, ConstantsNeedNoFields) {
  SchemeOptions o = cube();
  o.transport.viscous = o.transport.conducting = true;
  o.transport.viscosity = o.transport.conductivity = 1;
  EXPECT_EQ(tasks(o),
            "stress on axis 0; stress on axis 1; stress on axis 2; temperature; heat flux on axis "
            "0; heat flux on axis 1; heat flux on axis 2; ");
  // Temperature, three fluxes, the heat capacity.
  EXPECT_EQ(variables(o), variables(cube()) + 5);
}

TEST(Transport, LawsAndEddiesFillTheirFields) {
  SchemeOptions o = cube();
  o.transport.viscous = o.transport.viscosity_varies = true;
  o.transport.models.sutherland = Sutherland{1, 1};
  EXPECT_EQ(tasks(o),
            "molecular viscosity; stress on axis 0; stress on axis 1; stress on axis 2; ");
  o.transport.conducting = o.transport.conductivity_varies = true;
  o.transport.models.turbulence.emplace();
  EXPECT_EQ(tasks(o).substr(0, 54), "molecular viscosity; eddy viscosity; total viscosity; ");
}

TEST(Transport, FilterWidthIsTheMeanOfActiveSpacings) {
  SchemeOptions o = cube();
  o.transport.models.turbulence.emplace();
  o.transport.models.turbulence->filter_width = 2;
  EXPECT_DOUBLE_EQ(filter_width(o, {1, 2, 4}), 4);
  o.grid.axes = {2, {0, 2, 1}};
  EXPECT_DOUBLE_EQ(filter_width(o, {1, 7, 4}), 4);
  o.grid.axes = {1, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(filter_width(o, {1, 3, 4}), 6);
}

}  // namespace
}  // namespace sluice::ice::viscosity_test

// What decks may say of viscosity models, turbulence and wall laws, and what they are told.
#include "ice/deck/read_transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/deck/schema.hpp"

namespace sluice::ice::read_transport_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string material(const std::string& more) {
  return "<material name='gas'><EOS type='ideal_gas'/><dynamic_viscosity>0.1</dynamic_viscosity>" +
         more +
         "<thermal_conductivity>0</thermal_conductivity><specific_heat>1</specific_heat>"
         "<gamma>1.4</gamma><geom_object><null/><velocity>[0,0,0]</velocity><density>1</density>"
         "<temperature>1</temperature></geom_object></material>";
}

Deck deck(const std::string& ice, const std::string& models = "", const std::string& other = "",
          const std::string& faces = "") {
  Schema schema;
  add_framework_tags(schema);
  add_ice_tags(schema);
  return load_deck_text(
      "<Uintah_specification><Meta><title>t</title></Meta><SimulationComponent type='ice'/>"
      "<Time><maxTime>1</maxTime><initTime>0</initTime><delt_min>0</delt_min>"
      "<delt_max>1</delt_max><timestep_multiplier>1</timestep_multiplier></Time><Grid>" +
          faces +
          "<Level><Box><lower>[0,0,0]</lower><upper>[1,1,1]</upper><resolution>[4,4,4]"
          "</resolution></Box><periodic>[1,1,1]</periodic></Level></Grid><DataArchiver>"
          "<filebase>gas.uda</filebase><outputInterval>1</outputInterval></DataArchiver>"
          "<CFD><cfl>0.4</cfl><ICE><advection type='SecondOrder'/>" +
          ice +
          "</ICE></CFD><PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>1"
          "</reference_pressure></PhysicalConstants><MaterialProperties><ICE>" +
          material(models) + other + "</ICE></MaterialProperties></Uintah_specification>",
      "t.ups", {}, schema);
}

std::string said(const Deck& d) {
  std::string text;
  for (const Fault& fault : d.faults) text += to_string(fault) + '\n';
  return text;
}

const char* const smagorinsky =
    "<turbulence model='Smagorinsky'><model_constant>0.1</model_constant><filter_width>1.5"
    "</filter_width><turb_Pr>0.4</turb_Pr></turbulence>";
const char* const sutherland =
    "<dynamicViscosityModels><Model name='Sutherland'><a>1.458e-6</a><b>110.4</b></Model>"
    "<Model name='SpongeLayer'><maxDynamicViscosity>1</maxDynamicViscosity><box label='s'>"
    "<min>[0,0,0]</min><max>[1,1,1]</max></box></Model></dynamicViscosityModels>";

TEST(TransportSettings, ReadsTurbulence) {
  const Deck d = deck(smagorinsky);
  ASSERT_TRUE(d.good()) << said(d);
  const auto t = read_turbulence(*d.root->find("CFD/ICE"));
  ASSERT_TRUE(t);
  EXPECT_FALSE(t->dynamic);
  EXPECT_EQ(t->constant, 0.1);
  EXPECT_EQ(t->filter_width, 1.5);
  EXPECT_EQ(t->prandtl, 0.4);
  for (const char* name : {"Germano", "DynamicSmagorinsky"}) {
    const Deck other = deck(std::string("<turbulence model='") + name + "'/>");
    ASSERT_TRUE(other.good()) << said(other);
    const auto dynamic = read_turbulence(*other.root->find("CFD/ICE"));
    EXPECT_TRUE(dynamic->dynamic);
    EXPECT_EQ(dynamic->prandtl, 0.9);
    EXPECT_EQ(dynamic->test_filter_width, 2);
  }
}

TEST(TransportSettings, ReadsViscosityModels) {
  const Deck d = deck("", sutherland);
  ASSERT_TRUE(d.good()) << said(d);
  const ViscosityModels m = read_viscosity_models(*d.root->find("MaterialProperties/ICE/material"));
  ASSERT_TRUE(m.sutherland);
  // Air at 273.15 K: 1.716e-5 Pa s (F. M. White, Viscous Fluid Flow, table 1-2).
  EXPECT_NEAR(m.sutherland->viscosity(273.15) / 1.716e-5, 1, 2e-3);
  ASSERT_EQ(m.sponges.size(), 1u);
  EXPECT_EQ(m.sponges[0].viscosity, 1);
  EXPECT_EQ(m.sponges[0].boxes.size(), 1u);
  EXPECT_EQ(m.sponges[0].boxes[0].upper, (Vec3{1, 1, 1}));
}

TEST(TransportSettings, TellsWhatIsMissing) {
  EXPECT_THAT(said(deck("<turbulence model='Smagorinsky'/>")), HasSubstr("needs <model_constant>"));
  EXPECT_THAT(said(deck("<turbulence model='Germano'><model_constant>1</model_constant>"
                        "</turbulence>")),
              HasSubstr("<model_constant> has no effect"));
  EXPECT_THAT(said(deck("",
                        "<dynamicViscosityModels><Model name='Sutherland'><a>1</a></Model>"
                        "</dynamicViscosityModels>")),
              HasSubstr("<Model name=\"Sutherland\"> needs <b>"));
  const std::string layer = said(
      deck("", "<dynamicViscosityModels><Model name='SpongeLayer'/></dynamicViscosityModels>"));
  EXPECT_THAT(layer, HasSubstr("needs <maxDynamicViscosity>"));
  EXPECT_THAT(layer, HasSubstr("needs <box>"));
  EXPECT_THAT(said(deck("<wallShearStress model='logLawModel'><domainFace>x-</domainFace>"
                        "</wallShearStress>")),
              HasSubstr("needs <roughnessConstant>"));
  EXPECT_THAT(said(deck("<wallShearStress model='smoothwall'><domainFace>up</domainFace>"
                        "</wallShearStress>")),
              HasSubstr("there is no side 'up'"));
}

TEST(TransportSettings, RefusesWhatDoesNotGoTogether) {
  const std::string internal_energy_form = "<scheme>classic</scheme>";
  EXPECT_THAT(said(deck(internal_energy_form + smagorinsky)),
              HasSubstr("<scheme> classic has no <turbulence>"));
  EXPECT_THAT(said(deck(internal_energy_form, sutherland)),
              HasSubstr("<scheme> classic has no <dynamicViscosityModels>"));
  EXPECT_THAT(said(deck(smagorinsky, sutherland, material(""))), Not(HasSubstr("turbulence")));
  const std::string slip =
      "<BoundaryConditions><Face side='x-'><BCType id='0' label='Velocity' var='slip'>"
      "<value>[0,0,0]</value></BCType></Face></BoundaryConditions>";
  EXPECT_THAT(said(deck(smagorinsky, "", "", slip)),
              HasSubstr("slip needs a constant <dynamic_viscosity>; this deck has <turbulence>"));
  EXPECT_THAT(said(deck("", "", "", slip)), Not(HasSubstr("constant <dynamic_viscosity>")));
}

}  // namespace
}  // namespace sluice::ice::read_transport_test

// What ICE decks may say: defaults, rules that pass, rules that fire.
#include "ice/deck/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/deck/format_labels.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/exchange_settings.hpp"

namespace sluice::schema_test {
namespace {

using ::testing::HasSubstr;

// A periodic box of gas, with places to add things.
struct Sample {
  std::string ice, material, object_pressure = "<pressure>0.4</pressure>", faces, level, more;
  std::string periodic = "<periodic>[1,1,1]</periodic>", gravity = "[0,0,0]";

  Deck load() const {
    Schema schema;
    add_framework_tags(schema, {{"ice", {"ICE"}}});
    add_ice_tags(schema);
    return load_deck_text(text(), "gas.ups", {}, schema);
  }
  std::string text() const {
    return "<Uintah_specification><SimulationComponent type='ICE'/>"
           "<Time><maxTime>1</maxTime><initTime>0</initTime><delt_min>0</delt_min>"
           "<delt_max>1</delt_max><timestep_multiplier>1</timestep_multiplier></Time>"
           "<Grid>" +
           faces +
           "<Level><Box><lower>[0,0,0]</lower><upper>[1,1,1]</upper>"
           "<resolution>[4,4,4]</resolution></Box>" +
           periodic +
           "</Level></Grid>"
           "<DataArchiver><filebase>gas.uda</filebase><outputInterval>1</outputInterval>"
           "</DataArchiver>"
           "<CFD><cfl>0.4</cfl><ICE><advection type='FirstOrder' compatibleFluxes='false'/>" +
           ice +
           "</ICE></CFD>"
           "<PhysicalConstants><gravity>" +
           gravity +
           "</gravity><reference_pressure>1</reference_pressure></PhysicalConstants>"
           "<MaterialProperties><ICE><material name='gas'><EOS type='ideal_gas'/>"
           "<dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>0"
           "</thermal_conductivity><specific_heat>1</specific_heat><gamma>1.4</gamma>" +
           material +
           "<geom_object><null/><velocity>[0,0,0]</velocity><density>1</density>"
           "<temperature>1</temperature>" +
           object_pressure + "</geom_object></material></ICE></MaterialProperties>" + more +
           "</Uintah_specification>";
  }
};

std::string messages(const Deck& deck) {
  std::string text;
  for (const Fault& fault : deck.faults) text += to_string(fault) + '\n';
  return text;
}

TEST(IceSchema, FillsInTheDefaultsOfIce) {
  const Deck deck = Sample{}.load();
  ASSERT_TRUE(deck.good()) << messages(deck);
  const DeckNode& ice = *deck.root->find("CFD/ICE");
  EXPECT_EQ(ice.string("scheme"), "conservative");
  EXPECT_EQ(ice.need("TimeStepControl").string("Scheme_for_delT_calc"), "aggressive");
  EXPECT_EQ(ice.need("TimeStepControl").real("knob_for_speedSound"), 1.0);
  EXPECT_TRUE(ice.boolean("applyHydrostaticPressure"));
  EXPECT_EQ(ice.need("advection").attribute("useCompatibleFluxes"), "false");
  EXPECT_EQ(ice.child("customInitialization"), nullptr);
  const DeckNode& material = *deck.root->find("MaterialProperties/ICE/material");
  EXPECT_FALSE(material.boolean("isSurroundingMatl"));
  EXPECT_EQ(material.need("geom_object").int_vector("res"), (IntVec3{2, 2, 2}));
  EXPECT_EQ(deck.root->child("SimulationComponent")->attribute("type"), "ice");
}

TEST(IceSchema, ReadsFormulasAndTheClassicScheme) {
  Sample sample;
  sample.ice =
      "<scheme>classic</scheme><customInitialization><formula><density>1 + 0.1*sin(x)</density>"
      "<velocity_x>y</velocity_x></formula></customInitialization>";
  const Deck deck = sample.load();
  ASSERT_TRUE(deck.good()) << messages(deck);
  EXPECT_EQ(deck.root->find("CFD/ICE/customInitialization/formula/density")->text,
            "1 + 0.1*sin(x)");
  EXPECT_EQ(deck.root->find("CFD/ICE/scheme")->text, "classic");
}

TEST(IceSchema, NeedsNoConditionsWherePeriodic) {
  Sample sample;
  EXPECT_EQ(messages(sample.load()), "");
  sample.periodic = "<periodic>[1,0,1]</periodic>";
  const std::string said = messages(sample.load());
  EXPECT_THAT(said, HasSubstr("side y- has no boundary conditions"));
  EXPECT_THAT(said, HasSubstr("side y+ has no boundary conditions"));
  EXPECT_EQ(said.find("side x"), std::string::npos);
}

TEST(IceSchema, JoinsFacesOfOneSide) {
  const auto condition = [](const std::string& label, const std::string& value) {
    return "<BCType id='0' label='" + label + "' var='Neumann' value='" + value + "'/>";
  };
  Sample sample;
  sample.periodic = "<periodic>[1,0,1]</periodic>";
  sample.faces = "<BoundaryConditions><Face side='y-'>" + condition("Pressure", "0") +
                 condition("Velocity", "[0,0,0]") + "</Face><Face side='y-'>" +
                 condition("Density", "0") + condition("Temperature", "0") +
                 "</Face><Face side='y+'><BCType id='all' label='Symmetric' var='symmetry'/></Face>"
                 "<Face circle='y-' origin='0 0 0' radius='0.2'>" +
                 condition("Pressure", "0") + "</Face></BoundaryConditions>";
  const Deck deck = sample.load();
  EXPECT_THAT(messages(deck),
              HasSubstr("circle y- has no condition for Velocity, Temperature, Density"));
  EXPECT_EQ(messages(deck).find("side y"), std::string::npos) << messages(deck);
}

// A condition for one material beside one for all is the exception from it.
TEST(IceSchema, TellsARepeatedConditionFromAnException) {
  const std::string all =
      "<Face side='y-'><BCType id='all' label='Symmetric' var='symmetry'/>"
      "<BCType id='all' label='Density' var='Neumann' value='0'/>";
  Sample sample;
  sample.periodic = "<periodic>[1,0,1]</periodic>";
  const auto said = [&](const std::string& more) {
    sample.faces = "<BoundaryConditions>" + all + more +
                   "</Face><Face side='y+'><BCType id='all' label='Symmetric' var='symmetry'/>"
                   "</Face></BoundaryConditions>";
    return messages(sample.load());
  };
  EXPECT_EQ(said("<BCType id='0' label='Density' var='Dirichlet' value='2'/>"), "");
  EXPECT_THAT(said("<BCType id='all' label='Density' var='Neumann' value='0.0'/>"),
              HasSubstr("warning: second condition for Density of all materials on side y-"));
  EXPECT_THAT(said("<BCType id='all' label='Density' var='Neumann' value='1'/>"),
              HasSubstr("error: second condition for Density of all materials on side y-"));
  EXPECT_THAT(said("<BCType id='all' label='Symmetric' var='symmetry' value='7'/>"),
              HasSubstr("warning: second condition for Symmetric"));
}

TEST(IceSchema, WarnsOfAPressureThatContradicts) {
  Sample sample;
  sample.object_pressure = "<pressure>0.4003</pressure>";  // 0.075 % from 0.4
  EXPECT_EQ(messages(sample.load()), "");
  sample.object_pressure = "<pressure>0.4005</pressure>";  // 0.125 %
  const Deck deck = sample.load();
  EXPECT_TRUE(deck.good());
  EXPECT_THAT(messages(deck), HasSubstr("warning: <pressure> 0.4005 contradicts"));
  sample.object_pressure = "";
  EXPECT_EQ(messages(sample.load()), "");
}

// Counts how often `piece` stands in the text.
int count_of(const std::string& text, const std::string& piece) {
  int count = 0;
  for (auto at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++count;
  return count;
}

TEST(IceSchema, SaysNothingOfThePressureOfAGasThatCannotBe) {
  for (const char* change : {"<gamma>1.4|<gamma>0.9", "<specific_heat>1|<specific_heat>-1",
                             "<density>1|<density>-1", "<temperature>1|<temperature>-1"}) {
    const std::string edit = change;
    const auto bar = edit.find('|');
    std::string text = Sample{}.text();
    text.replace(text.find(edit.substr(0, bar)), bar, edit.substr(bar + 1));
    Schema schema;
    add_framework_tags(schema, {{"ice", {"ICE"}}});
    add_ice_tags(schema);
    const Deck deck = load_deck_text(text, "gas.ups", {}, schema);
    EXPECT_FALSE(deck.good()) << edit;
    EXPECT_EQ(count_of(messages(deck), "contradicts"), 0) << messages(deck);
  }
}

TEST(IceSchema, AnUnknownBoundaryVariableIsOneFault) {
  Sample sample;
  sample.faces =
      "<BoundaryConditions><Face side='x-'><BCType id='0' label='Velocty' var='Dirichlet'>"
      "<value>[0,0,0]</value></BCType></Face></BoundaryConditions>";
  const std::string text = messages(sample.load());
  EXPECT_EQ(count_of(text, "there is no boundary variable"), 1) << text;
  EXPECT_EQ(count_of(text, "is not a number"), 0) << text;
}

TEST(IceSchema, LetsModelsAndOtherComponentsHaveTheirOwnLabels) {
  Sample sample;
  sample.more =
      "<DataAnalysis><Module name='vorticity'><material>gas</material></Module>"
      "</DataAnalysis>";
  EXPECT_EQ(messages(sample.load()), "");
  const FieldLabels labels = ice_field_labels();
  EXPECT_THAT(labels.built, ::testing::IsSupersetOf({"rho_CC", "vel_CC", "uvel_FCME", "TotalMass",
                                                     "refineFlag", "delP_Dilatate"}));
  for (const std::string& label : labels.not_built) {
    EXPECT_EQ(std::count(labels.built.begin(), labels.built.end(), label), 0) << label;
  }
  for (const std::string& label : labels.built)
    EXPECT_EQ(find_foreign_label(label), nullptr) << label;
}

// What is said of a deck that saves this label too.
std::string said_of_save(std::string text, const std::string& label) {
  text.insert(text.find("</DataArchiver>"), "<save label='" + label + "'/>");
  Schema schema;
  add_framework_tags(schema, {{"ice", {"ICE"}}});
  add_ice_tags(schema);
  return messages(load_deck_text(text, "one.ups", {}, schema));
}

// Fields of errors that the scheme has not.
TEST(IceSchema, DropsLabelsOfWhatIsZeroByConstruction) {
  for (const char* label : {"mom_exch_error", "eng_exch_error", "mass_X_FC_flux"}) {
    std::string text = Sample{}.text();
    text.replace(text.find("'ICE'"), 5, "'ice'");
    const std::string said = said_of_save(text, label);
    EXPECT_THAT(said, ::testing::HasSubstr(std::string("variable '") + label + "' is not a field"));
    EXPECT_EQ(said.find("error:"), std::string::npos) << said;
  }
}

// The deck with a second material of this fill.
Deck with_a_second_material(const std::string& exchange, const std::string& gravity = "[0,0,0]",
                            const std::string& more = "", const std::string& ice = "") {
  Sample sample;
  sample.ice = ice;
  sample.object_pressure = "";
  std::string text = sample.text();
  const std::string end = "</material></ICE>";
  text.replace(text.find(end), end.size(),
               "</material><material name='water'><EOS type='StiffenedGas'><pinf>6e8</pinf></EOS>"
               "<dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>0"
               "</thermal_conductivity><specific_heat>1</specific_heat><gamma>4.4</gamma>" +
                   more +
                   "<geom_object><null/><velocity>[0,0,0]</velocity><density>1</density>"
                   "<temperature>1</temperature></geom_object></material></ICE>" +
                   exchange);
  text.replace(text.find("<gravity>[0,0,0]"), 16, "<gravity>" + gravity);
  Schema schema;
  add_framework_tags(schema, {{"ice", {"ICE"}}});
  add_ice_tags(schema);
  return load_deck_text(text, "two.ups", {}, schema);
}

std::string coefficients(const std::string& momentum, const std::string& heat) {
  return "<exchange_properties><exchange_coefficients><momentum>" + momentum + "</momentum><heat>" +
         heat + "</heat></exchange_coefficients></exchange_properties>";
}

TEST(IceSchema, CountsExchangeCoefficients) {
  EXPECT_THAT(messages(with_a_second_material(coefficients("[1e10,1e10]", "[1]"))),
              HasSubstr("<momentum> has 2 coefficients; 2 materials have 1 pair: 0-1"));
  EXPECT_THAT(messages(with_a_second_material(coefficients("[1e10]", "[1,2,3]"))),
              HasSubstr("<heat> has 3 coefficients; 2 materials have 1 pair: 0-1"));
  const std::string empty = messages(with_a_second_material(coefficients("[1e10]", "[]")));
  EXPECT_THAT(empty, HasSubstr("warning: <heat> is empty: 0 for each pair"));
  EXPECT_EQ(empty.find("error"), std::string::npos) << empty;
  const std::string good = messages(with_a_second_material(coefficients("[1e10]", "[0]")));
  EXPECT_EQ(good.find("coefficient"), std::string::npos) << good;
}

TEST(IceSchema, TakesAnyCoefficientOfMomentum) {
  constexpr const char* told = "momentum";
  for (const char* silent : {"[0]", "[100]", "[1e10]", "[1e20]"})
    EXPECT_THAT(messages(with_a_second_material(coefficients(silent, "[0]"))),
                testing::Not(HasSubstr(told)));
}

TEST(IceSchema, SaysThatMaterialsWithoutCoefficientsDoNotMeet) {
  EXPECT_THAT(messages(with_a_second_material("")),
              HasSubstr("warning: several materials without <exchange_properties>"));
  EXPECT_THAT(messages(with_a_second_material(
                  "<exchange_properties><exchange_coefficients><momentum>[1]</momentum>"
                  "</exchange_coefficients></exchange_properties>")),
              HasSubstr("warning: <exchange_coefficients> without <heat>"));
  for (const std::string& said :
       {messages(with_a_second_material(coefficients("[0]", "[0]"))), messages(Sample().load())})
    EXPECT_THAT(said, testing::Not(HasSubstr("exchange")));
}

TEST(IceSchema, ReadsHowCoefficientsVary) {
  std::string text = coefficients("[3]", "[7]");
  const auto read = [&](const char* momentum, const char* heat) {
    std::string varying = text;
    varying.insert(varying.find("<exchange_coeff"), std::string("<CoefficientModel><momentum>") +
                                                        momentum + "</momentum><heat>" + heat +
                                                        "</heat></CoefficientModel>");
    const Deck deck = with_a_second_material(varying);
    EXPECT_EQ(messages(deck).find("Coefficient"), std::string::npos) << messages(deck);
    return ice::read_exchange(*deck.root, 2);
  };
  const ice::ExchangeSettings heat = read("constant", "linearVariation");
  EXPECT_FALSE(heat.momentum.varies());
  EXPECT_TRUE(heat.heat.varies());
  EXPECT_EQ(heat.heat(0, 1), 7);
  EXPECT_EQ(heat.momentum.between(0, 1, 1, 1e9), 3);
  EXPECT_EQ(heat.heat.between(0, 1, 1, 1), 7);
  EXPECT_EQ(heat.heat.between(0, 1, 1, 1e9), 7e7);
  EXPECT_TRUE(read("linearVariation", "constant").momentum.varies());
}

TEST(IceSchema, TellsOfWeightThatNothingCarries) {
  Sample sample;
  sample.gravity = "[0,-9.8,0]";
  EXPECT_THAT(
      messages(sample.load()),
      HasSubstr("<gravity> acts along y, which is periodic: no boundary supports the weight"));
  sample.gravity = "[0,0,0]";
  EXPECT_EQ(messages(sample.load()), "");
}

TEST(IceSchema, AsksWhichMaterialMakesTheHydrostaticPressure) {
  EXPECT_THAT(messages(with_a_second_material("", "[0,-9.8,0]")),
              HasSubstr("no material is marked to determine the hydrostatic pressure"));
  for (const std::string& said :
       {messages(with_a_second_material("", "[0,-9.8,0]",
                                        "<isSurroundingMatl>true</isSurroundingMatl>")),
        messages(with_a_second_material(
            "", "[0,-9.8,0]", "", "<applyHydrostaticPressure>false</applyHydrostaticPressure>"))})
    EXPECT_EQ(said.find("hydrostatic pressure"), std::string::npos) << said;
}

TEST(IceSchema, LetsTheClassicSchemeHaveOneIdealGasOnly) {
  EXPECT_THAT(messages(with_a_second_material("", "[0,0,0]", "", "<scheme>classic</scheme>")),
              HasSubstr("<scheme> classic is for one material; this deck has 2"));
  EXPECT_THAT(messages(with_a_second_material("", "[0,0,0]", "", "<scheme>classic</scheme>")),
              HasSubstr("this deck has StiffenedGas"));
  Sample sample;
  sample.ice = "<scheme>classic</scheme>";
  sample.material = "<SpecificHeatModel type='airNasa'/>";
  EXPECT_THAT(messages(sample.load()), HasSubstr("has ideal_gas with <SpecificHeatModel>"));
}

TEST(IceSchema, WarnsOfAMixtureWithAnotherGasConstant) {
  Sample sample;
  sample.material =
      "<SpecificHeatModel type='Component'><XN2>0.7</XN2><XO2>0.3</XO2></SpecificHeatModel>";
  EXPECT_THAT(messages(sample.load()), HasSubstr("has a gas constant of 284.65"));
}

TEST(IceSchema, SaysThatPressureAlwaysWorks) {
  Sample sample;
  sample.material = "<includeFlowWork>false</includeFlowWork>";
  const Deck deck = sample.load();
  EXPECT_TRUE(deck.good());
  EXPECT_THAT(messages(deck), HasSubstr("<includeFlowWork> false has no effect"));
}

TEST(IceSchema, ChecksAddedHeat) {
  const auto said = [](const std::string& materials, const std::string& powers,
                       const std::string& stop) {
    Sample sample;
    sample.ice = "<ADD_HEAT><add_heat_matls>" + materials + "</add_heat_matls><add_heat_coeff>" +
                 powers + "</add_heat_coeff><add_heat_t_start>1</add_heat_t_start>" +
                 "<add_heat_t_final>" + stop + "</add_heat_t_final></ADD_HEAT>";
    return messages(sample.load());
  };
  EXPECT_EQ(said("[0]", "[3e9]", "2"), "");
  EXPECT_THAT(said("[1]", "[3e9]", "2"), HasSubstr("there is no material 1: the deck has 1"));
  EXPECT_THAT(said("[0]", "[1,2]", "2"), HasSubstr("has 2 numbers for 1 material"));
  EXPECT_THAT(said("[0]", "[1]", "1"), HasSubstr("no heat would be added"));
  Sample sample;
  sample.ice = "<ADD_HEAT/>";
  EXPECT_THAT(messages(sample.load()), HasSubstr("<ADD_HEAT> needs <add_heat_matls>"));
}

TEST(IceSchema, NamesWhatIsNotBuilt) {
  const auto said = [](auto change) {
    Sample sample;
    change(sample);
    const Deck deck = sample.load();
    EXPECT_FALSE(deck.good());
    for (const Fault& fault : deck.faults) {
      EXPECT_TRUE(fault.not_built || fault.severity != Severity::error) << to_string(fault);
    }
    return messages(deck);
  };
  EXPECT_THAT(said([](Sample& s) {
                s.ice =
                    "<customInitialization><manufacturedSolution type='mms_2'/>"
                    "</customInitialization>";
              }),
              HasSubstr("'mms_2'"));
}

}  // namespace
}  // namespace sluice::schema_test

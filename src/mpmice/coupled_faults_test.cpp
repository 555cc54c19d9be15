// What a deck of fluid and solids may get wrong, and states at the end of what can be computed:
// a message, or a run that keeps its books.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::coupled_faults_test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

CoupledDeck burning(const std::string& from, const std::string& to,
                    const std::string& rest =
                        "<ThresholdTemp>0</ThresholdTemp><ThresholdPressure>0</ThresholdPressure>"
                        "<Enthalpy>2e5</Enthalpy><BurnCoeff>75</BurnCoeff>"
                        "<refPressure>1e5</refPressure>") {
  CoupledDeck deck;
  deck.models =
      "<Model type='Simple_Burn'><Simple_Burn>" + from + to + rest + "</Simple_Burn></Model>";
  return deck;
}
constexpr const char* from_solid = "<fromMaterial>solid</fromMaterial>";
constexpr const char* to_gas = "<toMaterial>gas</toMaterial>";

std::string message_of(const CoupledDeck& deck) {
  try {
    const CoupledRun run(deck);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BurningDecks, NameWhatTheyAreMadeOf) {
  EXPECT_THAT(
      message_of(burning("<fromMaterial>solids</fromMaterial>", to_gas)),
      AllOf(HasSubstr("coupled.ups:"), HasSubstr("no material 'solids'"), HasSubstr("'solid'")));
  EXPECT_THAT(message_of(burning(from_solid, "<toMaterial>smoke</toMaterial>")),
              HasSubstr("no material 'smoke'"));
  EXPECT_THAT(message_of(burning("<fromMaterial>gas</fromMaterial>", to_gas)),
              AllOf(HasSubstr("coupled.ups:"), HasSubstr("<fromMaterial> is a fluid")));
  EXPECT_THAT(message_of(burning(from_solid, "<toMaterial>solid</toMaterial>")),
              HasSubstr("there would be no exchange"));
  EXPECT_THAT(message_of(burning(from_solid, "")), HasSubstr("needs <toMaterial>"));
  EXPECT_THAT(message_of(burning(from_solid, to_gas,
                                 "<ThresholdTemp>-1</ThresholdTemp><ThresholdPressure>0"
                                 "</ThresholdPressure><Enthalpy>2e5</Enthalpy><BurnCoeff>75"
                                 "</BurnCoeff><refPressure>1e5</refPressure>")),
              HasSubstr("'-1' is out of range"));
}

TEST(ConvectiveExchange, NamesAFluidAndWhatHasTheSurface) {
  const std::string exchange = "MaterialProperties/exchange_properties/";
  const auto of = [&](const char* fluid, const char* solid) {
    std::vector<std::string> tags = {exchange + "do_convective_heat_transfer=true"};
    if (fluid[0] != 0) tags.push_back(exchange + "convective_fluid=" + fluid);
    if (solid[0] != 0) tags.push_back(exchange + "convective_solid=" + solid);
    try {
      const CoupledRun run(CoupledDeck{}, tags);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(of("0", "1"), AllOf(HasSubstr("<convective_fluid>: material 0 is a solid"),
                                  HasSubstr("the fluids are 1 to 1: solids are counted first")));
  EXPECT_THAT(of("1", "1"), HasSubstr("are both 1: a material has no surface with itself"));
  EXPECT_THAT(of("2", "0"), HasSubstr("<convective_fluid>: there is no material 2"));
  EXPECT_THAT(of("1", ""), HasSubstr("<do_convective_heat_transfer> needs <convective_solid>"));
}

TEST(SolidsBesideAFluid, TakePartAllTheTime) {
  const auto of = [](const char* tags) {
    CoupledDeck deck;
    deck.solid = tags + deck.solid;
    return message_of(deck);
  };
  EXPECT_THAT(of("<is_active>false</is_active>"), HasSubstr("<is_active> false with a fluid"));
  EXPECT_THAT(of("<deactivation_time>0.1</deactivation_time>"),
              HasSubstr("<deactivation_time> with a fluid"));
  EXPECT_THAT(of("<is_rigid>true</is_rigid><is_force_transmitting_material>true"
                 "</is_force_transmitting_material>"),
              HasSubstr("<is_force_transmitting_material> with a fluid"));
}

bool finite(const CoupledRun& run, int gas = 1) {
  for (const char* label : {"press_CC", "temp_CC", "vel_CC"})
    for (const auto& component : run.field(label, label[0] == 'p' ? 0 : gas).components)
      for (const double q : component)
        if (!std::isfinite(q)) return false;
  return true;
}

// A rate at which all would be gone within a step.
TEST(BurningRuns, BurnNoMoreThanThereIs) {
  CoupledDeck deck = burning(from_solid, to_gas,
                             "<ThresholdTemp>0</ThresholdTemp><ThresholdPressure>0"
                             "</ThresholdPressure><Enthalpy>2e5</Enthalpy><BurnCoeff>1e6"
                             "</BurnCoeff><refPressure>1e5</refPressure>");
  deck.cells = "[24,24,1]";
  deck.upper = "[1,1,0.041666666666666664]";
  deck.time = "0.0004";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_TRUE(finite(run));
  EXPECT_THROW(run.particles("p.x"), std::runtime_error);  // none is left
}

CoupledDeck bars(const char* speed, const char* back) {
  CoupledDeck deck;
  deck.cells = "[50,1,1]";
  deck.upper = "[1,0.02,0.02]";
  deck.time = "0.001";
  const auto bar = [](double low, double high, const char* v) {
    return solid_object(
        fmt::format("<box><min>[{},-1,-1]</min><max>[{},2,2]</max></box>", low, high), v,
        "[2,1,1]");
  };
  deck.solid = bar(0.2, 0.4, speed);
  deck.further = solid_of(deck, "other", bar(0.5, 0.7, back));
  deck.drag = deck.heat = "0,0,0";
  return deck;
}

// No contact holds them: the gas between is squeezed to nothing, and they overlap.
TEST(GasBetweenSolids, MayBeSqueezedToNothing) {
  const CoupledRun run(bars("[60,0,0]", "[-60,0,0]"));
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
  EXPECT_TRUE(finite(run, 2));
}

// The same between bodies that do not give way: the step is redone, then the run ends and says
// where, or the gas escapes; never a number that is none.
TEST(GasBetweenSolids, ThatDoNotGiveWayEndsWithAReason) {
  CoupledDeck deck = bars("[600,0,0]", "[-600,0,0]");
  deck.density = "7800";
  deck.bulk = "1.6e11";
  deck.shear = "8e10";
  const CoupledRun run(deck);
  if (run.report().status == RunStatus::done) {
    EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
    EXPECT_TRUE(finite(run, 2));
  } else {
    EXPECT_THAT(run.report().message,
                AllOf(HasSubstr("step"), AnyOf(HasSubstr("cell ["), HasSubstr("particle "))));
  }
}

// Surfaces in grid planes, on a side of the domain: the gas above rests, the block too.
TEST(BlockOnAWall, StandsInGasAtRest) {
  CoupledDeck deck;
  deck.cells = "[20,20,1]";
  deck.upper = "[1,1,0.05]";
  deck.solid = solid_object(box_from("[0.3,0,-1]", "[0.7,0.4,2]"), "[0,0,0]");
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  const DenseField p = run.field("press_CC", 0);
  for (const double q : p.components[0]) EXPECT_NEAR(q, 1e5, 1e-5);
  for (const auto& component : run.particles("p.velocity"))
    for (const double v : component) EXPECT_NEAR(v, 0, 1e-9);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

// Gas that blows over it, with faces covered along the wall and a corner in a grid node.
TEST(BlockOnAWall, KeepsTheBooksInAWind) {
  CoupledDeck deck;
  deck.cells = "[20,20,1]";
  deck.upper = "[1,1,0.05]";
  deck.solid = solid_object(box_from("[0.3,0,-1]", "[0.7,0.4,2]"), "[0,0,0]");
  deck.gas = gas_object(box_from("[-1,-1,-1]", "[0.2,2,2]"), 3e5) +
             gas_object(box_from("[0.2,-1,-1]", "[2,2,2]"), 1e5);
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_TRUE(finite(run));
}

// Rigid disks in one another: what both fill is closed to the fluid.
TEST(RigidDisks, MayOverlap) {
  CoupledDeck deck;
  deck.cells = "[24,24,1]";
  deck.upper = "[1,1,0.041666666666666664]";
  deck.solid = "<is_rigid>true</is_rigid>" + solid_object(disk_at(0.4, 0.5, 0.15), "[50,0,0]");
  deck.further =
      solid_of(deck, "other",
               "<is_rigid>true</is_rigid>" + solid_object(disk_at(0.55, 0.5, 0.15), "[-50,0,0]"));
  deck.drag = deck.heat = "0,0,0";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(std::fabs(run.drift("mass of material 2")), 1e-13);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-6);  // momentum, measured 3e-7
  EXPECT_TRUE(finite(run, 2));
}

// A frame whose hole closes upon gas that has nowhere to go.
TEST(ClosingPocket, IsToldOrKept) {
  CoupledDeck deck;
  deck.cells = "[24,24,1]";
  deck.upper = "[1,1,0.041666666666666664]";
  deck.density = "1000";
  deck.bulk = "1e8";
  deck.shear = "6e7";
  const auto plate = [](const char* low, const char* high, const char* v) {
    return solid_object(box_from(low, high), v);
  };
  deck.solid = plate("[0.2,0.2,-1]", "[0.47,0.8,2]", "[80,0,0]") +
               plate("[0.53,0.2,-1]", "[0.8,0.8,2]", "[-80,0,0]");
  const CoupledRun run(deck);
  if (run.report().status == RunStatus::done) {
    EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
    EXPECT_TRUE(finite(run));
  } else {
    EXPECT_THAT(run.report().message, AllOf(HasSubstr("step"), HasSubstr("[")));
  }
}

}  // namespace
}  // namespace sluice::mpmice::coupled_faults_test

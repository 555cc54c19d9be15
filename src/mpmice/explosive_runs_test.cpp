// Explosive that burns and detonates, in runs: against the laws of its parts, the books, and itself
// on other boxes, threads and after a restart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/test_support/hmx.hpp"
#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::explosive_runs_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string model = "Models/Model/DDT1/";
std::vector<std::string> until(const char* time, std::vector<std::string> changes = {}) {
  changes.push_back(std::string("Time/maxTime=") + time);
  return changes;
}
std::vector<double> kinds(const CoupledRun& run) {
  const std::vector<double> all = run.field("burning", 0).components[0];
  for (std::size_t i = 0; i < 44; ++i) EXPECT_EQ(all[i], 0) << i;
  return {all.begin() + 44, all.end()};
}

// The flame comes to the surface after 0.2 ms, then goes through the cracks at F_b/I: a cell in 0.2
// ms.
TEST(ExplosiveRuns, FlamesComeAfterTheirDelay) {
  EXPECT_EQ(kinds(CoupledRun("explosive", until("0.00019"))),
            (std::vector<double>{1, 0, 0, 0, 0, 0}));
  const CoupledRun second("explosive", until("0.00037"));
  EXPECT_EQ(kinds(second), (std::vector<double>{2, 1, 0, 0, 0, 0}));
  EXPECT_EQ(kinds(CoupledRun("explosive", until("0.00057"))),
            (std::vector<double>{2, 3, 1, 0, 0, 0}));
  EXPECT_EQ(kinds(CoupledRun("explosive")), (std::vector<double>{2, 3, 3, 3, 1, 0}));
  const std::vector<double> delay = second.field("inductionTime", 0).components[0],
                            waited = second.field("countTime", 0).components[0];
  EXPECT_EQ(delay[44], 0);
  EXPECT_NEAR(delay[45] / 0.0002, 1, 0.02);   // by the pressure that has risen
  EXPECT_NEAR(waited[44] / 0.0002, 1, 0.03);  // whole steps
  EXPECT_NEAR(waited[45] / 0.00017, 1, 0.05);
}

const std::string surface =
    "<fromMaterial>solid</fromMaterial><toMaterial>gas</toMaterial><IdealGasConst>8.314"
    "</IdealGasConst><PreExpCondPh>1.637e15</PreExpCondPh><ActEnergyCondPh>1.76e5"
    "</ActEnergyCondPh><PreExpGasPh>1.6e-3</PreExpGasPh><CondPhaseHeat>4.0e5</CondPhaseHeat>"
    "<GasPhaseHeat>3.018e6</GasPhaseHeat><HeatConductGasPh>0.07</HeatConductGasPh>"
    "<HeatConductCondPh>0.2</HeatConductCondPh><SpecificHeatBoth>1.4e3</SpecificHeatBoth>"
    "<MoleWeightGasPh>0.0342</MoleWeightGasPh><IgnitionTemp>250</IgnitionTemp>";

// A disk of explosive in gas at 1 bar.
CoupledDeck disk(const std::string& tags) {
  CoupledDeck deck;
  deck.cells = "[20,20,1]";
  deck.upper = "[1,1,0.05]";
  deck.saves.emplace_back("p.mass");
  deck.models = "<Model type='DDT1'><DDT1>" + surface +
                "<ThresholdPressureSB>5e4</ThresholdPressureSB><G>1</G><b>1</b><E0>1</E0>" + tags +
                "</DDT1></Model>";
  return deck;
}

// Explosive whose flames are there at once, but cannot enter cracks: burns as Steady_Burn has it,
// to the bit.
TEST(ExplosiveRuns, SurfacesBurnAsBySteadyBurn) {
  CoupledDeck deck = disk("<ThresholdPressureJWL>1e12</ThresholdPressureJWL>");
  const CoupledRun explosive(deck);
  deck.models = "<Model type='Steady_Burn'><Steady_Burn>" + surface +
                "<ThresholdPressure>5e4</ThresholdPressure></Steady_Burn></Model>";
  const CoupledRun steady(deck);
  ASSERT_EQ(explosive.report().status, RunStatus::done) << explosive.report().message;
  EXPECT_EQ(explosive.particles("p.mass"), steady.particles("p.mass"));
  EXPECT_EQ(explosive.field("press_CC", 0).components[0],
            steady.field("press_CC", 0).components[0]);
  EXPECT_LT(explosive.worst_drift_but_energy(), 1e-13);
}

// Where flames need no time cracks burn beside hot gas, behind the cell whose surface burns: a
// particle loses its volume over the spacing of the cracks, times the mass flux at the cell's
// pressure. What burns there is hot: in the next step cracks burn beside it.
TEST(ExplosiveRuns, CracksBurnAtTheFluxOfSurfaces) {
  const std::vector<std::string> at_once = {model + "useInductionTime=false"};
  const CoupledRun run("explosive", at_once, 1, {}, 1);
  EXPECT_EQ(kinds(run), (std::vector<double>{2, 3, 0, 0, 0, 0}));
  const double volume = 0.01 * 0.02 * 0.02, density = 1840,
               burned = models::hmx().surface(5e6, 300, density).flux * volume / 0.002 *
                        run.report().time;
  const std::vector<double> masses = run.particles("p.mass").front();
  for (const std::size_t p : {1, 2})
    EXPECT_NEAR((volume * density - masses[p]) / burned, 1, 1e-6) << p;
  EXPECT_EQ(kinds(CoupledRun("explosive", at_once, 1, {}, 2))[2], 3);
}

// Products of GPa in pores of some millionths of a cell, all along the bar: they act on what is
// left around them by the share that is open, and no cell pushes another's explosive.
// Measured: energy 7e-9, speeds .5 m/s.
TEST(ExplosiveRuns, PoresDoNotTearExplosive) {
  const CoupledRun run("explosive", until("0.0001", {model + "useInductionTime=false"}));
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_EQ(kinds(run), (std::vector<double>{2, 3, 3, 3, 3, 3}));
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);  // momentum of what hardly moves
  EXPECT_LT(std::fabs(run.drift("total energy")), 1e-7);
  const std::vector<double> speeds = run.particles("p.velocity").front();
  for (const double u : speeds) EXPECT_LT(std::fabs(u), 2);
}

// Explosive without such cracks, at this pressure: its surface alone burns.
TEST(ExplosiveRuns, FlamesDoNotEnterSmallCracks) {
  const CoupledRun run("explosive",
                       {model + "useInductionTime=false", model + "CrackConstant=1e12"}, 1, {}, 3);
  EXPECT_EQ(kinds(run), (std::vector<double>{2, 0, 0, 0, 0, 0}));
}

// Above its pressure all of it detonates, as the law of JWL++ has it for one step; nothing burns
// besides.
TEST(ExplosiveRuns, DetonatesAtTheRateOfJwlpp) {
  const CoupledRun run("explosive", {model + "ThresholdPressureJWL=1e6", model + "G=1e4"}, 1, {},
                       1);
  for (const double kind : kinds(run)) EXPECT_EQ(kind, 0);
  const std::vector<double> detonating = run.field("detonating", 0).components[0],
                            F = run.field("F", 0).components[0],
                            gain = run.field("delF", 0).components[0],
                            given = run.field("modelMass_src", 0).components[0],
                            got = run.field("modelMass_src", 1).components[0];
  const double share = -std::expm1(-1e4 * run.report().time), whole = 0.01 * 0.02 * 0.02 * 1840;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(detonating[i], i < 44 ? 0 : 1) << i;
    EXPECT_EQ(got[i], -given[i]);
    if (i < 45) continue;  // without gas
    EXPECT_NEAR(F[i] / share, 1, 1e-12) << i;
    EXPECT_NEAR(gain[i] / share, 1, 1e-12) << i;
    EXPECT_NEAR(got[i] / (2 * whole * share), 1, 1e-12) << i;
  }
  const std::vector<double> masses = run.particles("p.mass").front();
  for (const double m : masses) EXPECT_NEAR((1 - m / whole) / share, 1, 1e-12);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

// A side of the explosive at which it detonates, and nothing burns beside it.
TEST(ExplosiveRuns, NothingBurnsBesideWhatDetonates) {
  const CoupledRun run("explosive",
                       {model + "ThresholdPressureJWL=4e6", model + "useInductionTime=false"}, 1,
                       {}, 1);
  for (const double kind : kinds(run)) EXPECT_EQ(kind, 0);
}

TEST(ExplosiveRuns, NeitherBoxesNorThreadsNorARestartShow) {
  const CoupledRun one("explosive"), many("explosive", {}, 2, {5, 1, 1}),
      begun("explosive", {}, 1, {}, 60), whole("explosive", {}, 1, {}, 0, &begun);
  for (const CoupledRun* other : {&many, &whole}) {
    EXPECT_EQ(one.particles("p.mass"), other->particles("p.mass"));
    for (const char* label : {"burning", "inductionTime", "countTime", "press_CC"})
      EXPECT_EQ(one.field(label, 0).components[0], other->field(label, 0).components[0]) << label;
  }
}

// Once it detonates outputs follow by time, and the run ends so many steps later.
TEST(ExplosiveRuns, IntervalsOfOutputsFollowADetonation) {
  const CoupledRun run(
      disk("<ThresholdPressureJWL>9e4</ThresholdPressureJWL><adjust_IO_intervals>"
           "<PressureSwitch><PressureThreshold>9e9</PressureThreshold><newOutputInterval>1"
           "</newOutputInterval><newCheckPointInterval>1</newCheckPointInterval></PressureSwitch>"
           "<DetonationDetected><remainingTimesteps>3</remainingTimesteps><newOutputInterval>1e-9"
           "</newOutputInterval><newCheckPointInterval>1</newCheckPointInterval>"
           "</DetonationDetected></adjust_IO_intervals>"));
  EXPECT_EQ(run.report().status, RunStatus::max_steps);
  EXPECT_EQ(run.report().last_step, 4);
  EXPECT_EQ(Archive::open(*run.report().archive).outputs().size(), 4u);  // 0, 2, 3, 4
}

template <class Deck>
std::string message_of(const Deck& deck, const std::vector<std::string>& changes = {}) {
  try {
    const CoupledRun run(deck, changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExplosiveDecks, NameWhatIsWrong) {
  EXPECT_THAT(
      message_of("explosive", {model + "ThresholdPressureSB=6e9"}),
      AllOf(HasSubstr("=6e9: error"), HasSubstr("is above <ThresholdPressureJWL> 5.3e+09")));
  EXPECT_THAT(message_of("explosive", {model + "toMaterial=explosive"}),
              HasSubstr("there would be no exchange"));
  EXPECT_THAT(message_of("explosive", {model + "IgnitionConst=2"}),
              HasSubstr("'2' is out of range"));
  const std::string jwl = "<ThresholdPressureJWL>5e9</ThresholdPressureJWL>";
  EXPECT_THAT(message_of(disk(jwl + "<useCrackModel>true</useCrackModel>")),
              AllOf(HasSubstr("coupled.ups:"),
                    HasSubstr("the constitutive model of 'solid' has no cracks")));
  EXPECT_THAT(message_of(disk(jwl + "<useInductionTime>true</useInductionTime>")),
              HasSubstr("<DDT1> with <useInductionTime> needs <IgnitionConst>"));
  EXPECT_THAT(message_of(disk(jwl + "<burnMaterial>solid</burnMaterial>")),
              HasSubstr("<burnMaterial> is a solid"));
  EXPECT_THAT(message_of(disk(jwl + "<burnMaterial>smoke</burnMaterial>")),
              HasSubstr("no material 'smoke'"));
  CoupledDeck twice = disk(jwl);
  twice.models += twice.models;
  EXPECT_THAT(message_of(twice), HasSubstr("two <DDT1> of the same material"));
}

}  // namespace
}  // namespace sluice::mpmice::explosive_runs_test

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

// Explosive whose flames are there at once, but cannot enter cracks: burns as Steady_Burn has it,
// to the bit.
TEST(ExplosiveRuns, SurfacesBurnAsBySteadyBurn) {
  const std::string surface =
      "<fromMaterial>solid</fromMaterial><toMaterial>gas</toMaterial><IdealGasConst>8.314"
      "</IdealGasConst><PreExpCondPh>1.637e15</PreExpCondPh><ActEnergyCondPh>1.76e5"
      "</ActEnergyCondPh><PreExpGasPh>1.6e-3</PreExpGasPh><CondPhaseHeat>4.0e5</CondPhaseHeat>"
      "<GasPhaseHeat>3.018e6</GasPhaseHeat><HeatConductGasPh>0.07</HeatConductGasPh>"
      "<HeatConductCondPh>0.2</HeatConductCondPh><SpecificHeatBoth>1.4e3</SpecificHeatBoth>"
      "<MoleWeightGasPh>0.0342</MoleWeightGasPh><IgnitionTemp>250</IgnitionTemp>";
  CoupledDeck deck;
  deck.cells = "[20,20,1]";
  deck.upper = "[1,1,0.05]";
  deck.saves.emplace_back("p.mass");
  deck.models = "<Model type='Steady_Burn'><Steady_Burn>" + surface +
                "<ThresholdPressure>5e4</ThresholdPressure></Steady_Burn></Model>";
  const CoupledRun steady(deck);
  deck.models = "<Model type='DDT1'><DDT1>" + surface +
                "<ThresholdPressureSB>5e4</ThresholdPressureSB><ThresholdPressureJWL>1e12"
                "</ThresholdPressureJWL><G>1</G><b>1</b><E0>1</E0></DDT1></Model>";
  const CoupledRun explosive(deck);
  ASSERT_EQ(explosive.report().status, RunStatus::done) << explosive.report().message;
  EXPECT_EQ(explosive.particles("p.mass"), steady.particles("p.mass"));
  EXPECT_EQ(explosive.field("press_CC", 0).components[0],
            steady.field("press_CC", 0).components[0]);
  EXPECT_LT(explosive.worst_drift_but_energy(), 1e-13);
}

// Where flames need no time cracks burn beside hot gas from the second step on, behind the cell
// whose surface burns: a particle loses its volume over the spacing of the cracks, times the mass
// flux at the cell's pressure, which is between those at the start and the end. Measured: the
// pressure rises by 8 % there.
TEST(ExplosiveRuns, CracksBurnAtTheFluxOfSurfaces) {
  const CoupledRun run("explosive", until("0.0001", {model + "useInductionTime=false"}));
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_EQ(kinds(run), (std::vector<double>{2, 3, 3, 3, 3, 3}));
  const double volume = 0.01 * 0.02 * 0.02, burned = volume * 1840 - run.particles("p.mass")[0][1];
  const double p = run.field("press_CC", 0).components[0][45];
  const auto at = [&](double pressure) {
    return models::hmx().surface(pressure, 300, 1840).flux * volume / 0.002 * 0.0001;
  };
  EXPECT_GT(p, 5e6);
  EXPECT_GT(burned, 0.98 * at(5e6));
  EXPECT_LT(burned, 1.02 * at(p));
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(std::fabs(run.drift("total energy")), 1e-6);
}

// Above its pressure all of it detonates, with an exponent 0 at the rate G whatever the pressure
// does; nothing burns besides.
TEST(ExplosiveRuns, DetonatesAtTheRateOfJwlpp) {
  const CoupledRun run("explosive", until("0.0001", {model + "ThresholdPressureJWL=1e6"}));
  ASSERT_EQ(run.report().status, RunStatus::done);
  for (const double kind : kinds(run)) EXPECT_EQ(kind, 0);
  const std::vector<double> detonating = run.field("detonating", 0).components[0],
                            F = run.field("F", 0).components[0],
                            gain = run.field("delF", 0).components[0];
  for (std::size_t i = 44; i < 50; ++i) EXPECT_EQ(detonating[i], 1) << i;
  for (std::size_t i = 0; i < 44; ++i) EXPECT_EQ(detonating[i], 0) << i;
  const double share = -std::expm1(-100 * 0.0001), whole = 0.01 * 0.02 * 0.02 * 1840;
  for (const double m : run.particles("p.mass")[0]) EXPECT_NEAR((1 - m / whole) / share, 1, 1e-6);
  EXPECT_NEAR(F[47] / share, 1, 0.01);  // of what has been given to the cell
  EXPECT_GT(gain[47], 0);
  EXPECT_LT(gain[47], 0.1 * share);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

TEST(ExplosiveRuns, NeitherBoxesNorThreadsNorARestartShow) {
  const CoupledRun one("explosive"), many("explosive", {}, 2, {5, 1, 1}),
      begun("explosive", {}, 1, {}, 60), whole("explosive", {}, 1, {}, 0, &begun);
  for (const CoupledRun* other : {&many, &whole}) {
    for (const char* label : {"DDT1.PartFlame", "DDT1.PartFlameCome", "DDT1.PartFlameTime",
                              "DDT1.PartFlameWay", "p.mass"})
      EXPECT_EQ(one.particles(label), other->particles(label)) << label;
    for (const char* label : {"burning", "inductionTime", "countTime", "press_CC"})
      EXPECT_EQ(one.field(label, 0).components[0], other->field(label, 0).components[0]) << label;
  }
}

std::string message_of(const std::vector<std::string>& changes) {
  try {
    const CoupledRun run("explosive", changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExplosiveDecks, NameWhatIsWrong) {
  EXPECT_THAT(
      message_of({model + "ThresholdPressureSB=6e9"}),
      AllOf(HasSubstr("explosive.ups"), HasSubstr("is above <ThresholdPressureJWL> 5.3e+09")));
  EXPECT_THAT(message_of({model + "toMaterial=explosive"}), HasSubstr("nothing would pass"));
  EXPECT_THAT(message_of({model + "IgnitionConst=2"}), HasSubstr("'2' is out of range"));
}

}  // namespace
}  // namespace sluice::mpmice::explosive_runs_test

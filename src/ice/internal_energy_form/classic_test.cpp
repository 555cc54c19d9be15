// The classic form against the exact solution, and what it keeps and does not keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/riemann/riemann.hpp"
#include "ice/internal_energy_form/limits.hpp"
#include "ice/test_support/classic.hpp"

namespace sluice::ice::classic_test {
namespace {

constexpr IntVec3 at(int i, int j = 0, int k = 0) {
  return {i, j, k};
}

// The tube of Uintah's shockTube deck: air, pressure ratio 10, 250 cells.
constexpr int tube_cells = 250;
constexpr double tube_end = 5e-4;
const exact::GasState left_gas{1.1768292682926831, 0, 101325, 1.4};
const exact::GasState right_gas{0.11768292682926831, 0, 10132.5, 1.4};

GasBox shock_tube() {
  GasBox box;
  box.cells = {tube_cells, 1, 1};
  box.high = {1, 0.001, 0.001};
  box.periodic = false;
  box.density = "x < 0.5 ? 1.1768292682926831 : 0.11768292682926831";
  box.pressure = "x < 0.5 ? 101325 : 10132.5";
  box.specific_heat = 717.5;
  return box;
}

struct Errors {
  double density = 0, velocity = 0, pressure = 0;
};

Errors mean_errors(const Stepper& run) {
  const exact::RiemannSolution solution(left_gas, right_gas);
  Errors e;
  for (int i = 0; i < tube_cells; ++i) {
    const double x = (i + 0.5) / tube_cells;
    const exact::GasState s = solution.sample((x - 0.5) / run.time());
    e.density += std::fabs(run.mass(at(i)) - s.density) / tube_cells;
    e.velocity += std::fabs(run.velocity(at(i)) - s.velocity) / tube_cells;
    e.pressure += std::fabs(run.pressure(at(i)) - s.pressure) / tube_cells;
  }
  return e;
}

TEST(ClassicForm, HasTheErrorsOfTheOriginalInAsManyEqualSteps) {
  constexpr int steps = 820;
  constexpr double share = 0.05;
  Stepper tube(shock_tube());
  for (int n = 0; n < steps; ++n) tube.step(tube_end / steps);
  const Errors e = mean_errors(tube);
  EXPECT_NEAR(e.density, 5.445e-3, share * 5.445e-3);  // measured 5.4438e-3
  EXPECT_NEAR(e.velocity, 3.267, share * 3.267);       // measured 3.2622
  EXPECT_NEAR(e.pressure, 454.7, share * 454.7);       // measured 455.89
}

TEST(ClassicForm, KeepsUniformFlowToTheBit) {
  for (const char* advection :
       {"type='SecondOrder'", "type='FirstOrder'", "type='SecondOrder' compatibleFluxes='false'"}) {
    GasBox box;
    box.cells = {6, 3, 2};  // narrower than the ghost layers
    box.advection = advection;
    box.velocity[0] = "0.7";
    box.velocity[1] = "-0.4";
    box.velocity[2] = "0.2";
    Stepper run(box);
    const double mass = run.mass(at(1, 2, 1)), energy = run.energy(at(1, 2, 1));
    for (int n = 0; n < 10; ++n) run.step(0.02);
    for_each_cell(run.domain(), [&](IntVec3 c) {
      EXPECT_EQ(run.mass(c), mass);
      EXPECT_EQ(run.energy(c), energy);
      EXPECT_EQ(run.momentum(c, 1), -0.4);
    });
  }
}

// A jump of density in uniform flow at uniform pressure. Compatible fluxes limit the specific
// energy by itself, so that density times energy, the pressure, does not stay uniform.
double velocity_defect_at_contact(const std::string& advection) {
  GasBox box;
  box.cells = {64, 1, 1};
  box.advection = advection;
  box.density = "abs(x - 0.5) < 0.2 ? 1 : 0.1";
  box.velocity[0] = "1";
  Stepper run(box);
  for (int n = 0; n < 50; ++n) run.step(0.001);
  double defect = 0;
  for (int i = 0; i < 64; ++i) defect = std::max(defect, std::fabs(run.velocity(at(i)) - 1));
  return defect;
}

TEST(ClassicForm, DisturbsContactsOnlyWithCompatibleFluxes) {
  EXPECT_LT(velocity_defect_at_contact("type='FirstOrder'"), 1e-12);  // measured 2e-16
  EXPECT_LT(velocity_defect_at_contact("type='SecondOrder' compatibleFluxes='false'"), 1e-12);  // 0
  EXPECT_NEAR(velocity_defect_at_contact("type='SecondOrder'"), 0.046, 0.001);
}

struct Sums {
  ExactSum mass, momentum[2], energy, magnitude;
};

Sums sums_of(const Stepper& run) {
  Sums s;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    s.mass.add(run.mass(c));
    double m2 = 0;
    for (int d = 0; d < 2; ++d) {
      s.momentum[d].add(run.momentum(c, d));
      s.magnitude.add(std::fabs(run.momentum(c, d)));
      m2 += run.momentum(c, d) * run.momentum(c, d);
    }
    s.energy.add(run.energy(c) + 0.5 * m2 / run.mass(c));
  });
  return s;
}

GasBox square_with_blast() {
  GasBox box;
  box.cells = {32, 32, 1};
  box.low = {-0.5, -0.5, 0};
  box.high = {0.5, 0.5, 0.03125};
  box.pressure = "x*x + y*y < 0.04 ? 10 : 0.1";
  return box;
}

TEST(ClassicForm, ConservesMassAndMomentumButNotTotalEnergy) {
  GasBox box = square_with_blast();
  box.velocity[0] = "0.3 + 0.2*sin(2*pi*y)";
  box.velocity[1] = "-0.1";
  Stepper run(box);
  const Sums before = sums_of(run);
  for (int n = 0; n < 200; ++n) run.step(0.001);
  const Sums after = sums_of(run);
  const double mass = before.mass.value(), momentum = after.magnitude.value();
  EXPECT_NEAR(after.mass.value(), mass, 1e-14 * mass);  // measured 0
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d].value(), before.momentum[d].value(), 1e-14 * momentum);  // 1e-17
  EXPECT_GT(std::fabs(after.energy.value() / before.energy.value() - 1), 1e-3);  // measured 0.18
}

TEST(ClassicForm, LetsNothingThroughWalls) {
  GasBox box = square_with_blast();
  box.periodic = false;
  box.walls = true;
  Stepper run(box);
  const double mass = sums_of(run).mass.value();
  for (int n = 0; n < 400; ++n) run.step(0.001);
  EXPECT_NEAR(sums_of(run).mass.value(), mass, 1e-14 * mass);  // measured 1e-16
}

TEST(ClassicForm, MirrorsMirroredStates) {
  Stepper run(square_with_blast());
  for (int n = 0; n < 100; ++n) run.step(0.001);
  for_each_cell(run.domain(), [&](IntVec3 c) {
    const IntVec3 mirror = at(31 - c.x, c.y), turned = at(c.y, c.x);
    EXPECT_EQ(run.mass(mirror), run.mass(c));
    EXPECT_EQ(run.energy(mirror), run.energy(c));
    EXPECT_EQ(run.momentum(mirror, 0), -run.momentum(c, 0));
    EXPECT_EQ(run.momentum(mirror, 1), run.momentum(c, 1));
    EXPECT_EQ(run.mass(turned), run.mass(c));
    EXPECT_EQ(run.momentum(turned, 0), run.momentum(c, 1));
  });
}

TEST(ClassicForm, DoesNotDependOnBoxesBlocksAndThreads) {
  GasBox box = square_with_blast();
  box.cells = {20, 14, 9};
  box.high = {0.5, 0.5, 1};
  SolverOptions split;
  split.threads = 2;
  split.block = {7, 5, 4};
  split.force_all = true;
  Stepper whole(box), parts(box, split, {3, 2, 2});
  for (int n = 0; n < 10; ++n) {
    whole.step(0.002);
    parts.step(0.002);
    EXPECT_EQ(whole.solver().attempt_result().maxima, parts.solver().attempt_result().maxima);
  }
  for_each_cell(whole.domain(), [&](IntVec3 c) {
    EXPECT_EQ(whole.mass(c), parts.mass(c));
    EXPECT_EQ(whole.energy(c), parts.energy(c));
    for (int d = 0; d < 3; ++d) EXPECT_EQ(whole.momentum(c, d), parts.momentum(c, d));
  });
}

TEST(ClassicForm, ReadsTheGhostLayersThatItsStateHas) {
  for (const auto& [advection, layers] :
       {std::pair{"type='SecondOrder'", 4}, std::pair{"type='FirstOrder'", 3}}) {
    GasBox box;
    box.cells = {8, 8, 8};
    box.advection = advection;
    Stepper run(box);
    EXPECT_EQ(run.solver().graphs().step(false, {}).plan(-1).halo, IntVec3::all(layers));
    for (const SlotInfo& slot : run.ice().state().slots()) EXPECT_EQ(slot.ghosts, layers);
  }
}

TEST(ClassicForm, NamesCellsThatEmpty) {
  GasBox box;
  box.cells = {16, 1, 1};
  box.velocity[0] = "10";
  SolverOptions awake;
  awake.force_all = true;
  Stepper run(box, awake);
  const StepAttempt& emptied = run.attempt(0.01);  // 1.6 cells a step
  EXPECT_EQ(emptied.faults, 16);
  EXPECT_EQ(emptied.first_fault.kind, fault_outflow);
  EXPECT_NEAR(emptied.first_fault.value, 1.6, 1e-12);
  EXPECT_NE(run.ice().step().describe_fault(fault_outflow).find("flows out"), std::string::npos);
}

// Slopes vanish where the mask is zero: a step redone everywhere is the first-order one.
TEST(ClassicForm, RedoesMaskedCellsAtFirstOrder) {
  GasBox box;
  box.cells = {16, 16, 1};
  box.density = "1 + 0.5*sin(2*pi*x)*cos(2*pi*y)";
  box.velocity[0] = "4 + sin(2*pi*y)";
  Stepper second(box);
  box.advection = "type='FirstOrder'";
  Stepper first(box);
  ASSERT_EQ(second.attempt(0.1).faults, 256);  // every cell empties
  second.solver().mask_faults();
  second.step(0.005);
  first.step(0.005);
  for_each_cell(first.domain(), [&](IntVec3 c) {
    EXPECT_DOUBLE_EQ(second.mass(c), first.mass(c));
    EXPECT_DOUBLE_EQ(second.energy(c), first.energy(c));
  });
}

TEST(ClassicForm, LeavesAColumnAtRest) {
  GasBox box;
  box.cells = {1, 32, 1};
  box.periodic = false;
  box.walls = true;
  box.gravity = "[0,-0.3,0]";
  box.density = "1.17";
  Stepper run(box);  // the start is the discrete balance, from p = 1 in cell (0,0,0)
  EXPECT_NEAR(run.pressure(at(0, 31)), 1 - 0.3 * 1.17 * 31 / 32, 1e-12);
  for (int n = 0; n < 1000; ++n) run.step(0.01);
  for (int j = 0; j < 32; ++j) EXPECT_LT(std::fabs(run.velocity(at(0, j))), 1e-13);  // 3e-15
}

TEST(ClassicForm, DampsAShearWaveByItsViscosity) {
  constexpr double mu = 0.01, pi = 3.14159265358979323846;
  GasBox box;
  box.cells = {32, 32, 1};
  box.viscosity = mu;
  box.velocity[1] = "0.01*sin(2*pi*x)";
  Stepper run(box);
  const double start = run.velocity(at(8, 5), 1);
  for (int n = 0; n < 200; ++n) run.step(0.01);
  const double exact = std::exp(-4 * pi * pi * mu * run.time());
  EXPECT_NEAR(run.velocity(at(8, 5), 1) / start, exact, 0.01 * exact);  // measured 0.00098
}

TEST(ClassicForm, StaysStableUpToItsOwnLimit) {
  const GasBox box = [] {
    GasBox b;
    b.cells = {12, 12, 12};
    b.pressure = "1/1.4 + 1e-6*sin(97*x + 53*y*y + 31*z*z*z)";
    return b;
  }();
  auto largest = [&](double courant) {
    Stepper run(box);
    for (int n = 0; n < 30; ++n) run.step(courant / 12);
    double most = 0;
    for_each_cell(run.domain(),
                  [&](IntVec3 c) { most = std::max(most, std::fabs(run.velocity(c))); });
    return most;
  };
  const double limit = internal_energy_form::sound_share(3);
  EXPECT_LT(largest(limit), 1e-6);        // measured 1.5e-8
  EXPECT_GT(largest(1.1 * limit), 1e-5);  // measured 1.9e-5, growing
}

}  // namespace
}  // namespace sluice::ice::classic_test

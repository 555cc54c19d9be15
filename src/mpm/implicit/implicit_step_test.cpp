// Newton's method, rigid bodies, heat and the ends of implicit steps.
#include <gtest/gtest.h>

#include <numbers>

#include "mpm/test_support/implicit_run.hpp"

namespace sluice::mpm::implicit_step_test {
namespace {

constexpr const char* quasi_static =
    "<time_integrator>implicit</time_integrator><dynamic>false</dynamic>";

// A component that tells how Newton's method went.
class Watched : public Mpm {
 public:
  Watched(const Scene& scene, const MpmScene& solids, std::vector<NewtonReport>& told)
      : Mpm(scene, solids), told_(&told) {}
  const MpmStep& step() const override { return own_; }
  void declare_stages(StepShape& shape) const {
    const auto step =
        std::make_shared<ImplicitStep>(run_scene(), scene(), carried(), particles()->kinds());
    shape.stage("begin", [step](const StageScope& s) { return step->begin(s); });
    shape.stage("ways", [step, told = told_](const StageScope& s) {
      const Verdict verdict = step->find_displacements(s);
      told->push_back(step->newton());
      return verdict;
    });
    shape.stage("particles", [step](const StageScope& s) { return step->to_particles(s); });
    shape.stage("take over", [step](const StageScope& s) { return step->take_over(s); });
  }

 private:
  struct Step final : MpmStep {
    explicit Step(const Watched& of) : MpmStep(of), watched(&of) {}
    void declare_stages(StepShape& stages) const override { watched->declare_stages(stages); }
    const Watched* watched;
  };
  std::vector<NewtonReport>* told_;
  Step own_{*this};
};

// A cube in the corner of three mirrors, and a rigid plate on its high x side.
SolidDeck pressed_cube(const std::string& flags) {
  SolidDeck deck;
  deck.upper = "[0.4,0.4,0.4]";
  deck.cells = "[4,4,4]";
  deck.flags = flags;
  deck.objects =
      "<geom_object><box><min>[0,0,0]</min><max>[0.2,0.2,0.2]</max></box><res>[2,2,2]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  deck.further =
      "<material name='plate'><density>1000</density><is_rigid>true</is_rigid>"
      "<constitutive_model type='comp_neo_hook'><bulk_modulus>1e6</bulk_modulus>"
      "<shear_modulus>5e5</shear_modulus></constitutive_model>"
      "<thermal_conductivity>1</thermal_conductivity><specific_heat>5</specific_heat>"
      "<geom_object><box><min>[0.2,0,0]</min><max>[0.3,0.4,0.4]</max></box><res>[2,2,2]</res>"
      "<velocity>[-0.04,0,0]</velocity><temperature>300</temperature></geom_object></material>";
  deck.contacts = "<contact><type>rigid</type><direction>[1,0,0]</direction></contact>";
  return deck;
}

// Once it is near, every iteration squares the residual (in units of where it began).
TEST(ImplicitStep, NewtonConvergesQuadratically) {
  std::vector<NewtonReport> told;
  const TextRun run(
      pressed_cube(std::string(quasi_static) +
                   "<convergence_criteria_disp>1e-26</convergence_criteria_disp>"
                   "<convergence_criteria_energy>1e-26</convergence_criteria_energy>"),
      implicit_steps(0.5, 0.5, saves({"p.stress"})), "newton", 1,
      [&](const Scene& scene, const MpmScene& solids) {
        return std::make_unique<Watched>(scene, solids, told);
      });
  ASSERT_EQ(told.size(), 1U);
  ASSERT_TRUE(told[0].converged);
  const std::vector<double>& r = told[0].residuals;
  EXPECT_LE(told[0].iterations, 6);
  int squared = 0;
  for (std::size_t n = 1; n + 1 < r.size(); ++n)
    squared += std::log(r[n + 1] / r[0]) < 1.8 * std::log(r[n] / r[0]);
  std::string all;
  for (const double x : r) all += fmt::format(" {:.3g}", x);
  EXPECT_GE(squared, 2) << all;
}

// Sides that are free carry no stress: a uniaxial stress, with the lateral stretch of the law.
TEST(ImplicitStep, ACubeUnderAPlateIsInUniaxialStress) {
  constexpr double tolerance = 1e-9;
  const TextRun run(
      pressed_cube(std::string(quasi_static) + "<total_lagrangian>true</total_lagrangian>"),
      implicit_steps(0.25, 0.5, saves({"p.stress", "p.deformationMeasure"})), "cube", 1,
      implicit_solids);
  const auto stress = run.particles("p.stress"), F = run.particles("p.deformationMeasure");
  for (std::size_t p = 0; p < stress[0].size(); ++p) {
    EXPECT_NEAR(F[0][p], 0.9, tolerance);
    EXPECT_LT(stress[0][p], -1e5);
    const double size = std::fabs(stress[0][p]);
    for (const std::size_t e : {1, 2, 3, 5}) EXPECT_NEAR(stress[e][p] / size, 0, 1e-6) << e;
    // sigma_yy = K/2 (J - 1/J) + G J^(-5/3) (b_yy - tr b/3) = 0, b_yy = b_zz
    EXPECT_NEAR(F[4][p], F[8][p], tolerance);
    const double J = F[0][p] * F[4][p] * F[8][p], b = F[4][p] * F[4][p];
    const double dev = (b - 0.81) / 3;
    EXPECT_NEAR(0.5e6 * (J - 1 / J) + 5e5 * std::pow(J, -5.0 / 3) * dev, 0, 1e-6 * size);
  }
}

// The plate feels the stress of the cube on its face, as it is where shape functions stand still.
TEST(ImplicitStep, APlateFeelsTheCube) {
  const TextRun run(
      pressed_cube(std::string(quasi_static) + "<total_lagrangian>true</total_lagrangian>"),
      implicit_steps(0.25, 0.5, saves({"p.stress", "p.deformationMeasure", "RigidReactionForce"})),
      "plate", 1, implicit_solids);
  const auto stress = run.particles("p.stress"), F = run.particles("p.deformationMeasure");
  const double area = 0.04 * F[4][0] * F[8][0];
  const std::vector<double> last = run.history("RigidReactionForce").back();
  EXPECT_NEAR(last[1] / (-stress[0][0] * area), 1, 1e-9);
  EXPECT_NEAR(last[2] / last[1], 0, 1e-9);
}

TEST(ImplicitStep, BitsDoNotDependOnThreadsOrBoxes) {
  const auto stress = [&](int threads, const char* patches) {
    TextRun::Rewrites rewrites = implicit_steps(0.25, 0.5, saves({"p.stress", "p.particleID"}));
    rewrites.emplace_back(
        "<resolution>[4,4,4]</resolution>",
        fmt::format("<resolution>[4,4,4]</resolution><patches>{}</patches>", patches));
    const TextRun run(pressed_cube(quasi_static), rewrites, "bits", threads, implicit_solids);
    const auto id = run.particles("p.particleID"), s = run.particles("p.stress");
    std::map<double, double> by_id;
    for (std::size_t p = 0; p < id[0].size(); ++p) by_id[id[0][p]] = s[0][p];
    return by_id;
  };
  const auto one = stress(1, "[1,1,1]");
  EXPECT_EQ(one, stress(2, "[1,1,1]"));
  EXPECT_EQ(one, stress(1, "[2,1,2]"));
}

// A slab with one warm side: T = T_1 + (T_0 - T_1) sum 2/(k L) sin(k x) exp(-a k^2 t). The mean
// error falls with the grid; particles beside the side keep what the first step, of a leap, gave
// them beyond the nodes.
double error_of_slab(int cells) {
  constexpr double length = 2, diffusivity = 1.0 / (1000 * 5), time = 4000;
  SolidDeck deck = bar(cells,
                       "<time_integrator>implicit</time_integrator>"
                       "<DoImplicitHeatConduction>true</DoImplicitHeatConduction>");
  const double h = length / cells;
  deck.cells = fmt::format("[{},1,1]", cells);
  deck.upper = fmt::format("[2,{},{}]", h, h);
  deck.objects = fmt::format(
      "<geom_object><box><min>[0,0,0]</min><max>[2,{},{}]</max></box><res>[2,1,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>",
      h, h);
  deck.faces =
      "<Face side='x-'><BCType id='all' label='Symmetric' var='symmetry'/>"
      "<BCType id='all' label='Temperature' var='Dirichlet'><value>400</value></BCType></Face>" +
      held("x+") + held("y-") + held("y+") + held("z-") + held("z+");
  const TextRun run(deck, implicit_steps(time / (4 * cells), time, saves({"p.temperature"})),
                    "slab", 1, implicit_solids);
  const std::vector<double> x = run.particles("p.x")[0], T = run.particles("p.temperature")[0];
  double error = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    double series = 0;
    for (int n = 0; n < 40; ++n) {
      const double k = (n + 0.5) * std::numbers::pi / length;
      series += 2 / (k * length) * std::sin(k * x[p]) * std::exp(-diffusivity * k * k * time);
    }
    error += std::fabs(T[p] - (400 - 100 * series)) / static_cast<double>(x.size());
  }
  return error;
}

TEST(ImplicitStep, HeatFollowsItsSeries) {
  const double coarse = error_of_slab(10), middle = error_of_slab(20), fine = error_of_slab(40);
  EXPECT_LT(fine, 0.5);  // K of 100
  EXPECT_GT(std::log2(coarse / middle), 0.9) << coarse << " " << middle;
  EXPECT_GT(std::log2(middle / fine), 0.9) << middle << " " << fine;
}

// A body that nothing holds, without inertia: one sentence says why.
TEST(ImplicitStep, ABodyThatNothingHoldsEndsClearly) {
  SolidDeck deck = bar(4, quasi_static);
  deck.faces =
      free_face("x-") + free_face("x+") + held("y-") + held("y+") + held("z-") + held("z+");
  deck.objects =
      "<geom_object><box><min>[0.2,0,0]</min><max>[0.4,0.1,0.1]</max></box><res>[2,1,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  TextRun::Rewrites rewrites = implicit_steps(1, 1, saves({"p.stress"}));
  rewrites.emplace_back("<gravity>[0,0,0]", "<gravity>[1,0,0]");
  try {
    const TextRun run(deck, rewrites, "loose", 1, implicit_solids);
    FAIL() << "the run has not ended";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("singular"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sluice::mpm::implicit_step_test

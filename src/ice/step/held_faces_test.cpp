// Velocities that a side prescribes hold on its faces: what enters and leaves is what the deck
// says, whatever the pressure inside, in each scheme, of one and several materials.
#include "ice/step/held_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/deck_run.hpp"

namespace sluice::ice::held_faces_test {
namespace {

constexpr double density = 1.1614401858304297, temperature = 300, pressure = 1e5;
constexpr double length = 1, width = 0.02;

// A pipe of air along an axis. `inlet`: conditions of its low side, without <Face>; the high side
// is closed, or has a pressure.
struct Pipe {
  int cells = 50, across = 1, axis = 0;
  std::string inlet;
  double outlet = 0;  // Pa; 0: closed
  double start = 0;   // velocity along the axis
  double warmer = 0;  // than the air that enters, K, of the same density
  std::string scheme = "conservative";
  std::string ice;        // further tags of <ICE>
  std::string materials;  // in place of the air
  std::string exchange;   // between them
  std::string levels;     // behind <Grid>
};

std::string condition(const char* label, const char* kind, const std::string& value,
                      const char* id = "all") {
  return fmt::format("<BCType id='{}' label='{}' var='{}'><value>{}</value></BCType>", id, label,
                     kind, value);
}
std::string vector_along(int axis, double u) {
  return fmt::format("[{},{},{}]", axis == 0 ? u : 0.0, axis == 1 ? u : 0.0, 0.0);
}
// Air of 300 K at 1e5 Pa that enters with u.
std::string inflow(double u, int axis = 0) {
  return condition("Pressure", "Neumann", "0") +
         condition("Density", "Dirichlet", fmt::format("{:.17g}", density)) +
         condition("Temperature", "Dirichlet", "300") +
         condition("Velocity", "Dirichlet", vector_along(axis, u));
}
std::string suction(double u) {
  return condition("Pressure", "Neumann", "0") + condition("Density", "Neumann", "0") +
         condition("Temperature", "Neumann", "0") +
         condition("Velocity", "Dirichlet", vector_along(0, -u));
}
std::string air(const char* name, double u, double share = 1, int axis = 0, double warmer = 0) {
  return fmt::format(
      "<material name='{}'><EOS type='ideal_gas'/><dynamic_viscosity>0</dynamic_viscosity>"
      "<thermal_conductivity>0</thermal_conductivity><specific_heat>717.5</specific_heat>"
      "<gamma>1.4</gamma><geom_object><box><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>"
      "<res>[2,2,2]</res><velocity>{}</velocity><density>{:.17g}</density>"
      "<temperature>{:.17g}</temperature><volumeFraction>{}</volumeFraction></geom_object>"
      "</material>",
      name, vector_along(axis, u), density, 300 + warmer, share);
}
std::string drag(double momentum) {
  return fmt::format(
      "<exchange_properties><exchange_coefficients><momentum>[{}]</momentum>"
      "<heat>[0]</heat></exchange_coefficients></exchange_properties>",
      momentum);
}

std::string text_of(const Pipe& p) {
  const char* axes = "xyz";
  const std::string mirror = "<BCType id='all' label='Symmetric' var='symmetry'/>";
  std::string faces;
  for (int d = 0; d < 3; ++d)
    for (const bool plus : {false, true}) {
      std::string inside = mirror;
      if (d == p.axis && !plus) inside = p.inlet;
      if (d == p.axis && plus && p.outlet > 0)
        inside = condition("Pressure", "Dirichlet", fmt::format("{}", p.outlet)) +
                 condition("Density", "Neumann", "0") + condition("Temperature", "Neumann", "0") +
                 condition("Velocity", "Neumann", "[0,0,0]");
      faces += fmt::format("<Face side='{}{}'>{}</Face>", axes[d], plus ? '+' : '-', inside);
    }
  const bool along_x = p.axis == 0;
  return fmt::format(
      "<Uintah_specification><SimulationComponent type='ice'/><Time><maxTime>1</maxTime>"
      "<initTime>0</initTime><delt_min>0</delt_min><delt_max>1</delt_max>"
      "<timestep_multiplier>1</timestep_multiplier></Time><Grid><BoundaryConditions>{}"
      "</BoundaryConditions><Level><Box><lower>[0,0,0]</lower><upper>[{},{},0.02]</upper>"
      "<resolution>[{},{},1]</resolution></Box></Level></Grid>{}"
      "<DataArchiver><filebase>pipe.uda</filebase><outputInterval>1</outputInterval><save "
      "label='rho_CC'/></DataArchiver>"
      "<CFD><cfl>0.4</cfl><ICE><scheme>{}</scheme><advection type='SecondOrder'/>{}</ICE></CFD>"
      "<PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>1e5</reference_pressure>"
      "</PhysicalConstants><MaterialProperties><ICE>{}</ICE>{}</MaterialProperties>"
      "</Uintah_specification>",
      faces, along_x ? length : width, along_x ? width : length, along_x ? p.cells : p.across,
      along_x ? p.across : p.cells, p.levels, p.scheme, p.ice,
      p.materials.empty() ? air("air", p.start, 1, p.axis, p.warmer) : p.materials, p.exchange);
}

class PipeRun : public DeckRun {
 public:
  explicit PipeRun(const Pipe& pipe, IntVec3 boxes = {}) : DeckRun(text_of(pipe), boxes) {}

  void run_to(double end) {
    while (time() < end) {
      const double allowed = std::min(limit(), 1.25 * last_);
      last_ = std::min(allowed, end - time());
      ASSERT_TRUE(attempt(last_));
    }
  }
  // Of the coarsest level, whose cells hold the means of finer ones.
  std::vector<double> values(Label label, int material = 0, int component = 0) const {
    std::vector<double> all;
    const Warehouse& state = hierarchy().level(0).state();
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) {
        all.push_back(state.view(state.find(label, material), component, b)(c));
      });
    return all;
  }
  double mass(int material = 0) const {
    const Vec3 h = level().spacing;
    double sum = 0;
    for (const double rho : values(labels().mass, material)) sum += rho * h.x * h.y * h.z;
    return sum;
  }

 private:
  double last_ = 1e-5;  // semi-implicit steps begin small
};

constexpr double at_start = density * length * width * width;

// What enters a closed pipe in t, over rho u A t: exact, as the flux is.
double filled(const Pipe& pipe, double u, double time, int across = 1) {
  PipeRun run(pipe);
  const double before = run.mass();
  run.run_to(time);
  return (run.mass() - before) / (density * u * width * width * across / across * time);
}

TEST(HeldVelocity, FillsAClosedPipe) {
  Pipe pipe;
  pipe.inlet = inflow(10);
  EXPECT_NEAR(filled(pipe, 10, 0.05), 1, 1e-11);
}

TEST(HeldVelocity, FillsInAnyDirectionOrderAndScheme) {
  Pipe pipe;
  pipe.inlet = inflow(10);
  pipe.cells = 20;
  pipe.scheme = "classic";
  EXPECT_NEAR(filled(pipe, 10, 0.01), 1, 1e-11);
  pipe = Pipe{};
  pipe.cells = 20;
  pipe.axis = 1;
  pipe.inlet = inflow(10, 1);
  EXPECT_NEAR(filled(pipe, 10, 0.01), 1, 1e-11);
  pipe.across = 4;
  EXPECT_NEAR(filled(pipe, 10, 0.01), 1, 1e-11);
}

TEST(HeldVelocity, SuctionEmptiesAPipe) {
  Pipe pipe;
  pipe.inlet = suction(10);
  PipeRun run(pipe);
  run.run_to(0.05);
  EXPECT_NEAR(run.mass() / at_start, std::exp(-0.5), 0.02 * std::exp(-0.5));
}

// rho u of every cell with 58 Pa against the flow: the pressure inside is that of the outlet, and
// higher than density and temperature of what enters would make. (Where the start has another
// pressure sound runs to and fro between the two ends for ever: both throw it back.)
TEST(HeldVelocity, CarriesWhatIsGivenAgainstAPressure) {
  for (const double u : {0.1, 1.0, 10.0}) {
    Pipe pipe;
    pipe.cells = 20;
    pipe.inlet = inflow(u);
    pipe.start = u;
    pipe.outlet = pressure + 58;
    pipe.warmer = 300 * 58 / pressure;
    PipeRun run(pipe);
    run.run_to(0.02);
    for (const double m : run.values(labels().momentum))
      EXPECT_NEAR(m, density * u, 0.005 * density * u);
  }
}

TEST(HeldVelocity, HoldsForEachOfSeveralMaterials) {
  const auto part = [](const char* id, double share, double u) {
    return condition("Density", "Dirichlet", fmt::format("{:.17g}", share * density), id) +
           condition("SpecificVol", "Dirichlet", fmt::format("{:.17g}", 1 / density), id) +
           condition("Temperature", "Dirichlet", "300", id) +
           condition("Velocity", "Dirichlet", vector_along(0, u), id);
  };
  constexpr double area = width * width, t = 0.01;
  for (const double second : {10.0, 4.0}) {
    Pipe pipe;
    pipe.cells = 20;
    pipe.inlet =
        condition("Pressure", "Neumann", "0") + part("0", 0.25, 10) + part("1", 0.75, second);
    pipe.materials = air("a", 0, 0.25) + air("b", 0, 0.75);
    pipe.exchange = drag(second == 10 ? 1e15 : 0);
    PipeRun run(pipe);
    const double a = run.mass(0), b = run.mass(1);
    run.run_to(t);
    EXPECT_NEAR((run.mass(0) - a) / (0.25 * density * 10 * area * t), 1, 1e-9) << second;
    EXPECT_NEAR((run.mass(1) - b) / (0.75 * density * second * area * t), 1, 1e-9) << second;
  }
}

TEST(HeldVelocity, HasTheSameBitsInAnyBoxes) {
  Pipe pipe;
  pipe.cells = 24;
  pipe.across = 6;
  pipe.inlet = inflow(10);
  PipeRun whole(pipe), cut(pipe, {3, 2, 1});
  for (PipeRun* run : {&whole, &cut}) run->run_to(0.003);
  std::vector<double> a = whole.values(labels().mass), b = cut.values(labels().mass);
  std::sort(a.begin(), a.end());  // boxes come in an order of their own
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
}

// A finer level at the inlet, and behind it.
TEST(HeldVelocity, HoldsOnLevels) {
  Pipe pipe;
  pipe.cells = 24;
  pipe.across = 8;
  pipe.inlet = inflow(10);
  pipe.levels =
      "<AMR><ICE><orderOfInterpolation>1</orderOfInterpolation><Refinement_Criteria_Thresholds>"
      "<Variable name='press_CC' value='100' matl='0'/></Refinement_Criteria_Thresholds></ICE>"
      "<Regridder type='Tiled'><max_levels>2</max_levels>"
      "<cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>"
      "<min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>";
  PipeRun run(pipe);
  run.run_to(0.002);
  EXPECT_GT(run.hierarchy().level_count(), 1);
  EXPECT_NEAR((run.mass() - at_start) / (density * 10 * width * width * 0.002), 1, 1e-9);
}

// Faster than sound nothing inside knows of the face: the whole state enters. What it rams throws
// back a shock, which the flow carries in with 127 m/s.
TEST(HeldVelocity, LetsAWholeStateInBeyondTheSpeedOfSound) {
  Pipe pipe;
  pipe.inlet = inflow(700);
  PipeRun run(pipe);
  run.run_to(1.6e-3);  // the shock is .2 m, ten cells, behind the face
  const std::vector<double> rho = run.values(labels().mass), m = run.values(labels().momentum);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(rho[i], density, 1e-3 * density);
    EXPECT_NEAR(m[i], density * 700, 1e-3 * density * 700);
  }
}

TEST(HeldVelocity, IsLeftToTheFlowBeyondTheSpeedOfSound) {
  EXPECT_TRUE(is_subsonic(300, false, 340, 340));
  EXPECT_FALSE(is_subsonic(350, false, 400, 340));   // enters
  EXPECT_TRUE(is_subsonic(350, true, 400, 340));     // leaves
  EXPECT_FALSE(is_subsonic(-450, false, 400, 340));  // leaves
  EXPECT_FALSE(is_subsonic(-350, true, 400, 340));   // enters
}

}  // namespace
}  // namespace sluice::ice::held_faces_test

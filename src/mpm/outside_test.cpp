// Whole runs under loads, gravity, manufactured forces and heat, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mpm/loads/manufactured.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::outside_test {
namespace {

constexpr double pi = std::numbers::pi;

// ---- manufactured solutions ----------------------------------------------------------------

struct Study {
  const char* basis;
  int directions;
  bool total_lagrangian;
  double order;  // least, from 16 to 32 cells
};

// Mean error of the places of all particles at a quarter of the period.
double axis_aligned_error(const Study& study, int n) {
  SolidDeck deck;
  const int d = study.directions;
  const std::string h = fmt::format("{:.17g}", 1.0 / n), m = std::to_string(n);
  deck.upper = "[1," + (d > 1 ? "1" : h) + "," + (d > 2 ? "1" : h) + "]";
  deck.cells = "[" + m + "," + (d > 1 ? m : "1") + "," + (d > 2 ? m : "1") + "]";
  deck.flags = std::string("<interpolator>") + study.basis +
               "</interpolator><RunMMSProblem>AxisAligned</RunMMSProblem>"
               "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>" +
               (study.total_lagrangian ? "<total_lagrangian>true</total_lagrangian>" : "");
  deck.objects =
      "<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[2,2,2]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  const TextRun run(deck,
                    {{"<density>1000", "<density>1"},
                     {"comp_neo_hook", "cnh_mms"},
                     {"<bulk_modulus>1e6", "<bulk_modulus>8333.3333333"},
                     {"<shear_modulus>5e5", "<shear_modulus>3846.1538462"},
                     {"<maxTime>1<", "<maxTime>0.005<"},
                     {"<outputInterval>0</outputInterval>", saves({"p.x", "p.displacement"})}},
                    "axis_aligned");
  const double K = 8333.3333333, G = 3846.1538462;
  const auto motion = manufactured(
      "AxisAligned", {1, K - 2 * G / 3, G, 0, {1, d > 1 ? 1.0 : 0.0, d > 2 ? 1.0 : 0.0}});
  const auto x = run.particles("p.x"), u = run.particles("p.displacement");
  double sum = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p) {
    const Vec3 now{u[0][p], u[1][p], u[2][p]};
    const Vec3 e = motion->displacement(Vec3{x[0][p], x[1][p], x[2][p]} - now, run.time()) - now;
    sum += std::sqrt(dot(e, e));
  }
  return sum / static_cast<double>(x[0].size());
}

class AxisAligned : public testing::TestWithParam<Study> {};

TEST_P(AxisAligned, ConvergesWithTheGrid) {
  const int coarse = GetParam().directions == 3 ? 8 : 16;
  const double a = axis_aligned_error(GetParam(), coarse);
  const double b = axis_aligned_error(GetParam(), 2 * coarse);
  RecordProperty("coarse", fmt::format("{:.3e}", a));
  RecordProperty("order", fmt::format("{:.2f}", std::log2(a / b)));
  EXPECT_GT(std::log2(a / b), GetParam().order) << a << ' ' << b;
}
// Measured, total Lagrangian in 1-D: 1.93, 1.93, 2.06, and 1.98 to 2.01 from 32 to 64 cells.
// Particles
// that cross cells leave an error of their spacing: 1.17 and 1.21, and nothing is gained
// beyond 64 cells.
INSTANTIATE_TEST_SUITE_P(Bases, AxisAligned,
                         testing::Values(Study{"gimp", 1, true, 1.85},
                                         Study{"3rdorderBS", 1, true, 1.85},
                                         Study{"linear", 1, true, 1.85},
                                         Study{"gimp", 2, true, 1.8}, Study{"gimp", 1, false, 1.0},
                                         Study{"3rdorderBS", 1, false, 1.0}));
INSTANTIATE_TEST_SUITE_P(Full, AxisAligned,
                         testing::Values(Study{"3rdorderBS", 2, true, 1.8},
                                         Study{"gimp", 3, true, 1.7},
                                         Study{"gimp", 3, false, 1.0}));

// ---- loads -----------------------------------------------------------------------------------

std::string pressure(const std::string& box, double value) {
  return fmt::format(
      "<PhysicalBC><MPM><pressure><geom_object><box label='face'>{}</box></geom_object>"
      "<load_curve><id>1</id><time_point><time>0</time><load>{}</load></time_point>"
      "<time_point><time>1</time><load>{}</load></time_point></load_curve></pressure></MPM>"
      "</PhysicalBC>",
      box, value, value);
}

// A free block under a constant pressure: momentum p A (t - dt/2) at the middle of the last step,
// whatever its waves do; the books close.
TEST(Loads, AFreeBlockTakesTheImpulseOfItsPressure) {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator><use_load_curves>true</use_load_curves>";
  deck.objects =
      "<geom_object><box><min>[0.2,0.2,0.2]</min><max>[0.6,0.6,0.6]</max></box>"
      "<res>[2,2,2]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
      "</geom_object>";
  deck.blocks = pressure("<min>[0.199,0.2,0.2]</min><max>[0.201,0.6,0.6]</max>", 1000);
  const TextRun run(deck,
                    {{"<maxTime>1<", "<maxTime>0.02<"},
                     {"<outputInterval>0</outputInterval>", saves({"TotalMomentum"})}},
                    "impulse");
  const auto rows = run.history("TotalMomentum");
  ASSERT_GT(rows.size(), 3U);
  const std::vector<double>&last = rows.back(), &before = rows[rows.size() - 2];
  const double impulse = 1000 * 0.4 * 0.4 * 0.5 * (last[0] + before[0]);
  EXPECT_NEAR(last[1], impulse, 1e-12 * impulse);
  EXPECT_NEAR(last[2], 0, 1e-12 * impulse);
  EXPECT_NEAR(last[3], 0, 1e-12 * impulse);
}

// A column at rest on its floor. The force of a side is that of the stresses: all of the
// weight but that
// of the nodes on the side, half a cell of eight (a little more, for the column is compressed
// there).
TEST(Gravity, TheFloorCarriesTheWeightOfAColumn) {
  SolidDeck deck;
  deck.upper = "[0.1,0.1,1]";
  deck.cells = "[1,1,10]";
  deck.flags =
      "<interpolator>gimp</interpolator>"
      "<artificial_damping_coeff>120</artificial_damping_coeff>";
  deck.objects =
      "<geom_object><box><min>[0,0,0]</min><max>[1,1,0.8]</max></box><res>[1,1,2]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  const TextRun run(deck,
                    {{"<gravity>[0,0,0]", "<gravity>[0,0,-10]"},
                     {"<maxTime>1<", "<maxTime>0.4<"},
                     {"<outputInterval>0</outputInterval>",
                      saves({"BndyForce_zminus", "BndyContactArea_zminus"})}},
                    "column");
  const double weight = 1000 * 10 * 0.8 * 0.01;
  const double carried = weight * (1 - 0.5 / 8);
  EXPECT_NEAR(run.history("BndyForce_zminus").back()[3], carried, 5e-4 * weight);  // measured 3e-4
  EXPECT_NEAR(run.history("BndyContactArea_zminus").back()[1], 0.01, 2e-4);
}

// A thick cylinder under inner pressure, axisymmetric: hoop stress of Lame. The load acts on the
// corners of the particles at the bore; in their middle it leaves 6 % there.
TEST(Axisymmetric, AThickCylinderHasLamesHoopStress) {
  SolidDeck deck;
  deck.upper = "[1.2,0.02,0.02]";
  deck.cells = "[60,1,1]";
  deck.flags =
      "<interpolator>gimp</interpolator><axisymmetric>true</axisymmetric>"
      "<use_load_curves>true</use_load_curves>"
      "<use_CBDI_boundary_condition>true</use_CBDI_boundary_condition>"
      "<artificial_damping_coeff>80</artificial_damping_coeff>";
  deck.objects =
      "<geom_object><box><min>[0.5,0,0]</min><max>[1,0.02,0.02]</max></box>"
      "<res>[2,1,1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
      "</geom_object>";
  deck.blocks =
      "<PhysicalBC><MPM><pressure><outward_normal>false</outward_normal>"
      "<geom_object><cylinder label='bore'>"
      "<bottom>[0,0,0]</bottom><top>[0,0,0.02]</top><radius>0.5</radius>"
      "<axisymmetric_side>true</axisymmetric_side></cylinder></geom_object>"
      "<load_curve><id>1</id><time_point><time>0</time><load>100</load></time_point>"
      "<time_point><time>1</time><load>100</load></time_point></load_curve></pressure>"
      "</MPM></PhysicalBC>";
  const TextRun run(deck,
                    {{"<maxTime>1<", "<maxTime>0.25<"},
                     {"<outputInterval>0</outputInterval>", saves({"p.x", "p.stress"})}},
                    "bore");
  const auto x = run.particles("p.x"), s = run.particles("p.stress");
  double worst = 0, peak = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p) {
    const double exact = 100 * 0.25 / 0.75 * (1 + 1 / (x[0][p] * x[0][p]));
    worst = std::max(worst, std::fabs(s[8][p] / exact - 1));
    peak = std::max(peak, s[8][p]);
  }
  RecordProperty("worst", fmt::format("{:.3e}", worst));
  EXPECT_LT(worst, 0.02);  // measured: 0.011
  EXPECT_NEAR(peak, 100 * 1.25 / 0.75, 0.05 * 100 * 1.25 / 0.75);
}

// ---- heat ------------------------------------------------------------------------------------

std::string half(double from, double to, double temperature) {
  return fmt::format(
      "<geom_object><box><min>[{},0,0]</min><max>[{},1,1]</max></box>"
      "<res>[2,1,1]</res><velocity>[0,0,0]</velocity>"
      "<temperature>{}</temperature></geom_object>",
      from, to, temperature);
}

// Two halves of a bar at 400 and 300 K: the part of T along cos(pi x), 200/pi at first, dies out as
// e^(-alpha pi^2 t). (Particles keep what nodes do not see: each keeps a share of the jump
// beside it.)
TEST(Heat, TheFirstModeOfABarDiesOutAsFourierSaysAndNoHeatIsLost) {
  SolidDeck deck;
  deck.upper = "[1,0.05,0.05]";
  deck.cells = "[20,1,1]";
  deck.flags = "<interpolator>gimp</interpolator>";
  deck.objects = half(0, 0.4999, 400) + half(0.5001, 1, 300);
  const TextRun run(
      deck,
      {{"<thermal_conductivity>1<", "<thermal_conductivity>500<"},
       {"<maxTime>1<", "<maxTime>0.3<"},
       {"<outputInterval>0</outputInterval>", saves({"p.x", "p.temperature", "ThermalEnergy"})}},
      "bar");
  const auto x = run.particles("p.x"), T = run.particles("p.temperature");
  double mode = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p)
    mode += 2.0 / 40 * (T[0][p] - 350) * std::cos(pi * x[0][p]);
  const double exact = 200 / pi * std::exp(-0.1 * pi * pi * run.time());
  RecordProperty("error", fmt::format("{:.3e}", mode / exact - 1));
  EXPECT_NEAR(mode, exact, 0.02 * exact);  // measured: 0.0022
  const auto heat = run.history("ThermalEnergy");
  EXPECT_NEAR(heat.back()[1] / heat.front()[1], 1, 1e-13);
}

TEST(Heat, ItPassesBetweenMaterialsOnlyWithThermalContact) {
  for (const bool contact : {false, true}) {
    SolidDeck deck;
    deck.upper = "[1,0.1,0.1]";
    deck.cells = "[10,1,1]";
    deck.flags = "<interpolator>gimp</interpolator>";
    deck.objects = half(0, 0.5, 400);
    deck.further = solid_material("other", half(0.5, 1, 300));
    if (contact) deck.contacts = "<thermal_contact></thermal_contact>";
    const TextRun run(deck,
                      {{"<thermal_conductivity>1<", "<thermal_conductivity>5000<"},
                       {"<thermal_conductivity>1<", "<thermal_conductivity>5000<"},
                       {"<maxTime>1<", "<maxTime>2<"},
                       {"<outputInterval>0</outputInterval>", saves({"p.temperature"})}},
                      "contact");
    for (const int m : {0, 1}) {
      const double wanted = contact ? 350 : m == 0 ? 400 : 300;
      const auto T = run.particles("p.temperature", m);
      double mean = 0;
      for (const double t : T[0]) mean += t / static_cast<double>(T[0].size());
      EXPECT_NEAR(mean, wanted, contact ? 0.5 : 1e-10) << m;
    }
  }
}

}  // namespace
}  // namespace sluice::mpm::outside_test

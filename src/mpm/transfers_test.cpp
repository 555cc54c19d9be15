// What every basis and transfer must hold, in runs of decks of inputs/mpm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "mpm/test_support/solid_run.hpp"

namespace sluice::mpm::transfers {
namespace {

// Young's modulus of the decks' material: 9 K G/(3 K + G).
constexpr double young = 9 * 0.6 * 0.3 / (3 * 0.6 + 0.3);
constexpr double most_flight_stress = 1e-12;  // of Young's modulus; measured 0
constexpr double most_momentum = 1e-12;       // of sum m |v|; measured 3e-15
constexpr double most_spin = 1e-12;           // of sum m |x| |v|; measured 1.6e-15
constexpr double most_frequency = 0.01;       // measured .0035 (CPDI) to .0088 (cubic)

std::string flag(const std::string& name, const std::string& value) {
  return "MPM/" + name + "=" + value;
}

double column(const ParticleTable& t, const char* name, int component, std::size_t n) {
  return t.find(name)->components[component][n];
}

double largest(const ParticleTable& t, const char* name) {
  double most = 0;
  for (const auto& c : t.find(name)->components)
    for (const double x : c) most = std::max(most, std::fabs(x));
  return most;
}

// Names as tests have them.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !std::isalnum(c); }, '_');
  return text;
}

using Flags = std::vector<std::string>;
struct Case {
  std::string name;
  Flags flags;
};
std::ostream& operator<<(std::ostream& to, const Case& c) {
  return to << c.name;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"linear", {flag("interpolator", "linear")}},
      {"linear_plain", {flag("interpolator", "linear"), flag("musl", "false")}},
      {"gimp", {flag("interpolator", "gimp")}},
      {"cpgimp", {flag("interpolator", "cpgimp")}},
      {"quadratic", {flag("interpolator", "quadraticBS")}},
      {"cubic", {flag("interpolator", "cubicBS")}},
      {"cpdi", {flag("interpolator", "cpdi")}},
      {"cpdi_cut", {flag("interpolator", "cpdi"), flag("cpdi_lcrit", "0.3")}},
      {"gimp_xpic2", {flag("interpolator", "gimp"), flag("transfer", ""), flag("XPIC2", "true")}},
      {"gimp_xpic3",
       {flag("interpolator", "gimp"), flag("transfer", "xpic"), flag("xpic_order", "3")}},
      {"quadratic_affine", {flag("interpolator", "quadraticBS"), flag("transfer", "affine")}},
      {"quadratic_apic", {flag("interpolator", "quadraticBS"), flag("transfer", "apic")}},
      {"cpdi_affine", {flag("interpolator", "fast_cpdi"), flag("transfer", "affine")}},
      {"gimp_enhanced",
       {flag("interpolator", "gimp"), flag("transfer", ""),
        flag("UseGradientEnhancedVelocityProjection", "true")}},
      {"quadratic_reference",
       {flag("interpolator", "quadraticBS"), flag("total_lagrangian", "true")}},
      {"gimp_midpoint", {flag("interpolator", "gimp"), flag("transfer", "midpoint")}},
      {"quadratic_midpoint", {flag("interpolator", "quadraticBS"), flag("transfer", "midpoint")}},
      {"cubic_midpoint", {flag("interpolator", "cubicBS"), flag("transfer", "midpoint")}},
      {"cpdi_midpoint", {flag("interpolator", "cpdi"), flag("transfer", "midpoint")}},
      {"carried_corners_midpoint",
       {flag("interpolator", "carried_corners"), flag("transfer", "midpoint")}},
      {"carried_corners", {flag("interpolator", "carried_corners")}},
      {"carried_corners_affine",
       {flag("interpolator", "carried_corners"), flag("transfer", "affine")}},
      {"carried_corners_xpic3",
       {flag("interpolator", "carried_corners"), flag("transfer", "xpic"),
        flag("xpic_order", "3")}},
  };
  return all;
}

class EveryTransfer : public testing::TestWithParam<Case> {};

// Free flight over 100 cells at the speed of sound.
TEST_P(EveryTransfer, FlightLeavesNoStress) {
  const SolidRun run("moving_block", GetParam().flags);
  const ParticleTable start = run.particles("first"), end = run.particles("last");
  ASSERT_EQ(start.size(), end.size());
  const double stress = largest(end, "p.stress") / young;
  RecordProperty("stress", std::to_string(1e15 * stress) + "e-15");
  EXPECT_LE(stress, most_flight_stress);
  for (std::size_t n = 0; n < end.size(); ++n) {
    EXPECT_NEAR(column(end, "p.velocity", 0, n), 1, 1e-12);
    EXPECT_NEAR(column(end, "p.velocity", 1, n), 0.5, 1e-12);
  }
}

// Momentum of a collision, between sides that take none.
TEST_P(EveryTransfer, CollisionKeepsMomentum) {
  const SolidRun run("colliding_blocks", GetParam().flags);
  const ParticleTable start = run.particles("first"), end = run.particles("last");
  double size = 0;
  for (std::size_t n = 0; n < start.size(); ++n)
    size += column(start, "p.mass", 0, n) * std::fabs(column(start, "p.velocity", 0, n));
  for (int d = 0; d < 2; ++d) {
    double before = 0, after = 0;
    for (std::size_t n = 0; n < start.size(); ++n) {
      before += column(start, "p.mass", 0, n) * column(start, "p.velocity", d, n);
      after += column(end, "p.mass", 0, n) * column(end, "p.velocity", d, n);
    }
    RecordProperty(d == 0 ? "drift_x" : "drift_y",
                   std::to_string(1e15 * std::fabs(after - before) / size) + "e-15");
    EXPECT_NEAR(before, after, most_momentum * size);
  }
}

// Mirror images to the bit: x -> -x of the scene, whose lattice is exact in binary numbers.
TEST_P(EveryTransfer, MirrorImageHasMirroredBits) {
  Flags mirrored = GetParam().flags, plain_flags = mirrored;
  const std::string object = "MaterialProperties/MPM/material/geom_object";
  for (const char* to : {"[1]/box/min=[0.1,-0.35,0]", "[1]/box/max=[0.6,0.15,0.125]",
                         "[1]/velocity=[-0.3,0.05,0]", "[2]/box/min=[-0.55,-0.1,0]",
                         "[2]/box/max=[-0.15,0.4,0.125]", "[2]/velocity=[0.25,-0.1,0]"})
    mirrored.push_back(object + to);
  const ParticleTable a = SolidRun("colliding_blocks", plain_flags).particles();
  const ParticleTable b = SolidRun("colliding_blocks", mirrored).particles();
  ASSERT_EQ(a.size(), b.size());
  const auto rows = [](const ParticleTable& t, double sign) {
    std::vector<std::array<double, 5>> all;
    for (std::size_t n = 0; n < t.size(); ++n) {
      const Vec3 x = t.position(n);
      all.push_back({sign * x.x, x.y, sign * column(t, "p.velocity", 0, n),
                     column(t, "p.velocity", 1, n), column(t, "p.stress", 0, n)});
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto own = rows(a, 1), image = rows(b, -1);
  for (std::size_t n = 0; n < own.size(); ++n) ASSERT_EQ(own[n], image[n]) << n;
}

TEST_P(EveryTransfer, BoxesAndThreadsChangeNoBit) {
  const ParticleTable a = SolidRun("colliding_blocks", GetParam().flags).particles();
  const ParticleTable b = SolidRun("colliding_blocks", GetParam().flags, 2, {3, 2, 1}).particles();
  ASSERT_EQ(a.ids, b.ids);
  for (std::size_t c = 0; c < a.columns.size(); ++c)
    EXPECT_EQ(a.columns[c].components, b.columns[c].components) << a.columns[c].info.name;
}

INSTANTIATE_TEST_SUITE_P(Transfers, EveryTransfer, testing::ValuesIn(cases()),
                         [](const auto& of) { return plain(of.param.name); });

// Angular momentum of a block that shears, rings and turns. APIC carries a part of it in C:
// m (C_yx - C_xy) h^2/4 a particle.
TEST(Transfers, ApicKeepsAngularMomentum) {
  const SolidRun run("turning_block");
  const double h = 0.05;
  const auto spin = [&](const ParticleTable& t, double& size) {
    double sum = 0;
    size = 0;
    for (std::size_t n = 0; n < t.size(); ++n) {
      const Vec3 x = t.position(n);
      const double m = column(t, "p.mass", 0, n), vx = column(t, "p.velocity", 0, n),
                   vy = column(t, "p.velocity", 1, n);
      sum += m * (x.x * vy - x.y * vx) +
             0.25 * h * h * m *
                 (column(t, "p.affineVelocity", 3, n) - column(t, "p.affineVelocity", 1, n));
      size += m * std::hypot(x.x, x.y) * std::hypot(vx, vy);
    }
    return sum;
  };
  double size = 0, size_after = 0;
  const double before = spin(run.particles("first"), size),
               after = spin(run.particles("last"), size_after);
  EXPECT_GT(std::fabs(before), 0.5 * size);
  RecordProperty("loss", std::to_string(1e15 * std::fabs(after - before) / size) + "e-15");
  EXPECT_NEAR(after, before, most_spin * size);
}

// p.scalefactor: F diag(h) R0, whatever the basis.
TEST(Transfers, ScaleFactorIsTheDeformedEdges) {
  for (const char* basis : {"cpdi", "gimp"}) {
    const ParticleTable t = SolidRun("colliding_blocks", {flag("interpolator", basis)}).particles();
    for (std::size_t n = 0; n < t.size(); n += 7)
      for (int a = 0; a < 3; ++a)
        for (int e = 0; e < 3; ++e)
          EXPECT_NEAR(column(t, "p.scalefactor", 3 * a + e, n),
                      column(t, "p.deformationMeasure", 3 * a + e, n) * 0.125 *
                          column(t, "p.size", 4 * e, n),
                      1e-15);
  }
}

class EveryBasis : public testing::TestWithParam<Case> {};

// The frequency of the lowest mode of a bar held at one end, pi/2 c/L, ten cells long.
TEST_P(EveryBasis, BarVibratesAtItsFrequency) {
  const SolidRun run("vibrating_bar", GetParam().flags);
  const Archive archive = run.archive();
  std::vector<double> times, amplitudes;
  const ParticleTable start = run.particles("first");
  for (const StepEntry& entry : archive.outputs()) {
    const ArchiveStep step = archive.read_output(entry);
    const ParticleTable t = read_particles(step, 0);
    double sum = 0;
    for (std::size_t n = 0; n < t.size(); ++n)
      sum += column(t, "p.velocity", 0, n) * std::sin(0.5 * std::numbers::pi * start.position(n).x);
    times.push_back(step.info().time);
    amplitudes.push_back(sum);
  }
  std::vector<double> crossings;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (amplitudes[k - 1] * amplitudes[k] < 0)
      crossings.push_back(times[k - 1] + (times[k] - times[k - 1]) * amplitudes[k - 1] /
                                             (amplitudes[k - 1] - amplitudes[k]));
  ASSERT_GE(crossings.size(), 5u);
  const double half_period =
      (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  RecordProperty("half_period", std::to_string(half_period));
  EXPECT_NEAR(half_period, 2, 2 * most_frequency);
}

INSTANTIATE_TEST_SUITE_P(
    Transfers, EveryBasis,
    testing::Values(
        Case{"linear", {flag("interpolator", "linear")}},
        Case{"gimp", {flag("interpolator", "gimp")}},
        Case{"quadratic", {flag("interpolator", "quadraticBS")}},
        Case{"cubic", {flag("interpolator", "cubicBS")}},
        Case{"gimp_midpoint", {flag("interpolator", "gimp"), flag("transfer", "midpoint")}},
        Case{"cubic_midpoint", {flag("interpolator", "cubicBS"), flag("transfer", "midpoint")}},
        Case{"cpdi", {flag("interpolator", "cpdi")}},
        Case{"cpdi_midpoint", {flag("interpolator", "cpdi"), flag("transfer", "midpoint")}},
        Case{"corners_midpoint",
             {flag("interpolator", "carried_corners"), flag("transfer", "midpoint")}},
        Case{"carried_corners", {flag("interpolator", "carried_corners")}},
        Case{"reference", {flag("interpolator", "quadraticBS"), flag("total_lagrangian", "true")}}),
    [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace sluice::mpm::transfers

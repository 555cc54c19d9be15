// The vortex ring, a manufactured motion with shear strains of 3, against its exact places.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::vortex_ring_test {
namespace {

using Overrides = std::vector<std::string>;

CaseRun ring(int n, const Overrides& more) {
  Overrides overrides = {resolution(n, n)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return CaseRun(SLUICE_SOURCE_DIR "/inputs/mpm/vortex_ring.ups", overrides, {"--threads", "2"});
}

// Mean distance of all particles, by volume, from where they should be at an output.
double place_error(const CaseRun& run, const char* output, double amplitude = 1) {
  const auto x = run.particles("p.x", output), u = run.particles("p.displacement", output);
  const auto V = run.particles("p.volume", output);
  const double t = run.time(output);
  const double turn = 0.5 * amplitude * (1 - std::cos(2 * std::numbers::pi * t));
  double sum = 0, volume = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p) {
    const double X = x[0][p] - u[0][p], Y = x[1][p] - u[1][p], s = std::hypot(X, Y) - 1;
    const double angle = turn * (16 * s * s - 1) * (16 * s * s - 1);
    const double c = std::cos(angle), d = std::sin(angle);
    sum += V[0][p] * std::hypot(c * X - d * Y - x[0][p], d * X + c * Y - x[1][p]);
    volume += V[0][p];
  }
  return sum / volume;
}

double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

TEST(VortexRing, ComesBack) {
  const CaseRun run = ring(60, {});
  record("quarter", place_error(run, "#2")), record("end", place_error(run, "last"));
  EXPECT_LE(place_error(run, "#2"), 1.4e-2);
  EXPECT_LE(place_error(run, "last"), 3.4e-2);  // measured 3.25e-2
}

// Places at the end of the motion there and back: of the 18 runs of Kamojjala and others (2015) 2
// get there, none of this amplitude.
TEST(FullVortexRing, ConvergesToTheSecondOrder) {
  constexpr double lowest_late = 1.8, lowest_early = 1.9, allowed = 1.5e-3;
  std::array<double, 4> early{}, late{};
  constexpr std::array<int, 4> cells{120, 240, 300, 480};
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const CaseRun run = ring(cells[n], {});
    early[n] = place_error(run, "#2"), late[n] = place_error(run, "last");
    record("quarter " + std::to_string(cells[n]), early[n]);
    record("end " + std::to_string(cells[n]), late[n]);
  }
  EXPECT_GE(order(early[0], early[1], 2), lowest_early);
  EXPECT_GE(order(late[0], late[2], 2.5), lowest_late);
  EXPECT_GE(order(late[2], late[3], 1.6), lowest_late);
  EXPECT_LE(late[3], allowed);
}

TEST(FullVortexRing, HalfTheAmplitude) {
  double error[2];
  for (const int n : {0, 1}) {
    const CaseRun run = ring(n == 0 ? 120 : 240, {"MPM/manufactured_amplitude=0.5"});
    error[n] = place_error(run, "last", 0.5);
    record("end " + std::to_string(n), error[n]);
  }
  EXPECT_GE(order(error[0], error[1], 2), 1.5);
  EXPECT_LE(error[1], 1e-3);
}

// Particles that find their nodes anew in every step, to a quarter of the time.
struct Updated {
  const char *basis, *transfer;
  double order;
};
class UpdatedRing : public testing::TestWithParam<Updated> {};

TEST_P(UpdatedRing, ConvergesWithTheGrid) {
  const auto [basis, transfer, lowest] = GetParam();
  const Overrides updated = {"MPM/total_lagrangian=false", "Time/maxTime=0.25",
                             std::string("MPM/interpolator=") + basis,
                             std::string("MPM/transfer=") + transfer};
  const double coarse = place_error(ring(60, updated), "last");
  const double fine = place_error(ring(120, updated), "last");
  record("order", order(coarse, fine, 2));
  EXPECT_GE(order(coarse, fine, 2), lowest) << coarse << ' ' << fine;
}
// Measured 2.14, 2.10, 1.94, 1.96, 1.90.
INSTANTIATE_TEST_SUITE_P(Of, UpdatedRing,
                         testing::Values(Updated{"quadraticBS", "apic", 1.9},
                                         Updated{"cubicBS", "apic", 1.9},
                                         Updated{"cpdi", "flip", 1.9},
                                         Updated{"quadraticBS", "flip", 1.7},
                                         Updated{"gimp", "flip", 0.9}));

}  // namespace
}  // namespace sluice::verification::vortex_ring_test

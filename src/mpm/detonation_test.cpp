// A programmed detonation from a wall, and the wave of Taylor behind it.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::detonation_test {
namespace {

// Products p = C v^-3 that detonate by Chapman and Jouguet at D: p = rho_0 D^2/4 at v = 3/4.
// Behind the front (Taylor 1950, with the exponent 3): u = (x/t - D/2)/2 from x = D t/2 on, and
// before that rest, where p = 2/27 rho_0 D^2.
TEST(Detonation, LeavesTheWaveOfTaylorBehindIt) {
  const double D = 8000, rho = 1000, end = 1e-4;
  SolidDeck deck;
  deck.upper = "[1,0.005,0.005]";
  deck.cells = "[200,1,1]";
  deck.flags = "<interpolator>gimp</interpolator><artificial_viscosity>true</artificial_viscosity>";
  deck.objects =
      "<geom_object><box><min>[0,0,0]</min><max>[1,0.005,0.005]</max></box><res>[2,1,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  const std::string law = fmt::format(
      "program_burn'><K>1.6e-10</K><n>4</n><A>0</A><B>0</B><C>{}</C><R1>4</R1><R2>1</R2><om>2</om>"
      "<D>8000</D><starting_location>[0,0.3,0]</starting_location>"
      "<direction_if_plane>[2,0,0]</direction_if_plane>",
      rho * D * D / 4 * std::pow(0.75, 3));
  const TextRun run(
      deck,
      {{"comp_neo_hook'><bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus>", law},
       {"<maxTime>1<", fmt::format("<maxTime>{}<", end)},
       {"<timestep_multiplier>0.4<", "<timestep_multiplier>0.2<"},
       {"<outputInterval>0</outputInterval>",
        saves({"p.x", "p.displacement", "p.velocity", "p.stress", "p.progressF"})}},
      "detonation");
  const auto x = run.particles("p.x"), moved = run.particles("p.displacement"),
             v = run.particles("p.velocity"), s = run.particles("p.stress"),
             f = run.particles("p.progressF");
  const double t = run.time();
  double rest = 0, count = 0, error = 0, size = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p) {
    const double start = x[0][p] - moved[0][p], xi = x[0][p] / (D * t);
    EXPECT_EQ(f[0][p] > 0, start < D * t) << start;
    if (xi > 0.1 && xi < 0.4) {
      rest -= s[0][p] / (2.0 / 27 * rho * D * D);
      ++count;
    }
    if (xi < 0.9) {
      const double u = std::max(0.5 * D * (xi - 0.5), 0.0);
      error += std::fabs(v[0][p] - u);
      size += u;
    }
  }
  RecordProperty("rest", fmt::format("{:.5f}", rest / count));
  RecordProperty("wave", fmt::format("{:.3e}", error / size));
  EXPECT_NEAR(rest / count, 1, 0.02);  // measured 0.9936
  EXPECT_LT(error / size, 0.08);       // measured 0.061
}

}  // namespace
}  // namespace sluice::mpm::detonation_test

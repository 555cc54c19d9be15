// Weak pulses that meet the surface between air and an elastic solid, against linear acoustics.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::sound_at_solids_test {
namespace {

constexpr double p0 = 1e5, gamma = 1.4, rho = 1.1614401858, surface = 2;
constexpr double shear = 0.75e5;

// An elastic solid, where its surface lies in its cell, and the exchange of momentum with the air.
struct Solid {
  double density, bulk;
  const char* from;
  const char* exchange;

  double modulus() const { return bulk + 4 * shear / 3; }
  double speed() const { return std::sqrt(modulus() / density); }
  // Of impedances.
  double ratio() const { return density * speed() / std::sqrt(gamma * p0 * rho); }
};
double air_speed() {
  return std::sqrt(gamma * p0 / rho);
}

CaseRun run_of(const char* deck, int per_unit, const Solid& s) {
  const std::string material = "MaterialProperties/MPM/material/";
  return CaseRun(std::string(SLUICE_SOURCE_DIR) + "/inputs/mpmice/" + deck + ".ups",
                 {resolution(4 * per_unit), material + fmt::format("density={:g}", s.density),
                  material + fmt::format("constitutive_model/bulk_modulus={:g}", s.bulk),
                  material + fmt::format("geom_object[1]/box/min=[{},0,0]", s.from),
                  std::string("MaterialProperties/exchange_properties/exchange_coefficients/"
                              "momentum=[") +
                      s.exchange + "]"});
}

// Integral of p - p0 over the air.
double in_air(const CaseRun& run, const char* when) {
  const CellValues p = run.field("press_CC", 0, when);
  double sum = 0;
  for (int i = 0; i < p.size.x; ++i)
    if (p.centre(i).x < surface - 0.05) sum += (p.at(i) - p0) * p.spacing.x;
  return sum;
}

// Integral of -sigma_xx over the particles nearer than x.
double in_solid(const CaseRun& run, double x) {
  const auto place = run.particles("p.x"), stress = run.particles("p.stress"),
             volume = run.particles("p.volume");
  double sum = 0;
  for (std::size_t p = 0; p < place[0].size(); ++p)
    if (place[0][p] < x) sum -= stress[0][p] * volume[0][p];
  return sum;
}

class SoundAtSolids : public testing::TestWithParam<Solid> {};

TEST_P(SoundAtSolids, OfTheAirComesBackAndGoesOn) {
  const CaseRun run = run_of("sound_into_solid", 100, GetParam());
  const double Z = GetParam().ratio(), pulse = in_air(run, "first");
  const double back = in_air(run, "last") / pulse, on = in_solid(run, 4) / pulse;
  const double on_wanted = 2 * Z / (Z + 1) * GetParam().speed() / air_speed();
  record("back", back / ((Z - 1) / (Z + 1)) - 1), record("on", on / on_wanted - 1);
  EXPECT_NEAR(back, (Z - 1) / (Z + 1), 0.005 * (Z - 1) / (Z + 1));
  EXPECT_NEAR(on, on_wanted, 0.005 * on_wanted);
}

// Slabs move at -v sin^2, a mean of v/2 over .4: a pulse of half of that runs to each side.
TEST_P(SoundAtSolids, OfTheSolidGoesOnAndComesBack) {
  constexpr double slabs = 0.4, mean = 0.0135;
  const CaseRun run = run_of("sound_out_of_solid", 100, GetParam());
  const Solid& s = GetParam();
  const double Z = s.ratio(), pulse = s.density * s.speed() * mean / 2 * slabs;
  const double on = in_air(run, "last") / pulse, back = in_solid(run, 2.95) / pulse;
  const double on_wanted = 2 / (Z + 1) * air_speed() / s.speed(), back_wanted = (1 - Z) / (Z + 1);
  record("on", on / on_wanted - 1), record("back", back / back_wanted - 1);
  EXPECT_NEAR(on, on_wanted, 0.005 * on_wanted);
  EXPECT_NEAR(back, back_wanted, 0.005 * std::fabs(back_wanted));
}

INSTANTIATE_TEST_SUITE_P(Of, SoundAtSolids,
                         testing::Values(Solid{2, 1.75e5, "2.0033", "0"},
                                         Solid{5, 4.44e5, "2.007", "1e15"}));
INSTANTIATE_TEST_SUITE_P(Full, SoundAtSolids,
                         testing::Values(Solid{2, 1.75e5, "2", "1e15"},
                                         Solid{5, 4.44e5, "2.0033", "0"}));

}  // namespace
}  // namespace sluice::verification::sound_at_solids_test

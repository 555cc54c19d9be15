// Bars in implicit steps, against closed forms and against explicit steps.
#include <gtest/gtest.h>

#include <numbers>

#include "mpm/test_support/implicit_run.hpp"

namespace sluice::mpm::implicit_bar_test {
namespace {

// The material of SolidDeck: K + 4G/3 and rho.
constexpr double modulus = 1e6 + 4.0 / 3 * 5e5, density = 1000;

TextRun::Rewrites with_gravity(TextRun::Rewrites rewrites, double g) {
  rewrites.emplace_back("<gravity>[0,0,0]", fmt::format("<gravity>[{},0,0]", g));
  return rewrites;
}

// The particle of the largest x.
std::size_t tip_of(const std::vector<double>& x) {
  return static_cast<std::size_t>(std::max_element(x.begin(), x.end()) - x.begin());
}

// u = rho g/E (L x - x^2/2) of places at the start.
TEST(ImplicitBar, HangsAsTheClosedFormInOneStep) {
  constexpr double g = 1e-3, length = 1, tolerance = 3e-3;  // of the tip's way; not measured yet
  const TextRun run(bar(10, "<time_integrator>implicit</time_integrator><dynamic>false</dynamic>" +
                                std::string("<total_lagrangian>true</total_lagrangian>")),
                    with_gravity(implicit_steps(1, 1, saves({"p.displacement"})), g), "hangs", 1,
                    implicit_solids);
  const std::vector<double> x = run.particles("p.x")[0], u = run.particles("p.displacement")[0];
  const double tip = density * g / modulus * length * length / 2;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double X = x[p] - u[p];
    EXPECT_NEAR(u[p], density * g / modulus * (length * X - X * X / 2), tolerance * tip);
  }
}

// Once a load rests, steps without inertia have nothing left to find: with wide shape functions
// too, some of whose nodes hold next to nothing.
TEST(ImplicitBar, RestsUnderAConstantLoad) {
  for (const char* basis : {"linear", "gimp", "3rdorderBS"}) {
    const TextRun run(
        bar(10, fmt::format("<time_integrator>implicit</time_integrator><dynamic>false</dynamic>"
                            "<interpolator>{}</interpolator>",
                            basis)),
        with_gravity(implicit_steps(1, 4, saves({"p.displacement", "p.velocity"})), 1e-3), "rests",
        1, implicit_solids);
    const std::vector<double> x = run.particles("p.x")[0], u = run.particles("p.displacement")[0],
                              v = run.particles("p.velocity")[0];
    const std::size_t tip = tip_of(x);
    EXPECT_NEAR(u[tip] / (density * 1e-3 / modulus / 2), 1, 0.03) << basis;
    EXPECT_NEAR(v[tip] / u[tip], 0, 1e-3) << basis;
  }
}

// Gravity begins at once: after half the longest period, 2 L/c, every mode has gone its way, and
// the tip is twice as low as at rest; after a whole one the bar is as it was.
TEST(ImplicitBar, SwingsWithItsPeriod) {
  constexpr double g = 1e-3, length = 2, tolerance = 0.02;  // not measured yet
  const double c = std::sqrt(modulus / density), half = 2 * length / c;
  const double rest = density * g / modulus * length * length / 2;
  const auto tip_after = [&](double time) {
    const TextRun run(
        bar(20,
            "<time_integrator>implicit</time_integrator>"
            "<total_lagrangian>true</total_lagrangian>"),
        with_gravity(implicit_steps(half / 80, time, saves({"p.displacement", "p.velocity"})), g),
        "swings", 1, implicit_solids);
    const std::vector<double> x = run.particles("p.x")[0];
    return run.particles("p.displacement")[0][tip_of(x)];
  };
  EXPECT_NEAR(tip_after(half) / rest, 2, 2 * tolerance);
  EXPECT_NEAR(tip_after(2 * half) / rest, 0, 2 * tolerance);
}

// The trapezoidal rule is of second order in time. Particles blur the acceleration that they carry,
// which adds an error of first order in time and second in space: it is small in long bars.
TEST(ImplicitBar, ErrorsFallWithTheSquareOfTheStep) {
  constexpr double end = 0.08;
  const auto tip = [&](int steps) {
    const TextRun run(
        bar(40,
            "<time_integrator>implicit</time_integrator>"
            "<total_lagrangian>true</total_lagrangian>"),
        with_gravity(implicit_steps(end / steps, end, saves({"p.displacement"})), 1e-3), "order", 1,
        implicit_solids);
    return run.particles("p.displacement")[0][tip_of(run.particles("p.x")[0])];
  };
  const double reference = tip(320);
  const double coarse = std::fabs(tip(5) - reference), fine = std::fabs(tip(10) - reference);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

// A bar that a rigid body shortens slowly: one implicit step ends where four hundred
// explicit ones do.
TEST(ImplicitBar, EndsWhereExplicitStepsEnd) {
  constexpr double tolerance = 5e-3;
  const std::string rigid =
      "<material name='piston'><density>1000</density><is_rigid>true</is_rigid>"
      "<constitutive_model type='comp_neo_hook'><bulk_modulus>1e6</bulk_modulus>"
      "<shear_modulus>5e5</shear_modulus></constitutive_model>"
      "<thermal_conductivity>1</thermal_conductivity><specific_heat>5</specific_heat>"
      "<geom_object><box><min>[0.5,0,0]</min><max>[0.6,0.1,0.1]</max></box><res>[2,1,1]</res>"
      "<velocity>[-0.01,0,0]</velocity><temperature>300</temperature></geom_object></material>";
  const auto stress = [&](bool implicit) {
    SolidDeck deck = bar(5, implicit ? "<time_integrator>implicit</time_integrator>"
                                       "<dynamic>false</dynamic>"
                                     : "<artificial_damping_coeff>20</artificial_damping_coeff>");
    deck.further = rigid;
    deck.contacts = std::string("<contact><type>rigid</type><materials>[0,1]</materials>") +
                    (implicit ? "" : "<master_material>1</master_material>") +
                    "<direction>[1,0,0]</direction></contact>";
    TextRun::Rewrites rewrites = implicit_steps(implicit ? 0.4 : 1e-3, 0.4, saves({"p.stress"}));
    if (!implicit) rewrites.erase(rewrites.begin());
    const TextRun run(deck, rewrites, "pressed", 1, implicit_solids);
    return run.particles("p.stress")[0];
  };
  const std::vector<double> by_implicit = stress(true), by_explicit = stress(false);
  ASSERT_EQ(by_implicit.size(), by_explicit.size());
  double mean_implicit = 0, mean_explicit = 0;
  for (std::size_t p = 0; p < by_implicit.size(); ++p) {
    mean_implicit += by_implicit[p];
    mean_explicit += by_explicit[p];
  }
  EXPECT_NEAR(mean_implicit / mean_explicit, 1, tolerance);
}

}  // namespace
}  // namespace sluice::mpm::implicit_bar_test

// Every kind of exact solution made from its parameters; error norms.
#include "exact/exact_solutions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "exact/base/error_norms.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::exact_solution_test {
namespace {

using Values = std::map<std::string, std::string>;

std::unique_ptr<ExactSolution> make(const std::string& type, const Values& values) {
  return make_exact_solution(SolutionParameters(type, values));
}

std::string refusal(const std::string& type, const Values& values) {
  try {
    make(type, values);
  } catch (const InputError& fault) {
    return fault.what();
  }
  return "accepted";
}

const Values sod = {{"left", "[1, 0, 1]"}, {"right", "[0.125, 0, 0.1]"}, {"position", "0.5"}};

TEST(MakeExactSolution, RiemannProblemAlongAnyAxis) {
  const auto along_x = make("riemann", sod);
  Values turned = sod;
  turned["direction"] = "[0, 1, 0]";
  const auto along_y = make("riemann", turned);
  for (double s : {.1, .4, .6, .7, .9}) {
    const State a = along_x->at({s, 7, 3}, .2), b = along_y->at({7, s, 3}, .2);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.velocity.x, b.velocity.y);
    EXPECT_EQ(b.velocity.x, 0);
  }
  EXPECT_EQ(along_x->at({.499, 0, 0}, 0).density, 1);
  EXPECT_EQ(along_x->at({.501, 0, 0}, 0).density, .125);
}

TEST(MakeExactSolution, EveryKindCanBeMadeAndSampled) {
  const std::map<std::string, Values> samples = {
      {"riemann", sod},
      {"two_materials",
       {{"left", "[1000, 0, 1e9]"},
        {"eos_left", "StiffenedGas gamma=4.4 pinf=6e8 specific_heat=1816"},
        {"right", "[50, 0, 1e5]"},
        {"eos_right", "ideal_gas gamma=1.4 specific_heat=717.5"},
        {"position", "0.7"},
        {"materials", "[1, 0]"}}},
      {"shock_at_interface",
       {{"left", "[1.2, 0, 1e5]"},
        {"eos_left", "ideal_gas gamma=1.4 specific_heat=717.5"},
        {"right", "[1000, 0, 1e5]"},
        {"eos_right", "StiffenedGas gamma=4.4 pinf=6e8 specific_heat=1816"},
        {"shock_pressure", "2e6"},
        {"shock_position", "0.2"},
        {"position", "0.7"}}},
      {"noh", {{"dimension", "3"}}},
      {"sedov", {{"energy", "0.851072"}}},
      {"isentropic_vortex", {{"velocity", "[1,1,0]"}, {"period", "16"}}},
      {"gresho", {{"mach", "0.1"}}},
      {"radial",
       {{"dimension", "3"},
        {"high", "1"},
        {"cells", "100"},
        {"states", "[1,0,1, .125,0,.1]"},
        {"edges", "0.4"}}},
      {"uniform", {{"velocity", "[1,2,3]"}}},
      {"advected_wave", {{"amplitude", "0.2"}, {"velocity", "[1,0,0]"}}},
      {"sound_wave", {{"amplitude", "1e-6"}}},
      {"simple_wave", {{"amplitude", "0.1"}, {"sense", "-1"}}},
      {"vortex_ring", {}},
      {"axis_aligned", {{"speed", "100"}}},
      {"hydrostatic", {{"gravity", "[0,-1,0]"}}}};
  for (const auto& help : exact_solution_help()) {
    ASSERT_TRUE(samples.contains(help.type)) << help.type;
    const auto solution = make(help.type, samples.at(help.type));
    if (solution->has_places()) continue;
    const State s = solution->at({.3, .2, .1}, .1);
    EXPECT_GT(s.density, 0) << help.type;
    EXPECT_TRUE(std::isfinite(s.pressure)) << help.type;
  }
  EXPECT_EQ(samples.size(), exact_solution_help().size());
}

TEST(MakeExactSolution, SaysWhatIsWrongWithTheParameters) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("rieman", sod), HasSubstr("known are: riemann, two_materials"));
  Values values = sod;
  values["centre"] = "0.5";
  EXPECT_THAT(refusal("riemann", values), HasSubstr("no parameter <centre>; it knows"));
  values = sod;
  values.erase("left");
  EXPECT_THAT(refusal("riemann", values), HasSubstr("needs the parameter <left>"));
  values = sod;
  values["left"] = "[1, 0]";
  EXPECT_THAT(refusal("riemann", values), HasSubstr("holds 2 numbers"));
  values = sod;
  values["position"] = "middle";
  EXPECT_THAT(refusal("riemann", values), HasSubstr("is 'middle', expected numbers"));
  values["position"] = "nan";
  EXPECT_THAT(refusal("riemann", values), HasSubstr("is 'nan'"));
  EXPECT_THAT(refusal("noh", {{"dimension", "4"}}), HasSubstr("a whole number from 1 to 3"));
  EXPECT_THAT(refusal("gresho", {{"mach", "-1"}}), HasSubstr("a number above zero"));
  EXPECT_THAT(refusal("sound_wave", {{"amplitude", "2"}}), HasSubstr("allowed is -1 to 1"));
  EXPECT_THAT(refusal("radial", {{"high", "1"}, {"states", "1 0 1"}, {"edges", "0.4"}}),
              HasSubstr("3 numbers in <states> and 1 in <edges>"));
}

TEST(ErrorNorms, NormsOfKnownDifferences) {
  const ErrorNorms norms = error_norms({1, 2, 3, 4}, {1, 2, 4, 2});
  EXPECT_EQ(norms.points, 4u);
  EXPECT_EQ(norms.l1, .75);
  EXPECT_EQ(norms.l2, std::sqrt(1.25));
  EXPECT_EQ(norms.linf, 2);
  EXPECT_EQ(norms.relative_l1, 3. / 9);
  EXPECT_TRUE(std::isnan(error_norms({std::nan(""), 2}, {1, 0}).linf));
  EXPECT_THROW(error_norms({1}, {1, 2}), InputError);
  EXPECT_EQ(error_norms({1, 2}, {1, 1}, {3, 1}).l1, .25);
  EXPECT_THROW(error_norms({1, 2}, {1, 1}, {3}), InputError);
}

TEST(ErrorNorms, VariablesOfAnArchive) {
  const State s{2, {1, -1, 3}, 4, 1.5};
  EXPECT_EQ(exact_value(s, "rho_CC", 0, 1), 2);
  EXPECT_EQ(exact_value(s, "vel_CC", 1, 1), -1);
  EXPECT_EQ(exact_value(s, "temp_CC", 0, 2), 2);  // 4 / (.5 2) / 2
  EXPECT_THROW(exact_value(s, "delP_Dilatate", 0, 1), InputError);
}

// Volume is kept, radii too; after a period all are back.
TEST(Motions, OfAVortexRingKeepVolumeAndComeBack) {
  const auto ring = make("vortex_ring", {});
  ASSERT_TRUE(ring->has_places());
  const Vec3 X{0.5, 0.8, 0.1};
  constexpr double h = 1e-6;
  const Vec3 dx =
      (ring->place(X + Vec3{h, 0, 0}, 0.4) - ring->place(X - Vec3{h, 0, 0}, 0.4)) * (0.5 / h);
  const Vec3 dy =
      (ring->place(X + Vec3{0, h, 0}, 0.4) - ring->place(X - Vec3{0, h, 0}, 0.4)) * (0.5 / h);
  EXPECT_NEAR(dx.x * dy.y - dx.y * dy.x, 1, 1e-8);
  const Vec3 x = ring->place(X, 0.5), back = ring->place(X, 1);
  EXPECT_NEAR(std::hypot(x.x, x.y), std::hypot(X.x, X.y), 1e-15);
  EXPECT_GT(std::fabs(x.x - X.x), 0.1);
  EXPECT_NEAR(back.x, X.x, 1e-15);
  EXPECT_THROW(ring->at(X, 0), InputError);
}

TEST(Motions, OfACubeLeaveItsSidesInPlace) {
  const auto cube = make("axis_aligned", {{"speed", "100"}, {"directions", "2"}});
  const Vec3 x = cube->place({1, 0.25, 0.25}, 0.005);
  EXPECT_NEAR(x.x, 1, 1e-15);
  EXPECT_NEAR(x.y, 0.25 - 0.05, 1e-15);
  EXPECT_EQ(x.z, 0.25);
}

}  // namespace
}  // namespace sluice::exact::exact_solution_test

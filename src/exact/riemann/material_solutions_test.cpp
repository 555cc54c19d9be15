// Flows of two materials as a deck names them, and laws as text.
#include "exact/riemann/material_solutions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "exact/base/law_text.hpp"
#include "exact/exact_solutions.hpp"
#include "exact/test_support/material_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::material_solutions_test {
namespace {

using testing::HasSubstr;
using Values = std::map<std::string, std::string>;

std::string refusal(const std::string& type, const Values& values) {
  try {
    make_exact_solution(SolutionParameters(type, values));
  } catch (const InputError& fault) {
    return fault.what();
  }
  return "accepted";
}

const Values tube = {{"left", "[1000, 0, 1e9]"},
                     {"eos_left", "StiffenedGas gamma=4.4 pinf=6e8 specific_heat=1816"},
                     {"right", "[50, 0, 1e5]"},
                     {"eos_right", "ideal_gas gamma=1.4 specific_heat=717.5"},
                     {"position", "0.7"}};

TEST(LawText, NamesEveryLawAndItsParameters) {
  const auto jwl = std::get<eos::Jwl>(
      law_from_text("JWL A=3.712e11 B=3.231e9 R1=4.15 R2=0.95 om=0.3 rho0=1630"));
  EXPECT_EQ(jwl.A, 3.712e11);
  EXPECT_EQ(jwl.rho0, 1630);
  EXPECT_EQ(jwl.specific_heat, 1);
  for (const char* name : {"ideal_gas", "StiffenedGas", "hard_sphere_gas", "TST", "JWL", "JWLC",
                           "Murnaghan", "BirchMurnaghan", "MieGruneisen", "Gruneisen", "Tillotson",
                           "Thomsen_Hartka_water", "KnaussSeaWater"}) {
    EXPECT_EQ(eos::name_of(law_from_text(name)), name);
    EXPECT_THAT(known_laws(), HasSubstr(name));
  }
}

TEST(LawText, SaysWhatIsWrong) {
  const auto said = [](const char* text) {
    try {
      law_from_text(text);
    } catch (const InputError& fault) {
      return std::string(fault.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(said("idealgas"), HasSubstr("known are: ideal_gas, StiffenedGas"));
  EXPECT_THAT(said(""), HasSubstr("known are"));
  EXPECT_THAT(said("ideal_gas gama=1.4"), HasSubstr("it knows: gamma, specific_heat"));
  EXPECT_THAT(said("ideal_gas gamma=x"), HasSubstr("contains no number"));
  EXPECT_THAT(said("ideal_gas gamma 1.4"), HasSubstr("is not NAME=NUMBER"));
}

TEST(TwoMaterials, AreThereAlongAnyAxisWithTheirNumbers) {
  Values turned = tube;
  turned["direction"] = "[0, 0, -1]";
  turned["position"] = "-0.7";
  turned["materials"] = "[2, 0]";
  const auto along = make_exact_solution({"two_materials", tube});
  const auto back = make_exact_solution({"two_materials", turned});
  EXPECT_EQ(along->materials(), 2);
  // Left of the interface at z < 0.7 along x; beyond it along -z.
  for (const double x : {.1, .3, .6, .75, .83, .9}) {
    const State a = along->at({x, 7, 3}, 2.4e-4), b = back->at({7, 3, 1.4 - x}, 2.4e-4);
    EXPECT_NEAR(a.density, b.density, 1e-10 * a.density);
    EXPECT_NEAR(a.velocity.x, -b.velocity.z, 1e-9);
    EXPECT_EQ(b.velocity.x, 0);
    EXPECT_EQ(b.material, a.material == 0 ? 2 : 0);
    EXPECT_NEAR(a.temperature(99), b.temperature(77), 1e-9 * a.temperature(99));
  }
  const State wet = along->at({.699, 0, 0}, 0), dry = along->at({.701, 0, 0}, 0);
  EXPECT_EQ(wet.material, 0);
  EXPECT_EQ(dry.material, 1);
  EXPECT_NEAR(wet.temperature(1), 1.6e9 / (3.4 * 1000 * 1816), 1e-9);
  EXPECT_NEAR(dry.temperature(1), 1e5 / (.4 * 50 * 717.5), 1e-12);
}

TEST(TwoMaterials, SayWhatIsWrongWithTheParameters) {
  Values values = tube;
  values["eos_left"] = "Water";
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("no equation of state 'Water'"));
  values = tube;
  values.erase("eos_right");
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("needs the parameter <eos_right>"));
  values = tube;
  values["materials"] = "[0.5, 1]";
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("<materials> must hold the numbers"));
  values = tube;
  values["right"] = "[50, 0, -1]";
  EXPECT_THAT(refusal("two_materials", values),
              HasSubstr("ideal_gas: there is no admissible state"));
  values = tube;
  values["left"] = "[50, 0]";
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("holds 2 numbers"));
  values = tube;
  values["eos_left"] = "Murnaghan n=7.4 K=39e-11 rho0=1160 specific_heat=1400";
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("<temperature_left>"));
  values["left"] = "[1200, 0, 1e9]";
  values["temperature_left"] = "300";
  EXPECT_THAT(refusal("two_materials", values), HasSubstr("depends on density only"));
  values["left"] = "[1160, 0, 101325]";
  EXPECT_EQ(refusal("two_materials", values), "accepted");
}

TEST(ShockAtInterface, HasAWallWhenThereIsNoSecondMaterial) {
  const Values wall = {{"left", "[1.2, 0, 1e5]"},
                       {"eos_left", "ideal_gas specific_heat=717.5"},
                       {"shock_pressure", "2e6"},
                       {"shock_position", "0.2"},
                       {"position", "0.7"}};
  const auto flow = make_exact_solution({"shock_at_interface", wall});
  const State late = flow->at({.699, 0, 0}, 1e-3);
  EXPECT_NEAR(late.pressure, 2e6 * (3.2 * 20 - .4) / (.4 * 20 + 2.4), 1);
  EXPECT_NEAR(late.velocity.x, 0, 1e-9);
}

// The flow of a reflected problem is the mirror image, whatever waves it has.
void expect_mirror_image(const ExactSolution& flow, const ExactSolution& image, double end) {
  for (int i = 0; i < 200; ++i) {
    const double x = (i + .5) / 200;
    for (const double t : {0.0, .3 * end, end}) {
      const State a = flow.at({x, 0, 0}, t), b = image.at({1 - x, 0, 0}, t);
      EXPECT_NEAR(a.density, b.density, 1e-9 * a.density) << x;
      EXPECT_NEAR(a.pressure, b.pressure, 1e-9 * std::abs(a.pressure) + 1e-5) << x;
      EXPECT_NEAR(a.velocity.x, -b.velocity.x, 1e-9 * std::abs(a.velocity.x) + 1e-9) << x;
      EXPECT_EQ(a.material, b.material) << x;
    }
  }
}

constexpr Placement mirrored(double position) {
  return {.position = position - 1, .direction = {-1, 0, 0}};
}

TEST(MirroredMaterials, ShockTubesAreMirrorImages) {
  struct Tube {
    MaterialSide left, right;
    double interface, end;
  };
  for (const Tube& one : {Tube{gas(1.4, 1, 0, 1), gas(1.667, .125, 0, .1), .5, .2},
                          Tube{gas(1.4, 1, 0, 500), gas(1.667, 1, 0, .2), .5, .01},
                          Tube{water(1000, 0, 1e9), gas(1.4, 1.2, 0, 1e5), .7, 1.2e-4},
                          Tube{gas(1.4, 6.26, 1000, 2e6), water(1000, 0, 1e5), .4, 3e-4}}) {
    SCOPED_TRACE(one.end);
    const MaterialRiemann riemann(one.left, one.right);
    expect_mirror_image(TwoMaterials(riemann, {.position = one.interface}),
                        TwoMaterials(riemann, mirrored(one.interface)), one.end);
  }
}

TEST(MirroredMaterials, ReflectedShocksAreMirrorImages) {
  for (const double ratio : {20.0, 200.0}) {
    SCOPED_TRACE(ratio);
    const ShockMeetsInterface shock(gas(1.4, 1.2, 0, 1e5), water(1000, 0, 1e5), ratio * 1e5, .3,
                                    .6);
    expect_mirror_image(ShockAtInterface(shock, {}), ShockAtInterface(shock, mirrored(0)), 2e-4);
  }
}

}  // namespace
}  // namespace sluice::exact::material_solutions_test

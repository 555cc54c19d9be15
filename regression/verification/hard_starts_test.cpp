// Starts that cannot be and states that leave the laws: the run ends with the cell, the material
// and the range named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "verification/case_run.hpp"

namespace sluice::verification::hard_starts_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string how_it_fails(const std::string& deck, const std::vector<std::string>& overrides) {
  try {
    const CaseRun run(deck, overrides);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "it did not fail";
}

const std::string materials = "MaterialProperties/ICE/";

// A gas at 1e14 Pa and a solid whose law turns over below, half and half: no pressure suits both.
TEST(HardStart, WithoutACommonPressureNamesCellMaterialsAndStates) {
  const std::string gas = materials + "material[1]/", solid = materials + "material[2]/";
  EXPECT_THAT(how_it_fails("products_into_solid",
                           {gas + "EOS/@type=StiffenedGas", gas + "EOS/pinf=0", gas + "gamma=2",
                            gas + "geom_object/density=1e6", gas + "geom_object/temperature=1e5",
                            gas + "geom_object/volumeFraction=0.5",
                            gas + "geom_object/box/max=[9,9,9]", solid + "EOS/@type=BirchMurnaghan",
                            solid + "EOS/n=3", solid + "geom_object/box/min=[-9,-9,-9]",
                            solid + "geom_object/volumeFraction=0.5"}),
              AllOf(HasSubstr("cell [0, 0, 0] of level 0 have no common pressure"),
                    HasSubstr("material 0 ('products'): volume fraction 0.5, density 1e+06"),
                    HasSubstr("pressure 1e+14 Pa (its equation of state allows more than 0)"),
                    HasSubstr("material 1 ('solid'): volume fraction 0.5, density 1160")));
}

TEST(HardStart, OverlappingMaterialsAreNamed) {
  EXPECT_THAT(how_it_fails("products_into_solid",
                           {materials + "material[1]/geom_object/box/max=[0.6,9,9]"}),
              AllOf(HasSubstr("volume fractions"), HasSubstr("cell [")));
}

TEST(HardStart, CellsThatNothingFillsAreNamed) {
  EXPECT_THAT(how_it_fails("products_into_solid",
                           {materials + "material[1]/geom_object/box/max=[0.4,9,9]"}),
              AllOf(HasSubstr("volume fractions"), HasSubstr("cell [")));
}

// More heat is taken from a material than it has: the step is made smaller until no step is small
// enough. Among others or alone in its cells or in its deck, whatever its law.
struct Cooled {
  const char* name;
  const char* deck;
  const char* material;
  const char* heat;  // W/kg
  const char *called, *range;
};
class HardState : public testing::TestWithParam<Cooled> {};

TEST_P(HardState, OutsideItsLawIsNamedAfterSmallerSteps) {
  const std::string heat = "CFD/ICE/ADD_HEAT/";
  const Cooled& c = GetParam();
  EXPECT_THAT(how_it_fails(c.deck, {heat + "add_heat_matls=[" + c.material + "]",
                                    heat + "add_heat_coeff=[" + c.heat + "]",
                                    heat + "add_heat_t_start=0", heat + "add_heat_t_final=9"}),
              AllOf(HasSubstr("inadmissible even with dt ="), HasSubstr("cell ["),
                    HasSubstr(std::string("level 0, material ") + c.material + ":"),
                    HasSubstr(std::string("material ") + c.material + " ('" + c.called),
                    HasSubstr(std::string("pressure above ") + c.range + " Pa")));
}

INSTANTIATE_TEST_SUITE_P(
    Of, HardState,
    testing::Values(Cooled{"AGasAmongOthers", "mixed_gases", "1", "-1e4", "monatomic", "0"},
                    Cooled{"WaterInARow", "three_in_a_row", "1", "-1e10", "water", "-6e+08"},
                    Cooled{"AirInARow", "three_in_a_row", "2", "-1e9", "air", "0"},
                    Cooled{"AGasAlone", "shock_tube", "0", "-1e4", "gas", "0"},
                    Cooled{"ASolidAlone", "murnaghan_shock_tube", "0", "-1e13", "solid", "0"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::hard_starts_test

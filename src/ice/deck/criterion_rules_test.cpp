// Which variables and materials criteria of refinement may name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ice/test_support/classic.hpp"

namespace sluice::ice::criterion_rules_test {
namespace {

using testing::HasSubstr;

std::string faults_of(const std::string& amr, int materials = 1) {
  Schema schema;
  add_framework_tags(schema);
  add_ice_tags(schema);
  std::string text = deck_text(GasBox{});
  const std::string end = "</material>";
  const std::size_t first = text.find("<material"), last = text.find(end) + end.size();
  for (int m = 1; m < materials; ++m) text.insert(last, text.substr(first, last - first));
  text.insert(text.rfind("</Uintah_specification>"), amr);
  std::string all;
  for (const Fault& f : load_deck_text(text, "box.ups", {}, schema).faults)
    all += to_string(f) + (f.not_built ? " [not built]\n" : "\n");
  return all;
}

std::string threshold(const std::string& name, const std::string& material = "0") {
  return faults_of(
      "<AMR><ICE><orderOfInterpolation>1</orderOfInterpolation>"
      "<Refinement_Criteria_Thresholds><Variable name='" +
      name + "' value='1' matl='" + material + "'/></Refinement_Criteria_Thresholds></ICE></AMR>");
}

std::string error(const std::string& name) {
  return faults_of("<AMR><ErrorEstimate variable='" + name + "' tolerance='0.1'/></AMR>");
}

TEST(CriterionRules, AnyCellVariableOfTheStateIsFine) {
  for (const char* name : {"rho_CC", "vel_CC", "temp_CC", "press_CC", "mach", "speedSound_CC",
                           "vorticity", "mag_grad_press_CC", "sp_vol_CC"}) {
    EXPECT_EQ(threshold(name), "");
    EXPECT_EQ(error(name), "");
  }
  EXPECT_EQ(threshold("rho_CC", "all"), "");
}

TEST(CriterionRules, OthersAreRefusedByName) {
  for (const auto& told :
       {threshold, +[](const std::string& n, const std::string&) { return error(n); }}) {
    EXPECT_THAT(told("rho_C", "0"), HasSubstr("there is no variable 'rho_C'"));
    EXPECT_THAT(told("rho_C", "0"), HasSubstr("did you mean 'rho_CC'"));
    EXPECT_THAT(told("uvel_FC", "0"), HasSubstr("uvel_FC is on faces"));
    EXPECT_THAT(told("TotalMass", "0"), HasSubstr("TotalMass is one number per step"));
    EXPECT_THAT(told("refineFlag", "0"), HasSubstr("is the result of the refinement criteria"));
    EXPECT_THAT(told("delP_Dilatate", "0"), HasSubstr("exists only within a step"));
    EXPECT_THAT(told("max_RHS", "0"), HasSubstr("[not built]"));
    EXPECT_THAT(told("state.mass", "0"), HasSubstr("error"));
    EXPECT_THAT(told("vol_frac_CC", "0"), HasSubstr("warning: <"));
    EXPECT_THAT(told("vol_frac_CC", "0"), HasSubstr("the same in all cells"));
  }
}

TEST(CriterionRules, WithSeveralMaterialsFractionsVaryAndInterfacesMove) {
  const std::string faults = faults_of(
      "<AMR><ICE><orderOfInterpolation>1</orderOfInterpolation>"
      "<Refinement_Criteria_Thresholds><Variable name='vol_frac_CC' value='1' matl='1'/>"
      "</Refinement_Criteria_Thresholds></ICE>"
      "<MaterialInterface distance='1'/><MaterialInterface distance='1' matl='1'/></AMR>",
      2);
  EXPECT_THAT(faults, testing::Not(HasSubstr("Variable")));
  EXPECT_THAT(faults, testing::Not(HasSubstr("MaterialInterface")));
}

TEST(CriterionRules, OneMaterialHasNoInterfaces) {
  EXPECT_THAT(faults_of("<AMR><MaterialInterface distance='1'/></AMR>"),
              HasSubstr("warning: <MaterialInterface> has no effect: a single material"));
}

TEST(CriterionRules, MaterialsMustExist) {
  EXPECT_THAT(threshold("rho_CC", "1"), HasSubstr("there is no material 1: the deck has 1"));
  EXPECT_THAT(threshold("rho_CC", "-1"), HasSubstr("there is no material -1"));
  EXPECT_THAT(threshold("rho_CC", "gas"), HasSubstr("write an index or all"));
  for (const char* matl : {"1", "gas"})
    EXPECT_THAT(
        faults_of("<AMR><MaterialInterface distance='1' matl='" + std::string(matl) + "'/></AMR>"),
        HasSubstr("<MaterialInterface>: there is no material " + std::string(matl)));
}

}  // namespace
}  // namespace sluice::ice::criterion_rules_test

// Which variables the format knows.
#include "framework/deck/format_labels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sluice::format_labels_test {
namespace {

TEST(FormatLabels, KnowNamesBeginningsAndEnds) {
  for (const char* label : {"p.x", "g.mass", "p.ArenaT1", "scalar-YO2", "mass_X_FC_flux", "phi",
                            "cz.force", "BndyForce_zminus", "TotalMass"})
    EXPECT_TRUE(format_has_label(label)) << label;
  for (const char* label : {"tmp_CC", "p.nonsense", "", "scalar", "_FC", "P.x"})
    EXPECT_FALSE(format_has_label(label)) << label;
}

TEST(FormatLabels, ForeignOnesSayWhatToSaveInstead) {
  for (const auto& [label, advice] :
       {std::pair{"maxMach_xminus", "save mach"}, std::pair{"temp_CC_Xchange", "save temp_CC"},
        std::pair{"sp_volY_FC", "save sp_vol_CC"}, std::pair{"grad_dp_ZFC", "grad_P_ZFC"},
        std::pair{"eq_press_iters", "remove"}}) {
    const ForeignLabel* foreign = find_foreign_label(label);
    ASSERT_NE(foreign, nullptr) << label;
    EXPECT_THAT(foreign->instead, ::testing::HasSubstr(advice));
    EXPECT_THAT(refusal_of(*foreign, label),
                ::testing::HasSubstr(std::string("variable '") + label + "' does not exist here"));
    EXPECT_TRUE(format_has_label(label)) << label;
  }
  EXPECT_EQ(find_foreign_label("temp_CC"), nullptr);
}

}  // namespace
}  // namespace sluice::format_labels_test

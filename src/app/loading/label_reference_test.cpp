// docs/labels.md is what the code declares.
#include "app/loading/label_reference.hpp"

#include <gtest/gtest.h>

#include "app/command/command_test_support.hpp"
#include "app/process/study_process.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/field/label.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::label_reference_test {
namespace {

// By the command itself: other tests of this executable declare labels of their own.
TEST(LabelReference, PageIsUpToDate) {
  const TemporaryFolder folder;
  const std::filesystem::path page = folder / "labels.md";
  const int status = run_process({{SLUICE_COMMAND, "help", "--labels"}, {}, page});
  const std::string written = text_of(page);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text_of(SLUICE_SOURCE_DIR "/docs/labels.md"), written)
      << "write it anew: sluice help --labels > docs/labels.md";
}

TEST(LabelReference, EveryLabelHasUnitAndDefinition) {
  const std::string page = label_reference();
  for (const Label label : all_labels()) {
    EXPECT_FALSE(label.info().unit.empty()) << label.name();
    EXPECT_FALSE(label.info().definition.empty()) << label.name();
    EXPECT_NE(page.find("| " + label.name() + " |"), std::string::npos) << label.name();
  }
}

// What the project promises to keep a meaning in the default scheme.
TEST(LabelReference, HoldsTheLabelsThatDecksSave) {
  const std::string page = label_reference();
  for (const char* name : {"press_equil_CC",
                           "delP_Dilatate",
                           "uvel_FC",
                           "uvel_FCME",
                           "vvel_FC",
                           "wvel_FC",
                           "mom_L_ME_CC",
                           "mom_L_CC",
                           "mass_L_CC",
                           "sp_vol_L_CC",
                           "intE_source_CC",
                           "mom_source_CC",
                           "int_eng_L_CC",
                           "delP_MassX",
                           "mag_grad_rho_CC",
                           "mag_grad_temp_CC",
                           "mag_grad_press_CC",
                           "mag_grad_vol_frac_CC",
                           "mag_div_vel_CC",
                           "refineFlag",
                           "rho_CC",
                           "press_CC",
                           "vel_CC",
                           "temp_CC",
                           "sp_vol_CC",
                           "vol_frac_CC",
                           "TotalMass",
                           "TotalMomentum",
                           "KineticEnergy",
                           "TotalIntEng"})
    EXPECT_NE(page.find(std::string("| ") + name + " |"), std::string::npos) << name;
}

}  // namespace
}  // namespace sluice::label_reference_test

// Files of analyses: header once, appended, cut back at a restart.
#include "framework/analysis/sample_file.hpp"

#include <gtest/gtest.h>

#include "framework/archive/posix_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::sample_file_test {
namespace {

namespace fs = std::filesystem;

class AnalysisFiles : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(AnalysisFiles, TheHeaderComesOnceAndLinesAreAppended) {
  AnalysisFile file("MinMax/L-0/press_CC_0", "# time min max\n", 0);
  file.flush(folder_.path());
  EXPECT_FALSE(fs::exists(folder_ / file.name())) << "no sample, no file";
  file.append("1 2 3");
  file.flush(folder_.path());
  file.append("2 3 4");
  file.flush(folder_.path());
  EXPECT_EQ(file.pending_bytes(), 0u);
  EXPECT_EQ(read_text(folder_ / file.name()), "# time min max\n1 2 3\n2 3 4\n");
}

TEST_F(AnalysisFiles, ARestartTakesOverWhatLiesBeforeIt) {
  make_folder(folder_ / "earlier");
  AnalysisFile file("X/L-0/i1_j2_k3", "# X Y Z Timestep Time p\n", 4);
  for (const char* line : {"9 9 9 1 0.1 5", "9 9 9 2 0.2 6", "9 9 9 3 0.3 7"}) file.append(line);
  file.flush(folder_ / "earlier");
  file.adopt(folder_ / "earlier", folder_.path(), 0.2);
  file.append("9 9 9 3 0.25 8");
  file.flush(folder_.path());
  EXPECT_EQ(read_text(folder_ / file.name()),
            "# X Y Z Timestep Time p\n9 9 9 1 0.1 5\n9 9 9 2 0.2 6\n9 9 9 3 0.25 8\n");
  const AnalysisFile other("Y/L-0/i0_j0_k0", "", 4);
  other.adopt(folder_ / "earlier", folder_.path(), 0.2);
  EXPECT_FALSE(fs::exists(folder_ / other.name()));
}

TEST(LinesUpTo, ALineCutShortIsDropped) {
  EXPECT_EQ(lines_up_to("# head\n1 2\n2 3\n3", 0, 9), "# head\n1 2\n2 3\n");
  EXPECT_EQ(lines_up_to("# head\n1 2\n2 3\n", 0, 1.5), "# head\n1 2\n");
  EXPECT_EQ(lines_up_to("", 0, 1), "");
}

TEST_F(AnalysisFiles, AFolderThatCannotBeMadeIsNamed) {
  write_text(folder_ / "MinMax", "a file is in the way");
  AnalysisFile file("MinMax/L-0/press_CC_0", "", 0);
  file.append("1 2 3");
  try {
    file.flush(folder_.path());
    FAIL() << "no error";
  } catch (const SystemError& e) {
    EXPECT_NE(std::string(e.what()).find("MinMax"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sluice::sample_file_test

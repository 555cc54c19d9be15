// The options of the command line that change no bit; regression/properties has all decks.
#include <gtest/gtest.h>

#include "app/process/study_process.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::same_bits_test {
namespace {

void expect_same(const CaseRun& a, const CaseRun& b) {
  ProcessRequest request;
  request.words = {SLUICE_COMMAND, "compare", a.archive().string(), b.archive().string()};
  request.output = a.folder() / "compare.log";
  EXPECT_EQ(a.steps(), b.steps());
  EXPECT_EQ(run_process(request), 0) << last_lines(request.output, 20);
  for (const char* variable : {"rho_CC", "press_CC", "temp_CC"}) {
    EXPECT_EQ(a.field(variable).values, b.field(variable).values) << variable;
  }
}

TEST(SameBits, OnThreadsBoxesAndRanksAndWithoutSavings) {
  const char* const deck = "explosion_2d";
  const char* const boxes = "3,2,1";  // a split that does not divide evenly
  const std::vector<std::string> overrides{resolution(65, 47), "Time/maxTime=0.1"};
  const CaseRun plain(deck, overrides);
  {
    SCOPED_TRACE("boxes");
    expect_same(plain, CaseRun(deck, overrides, {"--boxes", boxes}));
  }
  {
    SCOPED_TRACE("threads");
    expect_same(plain, CaseRun(deck, overrides, {"--threads", "2"}));
  }
  {
    SCOPED_TRACE("force-all");
    expect_same(plain, CaseRun(deck, overrides, {"--force-all"}));
  }
  {
    SCOPED_TRACE("ranks");
    expect_same(plain, CaseRun(deck, overrides, {"--boxes", boxes}, 2));
  }
}

}  // namespace
}  // namespace sluice::verification::same_bits_test

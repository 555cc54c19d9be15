// Same bits on ranks, threads, any split into boxes and with all savings off.
#include <gtest/gtest.h>

#include "app/study_process.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::same_bits_test {
namespace {

struct Scene {
  const char* name;
  const char* deck;
  std::vector<std::string> overrides;
  const char* boxes;  // a split that does not divide evenly
};

// Shocks, walls, periodic faces, outflow, gravity; one to three dimensions; quiet regions.
const Scene scenes[] = {
    {"tube", "riemann_sod", {resolution(257)}, "5,1,1"},
    {"blasts", "woodward_colella", {resolution(200)}, "3,1,1"},
    {"periodic", "periodic_shocks", {resolution(101), "Time/maxTime=0.5"}, "4,1,1"},
    {"square", "explosion_2d", {resolution(65, 47), "Time/maxTime=0.1"}, "3,2,1"},
    {"vortex", "vortex", {resolution(48, 48), "Time/maxTime=0.5"}, "2,5,1"},
    {"column", "hydrostatic_column", {"Time/maxTime=0.005"}, "1,3,1"},
    {"cube", "blast_3d", {resolution(17, 16, 15), "Time/maxTime=0.02"}, "2,3,2"},
};

class SameBits : public testing::TestWithParam<Scene> {
 protected:
  static void expect_same(const CaseRun& a, const CaseRun& b) {
    ProcessRequest request;
    request.words = {SLUICE_COMMAND, "compare", a.archive().string(), b.archive().string()};
    request.output = a.folder() / "compare.log";
    EXPECT_EQ(a.steps(), b.steps());
    EXPECT_EQ(run_process(request), 0) << last_lines(request.output, 20);
    for (const char* variable : {"rho_CC", "press_CC", "temp_CC"}) {
      EXPECT_EQ(a.field(variable).values, b.field(variable).values) << variable;
    }
  }
};

TEST_P(SameBits, OnThreadsBoxesAndRanksAndWithoutSavings) {
  const Scene& scene = GetParam();
  const CaseRun plain(scene.deck, scene.overrides);
  {
    SCOPED_TRACE("boxes");
    expect_same(plain, CaseRun(scene.deck, scene.overrides, {"--boxes", scene.boxes}));
  }
  {
    SCOPED_TRACE("threads");
    expect_same(plain, CaseRun(scene.deck, scene.overrides, {"--threads", "2"}));
  }
  {
    SCOPED_TRACE("force-all");
    expect_same(plain, CaseRun(scene.deck, scene.overrides, {"--force-all"}));
  }
  {
    SCOPED_TRACE("ranks");
    expect_same(plain, CaseRun(scene.deck, scene.overrides, {"--boxes", scene.boxes}, 2));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::ValuesIn(scenes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::same_bits_test

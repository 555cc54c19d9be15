// Books of the energy of solids: what transfers, integration and contact take adds up to what the
// total energy lost; nodes keep their own balance; the losses fall with the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::solids_energy_test {
namespace {

CaseRun run_of(const std::string& deck, const std::vector<std::string>& overrides = {}) {
  return CaseRun(SLUICE_SOURCE_DIR "/inputs/mpm/" + deck + ".ups", overrides);
}

// 0 of what the run has none of.
double budget(const CaseRun& run, const char* name) {
  const auto& all = run.record().at("energy_account");
  return all.contains(name) ? all.at(name).get<double>() : 0.0;
}
double of_energy(const CaseRun& run, const char* what) {
  return run.record().at("conservation").at("total energy").at(what).get<double>();
}

// Free bodies, friction and gravity, masters of contact, a held end.
class SolidsEnergy : public testing::TestWithParam<const char*> {};

TEST_P(SolidsEnergy, BooksClose) {
  constexpr double round_off = 1e-12;
  const CaseRun run = run_of(GetParam());
  const double scale = of_energy(run, "scale");
  ASSERT_GT(scale, 0);
  record("nodes", budget(run, "nodes") / scale);
  EXPECT_LE(std::fabs(budget(run, "nodes")), round_off * scale);
  const double lost = budget(run, "transfer loss") + budget(run, "integration loss") +
                      budget(run, "contact loss") + budget(run, "within cells") +
                      budget(run, "back as heat");
  record("left", (lost + of_energy(run, "defect")) / scale);
  EXPECT_LE(std::fabs(lost + of_energy(run, "defect")), round_off * scale);
}

INSTANTIATE_TEST_SUITE_P(Of, SolidsEnergy,
                         testing::Values("colliding_disks", "sliding_block", "bouncing_bar",
                                         "vibrating_bar", "disk_rolls", "turning_block",
                                         "thick_cylinder"),
                         [](const auto& test) { return std::string(test.param); });

// Of the kinetic energy at the start, when the disks have met and parted.
TEST(CollidingDisks, LoseLittleAndLessOnAFinerGrid) {
  constexpr double allowed = 0.1;
  double lost[2];
  for (const int n : {0, 1}) {
    const CaseRun run = run_of("colliding_disks", {resolution(n == 0 ? 20 : 40, n == 0 ? 20 : 40)});
    const double start = of_energy(run, "start");
    const double transfer = budget(run, "transfer loss") / start;
    const double integration = budget(run, "integration loss") / start;
    record("transfer " + std::to_string(n), transfer);
    record("integration " + std::to_string(n), integration);
    lost[n] = std::fabs(transfer) + std::fabs(integration);
  }
  EXPECT_LE(lost[1], allowed);
  EXPECT_LT(lost[1], lost[0]);
}

}  // namespace
}  // namespace sluice::verification::solids_energy_test

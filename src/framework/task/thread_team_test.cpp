// Every piece once, on thread numbers within the team, none of them twice at a time.
#include "framework/task/thread_team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace sluice::thread_team_test {
namespace {

TEST(ThreadTeam, DoesEveryPieceOnce) {
  for (const int threads : {1, 2, 3}) {
    const ThreadTeam team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
      std::vector<int> done(count, 0);
      std::vector<std::atomic<int>> busy(threads);
      std::atomic<int> faults = 0;
      team.for_each(count, [&](std::size_t n, int thread) {
        if (thread < 0 || thread >= threads) {
          ++faults;
          return;
        }
        auto& mine = busy[thread];
        faults += mine.exchange(1);
        ++done[n];
        mine = 0;
      });
      EXPECT_EQ(faults, 0);
      EXPECT_EQ(done, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(ThreadTeam, ATeamOfOneKeepsTheOrder) {
  std::vector<std::size_t> seen;
  ThreadTeam().for_each(4, [&](std::size_t n, int) { seen.push_back(n); });
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace sluice::thread_team_test

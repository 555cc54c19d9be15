// Bits of flags against a plain array: set, search, count, widen.
#include "framework/refine/flag_field.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace sluice::flag_field_test {
namespace {

using Periodic = std::array<bool, 3>;

FlagField random_flags(const IndexBox& domain, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance(0, 1);
  FlagField flags(domain);
  for_each_cell(domain, [&](IntVec3 c) {
    if (chance(random) < share) flags.set(c);
  });
  return flags;
}

int apart(int a, int b, int n, bool periodic) {
  const int d = std::abs(a - b);
  return periodic ? std::min(d, n - d) : d;
}

// Every cell by comparison with every flag.
FlagField slowly_dilated(const FlagField& flags, IntVec3 reach, const Periodic& periodic) {
  const IntVec3 n = flags.domain().size();
  FlagField wide(flags.domain());
  for_each_cell(flags.domain(), [&](IntVec3 c) {
    bool near = false;
    for_each_cell(flags.domain(), [&](IntVec3 f) {
      if (near || !flags.get(f)) return;
      near = true;
      for (int d = 0; d < 3; ++d) near = near && apart(c[d], f[d], n[d], periodic[d]) <= reach[d];
    });
    if (near) wide.set(c);
  });
  return wide;
}

TEST(FlagField, KeepsWhatIsSet) {
  const IndexBox domain{{-3, 2, 0}, {127, 9, 2}};  // rows of 130 bits
  FlagField flags(domain);
  EXPECT_FALSE(flags.any());
  const std::vector<IntVec3> cells = {{-3, 2, 0}, {60, 5, 1}, {61, 5, 1}, {126, 8, 1}};
  for (const IntVec3& c : cells) flags.set(c);
  EXPECT_EQ(flags.count(), 4);
  for_each_cell(domain, [&](IntVec3 c) {
    EXPECT_EQ(flags.get(c), std::find(cells.begin(), cells.end(), c) != cells.end());
  });
  EXPECT_TRUE(flags.any(IndexBox{{60, 5, 1}, {61, 6, 2}}));
  EXPECT_FALSE(flags.any(IndexBox{{60, 5, 0}, {62, 6, 1}}));
  EXPECT_FALSE(flags.any(IndexBox{{62, 2, 0}, {126, 9, 2}}));
  EXPECT_TRUE(flags.any(IndexBox{{62, 2, 0}, {500, 900, 20}}));
  EXPECT_FALSE(flags.any(IndexBox{{200, 0, 0}, {500, 900, 20}}));
}

TEST(FlagField, FillsBoxesWithinTheDomain) {
  const IndexBox domain{{0, 0, 0}, {200, 3, 3}};
  for (const IndexBox& box : {IndexBox{{0, 0, 0}, {64, 1, 1}}, IndexBox{{63, 1, 1}, {129, 3, 2}},
                              IndexBox{{-9, -9, 2}, {500, 1, 9}}, IndexBox{{5, 1, 1}, {5, 3, 3}}}) {
    FlagField flags(domain);
    flags.fill(box);
    EXPECT_EQ(flags.count(), intersection(box, domain).volume());
    for_each_cell(domain, [&](IntVec3 c) { EXPECT_EQ(flags.get(c), box.contains(c)); });
  }
}

TEST(FlagField, WidensLikeABoxFilter) {
  const struct {
    IndexBox domain;
    IntVec3 reach;
    Periodic periodic;
  } cases[] = {
      {{{0, 0, 0}, {70, 9, 1}}, {1, 1, 0}, {false, false, false}},
      {{{0, 0, 0}, {70, 9, 1}}, {3, 2, 0}, {true, true, false}},
      {{{0, 0, 0}, {64, 5, 4}}, {5, 0, 1}, {true, false, true}},
      {{{-4, 3, 2}, {61, 9, 6}}, {2, 3, 2}, {false, true, false}},
      {{{0, 0, 0}, {130, 3, 1}}, {65, 1, 0}, {true, false, false}},
      {{{0, 0, 0}, {130, 3, 1}}, {64, 0, 0}, {false, false, false}},
      {{{0, 0, 0}, {130, 3, 1}}, {63, 0, 0}, {false, false, false}},
      {{{0, 0, 0}, {128, 3, 1}}, {63, 0, 0}, {true, false, false}},
      {{{0, 0, 0}, {192, 3, 1}}, {6, 0, 0}, {true, false, false}},
      {{{0, 0, 0}, {7, 4, 1}}, {20, 9, 0}, {true, true, false}},
      {{{0, 0, 0}, {7, 4, 1}}, {20, 9, 0}, {false, false, false}},
      {{{0, 0, 0}, {1, 40, 1}}, {0, 2, 0}, {true, true, true}},
  };
  unsigned seed = 1;
  for (const auto& c : cases)
    for (const double share : {0.003, 0.02}) {
      const FlagField flags = random_flags(c.domain, share, ++seed);
      const FlagField wide = flags.dilated(c.reach, c.periodic);
      EXPECT_EQ(wide, slowly_dilated(flags, c.reach, c.periodic)) << seed;
      EXPECT_TRUE(flags.within(wide));
    }
}

TEST(FlagField, JoinsAndCompares) {
  const IndexBox domain{{0, 0, 0}, {100, 7, 1}};
  const FlagField a = random_flags(domain, 0.3, 1), b = random_flags(domain, 0.3, 2);
  FlagField either = a, both = a;
  either |= b;
  both &= b;
  EXPECT_EQ(either.count() + both.count(), a.count() + b.count());
  EXPECT_TRUE(a.within(either));
  EXPECT_TRUE(both.within(b));
  EXPECT_FALSE(either.within(a));
}

TEST(FlagField, RunsAreFoundInRows) {
  FlagField flags(IndexBox{{0, 0, 0}, {200, 1, 1}});
  flags.fill({{3, 0, 0}, {5, 1, 1}});
  flags.fill({{63, 0, 0}, {140, 1, 1}});
  const std::uint64_t* row = flags.row(0, 0);
  EXPECT_EQ(next_flag(row, 0, 200), 3);
  EXPECT_EQ(next_gap(row, 3, 200), 5);
  EXPECT_EQ(next_flag(row, 5, 200), 63);
  EXPECT_EQ(next_gap(row, 63, 200), 140);
  EXPECT_EQ(next_gap(row, 63, 100), 100);
  EXPECT_EQ(next_flag(row, 140, 200), 200);
}

}  // namespace
}  // namespace sluice::flag_field_test

// The rules of comparison, the norms and the CSV contract.
#include "framework/archive/compare/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/compare/norms.hpp"
#include "framework/base/error.hpp"

namespace sluice::compare_test {
namespace {

using namespace archive_test;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

// An archive of press_CC (and more) in boxes of a given layout, changed by a function.
fs::path write_archive(const fs::path& folder, const Grid& grid, int steps,
                       const Fields::Function& press, bool with_velocity = false) {
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder));
  for (int step = 1; step <= steps; ++step) {
    Fields fields;
    for (const Level& level : grid.levels) {
      fields.add(level, real_label("press_CC"), 0, press);
      if (with_velocity) fields.add(level, vector_label("vel_CC"), 1, wavy);
    }
    const StepInfo info{step, 0.1 * step, 0.1, 0.1, {}};
    writer.write_output(info, grid, fields.pieces());
    writer.write_checkpoint(info, grid, fields.pieces());
  }
  return writer.folder();
}

CompareResult compare_paths(const fs::path& a, const fs::path& b, const CompareOptions& o = {}) {
  return compare(Archive::open(a), Archive::open(b), o);
}

TEST(Compare, NumbersDifferWhenBothBoundsAreExceeded) {
  EXPECT_FALSE(numbers_differ(0.0, -0.0, 0, 0));
  EXPECT_FALSE(numbers_differ(inf, inf, 0, 0));
  EXPECT_TRUE(numbers_differ(inf, -inf, inf, 0));
  EXPECT_TRUE(numbers_differ(inf, 1, 0, 1));
  EXPECT_TRUE(numbers_differ(nan, nan, inf, inf));
  EXPECT_TRUE(numbers_differ(nan, 1, inf, inf));
  EXPECT_TRUE(numbers_differ(1, std::nextafter(1, 2), 0, 0));
  EXPECT_FALSE(numbers_differ(1, 1.1, 0.2, 0));     // within abs
  EXPECT_FALSE(numbers_differ(1, 1.1, 0, 0.1));     // within rel of the larger
  EXPECT_FALSE(numbers_differ(1, 1.1, 0.01, 0.1));  // one bound is enough
  EXPECT_TRUE(numbers_differ(1, 1.1, 0.01, 0.01));
  EXPECT_TRUE(numbers_differ(1e-12, 2e-12, 0, 0.4));
}

TEST(Compare, LayoutOfBoxesDoesNotMatter) {
  const TemporaryFolder folder;
  const fs::path a = write_archive(folder.path(), make_grid({12, 6, 4}, {1, 1, 1}), 3, wavy, true);
  const fs::path b = write_archive(folder.path(), make_grid({12, 6, 4}, {3, 2, 2}), 3, wavy, true);
  for (const bool checkpoints : {false, true}) {
    CompareOptions o;
    o.checkpoints = checkpoints;
    const CompareResult r = compare_paths(a, b, o);
    EXPECT_EQ(r.exit_status(), 0);
    EXPECT_EQ(r.steps(), checkpoints ? 2 : 3);
    EXPECT_EQ(r.values, r.steps() * 4 * 12 * 6 * 4);
  }
}

TEST(Compare, FirstAndLargestDifferenceAreNamed) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({12, 6, 4}, {2, 1, 1});
  const fs::path a = write_archive(folder.path(), grid, 1, wavy);
  const fs::path b = write_archive(folder.path(), grid, 1, [](IntVec3 c, int m) {
    const double small = c == IntVec3{1, 0, 0} ? 1e-9 : 0;
    return wavy(c, m) + small + (c == IntVec3{11, 5, 3} ? 0.5 : 0);
  });
  CompareResult r = compare_paths(a, b);
  EXPECT_EQ(r.exit_status(), 1);
  EXPECT_EQ(r.differing, 2);
  EXPECT_EQ(r.first()->index, (IntVec3{1, 0, 0}));
  EXPECT_EQ(r.largest()->index, (IntVec3{11, 5, 3}));
  EXPECT_NEAR(r.largest()->size(), 0.5, 1e-15);
  EXPECT_THAT(to_string(*r.largest()),
              HasSubstr("press_CC of material 0 on level 0 at [11, 5, 3]"));
  CompareOptions o;
  o.absolute = 1e-8;
  EXPECT_EQ(compare_paths(a, b, o).differing, 1);
  o.absolute = 0.6;
  EXPECT_EQ(compare_paths(a, b, o).exit_status(), 0);
}

TEST(Compare, NaNDiffersEvenFromItself) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 1, 1}, {1, 1, 1});
  auto with_nan = [](IntVec3 c, int) { return c.x == 2 ? nan : -0.0; };
  const fs::path a = write_archive(folder.path(), grid, 1, with_nan);
  const fs::path b = write_archive(folder.path(), grid, 1, with_nan);
  EXPECT_EQ(compare_paths(a, b).differing, 1);
  const fs::path zero = write_archive(folder.path(), grid, 1, [](IntVec3, int) { return 0.0; });
  EXPECT_EQ(compare_paths(a, zero).differing, 1);
}

TEST(Compare, WhatIsNotComparable) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({12, 6, 1}, {1, 1, 1});
  const fs::path a = write_archive(folder.path(), grid, 2, wavy);
  const fs::path more_steps = write_archive(folder.path(), grid, 3, wavy);
  const fs::path more_labels = write_archive(folder.path(), grid, 2, wavy, true);
  Grid finer = make_grid({24, 6, 1}, {1, 1, 1});
  const fs::path other_cells = write_archive(folder.path(), finer, 2, wavy);
  Grid wider = grid;
  wider.levels[0].spacing.x *= 1.001;
  const fs::path other_spacing = write_archive(folder.path(), wider, 2, wavy);
  Grid holey = make_grid({12, 6, 1}, {2, 1, 1});
  holey.levels[0].boxes.pop_back();
  const fs::path half = write_archive(folder.path(), holey, 2, wavy);
  for (const fs::path& b : {more_steps, more_labels, other_cells, other_spacing, half}) {
    EXPECT_EQ(compare_paths(a, b).exit_status(), 2) << b;
    EXPECT_EQ(compare_paths(b, a).exit_status(), 2) << b;
  }
  CompareOptions o;
  o.common_times = true;
  EXPECT_EQ(compare_paths(a, more_steps, o).exit_status(), 0);
  CompareOptions only;
  only.labels.ignore = {"vel_CC"};
  EXPECT_EQ(compare_paths(a, more_labels, only).exit_status(), 0);
  only.labels = {{"nothing"}, {}};
  EXPECT_EQ(compare_paths(a, more_labels, only).exit_status(), 2);
}

// A tensor has nine components, row after row.
TEST(Compare, TellsTheComponentOfATensor) {
  Difference d;
  d.label = "p.stress";
  d.components = 9;
  d.component = 5;
  d.particle = 7;
  d.a = 1;
  d.b = 2;
  EXPECT_THAT(to_string(d), HasSubstr("p.stress yz of material 0, particle 7, "));
  d.components = 3;
  d.component = 2;
  EXPECT_THAT(to_string(d), HasSubstr("p.stress z of material 0"));
}

TEST(Compare, HistoriesNumberByNumber) {
  const TemporaryFolder folder;
  auto write = [&](double last, int lines, const char* name) {
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    for (int n = 1; n <= lines; ++n)
      writer.history(name, -1, n, 0.1 * n, n == lines ? last : 1.0 / n);
    writer.history("Momentum", 0, 1, 0.1, Vec3{1, 2, 3});
    writer.finish();
    return Archive::open(writer.folder());
  };
  const Archive a = write(5, 4, "TotalMass");
  EXPECT_EQ(compare_histories(a, write(5, 4, "TotalMass"), {}).exit_status(), 0);
  const HistoryComparison r = compare_histories(a, write(5.5, 4, "TotalMass"), {});
  EXPECT_EQ(r.exit_status(), 1);
  EXPECT_EQ(r.values, 12);
  EXPECT_THAT(r.differences, ::testing::ElementsAre("TotalMass.dat: line 4, column 2: 5 and 5.5"));
  CompareOptions loose;
  loose.relative = 0.1;
  EXPECT_EQ(compare_histories(a, write(5.5, 4, "TotalMass"), loose).exit_status(), 0);
  EXPECT_EQ(compare_histories(a, write(5, 3, "TotalMass"), {}).exit_status(), 2);
  EXPECT_EQ(compare_histories(a, write(5, 4, "Other"), {}).exit_status(), 2);
}

TEST(Norms, OverTheFirstArchivesPoints) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({8, 1, 1}, {2, 1, 1});
  const fs::path a = write_archive(folder.path(), grid, 2, wavy, true);
  const fs::path b = write_archive(folder.path(), grid, 2, [](IntVec3 c, int m) {
    return wavy(c, m) + (c.x == 3 ? -2.0 : c.x == 5 ? 0.5 : 0);
  });
  const NormsResult r = difference_norms(Archive::open(a), Archive::open(b), {});
  ASSERT_EQ(r.rows.size(), 2u);
  EXPECT_THAT(r.skipped, ::testing::ElementsAre("vel_CC"));
  EXPECT_EQ(r.rows[1].time, 0.2);
  EXPECT_EQ(r.rows[0].points, 8);
  EXPECT_NEAR(r.rows[0].l1, 2.5 / 8, 1e-15);
  EXPECT_NEAR(r.rows[0].l2, std::sqrt(4.25 / 8), 1e-15);
  EXPECT_NEAR(r.rows[0].linf, 2.0, 1e-15);
  const NormsResult same = difference_norms(Archive::open(a), Archive::open(a), {});
  ASSERT_EQ(same.rows.size(), 8u);  // press_CC and three components, twice
  for (const NormsRow& row : same.rows) EXPECT_EQ(row.l1 + row.l2 + row.linf, 0);
}

TEST(Norms, APartOfALargerDomain) {
  const TemporaryFolder folder;
  Grid part = make_grid({4, 3, 1}, {1, 1, 1});
  part.levels[0].anchor.x += 2 * 0.1;  // starts two cells further on
  const fs::path a = write_archive(folder.path(), part, 1, [](IntVec3 c, int m) {
    return wavy(c + IntVec3{2, 0, 0}, m);
  });
  const fs::path b = write_archive(folder.path(), make_grid({9, 5, 1}, {2, 2, 1}), 1, wavy);
  EXPECT_EQ(difference_norms(Archive::open(a), Archive::open(b), {}).rows.at(0).linf, 0);
  EXPECT_THROW(difference_norms(Archive::open(b), Archive::open(a), {}), InputError);
  part.levels[0].anchor.x += 0.05;  // half a cell off
  const fs::path off = write_archive(folder.path(), part, 1, wavy);
  EXPECT_THROW(difference_norms(Archive::open(off), Archive::open(b), {}), InputError);
  const fs::path later = write_archive(folder.path(), make_grid({9, 5, 1}, {1, 1, 1}), 2, wavy);
  EXPECT_THROW(difference_norms(Archive::open(later), Archive::open(b), {}), InputError);
}

TEST(Norms, NaNIsNotHidden) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({6, 1, 1}, {1, 1, 1});
  const fs::path a = write_archive(folder.path(), grid, 1, wavy);
  const fs::path b = write_archive(
      folder.path(), grid, 1, [](IntVec3 c, int m) { return c.x == 2 ? nan : wavy(c, m) + 1; });
  const NormsRow row = difference_norms(Archive::open(a), Archive::open(b), {}).rows.at(0);
  EXPECT_TRUE(std::isnan(row.l1) && std::isnan(row.l2) && std::isnan(row.linf));
}

}  // namespace
}  // namespace sluice::compare_test

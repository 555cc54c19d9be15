// Histories of other steps at the same times: what differs is told, and nothing else.
#include "framework/archive/compare/history_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "framework/archive/xml_text.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::history_table_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

HistoryTable read(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.dat") << text;
  return read_history(folder / "x.dat");
}

HistoryTable sampled(int lines, double end, const std::function<double(double)>& f) {
  HistoryTable table;
  table.values.resize(1);
  for (int n = 1; n <= lines; ++n) {
    table.times.push_back(end * n / lines);
    table.values[0].push_back(f(table.times.back()));
  }
  return table;
}

TEST(HistoryTable, KnowsItsColumns) {
  EXPECT_THAT(read("0.5\t7\n1\t8\n").times, ElementsAre(0.5, 1));
  EXPECT_THAT(read("0.5\t7\n1\t8\n").values.at(0), ElementsAre(7, 8));
  const HistoryTable vector = read("0.5\t 1 2 3 \n1\t 4 5 6 \n");
  EXPECT_EQ(vector.values.size(), 3U);
  EXPECT_THAT(vector.values.at(2), ElementsAre(3, 6));
  const HistoryTable steps = read("         1\t0.25\t9\n         2\t0.5\t8\n");
  EXPECT_THAT(steps.times, ElementsAre(0.25, 0.5));
  EXPECT_THAT(steps.values.at(0), ElementsAre(9, 8));
  EXPECT_EQ(read("1 0.25 1 2 3\n2 0.5 1 2 4\n").values.size(), 3U);
  const HistoryTable bare = read("5\n6\n");
  EXPECT_FALSE(bare.timed);
  EXPECT_THAT(bare.times, ElementsAre(1, 2));
  EXPECT_EQ(read("0.5 0.25 1\n0.25 0.5 4\n").values.size(), 3U) << "a vector without a time";
  EXPECT_TRUE(read("").times.empty());
  EXPECT_THROW(read("1 2\n3\n"), DamageError);
  EXPECT_THROW(read("1 x\n"), DamageError);
  EXPECT_THROW(read("1 2 3 4 5 6 7\n"), DamageError);
}

TEST(HistoryTable, OfOtherStepsIsComparedAtTheSameTimes) {
  // A line is a line, whatever the steps.
  const auto line = [](double t) { return 3 - 2 * t; };
  const HistoryDifferences same =
      compare_history(sampled(347, 1, line), sampled(289, 1, line), 1e-14, 0);
  EXPECT_TRUE(same.interpolated);
  EXPECT_EQ(same.not_comparable, "");
  EXPECT_TRUE(same.columns.empty());
  EXPECT_NEAR(static_cast<double>(same.values), 347, 2);
  // Of a parabola, by chords: at most h^2/4 for x^2, half way between two lines.
  const auto square = [](double t) { return t * t; };
  const HistoryDifferences curved =
      compare_history(sampled(1000, 1, square), sampled(10, 1, square), 0, 0);
  ASSERT_EQ(curved.columns.size(), 1U);
  EXPECT_NEAR(curved.columns[0].b - curved.columns[0].a, 0.1 * 0.1 / 4, 1e-15);
  EXPECT_EQ(
      compare_history(sampled(1000, 1, square), sampled(10, 1, square), 0.0026, 0).columns.size(),
      0U);
}

TEST(HistoryTable, TheLargestDifferenceIsNamed) {
  const auto flat = [](double) { return 1.0; };
  const auto bump = [](double t) { return t > 0.41 && t < 0.43 ? 1.5 : t > 0.9 ? 1.1 : 1.0; };
  const HistoryDifferences found =
      compare_history(sampled(100, 1, flat), sampled(100, 1, bump), 0, 0);
  EXPECT_FALSE(found.interpolated);
  ASSERT_EQ(found.columns.size(), 1U);
  EXPECT_EQ(found.columns[0].line, 42);
  EXPECT_EQ(found.columns[0].time, 0.42);
  EXPECT_EQ(found.columns[0].a, 1);
  EXPECT_EQ(found.columns[0].b, 1.5);
  EXPECT_EQ(found.columns[0].scale, 1);
  EXPECT_EQ(found.columns[0].differing, 1 + 10);
  HistoryTable broken = sampled(100, 1, flat);
  broken.values[0][7] = std::nan("");
  EXPECT_EQ(compare_history(sampled(100, 1, flat), broken, 1, 1).columns.size(), 1U);
}

TEST(HistoryTable, WhatEndsElsewhereIsNotComparable) {
  const auto flat = [](double) { return 1.0; };
  EXPECT_THAT(compare_history(sampled(10, 1, flat), sampled(10, 2, flat), 0, 0).not_comparable,
              HasSubstr("one ends at 1, the other at 2"));
  // A step beyond maxTime, as runs end.
  EXPECT_EQ(compare_history(sampled(10, 1, flat), sampled(10, 1.05, flat), 0, 0).not_comparable,
            "");
  EXPECT_THAT(compare_history(sampled(10, 1, flat), {}, 0, 0).not_comparable,
              HasSubstr("columns of values"));
}

}  // namespace
}  // namespace sluice::history_table_test

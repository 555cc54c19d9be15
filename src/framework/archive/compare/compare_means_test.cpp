// Comparisons between resolutions and levels: means of known fields, and observed orders of
// manufactured sequences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/compare/norms.hpp"
#include "framework/archive/compare/observed_order.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"

namespace sluice::compare_means_test {
namespace {

using namespace archive_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

using OfPlace = std::function<double(Vec3)>;

// [-1, -0.2] x [0.25, 1.75], n times as many cells as make_grid({8, 6, 1}) along x and y.
Grid uniform(int n) {
  Grid grid = make_grid({8 * n, 6 * n, 1}, {2, 1, 1});
  grid.levels[0].spacing = {0.1 / n, 0.25 / n, 0.5};
  return grid;
}

// The same domain with the middle (x) or the low end refined twice.
Grid refined(bool at_low_end = false) {
  Grid grid = make_two_levels(1);
  if (at_low_end) grid.levels[1].boxes = {{{{0, 0, 0}, {6, 12, 1}}, 0, 0}};
  return grid;
}

class CompareMeans : public ::testing::Test {
 protected:
  Archive write(const Grid& grid, const OfPlace& f, const Label& label = real_label("press_CC"),
                int steps = 1) {
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder_.path()));
    for (int step = 1; step <= steps; ++step) {
      Fields fields;
      for (const Level& level : grid.levels)
        fields.add(level, label, 0, [&](IntVec3 c, int m) {
          return f(position(level, label.info().centring, c)) + m;
        });
      writer.write_output({step, 0.1 * step, 0.1, 0.1, {}}, grid, fields.pieces());
    }
    writer.finish();
    return Archive::open(writer.folder());
  }
  static NormsRow norms(const Archive& a, const Archive& b) {
    return difference_norms(a, b, {}).rows.at(0);
  }
  TemporaryFolder folder_;
};

double plane(Vec3 p) {
  return 2 - 3 * p.x + 0.5 * p.y;
}

// The mean of (X - h/4)^2 and (X + h/4)^2 is X^2 + h^2/16; that of three thirds X^2 + 2 h^2/27.
TEST_F(CompareMeans, OfAPolynomialAreKnown) {
  const auto square = [](Vec3 p) { return p.x * p.x + 3 * p.y * p.y; };
  const Archive coarse = write(uniform(1), square), twice = write(uniform(2), square),
                thrice = write(uniform(3), square);
  const double hx2 = 0.1 * 0.1, hy2 = 0.25 * 0.25;
  for (const bool turned : {false, true}) {
    const NormsRow half = turned ? norms(twice, coarse) : norms(coarse, twice);
    const double expected = (hx2 + 3 * hy2) / 16;
    EXPECT_EQ(half.points, 48);
    EXPECT_EQ(half.level, all_levels);
    EXPECT_NEAR(half.l1, expected, 1e-14);
    EXPECT_NEAR(half.l2, expected, 1e-14);
    EXPECT_NEAR(half.linf, expected, 1e-14);
    const NormsRow third = turned ? norms(thrice, coarse) : norms(coarse, thrice);
    EXPECT_NEAR(third.linf, 2 * (hx2 + 3 * hy2) / 27, 1e-14);
  }
  EXPECT_THROW(norms(twice, thrice), InputError);  // two and three do not nest
}

// A linear field is its own mean: nothing differs, wherever which of the two is finer.
TEST_F(CompareMeans, OfLinearFieldsAgreeOnAllLevels) {
  const std::vector<Label> labels = {real_label("press_CC"), vector_label("vel_CC"),
                                     real_label("uvel_FC", Centring::x_face),
                                     real_label("node_NC", Centring::node)};
  for (const Label& label : labels) {
    const std::vector<Archive> all = {
        write(uniform(1), plane, label), write(uniform(2), plane, label),
        write(uniform(4), plane, label), write(refined(), plane, label),
        write(refined(true), plane, label)};
    for (const Archive& a : all)
      for (const Archive& b : all)
        for (const NormsRow& row : difference_norms(a, b, {}).rows) {
          EXPECT_LT(row.linf, 1e-13) << row.label;
          EXPECT_GT(row.points, 20);
        }
  }
}

// What is compared with a finer run are the cells that no finer one covers.
TEST_F(CompareMeans, PlacesAreTheCoarserCellsEverywhere) {
  const Archive levels = write(refined(), plane), other = write(refined(true), plane),
                fine = write(uniform(2), plane), coarse = write(uniform(1), plane);
  // 48 coarse cells; fine boxes of 4 x 4 and 4 x 6 cells cover 10 of them.
  EXPECT_EQ(norms(levels, fine).points, 38 + 40);
  EXPECT_EQ(norms(fine, levels).points, 38 + 40);
  // The finer run of the first is coarser than that of the second at the low end, where 18 coarse
  // cells are refined; 3 x (2 + 3) - ... of them by both.
  const std::int64_t both = norms(levels, other).points;
  EXPECT_EQ(both, norms(other, levels).points);
  // Coarse cells 2 are refined by both: 2 (of 6 rows) along x = 2.
  EXPECT_EQ(both, 48 - 2 + 2 * 4);
  EXPECT_EQ(norms(coarse, fine).points, 48);
}

TEST_F(CompareMeans, EqualValuesHaveTheirOwnMean) {
  const double third = 1.0 / 3;  // all bits of its mantissa are in use
  const Archive fine = write(uniform(5), [=](Vec3) { return third; });
  EXPECT_EQ(norms(write(uniform(1), [=](Vec3) { return third; }), fine).linf, 0);
}

// u_h = U + h^p g with linear U and g > 0, whose means are their own: the order is p exactly.
TEST_F(CompareMeans, TheObservedOrderIsThatOfTheSequence) {
  for (const double p : {0.5, 1.0, 2.0, 3.7}) {
    const auto run = [&](const Grid& grid, int n) {
      const double error = std::pow(1.0 / n, p);
      return write(grid, [=](Vec3 x) { return plane(x) + error * (2 + x.x + 0.1 * x.y); });
    };
    for (const auto& [n2, n3] : {std::pair{2, 4}, {3, 6}, {2, 12}}) {
      const Archive coarse = run(uniform(1), 1), middle = run(uniform(n2), n2),
                    fine = run(uniform(n3), n3);
      const OrderResult r = observed_orders({&fine, &coarse, &middle}, {});
      EXPECT_THAT(r.sorted, ElementsAre(1, 2, 0));
      ASSERT_THAT(r.rows, SizeIs(1));
      EXPECT_EQ(r.rows[0].points, 48);
      for (const NormOrder& norm : r.rows[0].norms) EXPECT_NEAR(norm.order, p, 1e-9) << n2 << n3;
      // The mean of |g| over the domain times h3^p.
      EXPECT_NEAR(r.rows[0].norms[0].error, std::pow(1.0 / n3, p) * (2 - 0.6 + 0.1), 1e-9);
    }
  }
}

TEST_F(CompareMeans, OrdersThatAreNoneAreNone) {
  EXPECT_NEAR(order_of(4, 1, 2, 2), 2, 1e-12);
  EXPECT_NEAR(order_of(0.5, 1, 2, 2), -1, 1e-12);
  EXPECT_TRUE(std::isnan(order_of(0, 1, 2, 2)));
  EXPECT_TRUE(std::isnan(order_of(1, 0, 2, 2)));
  const Archive a = write(uniform(1), plane), b = write(uniform(2), plane);
  try {
    observed_orders({&a, &b, &b}, {});
    FAIL() << "two of one resolution";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("three different resolutions"));
  }
}

TEST_F(CompareMeans, CompareFindsTheOneDifference) {
  const Archive coarse = write(uniform(1), plane);
  const auto changed = [](Vec3 p) {
    const bool there = std::abs(p.x + 0.675) < 1e-9 && std::abs(p.y - 0.8125) < 1e-9;
    return plane(p) + (there ? 1 : 0);
  };
  const Archive fine = write(uniform(2), changed);
  CompareOptions options;
  options.absolute = 1e-12;
  EXPECT_EQ(compare(coarse, fine, options).exit_status(), 2);
  options.means = true;
  const CompareResult r = compare(coarse, fine, options);
  EXPECT_EQ(r.exit_status(), 1);
  EXPECT_EQ(r.values, 48);
  ASSERT_THAT(r.fields, SizeIs(1));
  EXPECT_EQ(r.differing, 1);
  EXPECT_NEAR(r.fields[0].largest.size(), 0.25, 1e-12);
  EXPECT_EQ(r.fields[0].largest.index, (IntVec3{3, 2, 0}));
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("means on the coarser one are compared")));
  EXPECT_EQ(compare(coarse, write(uniform(4), plane), options).exit_status(), 0);
  Grid elsewhere = uniform(2);
  elsewhere.levels[0].anchor.x += 0.1;
  const CompareResult apart = compare(coarse, write(elsewhere, plane), options);
  EXPECT_EQ(apart.exit_status(), 2);
  EXPECT_THAT(apart.not_comparable, ElementsAre(HasSubstr("it must hold that of the first")));
}

// A label that is missing is one cause, on however many levels and outputs.
TEST_F(CompareMeans, OneCauseIsToldOnce) {
  const Archive a = write(refined(), plane, real_label("press_CC"), 3),
                b = write(refined(), plane, real_label("temp_CC"), 3);
  const CompareResult r = compare(a, b, {});
  EXPECT_THAT(
      r.not_comparable,
      ElementsAre("step 1 at time 0.10000000000000001 and 2 more: only the first has press_CC",
                  "step 1 at time 0.10000000000000001 and 2 more: only the second has temp_CC"));
  // Over three outputs one row with the largest.
  const Archive c = write(
      refined(), [](Vec3 p) { return plane(p) + p.x; }, real_label("press_CC"), 3);
  const auto rows = differences_by_label(compare(a, c, {}));
  ASSERT_THAT(rows, SizeIs(2));  // two levels
  EXPECT_EQ(rows[0].values, 3 * 48);
  EXPECT_DOUBLE_EQ(rows[0].largest.size(), 0.95);
  EXPECT_EQ(rows[0].largest.index, (IntVec3{0, 0, 0}));
}

}  // namespace
}  // namespace sluice::compare_means_test

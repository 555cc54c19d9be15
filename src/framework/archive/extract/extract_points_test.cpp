// Values at points and along lines: a field that is linear in place comes out exactly, on levels,
// at faces and nodes, at the ends of the domain; holders are the finest cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/extract/extract.hpp"
#include "framework/archive/extract/point_values.hpp"
#include "framework/archive/extract/quantity.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"

namespace sluice::extract_points_test {
namespace {

using namespace archive_test;
using ::testing::HasSubstr;

using Numbers = std::vector<double>;

// Rows as numbers; empty words are NaN.
std::vector<Numbers> rows_of(const ArchiveStep& step, const ExtractOptions& options) {
  std::string text;
  extract_csv(step, options, [&](std::string_view part) { text += part; });
  std::istringstream lines(text);
  std::vector<Numbers> rows;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    Numbers& row = rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');)
      row.push_back(word.empty() ? std::nan("") : std::stod(word));
  }
  return rows;
}

std::string message_of(const ArchiveStep& step, const ExtractOptions& options) {
  try {
    rows_of(step, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

ArchiveStep written_step(const TemporaryFolder& folder, const Grid& grid, Fields& fields) {
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({3, 0.5, 0, 0, {}}, grid, fields.pieces());
  const Archive archive = Archive::open(writer.folder());
  return archive.read_output(archive.outputs()[0]);
}

double plane(Vec3 p, int component) {
  return 2.0 - 3.0 * p.x + 0.5 * p.y + 7.0 * p.z + component * (1.0 + p.y);
}

void add_planes(Fields& fields, const Grid& grid) {
  const auto add = [&](const Label& label, Centring centring) {
    for (const Level& level : grid.levels)
      fields.add(level, label, 0, [&level, centring](IntVec3 c, int m) {
        return plane(position(level, centring, c), m);
      });
  };
  add(real_label("press_CC"), Centring::cell);
  add(vector_label("vel_CC"), Centring::cell);
  add(real_label("uvel_FC", Centring::x_face), Centring::x_face);
  add(real_label("node_NC", Centring::node), Centring::node);
}

std::vector<Vec3> random_points(const Level& level, int count) {
  std::mt19937 engine(7);
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    Vec3 p;
    for (int d = 0; d < 3; ++d) {
      const double high = level.domain.size()[d] * level.spacing[d];
      p[d] = level.anchor[d] + std::uniform_real_distribution<double>(0, high)(engine);
    }
    points.push_back(p);
  }
  points.push_back(level.anchor);  // a corner of the domain
  return points;
}

TEST(ExtractPoints, LinearFieldsAreExactOnLevels) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  add_planes(fields, grid);
  const ArchiveStep step = written_step(folder, grid, fields);
  for (const std::string name : {"press_CC", "vel_CC", "uvel_FC", "node_NC"}) {
    ExtractOptions options;
    options.label = name;
    options.linear = true;
    options.at = random_points(grid.levels[0], 400);
    const auto rows = rows_of(step, options);
    ASSERT_EQ(rows.size(), options.at.size());
    int fine = 0;
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const Vec3 p = options.at[n];
      fine += rows[n][1] == 1;
      EXPECT_EQ((Vec3{rows[n][3], rows[n][4], rows[n][5]}), p);
      for (std::size_t c = 6; c < rows[n].size(); ++c)
        EXPECT_NEAR(rows[n][c], plane(p, static_cast<int>(c) - 6), 1e-12)
            << name << " " << p.x << " " << p.y << " " << p.z;
    }
    EXPECT_GT(fine, 10) << "points on both levels";
    EXPECT_LT(fine, 300);
  }
}

TEST(ExtractPoints, LinesOfLinearFieldsAreExact) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  add_planes(fields, grid);
  const ArchiveStep step = written_step(folder, grid, fields);
  ExtractOptions options;
  options.label = "vel_CC.y";
  options.linear = true;
  const Vec3 a{-0.98, 0.3, 3.1}, b{-0.21, 1.7, 4.4};
  for (const int points : {0, 2, 17}) {
    options.line = ExtractLine{a, b, points};
    const auto rows = rows_of(step, options);
    if (points > 0) {
      ASSERT_EQ(rows.size(), static_cast<std::size_t>(points));
      EXPECT_EQ(rows.front()[1], 0);
      EXPECT_DOUBLE_EQ(rows.back()[1], std::sqrt(dot(b - a, b - a)));
    }
    EXPECT_GE(rows.size(), 2u);
    for (const Numbers& row : rows) {
      const Vec3 p{row[4], row[5], row[6]};
      EXPECT_NEAR(row[1], std::sqrt(dot(p - a, p - a)), 1e-12);
      EXPECT_NEAR(row[7], plane(p, 1), 1e-12);
    }
  }
}

// Each cell that a slanted line crosses has one row, in the middle of its piece.
TEST(ExtractPoints, ALineHasOneRowForEachCellThatItCrosses) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(1);
  Fields fields;
  for (const Level& level : grid.levels)
    fields.add(level, real_label("press_CC"), 0,
               [&](IntVec3 c, int) { return 1000.0 * level.index + c.x + 100.0 * c.y; });
  const ArchiveStep step = written_step(folder, grid, fields);
  // Along x through the row of coarse cells 2: three coarse cells, eight fine ones, two coarse.
  // The domain is [-1, -0.2] x [0.25, 1.75]; the fine boxes begin at x = -0.8 and end at -0.4.
  ExtractOptions options;
  options.label = "press_CC";
  options.line = ExtractLine{{-5, 0.8, 0}, {5, 0.8, 0}};
  const auto rows = rows_of(step, options);
  std::vector<double> x, values;
  for (const Numbers& row : rows) {
    x.push_back(row[4]);
    values.push_back(row[7]);
  }
  std::vector<double> expected_x, expected;
  for (int i = 0; i < 8; ++i) {
    if (i < 2 || i > 5) {
      expected_x.push_back(-1 + 0.1 * (i + 0.5));
      expected.push_back(200 + i);
      continue;
    }
    for (int fine = 2 * i; fine < 2 * i + 2; ++fine) {
      expected_x.push_back(-1 + 0.05 * (fine + 0.5));
      expected.push_back(1000 + fine + 400);
    }
  }
  EXPECT_THAT(x, ::testing::Pointwise(::testing::DoubleNear(1e-9), expected_x));
  EXPECT_EQ(values, expected);
  // A slanted line: the pieces of the cells follow each other, and end where it leaves the domain.
  options.line = ExtractLine{{-0.97, 0.3, 3.25}, {-0.33, 1.6, 3.25}};
  const auto slanted = rows_of(step, options);
  for (const Numbers& row : slanted) {
    const Level& level = grid.levels[static_cast<std::size_t>(row[2])];
    const IntVec3 c = cell_of(level, {row[4], row[5], row[6]});
    EXPECT_EQ(row[7], 1000.0 * row[2] + c.x + 100.0 * c.y);
  }
  for (std::size_t n = 1; n < slanted.size(); ++n)
    EXPECT_NE(slanted[n][7], slanted[n - 1][7]) << "one row a cell";
  EXPECT_GT(slanted.size(), 12u);
}

TEST(ExtractPoints, TheFinestCellHoldsAPoint) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(1);
  Fields fields;
  add_planes(fields, grid);
  const ArchiveStep step = written_step(folder, grid, fields);
  ExtractOptions options;
  options.label = "press_CC";
  options.at = {{-0.77, 0.8, 99}, {-0.97, 0.8, 3.1}, {-0.2, 1.75, 3.1}};
  const auto rows = rows_of(step, options);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], (Numbers{0.5, 1, 0, 4, 4, 0, -0.77500000000000002, 0.8125, 3.25,
                              plane({-0.775, 0.8125, 3.25}, 0)}));
  EXPECT_EQ(rows[1][1], 0);
  EXPECT_EQ((IntVec3{int(rows[1][3]), int(rows[1][4]), int(rows[1][5])}), (IntVec3{0, 2, 0}));
  // The high corner of the domain belongs to its last cell.
  EXPECT_EQ((IntVec3{int(rows[2][3]), int(rows[2][4]), int(rows[2][5])}), (IntVec3{7, 5, 0}));
  options.level = 0;
  EXPECT_EQ(rows_of(step, options)[0][1], 0);
  options.at = {{0, 0.8, 0}};
  EXPECT_THAT(message_of(step, options),
              HasSubstr("the domain is [-1, -0.2] x [0.25, 1.75] x [3, 3.5]"));
  options.at.clear();
  options.line = ExtractLine{{5, 5, 5}, {6, 6, 6}};
  EXPECT_THAT(message_of(step, options), HasSubstr("the domain is"));
}

// u(x) over a period of 8 cells: at the end of the domain the first and the last cell meet.
TEST(ExtractPoints, PeriodicDirectionsGoRound) {
  const TemporaryFolder folder;
  Grid grid = make_grid({8, 1, 1}, {2, 1, 1});
  grid.levels[0].periodic = {true, false, false};
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  const ArchiveStep step = written_step(folder, grid, fields);
  ExtractOptions options;
  options.label = "press_CC";
  options.linear = true;
  options.at = {{-1, 0.3, 3}, {-0.2, 0.3, 3}, {-0.98, 0.3, 3}};
  const auto rows = rows_of(step, options);
  const double first = wavy({0, 0, 0}, 0), last = wavy({7, 0, 0}, 0);
  EXPECT_NEAR(rows[0][6], 0.5 * (first + last), 1e-12);
  EXPECT_NEAR(rows[1][6], 0.5 * (first + last), 1e-12);
  EXPECT_NEAR(rows[2][6], 0.7 * first + 0.3 * last, 1e-12);
}

// Where a material is absent (NaN), the value is that of the cell.
TEST(ExtractPoints, AbsentNeighboursSpoilNothing) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 1, 1}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0,
             [](IntVec3 c, int) { return c.x < 2 ? 3.0 + c.x : std::nan(""); });
  const ArchiveStep step = written_step(folder, grid, fields);
  ExtractOptions options;
  options.label = "press_CC";
  options.linear = true;
  options.at = {{-0.9, 0.3, 3}, {-0.82, 0.3, 3}, {-0.7, 0.3, 3}};
  const auto rows = rows_of(step, options);
  EXPECT_NEAR(rows[0][6], 3.5, 1e-12);
  EXPECT_EQ(rows[1][6], 4);
  EXPECT_TRUE(std::isnan(rows[2][6]));
}

TEST(ExtractPoints, PartsOfVectorsAndTensors) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({2, 1, 1}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], vector_label("vel_CC"), 0, [](IntVec3 c, int m) {
    return m == 0 ? 3.0 : m == 1 ? -4.0 : 12.0 * c.x;
  });
  // Pressure 2 and a shear of 3: s = diag(0) + shear, sqrt(3/2 * 2 * 9) = sqrt(27).
  const Label tensor = declare_label({"tau_CC", ValueType::tensor, Centring::cell, "Pa", "a test"});
  fields.add(grid.levels[0], tensor, 0, [](IntVec3, int m) {
    return m % 4 == 0 ? -2.0 : m == 1 || m == 3 ? 3.0 : 0.0;
  });
  const ArchiveStep step = written_step(folder, grid, fields);
  const auto last_of = [&](const std::string& name) {
    return rows_of(step, {name, {}, -1, {}, {}}).back().back();
  };
  EXPECT_EQ(last_of("vel_CC.y"), -4);
  EXPECT_EQ(last_of("vel_CC.size"), 13);
  EXPECT_EQ(last_of("tau_CC.yx"), 3);
  EXPECT_DOUBLE_EQ(last_of("tau_CC.vonMises"), std::sqrt(27.0));
  EXPECT_DOUBLE_EQ(last_of("tau_CC.pressure"), 2);
  EXPECT_DOUBLE_EQ(last_of("tau_CC.det"), -2 * (4 - 0) - 3 * (3 * -2.0));
  EXPECT_DOUBLE_EQ(last_of("tau_CC.size"), std::sqrt(3 * 4 + 2 * 9.0));
  EXPECT_EQ(rows_of(step, {"tau_CC", {}, -1, {}, {}}).front().size(), 9u + 9u);
  EXPECT_THAT(message_of(step, {"vel_CC.vonMises", {}, -1, {}, {}}),
              HasSubstr("vel_CC is a vector: its parts are x, y, z and size"));
  EXPECT_THAT(message_of(step, {"vel_C.x", {}, -1, {}, {}}), HasSubstr("it has tau_CC, vel_CC"));
}

}  // namespace
}  // namespace sluice::extract_points_test

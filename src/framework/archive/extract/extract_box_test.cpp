// The CSV contract: header, order, digits, closed boxes, finest level, positions of faces and
// nodes.
#include "framework/archive/extract/extract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "framework/archive/archive_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::extract_box_test {
namespace {

using namespace archive_test;

struct Row {
  double time = 0;
  int level = 0, material = 0;
  IntVec3 index;
  Vec3 x;
  std::vector<double> values;
};

struct Table {
  std::string header;
  std::vector<Row> rows;
};

Table parse(const std::string& text) {
  Table t;
  std::istringstream lines(text);
  std::getline(lines, t.header);
  for (std::string line; std::getline(lines, line);) {
    std::vector<double> n;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) n.push_back(std::stod(part));
    auto whole = [&](std::size_t i) { return static_cast<int>(n[i]); };
    t.rows.push_back({n[0],
                      whole(1),
                      whole(2),
                      {whole(3), whole(4), whole(5)},
                      {n[6], n[7], n[8]},
                      {n.begin() + 9, n.end()}});
  }
  return t;
}

Table extracted(const ArchiveStep& step, const ExtractOptions& options) {
  std::string text;
  const std::int64_t rows =
      extract_csv(step, options, [&](std::string_view part) { text += part; });
  Table t = parse(text);
  EXPECT_EQ(static_cast<std::int64_t>(t.rows.size()), rows);
  return t;
}

ArchiveStep written_step(const TemporaryFolder& folder, const Grid& grid, Fields& fields) {
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({3, 0.1, 0, 0, {}}, grid, fields.pieces());
  const Archive archive = Archive::open(writer.folder());
  return archive.read_output(archive.outputs()[0]);
}

TEST(ExtractBox, EveryCellOnceWithAllDigits) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({5, 4, 3}, {2, 2, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  fields.add(grid.levels[0], vector_label("vel_CC"), 2, wavy);
  const ArchiveStep step = written_step(folder, grid, fields);
  const Table t = extracted(step, {"press_CC", {}, -1, {}, {}});
  EXPECT_EQ(t.header, "time,level,material,i,j,k,x,y,z,value");
  ASSERT_EQ(t.rows.size(), 60u);
  std::size_t n = 0;
  for_each_cell(grid.levels[0].domain, [&](IntVec3 c) {
    const Row& r = t.rows[n++];
    EXPECT_EQ(r.index, c);
    EXPECT_EQ(r.time, 0.1);
    EXPECT_EQ(r.x, grid.levels[0].centre(c));
    EXPECT_EQ(r.values, std::vector<double>{wavy(c, 0)});
  });
  const Table v = extracted(step, {"vel_CC", 2, 0, {}, {}});
  EXPECT_EQ(v.header, "time,level,material,i,j,k,x,y,z,value_x,value_y,value_z");
  EXPECT_EQ(v.rows.at(7).material, 2);
  EXPECT_EQ(v.rows[7].values,
            (std::vector<double>{wavy(v.rows[7].index, 0), wavy(v.rows[7].index, 1),
                                 wavy(v.rows[7].index, 2)}));
}

TEST(ExtractBox, ClosedBoxOfCentres) {
  const TemporaryFolder folder;
  Grid grid = make_grid({8, 4, 1}, {1, 1, 1});
  grid.levels[0].anchor = {0, 0, 0};
  grid.levels[0].spacing = {0.25, 0.5, 1};
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  const ArchiveStep step = written_step(folder, grid, fields);
  // Centres at 0.125, 0.375, ... : both ends lie on centres and belong.
  const Table t = extracted(step, {"press_CC", {}, -1, Vec3{0.375, 0.25, 0}, Vec3{0.875, 0.75, 1}});
  std::set<std::pair<int, int>> found;
  for (const Row& r : t.rows) found.insert({r.index.x, r.index.y});
  EXPECT_EQ(found, (std::set<std::pair<int, int>>{{1, 0}, {2, 0}, {3, 0}, {1, 1}, {2, 1}, {3, 1}}));
}

// Empty is not good: what is nearest is named instead.
TEST(ExtractBox, ABoxWithoutAPointNamesTheNearest) {
  const TemporaryFolder folder;
  Grid grid = make_grid({8, 4, 1}, {1, 1, 1});
  grid.levels[0].anchor = {0, 0, 0};
  grid.levels[0].spacing = {0.25, 0.5, 1};
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  fields.add_particles(
      0, 0, {5, 8}, [](double id, int c) { return 0.01 * id + c; }, 2);
  const ArchiveStep step = written_step(folder, grid, fields);
  const auto message = [&](const ExtractOptions& o) {
    std::string text;
    try {
      extract_csv(step, o, [&](std::string_view part) { text += part; });
    } catch (const InputError& e) {
      EXPECT_EQ(text, "") << "nothing may be written before";
      return std::string(e.what());
    }
    return text;
  };
  // Outside the domain; between two centres, of which (0.375, 0.25) is nearer; beside the flat z.
  EXPECT_THAT(message({"press_CC", {}, -1, Vec3{5, 5, 0}, Vec3{6, 6, 1}}),
              ::testing::HasSubstr("the nearest is [7, 3, 0] of level 0 at (1.875, 1.75, 0.5)"));
  EXPECT_THAT(message({"press_CC", {}, -1, Vec3{0.3, 0.2, 0}, Vec3{0.37, 0.3, 1}}),
              ::testing::HasSubstr("the nearest is [1, 0, 0] of level 0 at (0.375, 0.25, 0.5)"));
  EXPECT_THAT(message({"press_CC", {}, -1, Vec3{0.1, 0.2, 0}, Vec3{0.2, 0.3, 0}}),
              ::testing::HasSubstr("the nearest is [0, 0, 0] of level 0"));
  EXPECT_THAT(message({"p.heat", {}, -1, Vec3{0, 0, 0}, Vec3{0.01, 3, 3}}),
              ::testing::HasSubstr("the nearest is particle 5"));
  EXPECT_THAT(message({"p.heat", {}, 1, {}, {}}), ::testing::HasSubstr("materials 2 and levels 0"));
  EXPECT_THAT(message({"p.heat", 0, -1, {}, {}}), ::testing::HasSubstr("materials 2 and levels 0"));
}

TEST(ExtractBox, FacesAndNodesLieWhereTheyAre) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 3, 2}, {2, 1, 1});
  const Level& level = grid.levels[0];
  Fields fields;
  fields.add(level, real_label("uvel_FC", Centring::x_face), 0, wavy);
  fields.add(level, real_label("node_NC", Centring::node), 0, wavy);
  const ArchiveStep step = written_step(folder, grid, fields);
  const Table u = extracted(step, {"uvel_FC", {}, -1, {}, {}});
  ASSERT_EQ(u.rows.size(), 5u * 3 * 2);
  for (const Row& r : u.rows) {
    EXPECT_EQ(r.x.x, level.anchor.x + r.index.x * level.spacing.x);
    EXPECT_EQ(r.x.y, level.centre(r.index).y);
    EXPECT_EQ(r.values[0], wavy(r.index, 0));
  }
  const Table n = extracted(step, {"node_NC", {}, -1, {}, {}});
  ASSERT_EQ(n.rows.size(), 5u * 4 * 3);
  EXPECT_EQ(n.rows.back().x.z, level.anchor.z + 2 * level.spacing.z);
}

TEST(ExtractBox, AllLevelsGiveEveryPointOnceFromTheFinest) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  for (const Level& level : grid.levels) {
    const double shift = 1000.0 * level.index;
    fields.add(level, real_label("press_CC"), 0,
               [&, shift](IntVec3 c, int m) { return wavy(c, m) + shift; });
    fields.add(level, real_label("temp_CC"), level.index, wavy);  // on one level a material
  }
  const ArchiveStep step = written_step(folder, grid, fields);
  const Table t = extracted(step, {"press_CC", {}, -1, {}, {}});
  const std::int64_t fine = grid.levels[1].cell_count();
  EXPECT_EQ(static_cast<std::int64_t>(t.rows.size()),
            grid.levels[0].cell_count() - fine / 8 + fine);
  double volume = 0;
  for (const Row& r : t.rows) volume += grid.levels[r.level].cell_volume();
  EXPECT_NEAR(volume, 8 * 6 * 3 * grid.levels[0].cell_volume(), 1e-12);
  EXPECT_EQ(extracted(step, {"press_CC", {}, 0, {}, {}}).rows.size(), 8u * 6 * 3);
  EXPECT_EQ(extracted(step, {"press_CC", {}, 1, {}, {}}).rows.size(),
            static_cast<std::size_t>(fine));
  // Materials do not hide each other.
  EXPECT_EQ(static_cast<std::int64_t>(extracted(step, {"temp_CC", {}, -1, {}, {}}).rows.size()),
            grid.levels[0].cell_count() + fine);
}

TEST(ExtractBox, WhatIsNotThereIsSaid) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 1, 1}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  const ArchiveStep step = written_step(folder, grid, fields);
  auto message_of = [&](const ExtractOptions& o) {
    try {
      extract_csv(step, o, [](std::string_view) {});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message_of({"pres_CC", {}, -1, {}, {}}), ::testing::HasSubstr("it has press_CC"));
  EXPECT_THAT(message_of({"press_CC", 3, -1, {}, {}}), ::testing::HasSubstr("materials 0"));
  EXPECT_THAT(message_of({"press_CC", {}, 1, {}, {}}), ::testing::HasSubstr("levels 0"));
}

}  // namespace
}  // namespace sluice::extract_box_test

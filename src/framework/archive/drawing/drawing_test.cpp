// Names of arrays by materials, and marks of covered cells.
#include <gtest/gtest.h>

#include <numeric>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/drawing/array_names.hpp"
#include "framework/archive/drawing/covered_cells.hpp"

namespace sluice::drawing_test {
namespace {

using namespace archive_test;

ArrayNames names_with(const TemporaryFolder& folder, const std::string& deck) {
  const Grid grid = make_grid({4, 1, 1}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  for (const int material : {0, 1, 2})
    fields.add(grid.levels[0], real_label("temp_CC"), material, wavy);
  ArchiveSetup setup = setup_in(folder.path());
  setup.deck_xml = deck;
  ArchiveWriter writer = ArchiveWriter::create(setup);
  writer.write_output({1, 0.5, 0, 0, {}}, grid, fields.pieces());
  return ArrayNames(Archive::open(writer.folder()));
}

TEST(ArrayNames, SolidsAreNumberedFirst) {
  const TemporaryFolder folder;
  const ArrayNames names = names_with(
      folder,
      "<Uintah_specification><MaterialProperties><ICE><material name=\"air\"/><material/></ICE>"
      "<MPM><material name=\"steel\"/></MPM></MaterialProperties></Uintah_specification>\n");
  EXPECT_EQ(names.of("press_CC", 0), "press_CC");
  EXPECT_EQ(names.of("temp_CC", 0), "temp_CC_steel");
  EXPECT_EQ(names.of("temp_CC", 1), "temp_CC_air");
  EXPECT_EQ(names.of("temp_CC", 2), "temp_CC_2");
  EXPECT_EQ(names.described(1), "air");
  EXPECT_EQ(names.described(2), "material 2");
  EXPECT_EQ(names.of("not there", 1), "not there");
}

TEST(ArrayNames, WithoutNamesOfTheirOwnMaterialsHaveNumbers) {
  for (const char* deck :
       {"<Uintah_specification/>\n",
        "<Uintah_specification><MaterialProperties><ICE><material name=\"gas\"/>"
        "<material name=\"gas\"/></ICE></MaterialProperties></Uintah_specification>\n"}) {
    const TemporaryFolder folder;
    EXPECT_EQ(names_with(folder, deck).of("temp_CC", 1), "temp_CC_1") << deck;
  }
}

TEST(CoveredCells, AreThoseBelowFinerBoxes) {
  // The fine boxes lie over coarse cells 2 to 3 and 4 to 5 in x, from 2 to 3 and from 2 to 4 in y.
  const Grid grid = make_two_levels(1);
  const CoveredCells covered(grid, 0), finest(grid, 1);
  const IndexBox all = grid.levels[0].domain;
  const std::vector<std::uint8_t> types = covered.ghost_types(all);
  EXPECT_EQ(std::accumulate(types.begin(), types.end(), 0), 9 * (2 * 2 + 2 * 3));
  EXPECT_EQ(types[2 + 8 * 2], 9);
  EXPECT_EQ(types[2 + 8 * 4], 0);
  EXPECT_EQ(types[4 + 8 * 4], 9);
  EXPECT_TRUE(covered.any({{0, 0, 0}, {3, 3, 1}}));
  EXPECT_FALSE(covered.any({{0, 0, 0}, {2, 6, 1}}));
  EXPECT_FALSE(finest.any(grid.levels[1].domain));
}

}  // namespace
}  // namespace sluice::drawing_test

// Volume, mass and momentum of each material against what was put in; extremes of particles.
#include "framework/archive/extremes/material_sums.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/extremes/field_extremes.hpp"

namespace sluice::material_sums_test {
namespace {

using namespace archive_test;
using testing::ElementsAre;

ArchiveStep written(const TemporaryFolder& folder, const Grid& grid, Fields& fields) {
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({3, 0.1, 0, 0, {}}, grid, fields.pieces());
  const Archive archive = Archive::open(writer.folder());
  return archive.read_output(archive.outputs()[0]);
}

// Density 2, velocity (3, 0, -1): each place once, so that the finer level changes nothing.
TEST(MaterialSums, CountEachPlaceOnceOnItsFinestLevel) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  for (const Level& level : grid.levels) {
    fields.add(level, real_label("rho_CC"), 0, [](IntVec3, int) { return 2.0; });
    fields.add(level, vector_label("vel_CC"), 0, [](IntVec3, int c) {
      return c == 0 ? 3.0 : c == 2 ? -1.0 : 0.0;
    });
    // Coarse values under the finer level are wrong: they must not count.
    const bool coarse = level.index == 0;
    fields.add(level, real_label("vol_frac_CC"), 0, [&, coarse](IntVec3 c, int) {
      const bool under =
          coarse && c.z == 0 && c.x >= 2 && c.x < 6 && c.y >= 2 && c.y < (c.x < 4 ? 4 : 5);
      return under ? 77.0 : 0.5;
    });
  }
  const ArchiveStep step = written(folder, grid, fields);
  const auto sums = material_sums(step, false);
  ASSERT_EQ(sums.size(), 1U);
  const double volume = 8 * 0.1 * 6 * 0.25 * 3 * 0.5;
  EXPECT_FALSE(sums[0].particles);
  EXPECT_NEAR(*sums[0].mass, 2 * volume, 1e-13);
  EXPECT_NEAR(*sums[0].volume, 0.5 * volume, 1e-13);
  EXPECT_NEAR(sums[0].momentum->x, 6 * volume, 1e-13);
  EXPECT_EQ(sums[0].momentum->y, 0);
  EXPECT_NEAR(sums[0].momentum->z, -2 * volume, 1e-13);
}

TEST(MaterialSums, SayWhatIsMissing) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 3, 1}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("rho_CC"), 1, [](IntVec3, int) { return 2.0; });
  fields.add_particles(
      0, 0, {4, 9}, [](double id, int c) { return id + c; }, 2);
  const ArchiveStep step = written(folder, grid, fields);
  const auto several = material_sums(step, false), alone = material_sums(step, true);
  ASSERT_EQ(several.size(), 1U);  // particles without mass and volume tell nothing
  EXPECT_THAT(several[0].missing, ElementsAre("vol_frac_CC", "vel_CC"));
  EXPECT_FALSE(several[0].volume);
  EXPECT_NEAR(*alone[0].volume, 12 * 0.1 * 0.25 * 0.5, 1e-14);
}

TEST(FieldExtremes, OfParticlesAreNamedByNumber) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 3, 1}, {1, 1, 1});
  Fields fields;
  fields.add_particles(
      0, 0, {4, 9, 2}, [](double id, int c) { return id + c; }, 2);
  const ArchiveStep step = written(folder, grid, fields);
  const FieldExtremes heat = extremes_of(step, *step.find_particles("p.heat", 2, 0), 0);
  EXPECT_EQ(heat.values, 3);
  EXPECT_EQ(heat.least->value, 5);
  EXPECT_EQ(heat.least->particle, 2);
  EXPECT_EQ(heat.least->at, (Vec3{2, 3, 4}));
  EXPECT_EQ(heat.most->particle, 9);
  EXPECT_EQ(place_text(heat.field, *heat.most), "particle 9");
  EXPECT_EQ(all_extremes(step).size(), 4U);  // three components of p.x, and p.heat
}

TEST(FieldExtremes, WhatIsNoNumberIsCountedApart) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 3, 1}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("temp_CC"), 0,
             [](IntVec3 c, int) { return c.x == 1 ? std::nan("") : c.x - 10.0 * c.y; });
  const ArchiveStep step = written(folder, grid, fields);
  const FieldExtremes e = extremes_of(step, *step.find("temp_CC", 0, 0), 0);
  EXPECT_EQ(e.values, 9);
  EXPECT_EQ(e.not_numbers, 3);
  EXPECT_EQ(e.least->index, (IntVec3{0, 2, 0}));
  EXPECT_EQ(e.most->index, (IntVec3{3, 0, 0}));
  EXPECT_EQ(e.first_nan->index.x, 1);
}

}  // namespace
}  // namespace sluice::material_sums_test

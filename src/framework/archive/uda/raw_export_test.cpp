// What is exported in the raw layout reads back equal, from both formats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/raw_archive_test_support.hpp"
#include "framework/archive/uda/raw_export.hpp"

namespace sluice::raw_export_test {
namespace {

using namespace archive_test;
using ::testing::SizeIs;

fs::path write_own(const fs::path& folder) {
  const Grid grid = make_two_levels(2);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder));
  for (const int step : {1, 2}) {
    Fields fields;
    for (const Level& level : grid.levels) {
      fields.add(level, real_label("press_CC"), 0, wavy);
      fields.add(level, vector_label("vel_CC"), 1, wavy);
      fields.add(level, real_label("uvel_FC", Centring::x_face), 0, wavy);
      fields.add(level, real_label("g.mass", Centring::node), 1, wavy);
    }
    fields.add_particles(0, 1, {7, 3, 5}, [](double id, int c) {
      return -0.95 + 0.01 * id * (c == 0) + (c == 1 ? 1.3 : 0) + (c == 2 ? 4.2 : 0);
    });
    writer.history("TotalMass", -1, step, 0.5 * step, 1.0);
    writer.write_output({step, 0.5 * step, 0.5, 0.5, {}}, grid, fields.pieces());
  }
  writer.finish();
  return writer.folder();
}

TEST(RawExport, ReadsBackEqual) {
  const TemporaryFolder folder;
  const Archive own = Archive::open(write_own(folder.path()));
  const Archive raw = Archive::open(export_raw(own, folder / "raw.uda.000", {}, ""));
  ASSERT_EQ(raw.format(), ArchiveFormat::raw);
  const CompareResult r = compare(own, raw, {});
  EXPECT_THAT(r.not_comparable, SizeIs(0));
  EXPECT_THAT(r.fields, SizeIs(0));
  EXPECT_THAT(r.paired, SizeIs(2));
  const std::int64_t coarse = 8 * 6 * 2, fine = 4 * 4 * 4 + 4 * 6 * 4;
  EXPECT_GE(r.values, 2 * 4 * (coarse + fine));
  // Particles have kept their numbers.
  const ArchiveStep step = raw.read_output(raw.outputs()[1]);
  EXPECT_EQ(step.read_particle_integers(*step.find_particles("p.particleID", 0, 0)),
            (std::vector<std::int64_t>{7, 3, 5}));
  EXPECT_THAT(raw.index().histories, SizeIs(1));
  EXPECT_TRUE(fs::exists(raw.folder() / "TotalMass.dat"));
  EXPECT_THROW(export_raw(own, folder / "raw.uda.000", {}, ""), InputError);
  EXPECT_THROW(export_raw(own, folder / "none", {{"absent"}, {}}, ""), InputError);
}

// The high faces of a finer level, which Sluice does not store, are those of the coarser.
TEST(RawExport, ClosesFinerLevels) {
  const TemporaryFolder folder;
  const Archive own = Archive::open(write_own(folder.path()));
  const Archive raw = Archive::open(export_raw(own, folder / "raw", {{"uvel_FC"}, {}}, "last"));
  const ArchiveStep step = raw.read_output(raw.outputs()[0]);
  const DenseField faces = step.read(*step.find("uvel_FC", 0, 1));
  EXPECT_EQ(faces.cells.upper.x, 13);
  EXPECT_EQ(faces.at({12, 5, 1}), wavy({6, 2, 0}, 0));
  EXPECT_EQ(faces.at({11, 5, 1}), wavy({11, 5, 1}, 0));
}

TEST(RawExport, RawArchivesBecomeRawArchives) {
  const TemporaryFolder folder;
  raw_test::Writer writer(folder / "a.uda.000");
  writer.big_endian = true;
  writer.gzip = true;
  writer.add_step(
      3, 0.5, {raw_test::make_level({{0, 0, 0}, {6, 4, 1}}, {3, 2, 1}, {1, 1, 1}, {1, 1, 1})},
      {{"press_CC", "CCVariable<float>", 0, [](IntVec3 i, int) { return i.x + 8.0 * i.y; }}});
  writer.write_index();
  const Archive a = Archive::open(writer.folder());
  const Archive b = Archive::open(export_raw(a, folder / "b", {}, ""));
  const CompareResult r = compare(a, b, {});
  EXPECT_EQ(r.exit_status(), 0);
  EXPECT_EQ(r.values, 24);
  EXPECT_EQ(b.index().variables[0].type_name, "CCVariable<float>");
}

}  // namespace
}  // namespace sluice::raw_export_test

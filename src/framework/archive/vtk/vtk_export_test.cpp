// What VTK's and ParaView's readers see of an export are the archive's numbers.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/vtk/vtk_export.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::vtk_export_test {
namespace {

using namespace archive_test;

// ParaView's reader of times takes seconds to start: cases of ./dev test do without it, but one.
enum class With { vtk, paraview };

// Runs tools/verify_export.py; GTEST_SKIP where Python's VTK is missing.
int verify_export(const fs::path& archive, const fs::path& pvd, With readers) {
  const std::string command =
      std::string("/usr/bin/python3 -B " SLUICE_SOURCE_DIR "/tools/verify_export.py ") +
      archive.string() + " " + pvd.string() + (readers == With::paraview ? " --paraview" : "");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void add_all_kinds(Fields& fields, const Level& level) {
  fields.add(level, real_label("press_CC"), 0, wavy);
  fields.add(level, real_label("temp_CC"), 0, wavy);
  fields.add(level, real_label("temp_CC"), 1,
             [](IntVec3 c, int m) { return 1e-3 * wavy(c, m + 5); });
  fields.add(level, vector_label("vel_CC"), 0, wavy);
  fields.add(level, real_label("vvel_FC", Centring::y_face), 0, wavy);
  fields.add(level, declare_label({"flag", ValueType::integer, Centring::cell, "1", "a test"}), 0,
             [](IntVec3 c, int) { return c.x - 100 * c.y; });
}

void expect_right_numbers(const fs::path& archive_path, const fs::path& folder,
                          const char* extension, With readers) {
  const Archive archive = Archive::open(archive_path);
  ExportOptions options;
  options.amr = std::string(extension) == ".vthb";
  const fs::path made = export_vtk(archive, folder / ("as" + std::string(extension)), options);
  EXPECT_EQ(made.filename(), options.amr ? "box.uda.000.vthb.series" : "box.uda.000.pvd");
  EXPECT_TRUE(fs::exists(made.parent_path() / ("t00002" + std::string(extension))));
  const int status = verify_export(archive_path, made, readers);
  if (status == 77) GTEST_SKIP() << "vtkmodules (python3-paraview) or h5py is not installed";
  EXPECT_EQ(status, 0);
}

void export_images(With readers) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({7, 5, 3}, {2, 2, 1});
  Fields fields;
  add_all_kinds(fields, grid.levels[0]);
  fields.add(grid.levels[0], real_label("node_NC", Centring::node), 0, wavy);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), folder.path(), ".vti", readers);
}

TEST(VtkExport, OneLevelAsImages) {
  export_images(With::vtk);
}
TEST(FullVtkExport, OneLevelAsImages) {
  export_images(With::paraview);
}

void export_two_levels(int nz, int ny, With readers) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(nz, ny);
  Fields fields;
  for (const Level& level : grid.levels) add_all_kinds(fields, level);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  for (const char* extension : {".vtm", ".vthb"})
    expect_right_numbers(writer.folder(), folder.path(), extension, readers);
}

TEST(VtkExport, TwoLevelsInTwoDimensions) {
  export_two_levels(1, 6, With::vtk);
}
TEST(FullVtkExport, TwoLevelsInThreeDimensions) {
  export_two_levels(3, 6, With::paraview);
}
TEST(VtkExport, TwoLevelsInOneDimension) {
  export_two_levels(1, 1, With::vtk);
}
TEST(FullVtkExport, TwoLevelsInOneAndTwoDimensions) {
  export_two_levels(1, 1, With::paraview);
  export_two_levels(1, 6, With::paraview);
}

// VTK's hierarchies know one ratio for all directions; blocks of images do not care.
void export_unequal_ratios(With readers) {
  const TemporaryFolder folder;
  Grid grid = make_two_levels(3);
  Level& fine = grid.levels[1];
  fine.ratio = {2, 4, 2};
  fine.spacing.y = grid.levels[0].spacing.y / 4;
  fine.domain.upper.y = 4 * grid.levels[0].domain.upper.y;
  fine.domain.lower.y = 4 * grid.levels[0].domain.lower.y;
  for (GridBox& b : fine.boxes) {
    b.cells.lower.y *= 2;
    b.cells.upper.y *= 2;
  }
  Fields fields;
  for (const Level& level : grid.levels) fields.add(level, real_label("press_CC"), 0, wavy);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), folder.path(), ".vtm", readers);
  ExportOptions amr;
  amr.amr = true;
  EXPECT_THROW(export_vtk(Archive::open(writer.folder()), folder.path() / "amr", amr), InputError);
}

TEST(VtkExport, UnequalRatiosAreWrittenAsBlocksOnly) {
  export_unequal_ratios(With::vtk);
}
TEST(FullVtkExport, UnequalRatiosAreWrittenAsBlocksOnly) {
  export_unequal_ratios(With::paraview);
}

void export_particles(With readers) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(1);
  Fields fields;
  for (const Level& level : grid.levels) fields.add(level, real_label("press_CC"), 0, wavy);
  const auto f = [](double id, int c) { return std::sin(id + c); };
  fields.add_particles(0, 0, {9, 2, 0x1p53 - 1}, f);
  fields.add_particles(1, 1, {5}, f);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), folder.path(), ".vtm", readers);
  EXPECT_TRUE(fs::exists(folder.path() / "as.vtm" / "box.uda.000_particles.pvd"));
  // Particles alone.
  ExportOptions heat;
  heat.labels.only = {"p.heat"};
  const fs::path pvd = export_vtk(Archive::open(writer.folder()), folder.path() / "points", heat);
  EXPECT_EQ(pvd.filename(), "box.uda.000_particles.pvd");
  EXPECT_FALSE(fs::exists(folder.path() / "points" / "box.uda.000.pvd"));
}

TEST(VtkExport, ParticlesAsPoints) {
  export_particles(With::vtk);
}
TEST(FullVtkExport, ParticlesAsPoints) {
  export_particles(With::paraview);
}

void export_floats_in_gzip(With readers) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  for (const Level& level : grid.levels) add_all_kinds(fields, level);
  for (FieldPiece& piece : fields.pieces()) piece.gzip = true;
  ArchiveSetup setup = setup_in(folder.path());
  setup.outputs.doubles_as_float = true;
  ArchiveWriter writer = ArchiveWriter::create(setup);
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), folder.path(), ".vtm", readers);
}

TEST(VtkExport, FloatsInGzip) {
  export_floats_in_gzip(With::vtk);
}

// Several blocks of compressed values, and the last one full or not.
TEST(VtkExport, ManyValues) {
  for (const int nx : {8192, 20000}) {
    const TemporaryFolder folder;
    const Grid grid = make_grid({nx, 1, 1}, {1, 1, 1});
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
    fields.add(grid.levels[0], vector_label("vel_CC"), 0, wavy);
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.write_output({2, 0.5, 0, 0, {}}, grid, fields.pieces());
    expect_right_numbers(writer.folder(), folder.path(), ".vti", With::vtk);
  }
}

// The check itself must be able to fail: another number is found.
TEST(VtkExport, TheReadingBackFindsAWrongNumber) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({7, 5, 3}, {1, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({1, 1, 0, 0, {}}, grid, fields.pieces());
  const fs::path pvd =
      export_vtk(Archive::open(writer.folder()), folder.path() / "vtk", ExportOptions());
  // The same archive with one other value.
  const TemporaryFolder elsewhere;
  Fields others;
  others.add(grid.levels[0], real_label("press_CC"), 0, [](IntVec3 c, int m) {
    return wavy(c, m) + (c == IntVec3{3, 2, 1} ? 1e-14 : 0);
  });
  ArchiveWriter other = ArchiveWriter::create(setup_in(elsewhere.path()));
  other.write_output({1, 1, 0, 0, {}}, grid, others.pieces());
  const int status = verify_export(other.folder(), pvd, With::vtk);
  if (status == 77) GTEST_SKIP() << "vtkmodules (python3-paraview) or h5py is not installed";
  EXPECT_EQ(status, 1);
}

}  // namespace
}  // namespace sluice::vtk_export_test

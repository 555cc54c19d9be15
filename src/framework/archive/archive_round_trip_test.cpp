// What is written reads back to the bit: all types, centrings, boxes, ranks and storage options.
#include <gtest/gtest.h>

#include <barrier>
#include <bit>
#include <limits>
#include <thread>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/hdf5_handle.hpp"

namespace sluice::archive_round_trip_test {
namespace {

using namespace archive_test;

void expect_field(const ArchiveStep& step, const std::string& name, int material, int components,
                  const Fields::Function& f) {
  const FieldInfo* field = step.find(name, material, 0);
  ASSERT_NE(field, nullptr) << name;
  const DenseField dense = step.read(*field);
  ASSERT_FALSE(dense.cells.empty());
  for_each_cell(dense.cells, [&](IntVec3 c) {
    ASSERT_TRUE(dense.has(c));
    for (int m = 0; m < components; ++m)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(dense.at(c, m)), std::bit_cast<std::uint64_t>(f(c, m)))
          << name << ' ' << c.x << ' ' << c.y << ' ' << c.z;
  });
}

double whole(IntVec3 c, int) {
  return c.x - 3.0 * c.y + 100.0 * c.z;
}

TEST(ArchiveRoundTrip, AllTypesAndCentringsInSeveralBoxes) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({13, 7, 5}, {3, 2, 2});
  const Level& level = grid.levels[0];
  Fields fields;
  fields.add(level, real_label("press_CC"), 0, wavy);
  fields.add(level, real_label("press_CC"), 2, whole);
  fields.add(level, vector_label("vel_CC"), 0, wavy);
  fields.add(level, real_label("uvel_FC", Centring::x_face), 0, wavy);
  fields.add(level, real_label("wvel_FC", Centring::z_face), 0, wavy);
  fields.add(level, real_label("node_NC", Centring::node), 1, wavy);
  fields.add(level, declare_label({"flag", ValueType::integer, Centring::cell, "1", "a test"}), 0,
             whole);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  const StepInfo info{7, 0.1, 1.0 / 3, 1e-300, {{"regrid", "a <b> & \"c\"\nd"}}};
  writer.write_output(info, grid, fields.pieces());

  const Archive archive = Archive::open(folder.path() / "box.uda");
  ASSERT_EQ(archive.outputs().size(), 1u);
  EXPECT_EQ(archive.index().variables.size(), 6u);
  const ArchiveStep step = archive.read_output(archive.outputs()[0]);
  EXPECT_EQ(step.info().step, 7);
  EXPECT_EQ(step.info().time, 0.1);
  EXPECT_EQ(step.info().old_delt, 1.0 / 3);
  EXPECT_EQ(step.info().next_delt, 1e-300);
  EXPECT_EQ(step.info().state, info.state);
  EXPECT_EQ(step.grid().levels[0].boxes.size(), 12u);
  EXPECT_EQ(step.grid().levels[0].spacing, level.spacing);
  EXPECT_EQ(step.grid().levels[0].anchor, level.anchor);
  EXPECT_EQ(step.find("vel_CC", 0, 0)->unit, "m/s");
  expect_field(step, "press_CC", 0, 1, wavy);
  expect_field(step, "press_CC", 2, 1, whole);
  expect_field(step, "vel_CC", 0, 3, wavy);
  expect_field(step, "uvel_FC", 0, 1, wavy);
  expect_field(step, "wvel_FC", 0, 1, wavy);
  expect_field(step, "node_NC", 1, 1, wavy);
  expect_field(step, "flag", 0, 1, whole);
  EXPECT_EQ(step.range(*step.find("uvel_FC", 0, 0)), level.domain.grown(0, 0, 1));
  std::int64_t good = 0;
  EXPECT_TRUE(step.verify(good).empty());
  EXPECT_EQ(good, 6 * 455 + 14 * 35 + 91 * 6 + 14 * 8 * 6);
}

TEST(ArchiveRoundTrip, EveryBitPatternSurvives) {
  const double values[] = {-0.0,
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::infinity(),
                           std::bit_cast<double>(0x7ff8000000000123u),
                           std::bit_cast<double>(0xfff0000000000001u),
                           std::numeric_limits<double>::max()};
  auto odd = [&](IntVec3 c, int) { return values[c.x % 6]; };
  for (const bool gzip : {false, true}) {
    const TemporaryFolder folder;
    const Grid grid = make_grid({12, 1, 1}, {2, 1, 1});
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0, odd);
    for (FieldPiece& p : fields.pieces()) p.gzip = gzip;
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.write_checkpoint({1, 0, 0, 0, {}}, grid, fields.pieces());
    const Archive archive = Archive::open(writer.folder());
    EXPECT_TRUE(archive.outputs().empty());
    expect_field(archive.read_checkpoint(archive.select_checkpoint()), "press_CC", 0, 1, odd);
  }
}

TEST(ArchiveRoundTrip, ManyChunksCompressedAndPlain) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({70, 40, 30}, {2, 1, 2});  // more than one chunk a box
  Fields fields;
  fields.add(grid.levels[0], vector_label("vel_CC"), 0, wavy);
  fields.add(grid.levels[0], real_label("press_CC"), 0, whole);
  for (FieldPiece& p : fields.pieces()) p.gzip = p.label.name() == "press_CC";
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({1, 0, 0, 0, {}}, grid, fields.pieces());
  const Archive archive = Archive::open(writer.folder());
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  expect_field(step, "vel_CC", 0, 3, wavy);
  expect_field(step, "press_CC", 0, 1, whole);
  EXPECT_LT(fs::file_size(step.folder() / "p00000.h5"), 8u * 84000 * 7 / 2);
}

TEST(ArchiveRoundTrip, FloatsInOutputsNeverInCheckpoints) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({10, 4, 1}, {1, 1, 1});
  auto big = [](IntVec3 c, int) { return c.x == 0 ? 1e300 : 1.0 / (3 + c.x); };
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, big);
  ArchiveSetup setup = setup_in(folder.path());
  setup.outputs.doubles_as_float = true;
  ArchiveWriter writer = ArchiveWriter::create(setup);
  EXPECT_EQ(writer.write_output({1, 0, 0, 0, {}}, grid, fields.pieces()).float_overflows, 4);
  EXPECT_EQ(writer.write_checkpoint({1, 0, 0, 0, {}}, grid, fields.pieces()).float_overflows, 0);
  ASSERT_EQ(writer.warnings().size(), 1u);
  EXPECT_NE(writer.warnings()[0].find("4 values of step 1"), std::string::npos);
  const Archive archive = Archive::open(writer.folder());
  expect_field(
      archive.read_output(archive.select_output("first")), "press_CC", 0, 1,
      [&](IntVec3 c, int m) { return static_cast<double>(static_cast<float>(big(c, m))); });
  expect_field(archive.read_checkpoint(archive.select_checkpoint(1)), "press_CC", 0, 1, big);
}

// HDF5 keeps the second in which an object was made unless told not to.
TEST(ArchiveRoundTrip, EqualDataMakeEqualFilesAtAnyTime) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({6, 5, 1}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], vector_label("vel_CC"), 0, wavy);
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  for (FieldPiece& p : fields.pieces()) p.gzip = p.label.name() == "press_CC";
  std::string files[2];
  for (std::string& file : files) {
    if (!files[0].empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.write_output({1, 0, 0, 0, {}}, grid, fields.pieces());
    file = read_text(writer.folder() / "t00001" / "p00000.h5");
  }
  EXPECT_EQ(files[0], files[1]);
}

// A column along y whose x direction does not exist: rows run along y in memory.
TEST(ArchiveRoundTrip, InactiveDirectionsOfStrideZero) {
  const TemporaryFolder folder;
  Grid grid = make_grid({1, 50, 1}, {1, 1, 1});
  std::vector<double> memory(54);
  FieldPiece piece;
  piece.label = real_label("press_CC");
  piece.cells = grid.levels[0].domain;
  piece.view.data = memory.data();
  piece.view.box = piece.cells.grown(1, 2, 2);
  piece.view.stride[0] = 0;
  piece.view.stride[1] = 1;
  for (std::size_t n = 0; n < memory.size(); ++n) memory[n] = std::sqrt(static_cast<double>(n));
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({1, 0, 0, 0, {}}, grid, std::span(&piece, 1));
  const Archive archive = Archive::open(writer.folder());
  expect_field(archive.read_output(archive.outputs()[0]), "press_CC", 0, 1,
               [](IntVec3 c, int) { return std::sqrt(c.y + 2.0); });
}

// Several ranks as threads: each writes the boxes it owns into one archive.
TEST(ArchiveRoundTrip, SeveralRanksShareOneArchive) {
  constexpr int ranks = 3;
  const TemporaryFolder folder;
  Grid grid = make_grid({20, 6, 1}, {5, 2, 1});
  assign_owners(grid.levels[0].boxes, ranks);
  const Label label = vector_label("vel_CC");
  std::barrier meet(ranks);
  std::vector<std::string> texts(ranks);
  auto run = [&](int rank) {
    WriterRanks shared{rank, ranks, [&, rank](const std::string& text) {
                         texts[rank] = text;
                         meet.arrive_and_wait();
                         const std::vector<std::string> all = texts;
                         meet.arrive_and_wait();
                         return all;
                       }};
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()), shared);
    Level mine = grid.levels[0];
    std::erase_if(mine.boxes, [&](const GridBox& b) { return b.owner != rank; });
    Fields fields;
    fields.add(mine, label, 0, wavy);
    for (int step = 1; step <= 3; ++step) {
      writer.write_output({step, 0.5 * step, 0.5, 0.5, {}}, grid, fields.pieces());
      writer.write_checkpoint({step, 0.5 * step, 0.5, 0.5, {}}, grid, fields.pieces());
      writer.history("TotalMass", -1, step, 0.5 * step, 1.0);
    }
    writer.finish();
  };
  // HDF5 keeps one state a process: the ranks take turns inside it by the library's own lock only
  // where it has one, so that this test needs the thread-safe build or one rank after the other.
  hbool_t safe = false;
  H5is_library_threadsafe(&safe);
  if (!safe) GTEST_SKIP() << "HDF5 is not thread-safe here";
  std::vector<std::thread> threads;
  for (int r = 0; r < ranks; ++r) threads.emplace_back(run, r);
  for (std::thread& t : threads) t.join();
  const Archive archive = Archive::open(folder.path() / "box.uda");
  ASSERT_EQ(archive.outputs().size(), 3u);
  EXPECT_EQ(archive.checkpoints().size(), 2u);
  EXPECT_FALSE(fs::exists(folder.path() / "box.uda.001"));
  expect_field(archive.read_output(archive.outputs()[2]), "vel_CC", 0, 3, wavy);
}

}  // namespace
}  // namespace sluice::archive_round_trip_test

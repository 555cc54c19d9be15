// What fields.xmf names in the files of an archive is the archive's numbers, read by h5py; by
// ParaView in full.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/xdmf/xdmf_link.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::xdmf_link_test {
namespace {

using namespace archive_test;

enum class With { h5py, paraview };

// Runs tools/verify_link.py: 0 equal, 1 not, 77 its packages are missing.
int verify_link(const fs::path& archive, With reader) {
  const std::string command =
      std::string("/usr/bin/python3 -B " SLUICE_SOURCE_DIR "/tools/verify_link.py ") +
      archive.string() + (reader == With::paraview ? " --paraview" : "");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void expect_right_numbers(const fs::path& archive, With reader) {
  EXPECT_EQ(write_xdmf_link(Archive::open(archive)).filename(), "fields.xmf");
  const int status = verify_link(archive, reader);
  if (status == 77) GTEST_SKIP() << "h5py or paraview is not installed";
  EXPECT_EQ(status, 0);
}

ArchiveSetup setup_with_names(const fs::path& folder) {
  ArchiveSetup setup = setup_in(folder);
  setup.deck_xml =
      "<Uintah_specification><MaterialProperties><ICE><material name=\"air &amp; co\"/></ICE>"
      "<MPM><material name=\"steel\"/></MPM></MaterialProperties></Uintah_specification>\n";
  return setup;
}

void add_all_kinds(Fields& fields, const Level& level) {
  fields.add(level, real_label("press_CC"), 0, wavy);
  for (const int material : {0, 1})
    fields.add(level, real_label("temp_CC"), material,
               [=](IntVec3 c, int m) { return wavy(c, m + 5 * material); });
  fields.add(level, vector_label("vel_CC"), 0, wavy);
  fields.add(level, declare_label({"stress_CC", ValueType::tensor, Centring::cell, "Pa", "a test"}),
             1, wavy);
  fields.add(level, declare_label({"flag", ValueType::integer, Centring::cell, "1", "a test"}), 0,
             [](IntVec3 c, int) { return c.x - 100 * c.y; });
  // Of these a box does not hold all values at its edges.
  fields.add(level, real_label("vvel_FC", Centring::y_face), 0, wavy);
  fields.add(level, real_label("node_NC", Centring::node), 0, wavy);
}

// The boxes of another rank, as if this rank had written them.
class TwoRanks {
 public:
  TwoRanks(const fs::path& folder, std::span<const FieldPiece> of_second)
      : folder_(folder), of_second_(of_second) {}
  WriterRanks ranks() {
    return {0, 2, [this](const std::string& text) {
              for (const fs::directory_entry& e : fs::recursive_directory_iterator(folder_))
                if (e.path().extension() == ".partial" && e.is_directory() &&
                    !fs::exists(e.path() / "p00001.xml"))
                  write_field_file(e.path(), 1, of_second_, {});
              return std::vector<std::string>{text, ""};
            }};
  }

 private:
  fs::path folder_;
  std::span<const FieldPiece> of_second_;
};

void link_one_level_of_two_ranks(With reader) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({7, 5, 3}, {2, 2, 1});
  Level first = grid.levels[0], second = first;
  first.boxes.resize(1);
  second.boxes.erase(second.boxes.begin());
  Fields fields, others;
  add_all_kinds(fields, first);
  add_all_kinds(others, second);
  TwoRanks two(folder.path(), others.pieces());
  ArchiveWriter writer = ArchiveWriter::create(setup_with_names(folder.path()), two.ranks());
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), reader);
}

TEST(XdmfLink, OneLevelOfTwoRanks) {
  link_one_level_of_two_ranks(With::h5py);
}
TEST(FullXdmfLink, OneLevelOfTwoRanks) {
  link_one_level_of_two_ranks(With::paraview);
}

void link_levels_and_particles(int nz, int ny, With reader) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(nz, ny);
  Fields fields;
  for (const Level& level : grid.levels) add_all_kinds(fields, level);
  const auto f = [](double id, int c) { return std::sin(id + c); };
  fields.add_particles(0, 0, {9, 2, 0x1p53 - 1}, f);
  fields.add_particles(0, 1, {7}, f);
  fields.add_particles(1, 1, {5, 6}, f);
  fields.add_particles(1, 1, {3, 4}, f, 1);
  ArchiveWriter writer = ArchiveWriter::create(setup_with_names(folder.path()));
  for (int step = 1; step <= 2; ++step)
    writer.write_output({step, step / 3.0, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), reader);
}

TEST(XdmfLink, TwoLevelsAndParticles) {
  link_levels_and_particles(1, 6, With::h5py);
}
TEST(FullXdmfLink, TwoLevelsAndParticles) {
  for (const auto& [nz, ny] : {std::pair(1, 1), std::pair(1, 6), std::pair(3, 6)})
    link_levels_and_particles(nz, ny, With::paraview);
}

void link_compressed_floats(With reader) {
  const TemporaryFolder folder;
  const Grid grid = make_two_levels(3);
  Fields fields;
  for (const Level& level : grid.levels) add_all_kinds(fields, level);
  for (FieldPiece& piece : fields.pieces()) piece.gzip = true;
  ArchiveSetup setup = setup_with_names(folder.path());
  setup.outputs.doubles_as_float = true;
  ArchiveWriter writer = ArchiveWriter::create(setup);
  writer.write_output({1, 0.5, 0, 0, {}}, grid, fields.pieces());
  expect_right_numbers(writer.folder(), reader);
}

TEST(XdmfLink, CompressedFloats) {
  link_compressed_floats(With::h5py);
}
TEST(FullXdmfLink, CompressedFloats) {
  link_compressed_floats(With::paraview);
}

// The grid changes between outputs, and outputs of an earlier run are referred to.
TEST(XdmfLink, OutputsOfAnEarlierArchiveAndOtherGrids) {
  const TemporaryFolder folder;
  const Grid before = make_two_levels(1);
  Grid after = before;
  after.levels[1].boxes.pop_back();
  Fields of_before, of_after;
  for (const Level& level : before.levels) add_all_kinds(of_before, level);
  for (const Level& level : after.levels) add_all_kinds(of_after, level);
  ArchiveWriter first = ArchiveWriter::create(setup_in(folder.path()));
  first.write_output({1, 0.25, 0, 0, {}}, before, of_before.pieces());
  first.write_checkpoint({1, 0.25, 0, 0, {}}, before, of_before.pieces());
  first.finish();
  ArchiveWriter second = ArchiveWriter::create(setup_in(folder.path()));
  second.adopt(first.folder(), 1, Earlier::refer);
  second.write_output({2, 0.5, 0, 0, {}}, after, of_after.pieces());
  expect_right_numbers(second.folder(), With::h5py);
}

// The check itself must be able to fail: a range that begins one value late is found.
TEST(XdmfLink, TheCheckFindsAWrongRange) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({7, 5, 3}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.write_output({1, 1, 0, 0, {}}, grid, fields.pieces());
  const fs::path path = write_xdmf_link(Archive::open(writer.folder()));
  std::string text = read_text(path);
  const std::size_t place = text.find(">0 1 45<");
  ASSERT_NE(place, std::string::npos);
  text[place + 1] = '1';
  write_text(path, text);
  const int status = verify_link(writer.folder(), With::h5py);
  if (status == 77) GTEST_SKIP() << "h5py is not installed";
  EXPECT_EQ(status, 1);
}

TEST(XdmfLink, AnArchiveWithoutOutputsHasNone) {
  const TemporaryFolder folder;
  const ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  EXPECT_THROW(write_xdmf_link(Archive::open(writer.folder())), InputError);
  EXPECT_FALSE(fs::exists(writer.folder() / "fields.xmf"));
}

}  // namespace
}  // namespace sluice::xdmf_link_test

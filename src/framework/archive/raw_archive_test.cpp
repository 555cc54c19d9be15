// Archives in Uintah's raw layout, written here by the rules of the format: every value where it
// belongs, whatever the byte order, the compression and the patches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/archive/archive.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/archive/raw_archive_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::raw_archive_test {
namespace {

using raw_test::make_level;
using raw_test::Patch;
using raw_test::Variable;
using raw_test::Writer;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Exact as a float too.
double place_value(IntVec3 i, int c) {
  return i.x + 64.0 * i.y + 4096.0 * i.z + 0.25 * c;
}

void expect_places(const ArchiveStep& step, const std::string& name, int level,
                   const IndexBox& interior, const IndexBox& outer, int components) {
  const FieldInfo* f = step.find(name, 0, level);
  ASSERT_NE(f, nullptr) << name;
  EXPECT_EQ(f->components(), components);
  EXPECT_EQ(step.range(*f), interior) << name;
  EXPECT_EQ(step.range(*f, Layers::extra), outer) << name;
  for (const Layers layers : {Layers::interior, Layers::extra}) {
    const IndexBox& box = layers == Layers::extra ? outer : interior;
    const DenseField values = step.read(*f, box, layers);
    for_each_cell(box, [&](IntVec3 c) {
      ASSERT_TRUE(values.has(c)) << name << ' ' << triple_text(c);
      for (int m = 0; m < components; ++m)
        ASSERT_EQ(values.at(c, m), place_value(c, m)) << name << ' ' << triple_text(c);
    });
  }
}

struct Bytes {
  bool big_endian, gzip;
};
class RawArchiveBytes : public ::testing::TestWithParam<Bytes> {};

TEST_P(RawArchiveBytes, AllCentringsAndTypesLieWhereTheirIndicesSay) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  writer.big_endian = GetParam().big_endian;
  writer.gzip = GetParam().gzip;
  writer.add_step(7, 0.5, {make_level({{0, 0, 0}, {6, 5, 4}}, {2, 2, 1}, {1, 1, 2}, {.5, .25, 1})},
                  {{"press_CC", "CCVariable<double>", 0, place_value},
                   {"rho_CC", "CCVariable<float>", 0, place_value},
                   {"vel_CC", "CCVariable<Vector>", 0, place_value},
                   {"g.stressFS", "NCVariable<Matrix3>", 0, place_value},
                   {"uvel_FC", "SFCXVariable<double>", 0, place_value},
                   {"vvel_FC", "SFCYVariable<float>", 0, place_value},
                   {"wvel_FC", "SFCZVariable<double>", 0, place_value}});
  writer.write_index();
  const Archive archive = Archive::open(writer.folder());
  EXPECT_EQ(archive.format(), ArchiveFormat::raw);
  ASSERT_EQ(archive.outputs().size(), 1U);
  const ArchiveStep step = archive.read_output(archive.outputs()[0]);
  EXPECT_EQ(step.info().step, 7);
  EXPECT_EQ(step.info().time, 0.5);
  EXPECT_EQ(step.grid().levels[0].domain, (IndexBox{{0, 0, 0}, {6, 5, 4}}));
  EXPECT_EQ(step.grid().levels[0].boxes.size(), 4U);
  const auto boxes = [](IntVec3 more) {
    return std::pair{IndexBox{{0, 0, 0}, IntVec3{6, 5, 4} + more},
                     IndexBox{{-1, -1, -2}, IntVec3{7, 6, 6} + more}};
  };
  const auto [cells, more_cells] = boxes({});
  for (const auto& [name, n] : {std::pair{"press_CC", 1}, {"rho_CC", 1}, {"vel_CC", 3}})
    expect_places(step, name, 0, cells, more_cells, n);
  const auto [nodes, more_nodes] = boxes({1, 1, 1});
  expect_places(step, "g.stressFS", 0, nodes, more_nodes, 9);
  for (int d = 0; d < 3; ++d) {
    IntVec3 one;
    one[d] = 1;
    const auto [faces, more_faces] = boxes(one);
    expect_places(step, std::string(1, "uvw"[d]) + "vel_FC", 0, faces, more_faces, 1);
  }
  std::int64_t good = 0;
  EXPECT_THAT(step.verify(good), ElementsAre());
}

INSTANTIATE_TEST_SUITE_P(Both, RawArchiveBytes,
                         ::testing::Values(Bytes{false, false}, Bytes{false, true},
                                           Bytes{true, false}, Bytes{true, true}));

TEST(RawArchive, FinerLevelsHaveExtraCellsOverCoarserOnes) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  // The fine level is an L of two patches: the extra cells of one are inner cells of the other.
  auto fine = make_level({{4, 4, 0}, {8, 8, 1}}, {1, 1, 1}, {1, 1, 0}, {.5, .5, 1}, 1);
  auto arm = make_level({{8, 4, 0}, {12, 6, 1}}, {1, 1, 1}, {1, 1, 0}, {.5, .5, 1}, 2);
  fine.patches[0].outer.upper.x = 8;
  arm.patches[0].outer.lower.x = 8;
  fine.patches.push_back(arm.patches[0]);
  writer.add_step(1, 0.25,
                  {make_level({{0, 0, 0}, {8, 6, 1}}, {1, 1, 1}, {1, 1, 0}, {1, 1, 1}), fine},
                  {{"press_CC", "CCVariable<double>", 0, place_value},
                   {"uvel_FC", "SFCXVariable<double>", 0, place_value}});
  writer.write_index();
  const Archive archive = Archive::open(writer.folder());
  const ArchiveStep step = archive.read_output(archive.outputs()[0]);
  ASSERT_EQ(step.grid().levels.size(), 2U);
  EXPECT_EQ(step.grid().levels[1].ratio, (IntVec3{2, 2, 1}));
  EXPECT_EQ(step.grid().levels[1].domain, (IndexBox{{0, 0, 0}, {16, 12, 1}}));
  EXPECT_FALSE(step.grid().levels[0].active[2]);
  const FieldInfo& p = *step.find("press_CC", 0, 1);
  const DenseField inner = step.read(p);
  std::int64_t count = 0;
  for_each_cell(inner.cells, [&](IntVec3 c) { count += inner.has(c); });
  EXPECT_EQ(count, 4 * 4 + 4 * 2);
  const FieldInfo& u = *step.find("uvel_FC", 0, 1);
  // A patch that is followed along a part of its side only has no faces there itself.
  const DenseField faces = step.read(u);
  for (int j = 4; j < 8; ++j) EXPECT_EQ(faces.has({8, j, 0}), j < 6) << j;
  EXPECT_TRUE(faces.has({12, 5, 0}));
  EXPECT_FALSE(faces.has({12, 6, 0}));
}

TEST(RawArchive, PeriodicSidesHaveNeighbours) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  auto level = make_level({{0, 0, 0}, {6, 2, 1}}, {3, 1, 1}, {0, 1, 1}, {1, 1, 1});
  level.periodic = {1, 0, 0};
  writer.add_step(1, 0, {level}, {{"uvel_FC", "SFCXVariable<double>", 0, place_value}});
  writer.write_index();
  const Archive archive = Archive::open(writer.folder());
  expect_places(archive.read_output(archive.outputs()[0]), "uvel_FC", 0, {{0, 0, 0}, {6, 2, 1}},
                {{0, -1, -1}, {6, 3, 2}}, 1);
}

// Two ranks, whose patches alternate; particles are counted in the order of patches.
Variable particles(const char* name, const char* type,
                   std::function<double(const Patch&, int, int)> of) {
  return {name, type, 0, {}, [](const Patch& p) { return p.id; }, std::move(of)};
}
std::vector<raw_test::Level> four_patches() {
  auto level = make_level({{0, 0, 0}, {8, 1, 1}}, {4, 1, 1}, {1, 1, 1}, {1, 1, 1});
  for (Patch& p : level.patches) p.rank = p.id % 2;
  return {level};
}
double place(const Patch& p, int n, int c) {
  return p.interior.lower[c] + 0.125 * n + 0.0625;
}

TEST(RawArchive, ParticlesAreInTheOrderOfPatches) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  writer.add_step(1, 0, four_patches(),
                  {particles("p.x", "ParticleVariable<Point>", place),
                   particles("p.mass", "ParticleVariable<double>",
                             [](const Patch& p, int n, int) { return 10.0 * p.id + n; })});
  writer.write_index();
  const Archive archive = Archive::open(writer.folder());
  const ArchiveStep step = archive.read_output(archive.outputs()[0]);
  const FieldInfo& mass = *step.find_particles("p.mass", 0, 0);
  EXPECT_THAT(step.read_particles(mass)[0], ElementsAre(10, 20, 21, 30, 31, 32));
  EXPECT_THAT(step.particle_patches(mass), ElementsAre(1, 2, 2, 3, 3, 3));
  const ParticleTable table = read_particles(step, 0);
  EXPECT_FALSE(table.numbered);
  EXPECT_EQ(table.size(), 6U);
  EXPECT_EQ(table.position(4).x, 6 + 0.125 + 0.0625);
}

TEST(RawArchive, NumbersOfParticlesBeyondThoseOfADoubleStayApart) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  writer.add_step(
      1, 0, four_patches(),
      {particles("p.x", "ParticleVariable<Point>", place),
       // 40 cells up: the lowest bits are lost in a double.
       particles("p.particleID", "ParticleVariable<long64>", [](const Patch& p, int n, int) {
         return std::ldexp(40, 48) + 4096.0 * (4 - p.id) + 2048.0 * n;
       })});
  writer.write_index();
  // The last bits, which this writer of doubles cannot give.
  const fs::path file = writer.folder() / "t00001/l0/p00001.data";
  std::fstream data(file, std::ios::in | std::ios::out | std::ios::binary);
  data.seekp(3 * 1024);
  data.put(1);
  data.close();
  const Archive archive = Archive::open(writer.folder());
  const ParticleTable table = read_particles(archive.read_output(archive.outputs()[0]), 0);
  EXPECT_TRUE(table.numbered);
  ASSERT_EQ(table.size(), 6U);
  const std::int64_t base = std::int64_t{40} << 48;
  EXPECT_EQ(table.ids.front(), base + 4097);
  EXPECT_EQ(table.ids.back(), base + 3 * 4096);
}

TEST(RawArchive, AnIndexMayLeadIntoOtherArchives) {
  const TemporaryFolder folder;
  Writer first(folder / "a.uda.000"), second(folder / "b.uda.000"), master(folder / "all.uda");
  first.big_endian = true;
  const auto grid =
      std::vector{make_level({{0, 0, 0}, {4, 1, 1}}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1})};
  const std::vector<Variable> variables = {{"press_CC", "CCVariable<double>", 0, place_value}};
  first.add_step(1, 0.5, grid, variables);
  second.add_step(2, 1.5, grid, variables);
  master.head = "<restart from=\"a.uda.000\" timestep=\"1\"/>";
  master.add_reference(1, 0.5, "../a.uda.000/t00001/timestep.xml");
  master.add_reference(2, 1.5, (second.folder() / "t00002/timestep.xml").string());
  for (const Writer* w : {&first, &second, &master}) w->write_index();
  const Archive archive = Archive::open(master.folder());
  ASSERT_EQ(archive.outputs().size(), 2U);
  ASSERT_EQ(archive.index().restarts.size(), 1U);
  for (const StepEntry& e : archive.outputs())
    expect_places(archive.read_output(e), "press_CC", 0, {{0, 0, 0}, {4, 1, 1}},
                  {{-1, -1, -1}, {5, 2, 2}}, 1);
}

TEST(RawArchive, SectionsMayStandInFilesBeside) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  const auto grid =
      std::vector{make_level({{0, 0, 0}, {4, 3, 1}}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1})};
  writer.add_step(1, 0, grid, {{"press_CC", "CCVariable<double>", 0, place_value}});
  writer.write_index();
  const fs::path step = writer.folder() / "t00001";
  std::ofstream(step / "timestep.xml")
      << "<Uintah_timestep><Time><timestepNumber>1</timestepNumber><currentTime>0</currentTime>"
         "</Time></Uintah_timestep>";
  std::ofstream(step / "data.xml") << "<Data><Datafile href=\"l0/p00000.xml\"/></Data>";
  const auto check = [&] {
    const Archive archive = Archive::open(writer.folder());
    expect_places(archive.read_output(archive.outputs()[0]), "press_CC", 0, {{0, 0, 0}, {4, 3, 1}},
                  {{-1, -1, -1}, {5, 4, 2}}, 1);
  };
  std::ofstream(step / "grid.xml") << writer.grid_xml(grid);
  check();
  std::string binary;
  const auto ints = [&](IntVec3 v) {
    for (int d = 0; d < 3; ++d) writer.put(binary, v[d]);
  };
  const auto reals = [&](Vec3 v) {
    for (int d = 0; d < 3; ++d) writer.put(binary, v[d]);
  };
  writer.put(binary, std::uint32_t{0xABCDEF01});
  writer.put(binary, 1);
  writer.put(binary, 2);
  writer.put(binary, std::int64_t{12});
  ints({1, 1, 1});
  reals({0, 0, 0});
  ints({0, 0, 0});
  writer.put(binary, 0);
  reals({1, 1, 1});
  for (const Patch& p : grid[0].patches) {
    writer.put(binary, p.id);
    writer.put(binary, 0);
    for (const IntVec3 v : {p.outer.lower, p.outer.upper, p.interior.lower, p.interior.upper})
      ints(v);
    writer.put(binary, 0);
    reals({});
    reals({});
    writer.put(binary, 0);
  }
  writer.put(binary, std::uint32_t{0xABCDEF01});
  std::ofstream(step / "grid.xml", std::ios::binary) << binary;
  check();
}

TEST(RawArchive, LayersThatABlockNamesReplaceExtraCells) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  const auto grid =
      std::vector{make_level({{0, 0, 0}, {4, 3, 2}}, {1, 1, 1}, {2, 2, 2}, {1, 1, 1})};
  Variable v{"press_CC", "CCVariable<double>", 0, place_value};
  v.more = "<boundaryLayer>[2,2,2]</boundaryLayer>";
  writer.add_step(1, 0, grid, {v});
  writer.write_index();
  const fs::path timestep = writer.folder() / "t00001/timestep.xml";
  // The grid says one layer, the block two.
  auto thinner = grid;
  thinner[0].patches[0].outer = {{-1, -1, -1}, {5, 4, 3}};
  std::ofstream(writer.folder() / "t00001/grid.xml") << writer.grid_xml(thinner);
  const Archive archive = Archive::open(writer.folder());
  expect_places(archive.read_output(archive.outputs()[0]), "press_CC", 0, {{0, 0, 0}, {4, 3, 2}},
                {{-2, -2, -2}, {6, 5, 4}}, 1);
}

TEST(RawArchive, CheckpointsAndTypesThatAreNotRead) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000"), checkpoints(folder / "a.uda.000/checkpoints");
  writer.write_index();
  const auto grid =
      std::vector{make_level({{0, 0, 0}, {2, 1, 1}}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1})};
  checkpoints.head = "<outputFormat>UDA</outputFormat><ParticlePosition>p.xx</ParticlePosition>";
  checkpoints.add_step(3, 0.75, grid,
                       {{"press_CC", "CCVariable<double>", 0, place_value},
                        {"matrix", "CCVariable<Stencil7>", 0, place_value},
                        particles("p.xx", "ParticleVariable<Point>", place)});
  checkpoints.write_index();
  const fs::path step = checkpoints.folder() / "t00003";
  std::string delt;
  checkpoints.put(delt, 0.0625);
  std::ofstream(step / "global.data", std::ios::binary) << delt;
  std::ofstream(step / "global.xml")
      << "<Uintah_Output><Variable type=\"ReductionVariable&lt;double&gt;\"><variable>delT"
         "</variable><index>-1</index><patch>-1</patch><start>0</start><end>8</end><filename>"
         "global.data</filename></Variable></Uintah_Output>";
  std::ofstream(step / "data.xml")
      << "<Data><Datafile href=\"l0/p00000.xml\"/><Datafile href=\"global.xml\"/></Data>";
  const Archive archive = Archive::open(writer.folder());
  ASSERT_EQ(archive.checkpoints().size(), 1U);
  const ArchiveStep read = archive.read_checkpoint(archive.select_checkpoint());
  EXPECT_EQ(read.info().next_delt, 0.0625);
  EXPECT_NE(read.find("press_CC", 0, 0), nullptr);
  EXPECT_EQ(read.find("matrix", 0, 0), nullptr);
  EXPECT_NE(read.find_particles("p.x", 0, 0), nullptr);
  EXPECT_THROW(require_own_format(archive), InputError);
}

// The message of the first thing that is wrong.
std::string damage_of(const fs::path& folder) {
  try {
    const Archive archive = Archive::open(folder);
    std::int64_t good = 0;
    const std::vector<std::string> found = archive.read_output(archive.outputs()[0]).verify(good);
    return found.empty() ? "" : found.front();
  } catch (const DamageError& e) {
    return e.what();
  } catch (const SystemError& e) {
    return e.what();
  }
}

TEST(RawArchive, DamagedFilesAreNamed) {
  const TemporaryFolder folder;
  Writer writer(folder / "a.uda.000");
  writer.gzip = true;
  writer.add_step(1, 0, four_patches(), {{"press_CC", "CCVariable<double>", 0, place_value}});
  writer.write_index();
  ASSERT_EQ(damage_of(writer.folder()), "");
  for (const char* name :
       {"index.xml", "t00001/timestep.xml", "t00001/l0/p00000.xml", "t00001/l0/p00000.data"}) {
    const fs::path file = writer.folder() / name, kept = folder / "kept";
    fs::copy_file(file, kept, fs::copy_options::overwrite_existing);
    fs::resize_file(file, fs::file_size(file) - 20);
    EXPECT_THAT(damage_of(writer.folder()), HasSubstr(fs::canonical(file).string())) << name;
    fs::copy_file(kept, file, fs::copy_options::overwrite_existing);
    if (name == std::string("index.xml")) continue;
    fs::remove(file);
    EXPECT_THAT(damage_of(writer.folder()), HasSubstr(file.filename().string())) << name;
    fs::copy_file(kept, file);
  }
  // A bit within a compressed block; the other file reads on.
  const fs::path data = writer.folder() / "t00001/l0/p00001.data";
  std::fstream file(data, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(20);
  file.put('!');
  file.close();
  EXPECT_THAT(damage_of(writer.folder()), HasSubstr(data.filename().string()));
  const Archive archive = Archive::open(writer.folder());
  const ArchiveStep step = archive.read_output(archive.outputs()[0]);
  const FieldInfo& p = *step.find("press_CC", 0, 0);
  EXPECT_EQ(step.read(p, {{0, 0, 0}, {2, 1, 1}}).at({1, 0, 0}), 1.0);
  EXPECT_THROW(step.read(p, {{2, 0, 0}, {4, 1, 1}}), DamageError);
}

}  // namespace
}  // namespace sluice::raw_archive_test

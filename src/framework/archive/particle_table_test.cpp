// Particles written by boxes and ranks come back by their ids, and are compared by them.
#include "framework/archive/particle_table.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/extract/extract.hpp"
#include "framework/archive/xml_text.hpp"
#include "framework/base/error.hpp"

namespace sluice::particle_table_test {
namespace {

using namespace archive_test;

double place(double id, int c) {
  return std::sin(id + 10 * c);
}

class ParticleTables : public testing::Test {
 protected:
  using Boxes = std::vector<std::vector<double>>;  // ids; box n is on level n % 2

  Archive written(const std::string& name, const Boxes& boxes,
                  const std::function<double(double, int)>& f = place) const {
    const Grid grid = make_two_levels(1);
    Fields fields;
    for (std::size_t b = 0; b < boxes.size(); ++b)
      fields.add_particles(static_cast<int>(b % 2), static_cast<int>(b), boxes[b], f);
    ArchiveSetup setup = setup_in(folder_.path());
    setup.filebase = name + ".uda";
    ArchiveWriter writer = ArchiveWriter::create(setup);
    writer.write_output({1, 0.5, 0, 0, {}}, grid, fields.pieces());
    writer.finish();
    return Archive::open(writer.folder());
  }
  static ArchiveStep step(const Archive& archive) {
    return archive.read_output(archive.outputs().front());
  }
  const TemporaryFolder folder_;
};

TEST_F(ParticleTables, HoldAllBoxesAndLevelsInTheOrderOfIds) {
  const ArchiveStep read = step(written("a", {{7, 3}, {5}, {0x1p53 - 1}}));
  EXPECT_TRUE(read.fields().empty());
  EXPECT_EQ(particle_materials(read), std::vector<int>{0});
  const ParticleTable table = read_particles(read, 0);
  EXPECT_EQ(table.ids, (std::vector<std::int64_t>{3, 5, 7, (std::int64_t{1} << 53) - 1}));
  EXPECT_EQ(table.levels, (std::vector<int>{0, 1, 0, 0}));
  ASSERT_NE(table.find("p.heat"), nullptr);
  for (std::size_t n = 0; n < table.size(); ++n) {
    const auto id = static_cast<double>(table.ids[n]);
    EXPECT_EQ(table.position(n), (Vec3{place(id, 0), place(id, 1), place(id, 2)}));
    EXPECT_EQ(table.find("p.heat")->components[0][n], place(id, 3));
  }
  EXPECT_EQ(read_particles(read, 0, {{"p.x"}, {}}).columns.size(), 1U);
}

// Archives of before call positions vectors.
TEST_F(ParticleTables, CallPositionsPoints) {
  const Boxes boxes = {{7, 3}, {5}};
  const Archive now = written("now", boxes), before = written("before", boxes);
  const std::string written_now = "ParticleVariable&lt;Point&gt;\" name=\"p.x\"",
                    written_before = "ParticleVariable&lt;Vector&gt;\" name=\"p.x\"";
  for (const char* file : {"index.xml", "t00001/p00000.xml"}) {
    std::string text = read_text(before.folder() / file);
    EXPECT_EQ(text.find("Vector"), std::string::npos) << file;
    std::size_t found = 0;
    for (std::size_t at; (at = text.find(written_now)) != std::string::npos; ++found)
      text.replace(at, written_now.size(), written_before);
    EXPECT_GT(found, 0U) << file;
    text.erase(text.rfind("<!-- crc32c"));
    std::ofstream(before.folder() / file) << seal(text);
  }
  const Archive read = Archive::open(before.folder());
  EXPECT_EQ(read_particles(step(read), 0).position(0),
            (Vec3{place(3, 0), place(3, 1), place(3, 2)}));
  EXPECT_EQ(compare(now, read, {}).exit_status(), 0);
}

TEST_F(ParticleTables, NeedIdsThatADoubleHolds) {
  EXPECT_THROW(written("a", {{0.5}}), PhysicsError);
  EXPECT_THROW(written("b", {{0x1p60}}), PhysicsError);
}

TEST_F(ParticleTables, AreComparedWhateverTheBoxes) {
  const Archive a = written("a", {{7, 3}, {5}}), b = written("b", {{5}, {3}, {7}});
  const CompareResult same = compare(a, b, {});
  EXPECT_EQ(same.exit_status(), 0);
  EXPECT_EQ(same.values, 3 * 4);
  const Archive moved = written("c", {{3, 5, 7}}, [](double id, int c) {
    return place(id, c) + (id == 5 && c == 1 ? 1e-3 : 0.0);
  });
  const CompareResult differ = compare(a, moved, {});
  EXPECT_EQ(differ.exit_status(), 1);
  EXPECT_EQ(differ.differing, 1);
  EXPECT_EQ(differ.first()->particle, 5);
  EXPECT_NE(to_string(*differ.first()).find("p.x y of material 0, particle 5"), std::string::npos);
  const CompareResult lost = compare(a, written("d", {{3, 7}}), {});
  ASSERT_EQ(lost.exit_status(), 2);
  EXPECT_NE(lost.not_comparable.front().find("only the first has particle 5"), std::string::npos);
}

TEST_F(ParticleTables, AreExtractedAsRows) {
  const ArchiveStep read =
      step(written("a", {{7, 3}, {5}}, [](double id, int c) { return id + 0.25 * c; }));
  std::string text;
  ExtractOptions options;
  options.label = "p.heat";
  options.to = Vec3{6, 10, 10};
  options.from = Vec3{0, 0, 0};
  EXPECT_EQ(extract_csv(read, options, [&](std::string_view part) { text += part; }), 2);
  EXPECT_EQ(text,
            "time,level,material,id,x,y,z,value\n"
            "0.5,0,0,3,3,3.25,3.5,3.75\n"
            "0.5,1,0,5,5,5.25,5.5,5.75\n");
}

}  // namespace
}  // namespace sluice::particle_table_test

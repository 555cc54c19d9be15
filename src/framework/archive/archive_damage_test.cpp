// Damaged archives: every flipped bit is named, nothing damaged is returned, the rest reads on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice::archive_damage_test {
namespace {

using namespace archive_test;
using ::testing::HasSubstr;

struct Written {
  TemporaryFolder folder;
  fs::path archive;
  Grid grid = make_grid({6, 5, 4}, {2, 1, 1});

  Written() {
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
    fields.add(grid.levels[0], real_label("temp_CC"), 0, wavy);
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    for (int step = 1; step <= 2; ++step) {
      writer.write_output({step, 0.5 * step, 0.5, 0.5, {{"a", "b"}}}, grid, fields.pieces());
      writer.write_checkpoint({step, 0.5 * step, 0.5, 0.5, {}}, grid, fields.pieces());
    }
    archive = writer.folder();
  }
  fs::path step(int n) const { return archive / step_folder_name(n); }
  std::vector<std::string> verify(int n) const {
    const Archive a = Archive::open(archive);
    std::int64_t good = 0;
    return a.read_output(a.outputs().at(n - 1)).verify(good);
  }
};

TEST(ArchiveDamage, EveryFlippedBitOfTheDataFileIsNamed) {
  const Written w;
  const fs::path file = w.step(1) / "p00000.h5";
  const auto size = static_cast<std::int64_t>(fs::file_size(file));
  for (std::int64_t byte = 0; byte < size; byte += 7) {
    flip_bit(file, byte, static_cast<int>(byte % 8));
    const std::vector<std::string> found = w.verify(1);
    ASSERT_FALSE(found.empty()) << "byte " << byte;
    EXPECT_THAT(found[0], HasSubstr(file.string()));
    flip_bit(file, byte, static_cast<int>(byte % 8));
  }
  EXPECT_TRUE(w.verify(1).empty());
}

TEST(ArchiveDamage, EveryFlippedBitOfTheXmlFilesIsNamed) {
  const Written w;
  for (const fs::path& file :
       {w.step(1) / "timestep.xml", w.step(1) / "p00000.xml", w.archive / "index.xml"}) {
    const auto size = static_cast<std::int64_t>(fs::file_size(file));
    for (std::int64_t byte = 0; byte < size; byte += 5) {
      flip_bit(file, byte, static_cast<int>(byte % 8));
      std::string message;
      try {
        for (const std::string& m : w.verify(1)) message += m;
      } catch (const DamageError& e) {
        message = e.what();
      }
      EXPECT_THAT(message, HasSubstr(file.string())) << "byte " << byte;
      flip_bit(file, byte, static_cast<int>(byte % 8));
    }
  }
  EXPECT_TRUE(w.verify(1).empty());
}

TEST(ArchiveDamage, TheRestReadsOn) {
  const Written w;
  const Archive before = Archive::open(w.archive);
  // Damage one value of one label in step 1: the label's other box and the other label are good.
  const fs::path file = w.step(1) / "p00000.h5";
  const DataFileRecord record = parse_data_file(read_sealed(w.step(1) / "p00000.xml"), "record");
  ASSERT_EQ(record.variables[0].name, "press_CC");
  flip_bit(file, record.variables[0].offset);
  const ArchiveStep step = before.read_output(before.outputs()[0]);
  const FieldInfo& press = *step.find("press_CC", 0, 0);
  EXPECT_THROW(step.read(press), DamageError);
  EXPECT_THROW(step.read(press, {{0, 0, 0}, {1, 1, 1}}), DamageError);
  EXPECT_EQ(step.read(press, {{3, 0, 0}, {6, 5, 4}}).at({3, 1, 1}), wavy({3, 1, 1}, 0));
  EXPECT_EQ(step.read(*step.find("temp_CC", 0, 0)).at({0, 0, 0}), wavy({0, 0, 0}, 0));
  EXPECT_TRUE(w.verify(2).empty());
}

TEST(ArchiveDamage, CutFilesAndMissingFiles) {
  const Written w;
  const fs::path file = w.step(1) / "p00000.h5";
  fs::resize_file(file, fs::file_size(file) - 100);
  EXPECT_THAT(w.verify(1).at(0), HasSubstr("bytes long"));
  {
    const Archive a = Archive::open(w.archive);
    const ArchiveStep step = a.read_output(a.outputs()[0]);
    EXPECT_EQ(step.damage().size(), 1u);
    EXPECT_TRUE(step.fields().empty());
  }
  fs::remove(file);
  EXPECT_THAT(w.verify(1).at(0), HasSubstr("p00000.h5"));
  EXPECT_TRUE(w.verify(2).empty());
  fs::resize_file(w.step(1) / "timestep.xml", 0);
  EXPECT_THROW(w.verify(1), DamageError);
  fs::remove(w.step(1) / "timestep.xml");
  EXPECT_THROW(w.verify(1), SystemError);
  // A checkpoint index that is damaged leaves the outputs readable.
  flip_bit(w.archive / "checkpoints" / "index.xml", 40);
  const Archive a = Archive::open(w.archive);
  EXPECT_EQ(a.damage().size(), 1u);
  EXPECT_THROW(a.select_checkpoint(), DamageError);
  EXPECT_TRUE(w.verify(2).empty());
}

TEST(ArchiveDamage, WhatIsNoArchiveIsSaid) {
  const TemporaryFolder folder;
  EXPECT_THROW(Archive::open(folder.path() / "absent"), InputError);
  EXPECT_THROW(Archive::open(folder.path()), InputError);
  fs::create_directory(folder.path() / "other");
  write_sealed(folder.path() / "other" / "index.xml", XmlElement("Uintah_DataArchive"));
  try {
    Archive::open(folder.path() / "other");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("format is not given"));
  }
}

TEST(ArchiveDamage, LeftoversOfKilledRunsAreIgnored) {
  const Written w;
  fs::create_directory(w.archive / "t00003.partial");
  std::ofstream(w.archive / "t00003.partial" / "p00000.h5") << "half";
  std::ofstream(w.archive / "index.xml.999.partial") << "<Uintah_Data";
  fs::create_directory(w.archive / "t00004");  // renamed but not yet in the index
  const Archive a = Archive::open(w.archive);
  EXPECT_EQ(a.outputs().size(), 2u);
  EXPECT_TRUE(w.verify(2).empty());
}

TEST(ArchiveDamage, ChoosingAnOutputByTime) {
  const Written w;
  const Archive a = Archive::open(w.archive);
  EXPECT_EQ(a.select_output("last").step, 2);
  EXPECT_EQ(a.select_output("first").step, 1);
  EXPECT_EQ(a.select_output("#1").step, 2);
  EXPECT_EQ(a.select_output("0.74").step, 1);
  EXPECT_EQ(a.select_output("0.76").step, 2);
  EXPECT_EQ(a.select_output("1.25").step, 2);
  EXPECT_EQ(a.select_output("0.25").step, 1);
  for (const char* bad : {"1.26", "0.24", "#2", "#-1", "#x", "later", "nan", "inf", ""})
    EXPECT_THROW(a.select_output(bad), InputError) << bad;
}

}  // namespace
}  // namespace sluice::archive_damage_test

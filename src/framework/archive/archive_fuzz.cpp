// libFuzzer: no bytes in an archive's files may crash its reader; only Error may come out.
//
// The first byte chooses the file that the rest replaces in a small good archive: index.xml,
// timestep.xml, p00000.xml (these get a fitting seal, so that the parser behind it is reached), the
// data file, or a history. HDF5 itself is shielded: its file is opened only when its checksum fits.
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/history_file.hpp"
#include "framework/archive/posix_file.hpp"

namespace {

using namespace sluice;
using namespace sluice::archive_test;

struct GoodArchive {
  TemporaryFolder folder;
  fs::path path;
  GoodArchive() {
    const Grid grid = make_two_levels(1);
    Fields fields;
    for (const Level& level : grid.levels) fields.add(level, vector_label("vel_CC"), 0, wavy);
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.history("TotalMass", -1, 1, 0.5, 1.0);
    writer.write_output({1, 0.5, 0.5, 0.5, {{"a", "b"}}}, grid, fields.pieces());
    writer.finish();
    path = writer.folder();
  }
};

void write_raw(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

void read_everything(const fs::path& path) {
  const Archive archive = Archive::open(path);
  for (const StepEntry& entry : archive.outputs()) {
    const ArchiveStep step = archive.read_output(entry);
    std::int64_t good = 0;
    step.verify(good);
    for (const FieldInfo& f : step.fields())
      if (step.range(f).volume() < 1 << 20) step.read(f);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const GoodArchive good;
  if (size < 1) return 0;
  const fs::path files[] = {"index.xml", "t00001/timestep.xml", "t00001/p00000.xml",
                            "t00001/p00000.h5", "TotalMass.dat"};
  const std::size_t which = data[0] % 5;
  const fs::path file = good.path / files[which];
  const std::string before = read_text(file);
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  write_raw(file, which < 3 ? seal(bytes) : bytes);
  try {
    if (which == 4) cut_history(file, {1, 0, data[0] % 2 == 0, true}, 5, 0.5);
    read_everything(good.path);
  } catch (const Error&) {
    // A message to the user: what must come of bad bytes.
  }
  write_raw(file, before);
  return 0;
}

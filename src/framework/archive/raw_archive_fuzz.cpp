// libFuzzer: no bytes in the files of a raw archive may crash its reader; only Error may come out.
//
// The first byte chooses a small good archive (either byte order, gzip or not), one of its files
// (index.xml, timestep.xml, grid.xml, which may be binary, p00000.xml or p00000.data), and whether
// the rest replaces this file or changes single bytes of it: three bytes each, place and value.
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "framework/archive/archive.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/raw_archive_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace {

using namespace sluice;
namespace fs = std::filesystem;

double of_index(IntVec3 i, int c) {
  return i.x + 10.0 * i.y + 100.0 * i.z + 0.5 * c;
}

struct GoodArchive {
  TemporaryFolder folder;
  fs::path path;

  GoodArchive(bool big_endian, bool gzip) {
    raw_test::Writer writer(folder.path() / "a.uda.000");
    writer.big_endian = big_endian;
    writer.gzip = gzip;
    const auto count = [](const raw_test::Patch& p) { return 1 + p.id; };
    const auto of = [](const raw_test::Patch& p, int n, int c) { return p.id + 0.1 * n + c; };
    writer.add_step(
        1, 0.5,
        {raw_test::make_level({{0, 0, 0}, {4, 2, 1}}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1}),
         raw_test::make_level({{2, 0, 0}, {6, 4, 2}}, {1, 1, 1}, {1, 1, 1}, {0.5, 0.5, 0.5}, 2)},
        {{"press_CC", "CCVariable<double>", 0, of_index},
         {"uvel_FC", "SFCXVariable<float>", 0, of_index},
         {"p.x", "ParticleVariable<Point>", 0, {}, count, of},
         {"p.particleID", "ParticleVariable<long64>", 0, {}, count, of}});
    writer.write_index();
    path = writer.folder();
  }
};

void replace(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// Bytes at places of the text; a place behind its end adds one.
std::string changed(std::string text, const std::uint8_t* edits, std::size_t size) {
  for (std::size_t n = 0; n + 3 <= size; n += 3) {
    const std::size_t place = edits[n] * std::size_t{256} + edits[n + 1];
    const char value = static_cast<char>(edits[n + 2]);
    if (place < text.size())
      text[place] = value;
    else
      text.push_back(value);
  }
  return text;
}

void read_everything(const fs::path& path) {
  const Archive archive = Archive::open(path);
  for (const StepEntry& entry : archive.outputs()) {
    // What an index names lies in the archive: nothing else is opened here.
    if (entry.href.is_absolute() || entry.href.string().find("..") != std::string::npos) continue;
    const ArchiveStep step = archive.read_output(entry);
    std::int64_t good = 0;
    step.verify(good);
    for (const FieldInfo& f : step.fields())
      for (const Layers layers : {Layers::interior, Layers::extra})
        if (const IndexBox all = step.range(f, layers); all.volume() < 1 << 20)
          step.read(f, all, layers);
    for (const int material : particle_materials(step)) read_particles(step, material);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const GoodArchive archives[] = {
      {false, false}, {false, true}, {true, false}, {true, true}};
  if (size < 1) return 0;
  const GoodArchive& good = archives[data[0] / 64];
  const char* const files[] = {"index.xml", "t00001/timestep.xml", "t00001/grid.xml",
                               "t00001/l0/p00000.xml", "t00001/l0/p00000.data"};
  const fs::path file = good.path / files[data[0] % 5];
  const bool is_there = fs::exists(file);
  const std::string before = is_there ? read_text(file) : std::string();
  const bool whole = data[0] / 32 % 2 == 0;
  replace(file, whole ? std::string(reinterpret_cast<const char*>(data + 1), size - 1)
                      : changed(before, data + 1, size - 1));
  try {
    read_everything(good.path);
  } catch (const Error&) {
    // A message to the user: what must come of bad bytes.
  }
  if (is_there)
    replace(file, before);
  else
    fs::remove(file);
  return 0;
}

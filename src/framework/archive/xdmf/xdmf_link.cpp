// Two passes over the outputs: their grids, for the marks, then their text, output after output.
#include "framework/archive/xdmf/xdmf_link.hpp"

#include <fmt/format.h>

#include <optional>

#include "framework/archive/drawing/replacing_file.hpp"
#include "framework/archive/drawing/xml_part.hpp"
#include "framework/archive/xdmf/xdmf_step.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

constexpr const char* opening =
    "<?xml version=\"1.0\"?>\n"
    "<Xdmf Version=\"2.0\"><Domain>"
    "<Grid Name=\"outputs\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* closing = "</Grid></Domain></Xdmf>\n";

StepRecord read_record(const Archive& archive, const StepEntry& entry) {
  require_referenced_archive(entry, archive.folder());
  const fs::path path = archive.folder() / entry.href;
  return parse_step(read_sealed(path), path.string());
}

}  // namespace

fs::path write_xdmf_link(const Archive& archive) {
  if (archive.format() == ArchiveFormat::raw)
    throw InputError(archive.folder().string() +
                     " is an archive in Uintah's raw layout, into which no other program can look; "
                     "export it without --link");
  if (archive.outputs().empty()) throw InputError(archive.folder().string() + " has no output yet");
  const fs::path path = archive.folder() / "fields.xmf";
  const ArrayNames names(archive);
  XdmfContext context{&names, "fields_covered.h5"};
  std::optional<CoveredFile> file;
  std::vector<CoveredBoxes> covered(archive.outputs().size());
  for (std::size_t n = 0; n < covered.size(); ++n) {
    const Grid grid = read_record(archive, archive.outputs()[n]).grid;
    if (grid.levels.size() < 2) continue;
    if (!file) file.emplace(archive.folder() / context.covered_file);
    covered[n] = file->add(grid);
    context.covered_total = file->total();
  }
  ReplacingFile text(path);
  text.append(opening);
  for (std::size_t n = 0; n < covered.size(); ++n) {
    const StepEntry& entry = archive.outputs()[n];
    const StepRecord record = read_record(archive, entry);
    const fs::path folder = entry.href.parent_path();
    text.append(to_part(xdmf_step(context, record, covered[n], folder, archive.folder() / folder)));
    text.append("\n");
  }
  text.append(closing);
  if (file) file->finish();
  flush_file_system(archive.folder());
  text.finish();
  return path;
}

}  // namespace sluice

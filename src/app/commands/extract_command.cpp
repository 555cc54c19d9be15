// sluice extract UDA --var V --csv FILE|-: values of a label as CSV.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/csv_extract.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

struct ExtractRequest {
  std::string archive, label, csv = "-", time = "last", level = "all", from, to;
  std::optional<int> material;
  bool checkpoint = false;
};

Vec3 parse_point(const std::string& text, const char* option) {
  const std::vector<std::string> parts = split_names(text);
  if (parts.size() != 3)
    throw InputError(fmt::format("{} {}: expected three numbers x,y,z", option, text));
  return {parse_real(parts[0], option), parse_real(parts[1], option), parse_real(parts[2], option)};
}

int parse_level(const std::string& text) {
  if (text == "all") return -1;
  const int level = parse_int(text, "--level");
  if (level < 0) throw InputError("--level " + text + ": expected all, 0, 1, ...");
  return level;
}

ExtractOptions options_of(const ExtractRequest& r) {
  ExtractOptions options;
  options.label = r.label;
  options.material = r.material;
  options.level = parse_level(r.level);
  if (!r.from.empty()) options.from = parse_point(r.from, "--from");
  if (!r.to.empty()) options.to = parse_point(r.to, "--to");
  for (int d = 0; options.from && options.to && d < 3; ++d)
    if (!((*options.from)[d] <= (*options.to)[d]))
      throw InputError(
          fmt::format("--from {} --to {}: the box is empty: every number of --from must "
                      "be at most that of --to",
                      r.from, r.to));
  return options;
}

void extract(const ExtractRequest& r) {
  const ExtractOptions options = options_of(r);
  const Archive archive = Archive::open(r.archive);
  const ArchiveStep step =
      archive.read(r.checkpoint ? Stored::checkpoints : Stored::outputs, r.time);
  // Opened with the first row: a box without a point leaves an earlier file as it is.
  std::optional<TextSink> sink;
  extract_csv(step, options, [&](std::string_view text) {
    if (!sink) sink.emplace(r.csv);
    sink->write(text);
  });
  sink->close();
}

}  // namespace

void declare_extract_command(Command& command) {
  auto r = std::make_shared<ExtractRequest>();
  command.option("UDA", r->archive, "The archive").required();
  command.option("--var", r->label, "Label, e.g. press_CC").required();
  command.option("--material", r->material, "Material; absent: all that the label has");
  command.option("--time", r->time, "last, first, a time (nearest output), #N: N-th output");
  command.flag("--checkpoint", r->checkpoint,
               "Of a checkpoint (the state of the run), not of an output; --time selects it");
  command.option("--level", r->level, "A level, or all: every point once, from the finest");
  CommandOption from = command.option("--from", r->from, "Low corner x,y,z of a closed box");
  CommandOption to = command.option("--to", r->to, "High corner x,y,z of a closed box");
  from.together_with(to);
  command.option("--csv", r->csv, "File to write, - for standard output");
  command.action([r] {
    extract(*r);
    return 0;
  });
}

}  // namespace sluice

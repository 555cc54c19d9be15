// sluice extract UDA --var V --csv FILE|-: values of a label as CSV; --history NAME: lines of a
// history or of a sample of <DataAnalysis>.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/csv_extract.hpp"
#include "framework/archive/samples.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

struct ExtractRequest {
  std::string archive, label, history, csv = "-", time, level = "all", from, to;
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

std::string csv_row(const std::vector<std::string>& words) {
  return fmt::format("{}\n", fmt::join(words, ","));
}

Sample find_sample(const Archive& archive, const std::string& name) {
  std::vector<std::string> names;
  for (Sample& sample : find_samples(archive)) {
    if (sample.name == name) return std::move(sample);
    names.push_back(sample.name);
  }
  throw InputError(fmt::format("no history or sample '{}' in {} ({}; sluice info lists them)", name,
                               archive.folder().string(), suggest_name(name, names)));
}

void extract_history(const ExtractRequest& r) {
  const Archive archive = Archive::open(r.archive);
  const Sample sample = find_sample(archive, r.history);
  std::optional<double> time;
  if (!r.time.empty()) time = parse_real(r.time, "--time");
  const SampleTable table = read_sample(sample, time);
  TextSink sink(r.csv);
  sink.write(csv_row(table.columns));
  for (const std::vector<std::string>& row : table.rows) sink.write(csv_row(row));
  sink.close();
}

void extract(const ExtractRequest& r) {
  if (r.label.empty() == r.history.empty())
    throw InputError("extract needs either --var or --history");
  if (!r.history.empty()) {
    extract_history(r);
    return;
  }
  const ExtractOptions options = options_of(r);
  const Archive archive = Archive::open(r.archive);
  const ArchiveStep step = archive.read(r.checkpoint ? Stored::checkpoints : Stored::outputs,
                                        r.time.empty() ? "last" : r.time);
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
  command.option("--var", r->label, "Label, e.g. press_CC");
  command.option("--history", r->history,
                 "Instead of --var: a history, a sample of <DataAnalysis>, levels or effects, by "
                 "its name in sluice info; --time: only the sampled time nearest to it");
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

// sluice extract UDA --var V: values of a label as CSV or JSON, of a box, at points, along a line,
// of particles, over outputs; --history NAME: lines of a history or of a sample of <DataAnalysis>.
#include <fmt/format.h>

#include <cmath>
#include <list>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/extract/extract.hpp"
#include "framework/archive/samples.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

struct ExtractRequest {
  std::string archive, label, history, csv, json, time, level = "all", from, to, line, particles;
  std::vector<std::string> at;
  std::optional<int> material;
  bool checkpoint = false, linear = false, follow = false;
};

Vec3 parse_point(const std::string& text, const char* option) {
  const std::vector<std::string> parts = split_names(text);
  if (parts.size() != 3)
    throw InputError(fmt::format("{} {}: expected three numbers x,y,z", option, text));
  Vec3 p;
  for (int d = 0; d < 3; ++d) {
    p[d] = parse_real(parts[d], option);
    if (!std::isfinite(p[d]))
      throw InputError(fmt::format("{} {}: expected three finite numbers x,y,z", option, text));
  }
  return p;
}

int parse_level(const std::string& text) {
  if (text == "all") return -1;
  const int level = parse_int(text, "--level");
  if (level < 0) throw InputError("--level " + text + ": expected all, 0, 1, ...");
  return level;
}

// "x,y,z:x,y,z" or "x,y,z:x,y,z:n"
ExtractLine parse_line(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() != 2 && parts.size() != 3)
    throw InputError(fmt::format(
        "--line {}: expected two points and perhaps a number of points, x,y,z:x,y,z:n", text));
  ExtractLine line{parse_point(parts[0], "--line"), parse_point(parts[1], "--line")};
  if (line.first == line.last)
    throw InputError(fmt::format("--line {}: both points are the same", text));
  if (parts.size() == 3) {
    line.points = parse_int(parts[2], "--line");
    constexpr int most = 10'000'000;
    if (line.points < 2 || line.points > most)
      throw InputError(
          fmt::format("--line {}: expected 2 to {} points, its ends with them", text, most));
  }
  return line;
}

// Of --at, --line, --from with --to only one.
void refuse_two_places(const ExtractRequest& r) {
  const int ways = (r.at.empty() ? 0 : 1) + (r.line.empty() ? 0 : 1) + (r.from.empty() ? 0 : 1);
  if (ways > 1)
    throw InputError("--at, --line and a box (--from, --to) choose places: give one of them");
  if (r.linear && r.at.empty() && r.line.empty())
    throw InputError("--linear is for values at points (--at) or along a line (--line)");
  if (r.follow && r.from.empty())
    throw InputError("--follow needs the box (--from, --to) in which particles are at first");
}

ExtractOptions options_of(const ExtractRequest& r) {
  refuse_two_places(r);
  ExtractOptions options;
  options.label = r.label;
  options.material = r.material;
  options.level = parse_level(r.level);
  options.linear = r.linear;
  options.follow = r.follow;
  for (const std::string& text : r.at) options.at.push_back(parse_point(text, "--at"));
  if (!r.line.empty()) options.line = parse_line(r.line);
  for (const std::string& id : split_names(r.particles))
    options.particles.push_back(parse_integer(id, "--particle"));
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

SampleTable table_of(const Sample& sample, const std::string& time) {
  const bool range = time.find(':') != std::string::npos;
  if (time.empty() || time == "all" || range) {
    SampleTable table = read_sample(sample);
    if (range) keep_lines(table, sample, parse_time_range(time));
    return table;
  }
  return read_sample(sample, parse_real(time, "--time"));
}

Json json_of(const Sample& sample, const SampleTable& table) {
  Json rows = Json::array();
  for (const std::vector<std::string>& row : table.rows) {
    Json numbers = Json::array();
    for (const std::string& word : row) {
      const Json number = Json::parse_or_null(word);
      numbers.push_back(number.is_number() ? number : Json(word));
    }
    rows.push_back(numbers);
  }
  return {
      {"label", sample.name}, {"unit", sample.unit}, {"columns", table.columns}, {"rows", rows}};
}

void extract_history(const ExtractRequest& r) {
  const Archive archive = Archive::open(r.archive);
  const Sample sample = find_sample(archive, r.history);
  const SampleTable table = table_of(sample, r.time);
  if (!r.csv.empty() || r.json.empty()) {
    TextSink sink(r.csv.empty() ? "-" : r.csv);
    sink.write(csv_row(table.columns));
    for (const std::vector<std::string>& row : table.rows) sink.write(csv_row(row));
    sink.close();
  }
  if (r.json.empty()) return;
  write_text(r.json, json_of(sample, table).dump() + "\n");
}

// Files that are opened with the first row: a box without a point leaves an earlier one as it is.
class RowFiles {
 public:
  void add(ValueRows& rows, TextForm form, const std::string& target) {
    std::optional<TextSink>& sink = sinks_.emplace_back();
    rows.to(form, [&sink, target](std::string_view text) {
      if (!sink) sink.emplace(target);
      sink->write(text);
    });
  }
  void close() {
    for (std::optional<TextSink>& sink : sinks_) sink->close();
  }

 private:
  std::list<std::optional<TextSink>> sinks_;
};

void extract(const ExtractRequest& r) {
  if (r.label.empty() == r.history.empty())
    throw InputError("extract needs either --var or --history");
  if (r.csv == "-" && r.json == "-")
    throw InputError("--csv - and --json - cannot both go to standard output");
  if (!r.history.empty()) {
    extract_history(r);
    return;
  }
  const ExtractOptions options = options_of(r);
  const Archive archive = Archive::open(r.archive);
  const Stored kind = r.checkpoint ? Stored::checkpoints : Stored::outputs;
  ValueRows rows;
  RowFiles files;
  if (!r.csv.empty() || r.json.empty()) files.add(rows, TextForm::csv, r.csv.empty() ? "-" : r.csv);
  if (!r.json.empty()) files.add(rows, TextForm::json, r.json);
  Extraction extraction(options, rows);
  for (const StepEntry& entry : select_steps(archive, kind, r.time.empty() ? "last" : r.time))
    extraction.add(archive.read(kind, entry));
  extraction.finish();
  files.close();
}

}  // namespace

void declare_extract_command(Command& command) {
  auto r = std::make_shared<ExtractRequest>();
  command.option("UDA", r->archive, "The archive").required();
  command.option("--var", r->label,
                 "Label, e.g. press_CC, or a part of one: vel_CC.x, vel_CC.size, p.stress.xy, "
                 "p.stress.vonMises, .pressure, .det");
  command.option(
      "--history", r->history,
      "Instead of --var: a history, a sample of <DataAnalysis>, levels or effects, by "
      "its name in sluice info; --time: only the sampled time nearest to it, or a range");
  command.option("--material", r->material, "Material; absent: all that the label has");
  command.option("--time", r->time,
                 "last (without the option), first, a time (nearest output), #N: N-th output; "
                 "several: all, or A:B, where A and B are such as well and may be missing");
  command.flag("--checkpoint", r->checkpoint,
               "Of a checkpoint (the state of the run), not of an output; --time selects it");
  command.option("--level", r->level, "A level, or all: every point once, from the finest");
  CommandOption from = command.option("--from", r->from, "Low corner x,y,z of a closed box");
  CommandOption to = command.option("--to", r->to, "High corner x,y,z of a closed box");
  from.together_with(to);
  command
      .option("--at", r->at,
              "A point x,y,z: the value of the finest cell there (repeat for several points)")
      .repeatable();
  command.option("--line", r->line,
                 "A line x,y,z:x,y,z at any slant: one value per cell; with :n behind it at n even "
                 "points, both ends with them");
  command.flag("--linear", r->linear,
               "With --at and --line: linear between the centres of cells (of levels, too)");
  command.option("--particle", r->particles, "Of particles: only these numbers a,b,c");
  command.flag("--follow", r->follow,
               "Of particles: those that the box holds at the first time, wherever they go");
  command.option("--csv", r->csv,
                 "File to write, - for standard output (without --csv and --json, too)");
  command.option("--json", r->json, "Write JSON to a file, - for standard output");
  command.action([r] {
    extract(*r);
    return 0;
  });
}

}  // namespace sluice

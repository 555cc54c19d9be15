#include "framework/archive/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// t00012: the folder of an output, or of a snapshot.
bool is_step_folder(const std::string& part) {
  return part.size() > 5 && part[0] == 't' &&
         std::all_of(part.begin() + 1, part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// i1_j2_k3: a cell of a line.
bool is_cell_file(const std::string& part) {
  int i = 0, j = 0, k = 0, end = 0;
  return std::sscanf(part.c_str(), "i%d_j%d_k%d%n", &i, &j, &k, &end) == 3 &&
         end == static_cast<int>(part.size());
}

std::string kind_of_file(const Words& parts) {
  static const std::map<std::string, std::string> heads = {{"MinMax", "extremes"},
                                                           {"points", "probe"},
                                                           {"particleExtract", "particle"},
                                                           {"planeAverage", "average"},
                                                           {"planarAveTurbFluxes", "average"}};
  if (const auto found = heads.find(parts.front()); found != heads.end()) return found->second;
  if (std::any_of(parts.begin(), parts.end(), is_step_folder)) return "plane";
  return is_cell_file(parts.back()) ? "line" : "budget";
}

// Without what differs between the files of one sample.
std::string name_of_sample(const std::string& kind, Words parts) {
  if (fs::path(parts.back()).extension() == ".dat") parts.back() = fs::path(parts.back()).stem();
  if (kind == "line") parts.pop_back();
  std::erase_if(parts, is_step_folder);
  return fmt::format("{}", fmt::join(parts, "/"));
}

bool begins_with_hash(const fs::path& path) {
  std::ifstream file(path);
  return file.get() == '#';
}

// Paths of all files that begin with '#' below the archive, outputs and checkpoints left out.
std::vector<fs::path> text_files(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder, error);
       entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (entry.depth() == 0 && entry->is_directory(error) &&
        (is_step_folder(name) || name == "checkpoints" || name == "input_files")) {
      entry.disable_recursion_pending();
      continue;
    }
    if (entry->is_regular_file(error) && name != "levels.txt" && begins_with_hash(entry->path()))
      found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

Words words_of(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream text(line);
  Words words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

double number_in(const std::string& word, const fs::path& path) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0')
    throw InputError(
        fmt::format("{}: '{}' is not a number; expected a table of numbers", path.string(), word));
  return x;
}

struct TextTableFile {
  std::vector<std::string> header;  // lines that begin with #
  std::vector<Words> rows;
};

TextTableFile read_text_table(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ": cannot be read");
  TextTableFile table;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] == '#') {
      table.header.push_back(line.substr(1));
      continue;
    }
    Words words = words_of(line);
    if (words.empty()) continue;
    for (const std::string& word : words) number_in(word, path);
    if (!table.rows.empty() && words.size() != table.rows.front().size())
      throw InputError(fmt::format("{}: a line has {} numbers; the first has {}", path.string(),
                                   words.size(), table.rows.front().size()));
    table.rows.push_back(std::move(words));
  }
  return table;
}

// Whether the first words of the lines are numbers of steps, not times.
bool are_steps(const std::vector<Words>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Words& row) {
    const double x = std::strtod(row.front().c_str(), nullptr);
    return x >= 1 && x == std::floor(x);
  });
}

// From the last line of the head that has as many words as a row.
Words columns_of_table(const Sample& sample, const TextTableFile& table) {
  const std::size_t width = table.rows.empty() ? 0 : table.rows.front().size();
  if (sample.kind == "extremes") {
    Words columns = {"Time"};
    for (const char* which : {"minimum", "maximum"})
      for (std::size_t c = 0; c < (width - 1) / 2; ++c)
        columns.push_back(width == 3 ? which : fmt::format("{}.{}", which, "xyz"[c]));
    return columns;
  }
  if (sample.kind == "history") {
    Words columns = sample.vector ? Words{"x", "y", "z"} : Words{"value"};
    if (width <= columns.size()) return columns;
    const bool both = width == columns.size() + 2;
    const bool step = both || are_steps(table.rows);
    if (both || !step) columns.insert(columns.begin(), "Time");
    if (step) columns.insert(columns.begin(), "Timestep");
    return columns;
  }
  for (auto line = table.header.rbegin(); line != table.header.rend(); ++line) {
    Words columns = words_of(*line);
    if (sample.kind == "particle" && columns.size() > width) columns.resize(width);
    if (columns.size() == width) return columns;
  }
  Words columns = {"Time"};
  for (std::size_t c = 2; c <= width; ++c) columns.push_back(fmt::format("column {}", c));
  columns.resize(width);
  return columns;
}

// "# Simulation time: 0.25" of a snapshot.
std::string time_of_snapshot(const TextTableFile& table, const fs::path& path) {
  const std::string first = table.header.empty() ? "" : table.header.front();
  const Words words = words_of(first.substr(first.find(':') + 1));
  if (first.find(':') == std::string::npos || words.size() != 1)
    throw InputError(path.string() + ": its first line tells no time");
  number_in(words[0], path);
  return words[0];
}

SampleTable read_effects(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const Json report = Json::parse_or_null(text.str());
  SampleTable table{{"effect", "on", "seconds"}, {}};
  try {
    for (const Json& effect : report.at("effects").entries())
      table.rows.push_back({effect.at("name").get<std::string>(),
                            effect.at("on").get<bool>() ? "1" : "0",
                            fmt::format("{:.17g}", effect.at("seconds").get<double>())});
  } catch (const JsonError& error) {
    throw InputError(fmt::format("{}: tells no effects ({})", path.string(), error.what()));
  }
  return table;
}

// By time and place, as a reader of a line expects.
void sort_line(SampleTable& table) {
  std::vector<std::size_t> keys;
  for (const char* name : {"Time", "X", "Y", "Z"})
    if (const auto c = std::find(table.columns.begin(), table.columns.end(), name);
        c != table.columns.end())
      keys.push_back(static_cast<std::size_t>(c - table.columns.begin()));
  std::stable_sort(table.rows.begin(), table.rows.end(), [&](const Words& a, const Words& b) {
    for (const std::size_t k : keys) {
      const double x = std::strtod(a[k].c_str(), nullptr), y = std::strtod(b[k].c_str(), nullptr);
      if (x != y) return x < y;
    }
    return false;
  });
}

std::size_t column_of_times(const SampleTable& table, const Sample& sample) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(), [](const auto& c) {
    return c == "Time" || c == "time" || c == "#Time";
  });
  if (column == table.columns.end())
    throw InputError(
        fmt::format("'{}' has no column of times: --time selects nothing in it", sample.name));
  return static_cast<std::size_t>(column - table.columns.begin());
}

void keep_time(SampleTable& table, double wanted, const Sample& sample) {
  const std::size_t at = column_of_times(table, sample);
  const auto away = [&](const Words& row) {
    return std::abs(std::strtod(row[at].c_str(), nullptr) - wanted);
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const Words& row : table.rows) nearest = std::min(nearest, away(row));
  std::erase_if(table.rows, [&](const Words& row) { return away(row) > nearest; });
}

}  // namespace

std::vector<Sample> find_samples(const Archive& archive) {
  std::vector<Sample> all;
  for (const HistoryEntry& h : archive.index().histories)
    all.push_back({fs::path(h.file).stem(),
                   "history",
                   {archive.folder() / h.file},
                   h.unit,
                   h.type.find("Vector") != std::string::npos});
  std::map<std::string, Sample> by_name;
  for (const fs::path& path : text_files(archive.folder())) {
    Words parts;
    for (const fs::path& part : fs::relative(path, archive.folder())) parts.push_back(part);
    const std::string kind = kind_of_file(parts), name = name_of_sample(kind, parts);
    Sample& sample = by_name.try_emplace(name, Sample{name, kind, {}, "", false}).first->second;
    sample.files.push_back(path);
  }
  for (auto& [name, sample] : by_name) all.push_back(std::move(sample));
  if (const fs::path levels = archive.folder() / "levels.txt"; fs::exists(levels))
    all.push_back({"levels", "levels", {levels}, "", false});
  if (const fs::path report = archive.folder() / "run.json"; fs::exists(report))
    all.push_back({"effects", "effects", {report}, "", false});
  return all;
}

SampleTable read_sample(const Sample& sample, std::optional<double> time) {
  if (sample.kind == "effects") return read_effects(sample.files.front());
  SampleTable all;
  for (const fs::path& path : sample.files) {
    TextTableFile table = read_text_table(path);
    Words columns =
        sample.kind == "levels" ? Words{"Timestep", "Time"} : columns_of_table(sample, table);
    if (sample.kind == "levels")
      for (std::size_t l = 0; !table.rows.empty() && l + 2 < table.rows.front().size(); ++l)
        columns.push_back(fmt::format("level {}", l));
    if (sample.kind == "plane" || sample.kind == "average") {
      const std::string when = time_of_snapshot(table, path);
      columns.insert(columns.begin(), "Time");
      for (Words& row : table.rows) row.insert(row.begin(), when);
    }
    all.columns = std::move(columns);
    all.rows.insert(all.rows.end(), table.rows.begin(), table.rows.end());
  }
  if (sample.kind == "line") sort_line(all);
  if (time) keep_time(all, *time, sample);
  return all;
}

void keep_lines(SampleTable& table, const Sample& sample, const TimeRange& range) {
  const std::size_t at = column_of_times(table, sample);
  const std::string ends =
      table.rows.empty()
          ? "it is empty"
          : fmt::format("it goes from {} to {}", table.rows.front()[at], table.rows.back()[at]);
  std::erase_if(table.rows, [&](const Words& row) {
    return !range.contains(std::strtod(row[at].c_str(), nullptr));
  });
  if (table.rows.empty())
    throw InputError(fmt::format("'{}' has no line in this range of times: {}", sample.name, ends));
}

}  // namespace sluice

// Golden results: making, reading, writing, comparing.
#include "app/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

constexpr const char* first_line = "# sluice golden: steps {}, time {:.17g}\n";

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& what) {
  throw InputError(
      fmt::format("{}:{}: {}; a golden file is written by sluice regress --bless, never by hand",
                  file.string(), line, what));
}

std::vector<std::string> split_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

double number(const std::filesystem::path& file, int line, const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0) refuse(file, line, fmt::format("'{}' is no number", text));
  return x;
}

Golden::Row parse_row(const std::filesystem::path& file, int line, const std::string& text,
                      std::size_t columns) {
  const std::vector<std::string> words = split_commas(text);
  if (words.size() != columns + 4)
    refuse(file, line, fmt::format("{} values instead of {}", words.size(), columns + 4));
  std::vector<double> numbers;
  for (const std::string& w : words) numbers.push_back(number(file, line, w));
  Golden::Row row;
  row.level = static_cast<int>(numbers[0]);
  for (int d = 0; d < 3; ++d)
    row.cell[d] = static_cast<int>(numbers[static_cast<std::size_t>(d) + 1]);
  row.values.assign(numbers.begin() + 4, numbers.end());
  return row;
}

}  // namespace

Golden golden_of(const Archive& archive, const std::vector<std::string>& variables) {
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  Golden g;
  g.steps = step.info().step;
  g.time = step.info().time;
  bool first = true;
  for (const std::string& variable : variables)
    for (const FieldInfo& info : select_fields(step, variable, std::nullopt, 0)) {
      const DenseField field = step.read(info);
      for (int c = 0; c < info.components(); ++c)
        g.columns.push_back(
            info.components() == 1
                ? info.name
                : fmt::format("{}.{}", info.name, component_name(info.components(), c)));
      std::size_t n = 0;
      for_each_cell(step.grid().levels.front().domain, [&](IntVec3 cell) {
        if (first) g.rows.push_back({0, cell, {}});
        for (int c = 0; c < info.components(); ++c) g.rows[n].values.push_back(field.at(cell, c));
        ++n;
      });
      first = false;
    }
  return g;
}

Golden read_golden(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{} cannot be read", file.string()));
  Golden g;
  std::string text;
  std::getline(in, text);
  if (std::sscanf(text.c_str(), "# sluice golden: steps %d, time %lf", &g.steps, &g.time) != 2)
    refuse(file, 1, "the first line is not that of a golden file");
  std::getline(in, text);
  const std::vector<std::string> names = split_commas(text);
  if (names.size() < 5 || names.front() != "level")
    refuse(file, 2, "no columns level,i,j,k and variables");
  g.columns.assign(names.begin() + 4, names.end());
  for (int line = 3; std::getline(in, text); ++line)
    g.rows.push_back(parse_row(file, line, text, g.columns.size()));
  if (g.rows.empty()) refuse(file, 3, "no rows");
  return g;
}

void write_golden(const Golden& g, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << fmt::format(first_line, g.steps, g.time);
  out << fmt::format("level,i,j,k,{}\n", fmt::join(g.columns, ","));
  for (const Golden::Row& r : g.rows)
    out << fmt::format("{},{},{},{},{:.17g}\n", r.level, r.cell.x, r.cell.y, r.cell.z,
                       fmt::join(r.values, ","));
  if (!out.flush()) throw SystemError(fmt::format("cannot write {}", file.string()));
}

std::string golden_difference(const Golden& golden, const Golden& now, double tolerance) {
  if (golden.steps != now.steps)
    return fmt::format("{} steps, the golden run has {}", now.steps, golden.steps);
  if (!(std::fabs(golden.time - now.time) <= tolerance * std::fabs(golden.time)))
    return fmt::format("ends at {:.17g}, the golden run at {:.17g}", now.time, golden.time);
  if (golden.columns != now.columns)
    return fmt::format("holds {}, the golden file {}", fmt::join(now.columns, " "),
                       fmt::join(golden.columns, " "));
  if (golden.rows.size() != now.rows.size())
    return fmt::format("{} cells, the golden file has {}", now.rows.size(), golden.rows.size());
  for (std::size_t c = 0; c < golden.columns.size(); ++c) {
    double scale = 0;
    for (const Golden::Row& r : golden.rows) scale = std::max(scale, std::fabs(r.values[c]));
    double worst = 0;
    std::size_t where = 0, count = 0;
    for (std::size_t n = 0; n < golden.rows.size(); ++n) {
      if (!(golden.rows[n].cell == now.rows[n].cell)) return "the cells are not the same";
      const double d = std::fabs(golden.rows[n].values[c] - now.rows[n].values[c]);
      if (d <= tolerance * scale) continue;
      ++count;  // a NaN gets here too
      if (d <= worst) continue;
      worst = d;
      where = n;
    }
    if (count == 0) continue;
    const IntVec3 i = golden.rows[where].cell;
    return fmt::format("{} differs in {} of {} cells, most in [{},{},{}]: {:.17g}, golden {:.17g}",
                       golden.columns[c], count, golden.rows.size(), i.x, i.y, i.z,
                       now.rows[where].values[c], golden.rows[where].values[c]);
  }
  return {};
}

}  // namespace sluice

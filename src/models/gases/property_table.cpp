// Reading table files, and columns that follow from others.
#include "models/gases/property_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"
#include "models/gases/table_expression.hpp"

namespace sluice::models {
namespace {

// One name for what files call differently.
std::string canonical(const std::string& name) {
  static const std::map<std::string, std::string> others = {
      {"temperature", "Temp"},
      {"reference_temperature", "reference_Temp"},
      {"F", "mixture_fraction"},
      {"Fvar", "mixture_fraction_variance"},
      {"Hl", "heat_loss"}};
  const auto found = others.find(name);
  return found == others.end() ? name : found->second;
}

template <class Value>
std::map<std::string, Value> canonical_names(const std::map<std::string, Value>& map) {
  std::map<std::string, Value> renamed;
  for (const auto& [name, value] : map) renamed.emplace(canonical(name), value);
  return renamed;
}

// Lines with something on them that are no comments.
class TableLines {
 public:
  explicit TableLines(const std::string& file)
      : lines_(file, "property table", Separators::blanks) {}

  std::vector<std::string> words(const char* what) {
    next(what);
    std::vector<std::string> found;
    for (const DataLines::Word& word : lines_.words()) found.emplace_back(word.text);
    return found;
  }
  std::vector<double> numbers(const char* what, std::size_t count) {
    next(what);
    const std::size_t found = lines_.words().size();
    if (found != count)
      fail(std::min(found, count), what, fmt::format("{} numbers", count),
           fmt::format("{} of them", found));
    const std::string expected = fmt::format("a number ({})", what);
    std::vector<double> values;
    for (std::size_t n = 0; n < count; ++n) values.push_back(lines_.number(n, expected));
    return values;
  }
  std::size_t integer(const char* what, std::size_t most) {
    return integers(what, 1, most).front();
  }
  std::vector<std::size_t> integers(const char* what, std::size_t count, std::size_t most) {
    std::vector<std::size_t> values;
    for (const double x : numbers(what, count)) {
      const auto value = static_cast<std::size_t>(x > 0 ? x : 0);
      if (!(x > 0) || static_cast<double>(value) != x || value > most)
        fail(values.size(), what, fmt::format("whole numbers from 1 to {}", most),
             fmt::format("'{:g}'", x));
      values.push_back(value);
    }
    return values;
  }
  // At word n of the line.
  [[noreturn]] void fail(std::size_t n, const char* what, const std::string& expected,
                         const std::string& found) const {
    lines_.refuse(n, fmt::format("{} must be {}; found {}", what, expected, found));
  }
  // What stands behind the last line that the table has.
  void expect_end() {
    if (lines_.next_row())
      lines_.refuse(0, fmt::format("'{}' found after the end of the table",
                                   std::string(lines_.words().front().text.substr(0, 40))));
  }

 private:
  void next(const char* what) {
    if (!lines_.next_row())
      throw InputError(
          fmt::format("property table {}: ends where {} is expected", lines_.file(), what));
  }

  DataLines lines_;
};

constexpr std::size_t max_points = 1000000;

bool increases(const std::vector<double>& axis) {
  return std::is_sorted(axis.begin(), axis.end(), [](double a, double b) { return a <= b; });
}

// Where a value lies on an axis: between point and the next, how far.
struct OnAxis {
  std::size_t point = 0;
  double weight = 0;
};

OnAxis find_on_axis(const std::vector<double>& axis, double value) {
  OnAxis at;
  while (at.point + 2 < axis.size() && axis[at.point + 1] <= value) ++at.point;
  if (axis.size() > 1)
    at.weight =
        std::clamp((value - axis[at.point]) / (axis[at.point + 1] - axis[at.point]), 0., 1.);
  return at;
}

}  // namespace

PropertyTable::PropertyTable(const std::string& file, Additions additions)
    : file_(file), additions_(std::move(additions)) {
  additions_.defaults = canonical_names(additions_.defaults);
  additions_.constants = canonical_names(additions_.constants);
  additions_.derived = canonical_names(additions_.derived);
  TableLines lines(file);
  const std::size_t axes = lines.integer("the number of axes", 2);
  std::vector<std::string> names = lines.words("names of the axes");
  if (names.size() != axes)
    lines.fail(0, "names of the axes", fmt::format("{}, one for each axis", axes),
               fmt::format("{} of them", names.size()));
  axis_ = canonical(names.front());
  if (axis_ != "mixture_fraction")
    lines.fail(0, "the first axis", "mixture_fraction or F", "'" + names.front() + "'");
  const std::vector<std::size_t> points = lines.integers("points of the axes", axes, max_points);
  const std::size_t count = lines.integer("the number of columns", max_points);
  const std::vector<std::string> columns = lines.words("names of the columns");
  if (columns.size() != count)
    lines.fail(0, "names of the columns", fmt::format("{}, one for each column", count),
               fmt::format("{} of them", columns.size()));
  lines.words("units of the columns");
  std::vector<double> second = {0};
  OnAxis place;
  if (axes == 2) {
    second = lines.numbers("the second axis", points[1]);
    if (!increases(second)) lines.fail(0, "the second axis", "increasing", "no order");
    const auto given = additions_.defaults.find(canonical(names[1]));
    place = find_on_axis(second, given == additions_.defaults.end() ? 0.0 : given->second);
  }
  for (const std::string& column : columns) {
    const std::vector<double> fractions = lines.numbers("mixture fractions", points[0]);
    if (points[0] < 2 || !increases(fractions))
      lines.fail(0, "mixture fractions", "increasing", "no order");
    if (fractions_.empty()) fractions_ = fractions;
    if (fractions != fractions_)
      lines.fail(0, "mixture fractions", "the same for all columns",
                 "'" + column + "' with others");
    std::vector<double>& values = columns_[canonical(column)];
    values.assign(points[0], 0.0);
    for (std::size_t n = 0; n < second.size(); ++n) {
      const std::vector<double> row = lines.numbers("values of a column", points[0]);
      const double weight = n == place.point       ? 1.0 - place.weight
                            : n == place.point + 1 ? place.weight
                                                   : 0.0;
      if (weight == 0.0) continue;
      for (std::size_t i = 0; i < row.size(); ++i) values[i] += weight * row[i];
    }
  }
  lines.expect_end();
}

double PropertyTable::value(const std::string& asked, std::size_t point, int depth) const {
  const std::string name = canonical(asked);
  const auto constant = additions_.constants.find(name);
  if (constant != additions_.constants.end()) return constant->second;
  const auto derived = additions_.derived.find(name);
  if (derived != additions_.derived.end()) {
    constexpr int deepest = 32;
    if (depth > deepest)
      throw InputError(fmt::format("property table {}: {} depends on itself", file_, name));
    return evaluate_expression(derived->second, [&](const std::string& other, bool axis) {
      if (!axis) return value(other, point, depth + 1);
      if (canonical(other) == axis_) return fractions_[point];
      const auto given = additions_.defaults.find(canonical(other));
      if (given != additions_.defaults.end()) return given->second;
      throw InputError(
          fmt::format("property table {}: {} depends on {{{}}}; the axis is {{mixture_fraction}}",
                      file_, name, other));
    });
  }
  const auto column = columns_.find(name);
  if (column != columns_.end()) return column->second[point];
  std::string known;
  const auto add = [&](const auto& map) {
    for (const auto& entry : map) known += (known.empty() ? "" : ", ") + entry.first;
  };
  add(columns_);
  add(additions_.constants);
  add(additions_.derived);
  throw InputError(fmt::format(
      "property table {}: no column {}; there are {}. A <constantValue> or <derivedValue> adds one",
      file_, name, known));
}

std::vector<double> PropertyTable::column(const std::string& name) const {
  std::vector<double> values;
  for (std::size_t point = 0; point < fractions_.size(); ++point)
    values.push_back(value(name, point, 0));
  return values;
}

}  // namespace sluice::models

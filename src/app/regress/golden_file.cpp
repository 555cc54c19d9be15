// Golden results as files.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "app/regress/golden.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

constexpr const char* first_line = "# sluice golden: steps {}, time {:.17g}\n";

// A file that is read line by line; faults name the line.
struct Reader {
  const std::filesystem::path& file;
  std::ifstream in;
  int line = 0;
  std::string text;

  bool next() {
    ++line;
    return static_cast<bool>(std::getline(in, text));
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(
        fmt::format("{}:{}: {}; a golden file is written by sluice regress --bless, never by hand",
                    file.string(), line, what));
  }
  std::vector<std::string> words() const {
    std::vector<std::string> parts;
    std::stringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
  }
  double number(const std::string& word) const {
    char* end = nullptr;
    const double x = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != 0) refuse(fmt::format("'{}' is not a number", word));
    return x;
  }
};

GoldenTable::Row read_row(const Reader& from, const GoldenTable& table) {
  const std::vector<std::string> words = from.words();
  if (words.size() != table.columns.size())
    from.refuse(fmt::format("{} values instead of {}", words.size(), table.columns.size()));
  GoldenTable::Row row;
  const std::size_t places = table.place_columns();
  for (std::size_t n = 0; n < words.size(); ++n)
    if (n < places)
      row.place[n] = static_cast<std::int64_t>(from.number(words[n]));
    else
      row.values.push_back(from.number(words[n]));
  return row;
}

}  // namespace

Golden read_golden(const std::filesystem::path& file) {
  Reader from{file, std::ifstream(file), 0, {}};
  if (!from.in) throw InputError(fmt::format("{} cannot be read", file.string()));
  Golden g;
  from.next();
  if (std::sscanf(from.text.c_str(), "# sluice golden: steps %d, time %lf", &g.steps, &g.time) != 2)
    from.refuse("the first line is not that of a golden file");
  while (from.next()) {
    if (from.text.starts_with("# ")) {
      g.tables.push_back({from.text.substr(2), {}, {}});
      from.next();
      g.tables.back().columns = from.words();
      if (g.tables.back().columns.size() <= g.tables.back().place_columns())
        from.refuse("no columns i,j,k or id and values");
    } else if (g.tables.empty()) {
      from.refuse("a table begins with its variable and material");
    } else {
      g.tables.back().rows.push_back(read_row(from, g.tables.back()));
    }
  }
  if (g.tables.empty()) from.refuse("no tables");
  return g;
}

void write_golden(const Golden& g, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << fmt::format(first_line, g.steps, g.time);
  for (const GoldenTable& t : g.tables) {
    out << fmt::format("# {}\n{}\n", t.title, fmt::join(t.columns, ","));
    for (const GoldenTable::Row& r : t.rows) {
      const auto places = r.place.begin();
      out << fmt::format("{},{:.17g}\n",
                         fmt::join(places, places + static_cast<int>(t.place_columns()), ","),
                         fmt::join(r.values, ","));
    }
  }
  if (!out.flush()) throw SystemError(fmt::format("cannot write {}", file.string()));
}

}  // namespace sluice

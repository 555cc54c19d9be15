// Text files with a fixed number of numbers a line.
#include "framework/geometry/point_table.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/packed_text.hpp"

namespace sluice {

namespace {

const char* skip_separators(const char* c) {
  while (*c == ' ' || *c == '\t' || *c == ',' || *c == '\r') ++c;
  return c;
}

}  // namespace

void read_table(const std::string& file, int columns,
                const std::function<void(const double* numbers, int line)>& row) {
  if (!std::ifstream(file))
    throw InputError(fmt::format(
        "geometry file '{}' cannot be opened ({}); names are relative to the folder of the run, "
        "without quotation marks",
        file, std::strerror(errno)));
  std::istringstream in(unpacked_text(file, "geometry file"));
  std::vector<double> numbers(static_cast<std::size_t>(columns));
  std::string text;
  int line = 0, rows = 0;
  while (std::getline(in, text)) {
    ++line;
    const char* c = skip_separators(text.c_str());
    if (*c == '\0') continue;
    for (int i = 0; i < columns; ++i) {
      char* end = nullptr;
      const double x = std::strtod(c, &end);
      if (end == c || !std::isfinite(x))
        throw InputError(fmt::format("{}:{}: number {} of {} is missing or not a number: '{}'",
                                     file, line, i + 1, columns, text.substr(0, 60)));
      numbers[static_cast<std::size_t>(i)] = x;
      c = skip_separators(end);
    }
    row(numbers.data(), line);
    ++rows;
  }
  if (rows == 0)
    throw InputError(fmt::format("{}: no rows; expected {} numbers a line", file, columns));
}

}  // namespace sluice

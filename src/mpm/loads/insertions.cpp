#include "mpm/loads/insertions.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/data_lines.hpp"

namespace sluice::mpm {
namespace {

// Of the first row.
std::size_t numbers_in_a_row(const std::string& file) {
  DataLines lines(file, "data file", Separators::blanks_and_commas);
  return lines.next_row() ? lines.words().size() : 0;
}

}  // namespace

std::vector<Insertion> read_insertions(const std::string& file, int materials) {
  std::vector<std::string> columns = {"time",    "colour",     "shift x",    "shift y",
                                      "shift z", "velocity x", "velocity y", "velocity z"};
  const std::size_t more = numbers_in_a_row(file) == columns.size() + 1 ? 1 : 0;
  if (more == 1) columns.insert(columns.begin() + 1, "material");
  std::vector<Insertion> rows;
  read_table(file, columns, [&](const TableRow& v) {
    Insertion& row = rows.emplace_back();
    row.time = v[0];
    if (more == 1) {
      if (!(v[1] >= 0 && v[1] < materials && v[1] == std::floor(v[1])))
        v.refuse(1, fmt::format("there is no material {:g}; valid: 0 to {}", v[1], materials - 1));
      row.material = static_cast<int>(v[1]);
    }
    const auto at = [&](std::size_t n) { return v[n + more]; };
    row.colour = at(1);
    row.way = {at(2), at(3), at(4)};
    row.velocity = {at(5), at(6), at(7)};
  });
  return rows;
}

std::vector<Insertion> insertions_in(const std::vector<Insertion>& all, double time, double dt) {
  std::vector<Insertion> now;
  for (const Insertion& i : all)
    if (i.time >= time && i.time < time + dt) now.push_back(i);
  return now;
}

}  // namespace sluice::mpm

#include "mpm/loads/insertions.hpp"

#include "framework/base/data_lines.hpp"

namespace sluice::mpm {

std::vector<Insertion> read_insertions(const std::string& file) {
  std::vector<Insertion> rows;
  const std::vector<std::string> columns = {"time",    "colour",     "shift x",    "shift y",
                                            "shift z", "velocity x", "velocity y", "velocity z"};
  read_table(file, columns, [&](const TableRow& v) {
    rows.push_back({v[0], v[1], {v[2], v[3], v[4]}, {v[5], v[6], v[7]}});
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

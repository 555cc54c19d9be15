// Golden results: the values of a few variables at the end of a short run.
//
//   # sluice golden: steps 40, time 0.20000000000000001
//   # vel_CC, material 0, level 0
//   i,j,k,x,y,z
//   0,0,0,0.10000000000000001,0,0
//   ...
//   # p.mass, material 1
//   id,value
//   ...
//
// as CSV with 17 digits, small enough for the repository: one table for each variable, material and
// level. Two values differ when they are further apart than the tolerance times the largest
// magnitude of their column, so that round-off around zero does not count; steps must be equal,
// times (s) equal within the tolerance. Values have the units of the variables.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct GoldenTable {
  std::string title;                 // variable, material and level
  std::vector<std::string> columns;  // of the places (i, j, k or id), then of the values
  struct Row {
    std::array<std::int64_t, 3> place{};  // of a cell, face or node; or the id of a particle
    std::vector<double> values;
  };
  std::vector<Row> rows;

  std::size_t place_columns() const;  // 3 or 1
};

struct Golden {
  int steps = 0;
  double time = 0;     // s
  double last_dt = 0;  // s, of the last step; not kept in files
  std::vector<GoldenTable> tables;
};

// The last output, of every material and level that a variable has. Particles are in the order of
// their ids. InputError when the archive lacks a variable.
Golden golden_of(const Archive& archive, const std::vector<std::string>& variables);

// InputError with file and line when it is not such a file.
Golden read_golden(const std::filesystem::path& file);
// SystemError when it cannot be written.
void write_golden(const Golden& golden, const std::filesystem::path& file);

// Whether both are of the end of a run: at one step, or at times that are less than a step apart.
// Otherwise one is of some output on the way, and nothing is said by a comparison.
bool of_one_end(const Golden& golden, const Golden& now);

// What differs, in one sentence; empty when nothing does.
std::string golden_difference(const Golden& golden, const Golden& now, double tolerance);

}  // namespace sluice

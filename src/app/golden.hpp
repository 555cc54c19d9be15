// Golden results: the values of a few variables in every cell at the end of a short run.
//
//   # sluice golden: steps 40, time 0.20000000000000001
//   level,i,j,k,rho_CC,vel_CC.x,...
//
// as CSV with 17 digits, small enough for the repository. Two values differ when they are further
// apart than the tolerance times the largest |value| of their column, so that round-off around zero
// does not count; steps must be equal, times equal within the tolerance.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct Golden {
  int steps = 0;
  double time = 0;
  std::vector<std::string> columns;  // after level, i, j, k
  struct Row {
    int level = 0;
    IntVec3 cell;
    std::vector<double> values;
  };
  std::vector<Row> rows;
};

// The last output. InputError when the archive lacks a variable.
Golden golden_of(const Archive& archive, const std::vector<std::string>& variables);

// InputError with file and line when it is not such a file.
Golden read_golden(const std::filesystem::path& file);
// SystemError when it cannot be written.
void write_golden(const Golden& golden, const std::filesystem::path& file);

// What differs, in one sentence; empty when nothing does.
std::string golden_difference(const Golden& golden, const Golden& now, double tolerance);

}  // namespace sluice

// VTK's XML files: images (.vti, cell and point arrays over a box of cells), points (.vtp).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

enum class VtkType { real, integer, long_integer, byte };  // Float64, Int32, Int64, UInt8

struct VtkArray {
  std::string name;
  VtkType type = VtkType::real;
  bool on_points = false;
  int components = 1;
  std::vector<double> values;  // component fastest, then x, y, z; in the unit of what is named
};

// With `from_zero` the extent starts at 0 and the origin at the box's corner (what AMR data sets
// need); else extents are the level's own indices.
void write_vti(const std::filesystem::path& path, const Level& level, const IndexBox& cells,
               bool from_zero, const std::vector<VtkArray>& arrays);

// Points with values; `positions` has three components, m.
void write_vtp(const std::filesystem::path& path, const VtkArray& positions,
               const std::vector<VtkArray>& arrays);

}  // namespace sluice

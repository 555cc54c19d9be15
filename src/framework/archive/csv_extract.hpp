// Values of one label as CSV, for scripts.
//
//   time,level,material,i,j,k,x,y,z,value          (vectors: value_x,value_y,value_z)
//   time,level,material,id,x,y,z,value             (labels of particles; rows by material, id)
//
// Particles of a raw archive without numbers have an empty id, and the order of their patches.
// 17 digits; interior points only; rows by material, level, k, j, i. With all levels every point
// comes once, from the finest level that holds a value there.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "framework/archive/archive.hpp"

namespace sluice {

struct ExtractOptions {
  std::string label;
  std::optional<int> material;   // none: all that the label has
  int level = -1;                // < 0: all
  std::optional<Vec3> from, to;  // closed box that must hold the point, m
};

// Hands successive pieces of CSV text to `write`; returns the number of rows after the header.
std::int64_t extract_csv(const ArchiveStep& step, const ExtractOptions& options,
                         const std::function<void(std::string_view)>& write);

}  // namespace sluice

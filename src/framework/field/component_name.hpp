// What the components of a variable are called in texts and tables.
#pragma once

namespace sluice {

// Of 3 components x, y, z; of 9 (a tensor, row after row) xx to zz; of one an empty name.
// 0 <= component < components.
constexpr const char* component_name(int components, int component) {
  constexpr const char* of_vector[3] = {"x", "y", "z"};
  constexpr const char* of_tensor[9] = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  return components == 9 ? of_tensor[component] : components == 3 ? of_vector[component] : "";
}

}  // namespace sluice

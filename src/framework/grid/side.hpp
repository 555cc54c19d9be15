// The six sides of a box, in the order in which decks and the peer name them.
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace sluice {

enum class Side { x_minus, x_plus, y_minus, y_plus, z_minus, z_plus };

inline constexpr std::array<Side, 6> all_sides = {Side::x_minus, Side::x_plus,  Side::y_minus,
                                                  Side::y_plus,  Side::z_minus, Side::z_plus};

// Its place in all_sides, and in arrays that have an entry for each side.
constexpr std::size_t index_of(Side s) {
  return static_cast<std::size_t>(s);
}
constexpr int direction_of(Side s) {
  return static_cast<int>(s) / 2;
}
constexpr bool is_plus(Side s) {
  return static_cast<int>(s) % 2 == 1;
}
constexpr Side side_of(int direction, bool plus) {
  return static_cast<Side>(2 * direction + (plus ? 1 : 0));
}
constexpr std::string_view name_of(Side s) {
  constexpr std::array<std::string_view, 6> names = {"x-", "x+", "y-", "y+", "z-", "z+"};
  return names[index_of(s)];
}

}  // namespace sluice

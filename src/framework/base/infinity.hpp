// The number beyond all others.
#pragma once
#include <limits>

namespace sluice {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace sluice

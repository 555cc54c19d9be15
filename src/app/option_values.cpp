// Reading option values.
#include "app/option_values.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "framework/base/error.hpp"

namespace sluice {

IntVec3 positive_triple(const std::string& text, const char* option) {
  if (text.empty()) return {};
  IntVec3 v;
  char end = 0;
  const int read = std::sscanf(text.c_str(), "%d,%d,%d%c", &v.x, &v.y, &v.z, &end);
  if (read != 3 || v.x < 1 || v.y < 1 || v.z < 1)
    throw InputError(
        fmt::format("{} takes three positive numbers I,J,K; found '{}'", option, text));
  return v;
}

}  // namespace sluice

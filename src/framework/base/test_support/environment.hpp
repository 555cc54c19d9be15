// Variables of the environment, where one that is set to nothing counts as unset.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace sluice {

// The folder that the variable names; without a value where it names none.
inline std::optional<std::filesystem::path> folder_in_environment(const char* variable) {
  const char* named = std::getenv(variable);
  if (named == nullptr || *named == '\0') return std::nullopt;
  return std::filesystem::path(named);
}

}  // namespace sluice

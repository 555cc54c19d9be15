// Options of the tools that Uintah's users know: -name value, in any case, with - and _ anywhere.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

struct ClassicOption {
  std::string names;   // "-v --variable": any of these
  std::string values;  // "<i> <j> <k>": one value each; empty: a flag
  std::string text;
};

// How a tool is called.
struct ClassicSpec {
  std::string name;       // lineextract
  std::string arguments;  // "[options] <archive>"
  std::vector<ClassicOption> options;
};

// What stands on a command line. InputError, with the usage, for an option that the tool does not
// have, a value that is missing or is not a number.
class ClassicArguments {
 public:
  ClassicArguments(ClassicSpec spec, const std::vector<std::string>& words);

  bool has(const std::string& option) const { return given_.contains(option); }
  // The first name of an option identifies it; of one that is given twice the last counts.
  std::string text(const std::string& option, const std::string& fallback = {}) const;
  int integer(const std::string& option, int fallback) const;
  double real(const std::string& option, double fallback) const;
  std::optional<IntVec3> integers(const std::string& option) const;
  std::optional<std::pair<int, int>> pair(const std::string& option) const;
  std::optional<Vec3> reals(const std::string& option, std::size_t first = 0) const;
  std::vector<std::string> all(const std::string& option) const;  // each time it is given
  const std::vector<std::string>& values(const std::string& option) const {
    return given_.at(option).back();
  }

  const std::vector<std::string>& positional() const { return positional_; }
  // The single one that must be there.
  const std::string& only_positional(const char* what) const;
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  const ClassicOption& find(const std::string& word) const;
  const std::string& value(const std::string& option, std::size_t n) const;

  ClassicSpec spec_;
  std::map<std::string, std::vector<std::vector<std::string>>> given_;
  std::vector<std::string> positional_;
};

std::string usage_of(const ClassicSpec& spec);

}  // namespace sluice

// What labels are called in programs that draw: by their materials' names where several have them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

class ArrayNames {
 public:
  explicit ArrayNames(const Archive& archive);

  // LABEL, or LABEL_MATERIAL where the archive holds the label for several materials.
  std::string of(const std::string& label, int material) const;
  // As the deck calls it, or its number where the deck gives no name of its own.
  std::string material(int number) const;
  std::string described(int number) const;  // steel, or material 0

 private:
  bool named(int number) const;
  std::vector<std::string> materials_;  // by number; empty: no name of its own
  std::map<std::string, bool> several_;
};

}  // namespace sluice

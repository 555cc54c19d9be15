// Values of one archived step in a file, whatever its format: what ArchiveStep puts together.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "framework/archive/archive_record.hpp"

namespace sluice {

// Indices that hold values. `interior` is the part that no other box holds; beyond it lie the extra
// cells of raw archives. Particles are counted along x.
struct StoredBox {
  IndexBox stored;
  IndexBox interior;
  int patch = -1;  // its place in Level::boxes; -1: the file does not say
};

// All functions throw DamageError, which names the file, where something is not as written.
class StepFile {
 public:
  virtual ~StepFile() = default;

  virtual const std::vector<StoredVariable>& variables() const = 0;
  // In stored order.
  virtual const std::vector<StoredBox>& boxes(const StoredVariable& variable) = 0;
  // The values of box number `box`, component after component, x fastest.
  virtual std::vector<double> read_box(const StoredVariable& variable, std::size_t box) = 0;
  // The same of integers, of which a double holds 53 bits.
  virtual std::vector<std::int64_t> read_integers(const StoredVariable& variable,
                                                  std::size_t box) = 0;

  // nullptr where the file has no such variable.
  const StoredVariable* find(std::string_view name, int level, int material) const {
    for (const StoredVariable& v : variables())
      if (v.name == name && v.level == level && v.material == material) return &v;
    return nullptr;
  }
};

}  // namespace sluice

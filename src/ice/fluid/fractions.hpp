// The mass fractions of a mixed gas along a row of cells (models/gases/mixed_gas.hpp).
#pragma once
#include <array>
#include <cstddef>

#include "models/gases/combustion.hpp"

namespace sluice::ice {

// One pointer for each fraction, from the first cell of the row on; beyond them nothing is set.
struct FractionRows {
  std::array<const double*, models::max_species> of;

  FractionRows() {}  // NOLINT: made once a row, and only what is there is set
  explicit FractionRows(const double* alone) { of[0] = alone; }
  const double* alone() const { return of[0]; }
};

}  // namespace sluice::ice

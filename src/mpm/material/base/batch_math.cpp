// Checks of whole batches.
#include "mpm/material/base/batch_math.hpp"

namespace sluice::mpm {

std::optional<BatchFault> fault_of_volume(const Batch& batch) {
  const Nine<const double> F = batch.F;
  int bad = 0;
#pragma GCC ivdep
  for (int i = 0; i < batch.count; ++i) {
    const double J = determinant(at(F, i));
    bad |= static_cast<int>(!(J > 0)) | static_cast<int>(!(J < 1e300));
  }
  if (bad == 0) return std::nullopt;
  for (int i = 0; i < batch.count; ++i) {
    const double J = determinant(at(F, i));
    if (!(J > 0)) return BatchFault{i, J <= 0 ? "det F <= 0" : "det F is not a number", J};
    if (!(J < 1e300)) return BatchFault{i, "det F is not finite", J};
  }
  return std::nullopt;
}

}  // namespace sluice::mpm

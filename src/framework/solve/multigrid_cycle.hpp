// A multigrid cycle on a system as a preconditioner: z = B r, symmetric and positive.
//
// In 32-bit numbers where they serve, of vectors scaled to what these can hold.
#pragma once
#include <variant>

#include "framework/solve/dense_system.hpp"
#include "framework/solve/multigrid.hpp"

namespace sluice::solve {

class MultigridCycle {
 public:
  MultigridCycle() = default;
  explicit MultigridCycle(const DenseSystem& system);
  // `norm`: any norm of r, above 0. Of a singular system z has no mean.
  void apply(const DenseSystem& system, const DenseVector& r, double norm, DenseVector& z);

 private:
  std::variant<std::monostate, Multigrid<float>, Multigrid<double>> cycle_;
};

}  // namespace sluice::solve

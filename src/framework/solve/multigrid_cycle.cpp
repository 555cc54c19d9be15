#include "framework/solve/multigrid_cycle.hpp"

#include <cmath>

namespace sluice::solve {

MultigridCycle::MultigridCycle(const DenseSystem& system) {
  const MultigridSettings settings;
  DenseEquations equations = system.equations();
  if (needs_lines(equations, settings))
    cycle_.emplace<Multigrid<double>>(std::move(equations), settings);
  else
    cycle_.emplace<Multigrid<float>>(std::move(equations), settings);
}

// The cycle gets the residual over its norm: numbers that 32 bits can hold.
void MultigridCycle::apply(const DenseSystem& system, const DenseVector& r, double norm,
                           DenseVector& z) {
  const double shrink = std::ldexp(1.0, -std::ilogb(norm));
  const int n = system.shape().count[0];
  const auto by = [&]<class Real>(Multigrid<Real>& cycle) {
    Real* b = cycle.right_side();
    system.for_rows([&](std::ptrdiff_t row) {
      const double* from = r.data() + row;
      Real* to = b + row;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) to[i] = static_cast<Real>(shrink * from[i]);
    });
    cycle.cycle();
    const Real* e = cycle.correction();
    const double grow = cycle.scale() / shrink;
    system.for_rows([&](std::ptrdiff_t row) {
      const Real* from = e + row;
      double* to = z.data() + row;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) to[i] = grow * static_cast<double>(from[i]);
    });
  };
  if (auto* single = std::get_if<Multigrid<float>>(&cycle_)) by(*single);
  if (auto* full = std::get_if<Multigrid<double>>(&cycle_)) by(*full);
  if (system.singular()) system.remove_mean(z);
}

}  // namespace sluice::solve

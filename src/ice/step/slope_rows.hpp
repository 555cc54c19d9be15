// What becomes of slopes of the velocity and the pressure beside what they must not cross: cells of
// a redone step, and solids.
#pragma once
#include "framework/task/task.hpp"

namespace sluice::ice {

// By axis: slopes of the normal velocity and of the pressure (m/s and Pa per cell); transverse
// advection of the former (m/s).
struct SlopeOutputs {
  Out velocity, pressure, transverse;
};

// Slopes of D axes times the mask of a redone step.
inline void mask_slopes(const Row& row, In mask_in, const SlopeOutputs& h, int D) {
  const int n = row.whole_vectors();
  const double* __restrict mask = row(mask_in);
  for (int d = 0; d < D; ++d)
    for (double* __restrict s :
         {row(h.velocity, d), row(h.pressure, d), D > 1 ? row(h.transverse, d) : nullptr}) {
      if (s == nullptr) continue;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) s[i] *= mask[i];
    }
}

// Beside solids: slopes along axes that are open, transverse advection by those across.
inline void mask_slopes_at_closed_faces(const Row& row, In open_in, const SlopeOutputs& h, int D) {
  const int n = row.count();
  for (int d = 0; d < D; ++d) {
    const double* open = row(open_in, d);
    double *su = row(h.velocity, d), *sp = row(h.pressure, d);
    for (int i = 0; i < n; ++i) {
      su[i] *= open[i];
      sp[i] *= open[i];
    }
    for (int t = 0; t < D && D > 1; ++t) {
      if (t == d) continue;
      const double* across = row(open_in, t);
      double* UT = row(h.transverse, d);
      for (int i = 0; i < n; ++i) UT[i] *= across[i];
    }
  }
}

}  // namespace sluice::ice

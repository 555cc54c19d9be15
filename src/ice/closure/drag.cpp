// Drag of two materials by the exponential, of more by pair_relaxation.hpp.
#include "ice/closure/drag.hpp"

#include <algorithm>
#include <cmath>

#include "ice/closure/interface_band.hpp"
#include "ice/closure/pair_relaxation.hpp"
#include "ice/closure/surface_law.hpp"
#include "ice/fluid/limiters.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: volume fraction up to which a material moves with the mixture; unit: 1; test:
//   Drag.BindsLightTracesOnly
constexpr double bound = 1e-8;
// threshold: volume fraction above which its small amount no longer binds it to the mixture; unit:
//   1; test: Drag.BindsLightTracesOnly
constexpr double unbound = 1e-6;
// threshold: volume fraction up to which a light material feels at least the drag of fragments of
//   the size of a cell; unit: 1; test: Drag.BindsLightTracesOnly
constexpr double little = 1e-2;
// threshold: volume fraction above which it does not feel this drag; unit: 1; test:
//   Drag.BindsLightTracesOnly
constexpr double some = 2e-2;
// threshold: density relative to the mixture up to which a material counts as light for this drag;
//   unit: 1; test: Drag.BindsLightTracesOnly
constexpr double light = 1.0;
// threshold: density relative to the mixture above which it does not; unit: 1; test:
//   Drag.BindsLightTracesOnly
constexpr double heavy = 2.0;

// s/(1 - s) of a share s between 0 and 1.
double strength(double share) {
  if (share <= 0.0) return 0.0;
  return share < 1.0 ? std::fmin(share / (1.0 - share), strongest_bond) : strongest_bond;
}
// Half of the mass that the one of smaller volume pushes aside.
double virtual_mass(const DragCell& cell, int i, int j) {
  const double a = cell.V[i], b = cell.V[j];
  const double aa = a * a, bb = b * b;
  return 0.5 * a * b * (aa * cell.M[i] + bb * cell.M[j]) / (aa * a + bb * b);
}

// From 1 to 0 as x goes from a to b.
double falling(double x, double a, double b) {
  return x <= a ? 1.0 : x < b ? (b - x) / (b - a) : 0.0;
}

// `act`(`along`, values) on what is along the surface, direction by direction, and on what is
// across it; on each direction as it is where there is none.
template <class Act>
void split(const DragCell& cell, int directions, ByMaterial* w, Act act) {
  if (!(cell.surface > 0.0)) {
    for (int c = 0; c < directions; ++c) act(false, w[c]);
    return;
  }
  double across[max_materials];
  for (int k = 0; k < cell.count; ++k) {
    across[k] = 0;
    for (int c = 0; c < directions; ++c) across[k] += cell.normal[c] * w[c][k];
  }
  for (int c = 0; c < directions; ++c) {
    for (int k = 0; k < cell.count; ++k) w[c][k] -= cell.normal[c] * across[k];
    act(true, w[c]);
  }
  act(false, across);
  for (int c = 0; c < directions; ++c)
    for (int k = 0; k < cell.count; ++k) w[c][k] += cell.normal[c] * across[k];
}

bool is_zero(const DragCell& cell, const double* values) {
  return std::all_of(values, values + cell.count, [](double x) { return x == 0.0; });
}

}  // namespace

double freedom(double volume) {
  return 1.0 - falling(volume, bound, unbound);
}

double binding(const DragCell& cell, int i, double courant) {
  const double lightness = cell.M[i] / (cell.V[i] * cell.total);  // density by that of the mixture
  const double share = falling(lightness, light, heavy) * falling(cell.V[i], little, some);
  return strength(1.0 - freedom(cell.V[i])) + (share > 0.0 ? share * courant / lightness : 0.0);
}

double Drag::pair(const DragCell& cell, int i, int j, double dt, double part, bool along) const {
  const int a = cell.index[i], b = cell.index[j];
  const double K = K_.materials() > 0 ? K_.between(a, b, cell.M[i], cell.M[j]) : 0.0;
  const bool slides = along && slip_ && slip_->between(a, b);
  const double lock = (slides ? 0.0 : cell.lock) + cell.bind[i] + cell.bind[j];
  const double VV = cell.V[i] * cell.V[j];
  const double impulse =
      slides ? dt * through_surface(K * VV, cell.surface, cell.passes) : dt * K * VV;
  return part * (impulse + lock * (cell.M[i] * cell.M[j] / cell.total));
}

void Drag::relax(const DragCell& cell, double dt, double part, bool along, const double* w,
                 const double* push, double* after) const {
  const int n = cell.count;
  double k[max_materials * max_materials], gain[max_materials];
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) k[i * n + j] = i == j ? 0.0 : pair(cell, i, j, dt, part, along);
  relax_pairs(n, cell.M, w, k, gain, push);
  double rest = 0;
  for (int i = 0; i < n; ++i) {
    after[i] = w[i] + gain[i] / cell.M[i];
    rest += cell.M[i] * after[i];
  }
  rest /= cell.total;
  for (int i = 0; i < n; ++i) after[i] -= rest;
}

void Drag::decay_one(const DragCell& cell, double dt, double part, bool along, double* w) const {
  if (is_zero(cell, w)) return;
  if (cell.count > 2) return relax(cell, dt, part, along, w, nullptr, w);
  const double k = pair(cell, 0, 1, dt, part, along);
  const double D = (w[0] - w[1]) * std::exp(-k * (1.0 / cell.M[0] + 1.0 / cell.M[1]));
  w[0] = D * (cell.M[1] / cell.total);
  w[1] = -D * (cell.M[0] / cell.total);
}

void Drag::respond_one(const DragCell& cell, double dt, double part, bool along, const double* push,
                       double* w) const {
  double given[max_materials];  // `push` and `w` may be one
  std::copy_n(push, cell.count, given);
  std::fill_n(w, cell.count, 0.0);
  if (is_zero(cell, given)) return;
  if (cell.count > 2) return relax(cell, dt, part, along, w, given, w);
  const double z = pair(cell, 0, 1, dt, part, along) * (1.0 / cell.M[0] + 1.0 / cell.M[1]);
  const double share = z > 0.0 ? -std::expm1(-z) / z : 1.0;
  const double D = (given[0] / cell.M[0] - given[1] / cell.M[1]) * share;
  w[0] = D * (cell.M[1] / cell.total);
  w[1] = -D * (cell.M[0] / cell.total);
}

void Drag::decay(const DragCell& cell, double dt, double part, int directions,
                 ByMaterial* w) const {
  split(cell, directions, w,
        [&](bool along, double* one) { decay_one(cell, dt, part, along, one); });
}

void Drag::respond(const DragCell& cell, double dt, double part, int directions,
                   const ByMaterial* push, ByMaterial* w) const {
  for (int c = 0; c < directions; ++c) std::copy_n(push[c], cell.count, w[c]);
  split(cell, directions, w,
        [&](bool along, double* one) { respond_one(cell, dt, part, along, one, one); });
}

// (M + A) w = (M/total - V) dp, A from the virtual mass of each pair; momentum M w.
void Drag::push(const DragCell& cell, double dp, double* momentum) {
  const int n = cell.count;
  for (int i = 0; i < n; ++i) momentum[i] = (cell.M[i] / cell.total - cell.V[i]) * dp;
  if (n == 2) {
    // The smaller has all digits, of next to nothing too.
    const int small = cell.V[1] < cell.V[0] ? 1 : 0;
    const double m = virtual_mass(cell, 0, 1);
    momentum[small] /= 1.0 + m * (1.0 / cell.M[0] + 1.0 / cell.M[1]);
    momentum[1 - small] = -momentum[small];
    return;
  }
  double k[max_materials * max_materials], rest = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) k[i * n + j] = i == j ? 0.0 : virtual_mass(cell, i, j);
  solve_pairs(n, cell.M, k, momentum);
  for (int i = 0; i < n; ++i) rest += momentum[i] *= cell.M[i];
  for (int i = 0; i < n; ++i) momentum[i] -= rest * (cell.M[i] / cell.total);
}

// sum V_m u_m of a pressure impulse of -1, u_m = 1/rho + w_m.
double Drag::inverse_inertia(const DragCell& cell) {
  const double together = 1.0 / cell.total;
  if (cell.count < 2) return together;
  double given[max_materials], sum = together;
  push(cell, -1.0, given);
  for (int n = 0; n < cell.count; ++n) sum += cell.V[n] * (given[n] / cell.M[n]);
  return larger(sum, together);
}

double Drag::energy(const DragCell& cell, const double* w) {
  double sum = 0;
  for (int i = 0; i < cell.count; ++i) sum += 0.5 * cell.M[i] * (w[i] * w[i]);
  return sum;
}

void find_present(int materials, const double* const* mass, const double* const* volume, int i,
                  DragCell& cell) {
  cell.count = 0;
  cell.total = 0;
  for (int m = 0; m < materials; ++m) {
    if (mass[m][i] == 0.0) continue;
    cell.index[cell.count] = m;
    cell.M[cell.count] = mass[m][i];
    cell.V[cell.count] = volume[m][i];
    cell.total += mass[m][i];
    ++cell.count;
  }
}

}  // namespace sluice::ice::mixture

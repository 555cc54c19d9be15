// The shares of the materials in what passes a face, step by step.
#include <algorithm>
#include <cmath>

#include "ice/mixture/face_donors.hpp"

namespace sluice::ice::mixture {
namespace {

constexpr double least_entry = 1e-16;    // of a cell's volume: what enters an empty cell
constexpr double least_rest = 1e-10;     // of a material's volume that may stay behind
constexpr double trace = 1e-10;          // differences of smaller fractions are not trusted
constexpr double interface_band = 0.01;  // distance from 0 and 1 within which there is an interface

// Compressive slope: the bound itself.
double sharp_slope(double dm, double dp, double B) {
  const double bound = smaller(B * std::fabs(dm), 2.0 * std::fabs(dp));
  return dm * dp > 0.0 ? std::copysign(bound, dm) : 0.0;
}

}  // namespace

MaterialHandles read_materials(TaskBuilder& task, const Variables& v, const SchemeOptions& o,
                               int axis) {
  const int direction = o.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0), four = Stencil::along(direction, 2, 1);
  const Stencil six = Stencil::along(direction, 3, 2);
  MaterialHandles h;
  for (const VariableId id : v.mass) h.mass.push_back(task.read(id, both));
  for (const VariableId id : v.volume) h.volume.push_back(task.read(id, six));
  h.density = task.read(v.density, four);
  h.specific_energy = task.read(v.specific_energy, four);
  h.energy_L = task.read(v.energy_L, both);
  h.specific_energy_L = task.read(v.specific_energy_L, both);
  h.scale = task.read(v.energy_scale, both);
  h.lagrangian = task.read(v.common.lagrangian_mixture, both);
  if (o.second_order && o.axes.count > 1)
    h.base = task.read(v.base[static_cast<std::size_t>(axis)], both);
  return h;
}

FaceShares::FaceShares(const Row& row, const RemapFluxHandles& common,
                       const MaterialHandles& materials, Out flux, const SchemeOptions& options,
                       int axis, double l)
    : row_(&row),
      common_(&common),
      materials_(&materials),
      options_(&options),
      flux_(flux),
      axis_(axis),
      n_(row.count()),
      count_(static_cast<int>(materials.volume.size())),
      based_(options.second_order && options.axes.count > 1),
      l_(l),
      uf_(row(common.face_velocity)),
      iJ_(cells(common.inverse_J)),
      N_(cells(common.courant)),
      iN_(cells(common.inverse_courant)),
      J_(cells(materials.lagrangian, 0)),
      outlets_(cells(materials.lagrangian, 2)) {
  if (options.masked) mask_ = cells(common.mask);
}

void FaceShares::propose_volumes() {
  for (int m = 0; m < count_; ++m) propose(m);
}

void FaceShares::propose(int m) {
  const In volume = materials_->volume[static_cast<std::size_t>(m)];
  const auto at = [&](int shift) { return (*row_)(volume, 0, axis_, shift); };
  const double *mmm = at(-3), *mm = at(-2), *a = at(-1), *b = at(0), *pp = at(1), *ppp = at(2);
  const Pair base = based_ ? cells(materials_->base, component(m, of_volume)) : Pair{a, b};
  double* __restrict share = theta(m);
  for (int i = 0; i < n_; ++i) {
    const double H = l_ * uf_[i];
    const bool left = H < 0.0;
    const double V = left ? b[i] : a[i];
    const double iN = iN_.at(i, left);
    double value = base.at(i, left);
    if (options_->second_order) {
      const double nu = std::fabs(H) * iJ_.at(i, left), B = 2.0 * iN;
      const double low = a[i] - mm[i], middle = b[i] - a[i], high = pp[i] - b[i];
      const double dm = left ? high : low, dp = middle;
      // Of the five cells around the donor.
      const double least = left ? std::min({mm[i], a[i], b[i], pp[i], ppp[i]})
                                : std::min({mmm[i], mm[i], a[i], b[i], pp[i]});
      const double most = left ? std::max({mm[i], a[i], b[i], pp[i], ppp[i]})
                               : std::max({mmm[i], mm[i], a[i], b[i], pp[i]});
      const bool sharp = least < interface_band || most > 1.0 - interface_band;
      const double S = sharp ? sharp_slope(dm, dp, B) : upwind_slope(dm, dp, nu, B);
      const double mask = options_->masked ? mask_.at(i, left) : 1.0;
      value += (left ? -0.5 : 0.5) * (1.0 - nu) * mask * S;
    }
    const double cap = smaller(1.0, V / larger(N_.at(i, left), 1e-12));
    share[i] = smaller(larger(value, 0.0), cap);
  }
}

// The sum is one up to round-off after one pass: the caps of the materials sum to one or more.
void FaceShares::close_volumes() {
  for (int i = 0; i < n_; ++i) {
    const bool left = l_ * uf_[i] < 0.0;
    const double inverse = 1.0 / larger(N_.at(i, left), 1e-12);
    double sum = 0, room = 0;
    for (int m = 0; m < count_; ++m) {
      const double share = theta(m)[i];
      sum += share;
      room += smaller(1.0, volume_of(m).at(i, left) * inverse) - share;
    }
    if (sum == 1.0) continue;
    const double fill = room > 0.0 ? (1.0 - sum) / room : 0.0;
    for (int m = 0; m < count_; ++m) {
      double& share = theta(m)[i];
      if (sum > 1.0)
        share /= sum;
      else
        share += fill * (smaller(1.0, volume_of(m).at(i, left) * inverse) - share);
    }
  }
}

void FaceShares::keep_traces_together() {
  for (int m = 0; m < count_; ++m) trace_rules(m);
  // The largest share takes what round-off and the rules left.
  for (int i = 0; i < n_; ++i) {
    int largest = 0;
    for (int m = 1; m < count_; ++m)
      if (theta(m)[i] > theta(largest)[i]) largest = m;
    double others = 0;
    for (int m = 0; m < count_; ++m)
      if (m != largest) others += theta(m)[i];
    theta(largest)[i] = 1.0 - others;
  }
}

void FaceShares::trace_rules(int m) {
  const Pair volume = volume_of(m);
  const Pair M = cells(materials_->mass[static_cast<std::size_t>(m)]);
  double* __restrict share = theta(m);
  double* __restrict takes_all = mass(m);
  for (int i = 0; i < n_; ++i) {
    const double flow = std::fabs(l_ * uf_[i]);
    const bool left = l_ * uf_[i] < 0.0;
    const double V = volume.at(i, left);
    takes_all[i] = 0.0;
    if (V == 1.0 || V == 0.0) continue;  // a donor with one material
    const bool empty_receiver = (left ? M.a : M.b)[i] == 0.0;
    if (empty_receiver && flow * share[i] < least_entry) share[i] = 0.0;
    const double V_L = V * J_.at(i, left);
    const double rest = V_L - flow * share[i];
    if (share[i] > 0.0 && flow > 0.0 && outlets_.at(i, left) == 1.0 &&
        rest <= larger(least_entry, least_rest * V_L)) {
      share[i] = V_L / flow;
      takes_all[i] = 1.0;
    }
  }
}

void FaceShares::carry_mass_and_energy() {
  for (int m = 0; m < count_; ++m) carry(m);
}

void FaceShares::carry(int m) {
  const Pair volume = volume_of(m);
  const Pair M = cells(materials_->mass[static_cast<std::size_t>(m)]);
  const Pair E_L = cells(materials_->energy_L, m), eps_L = cells(materials_->specific_energy_L, m);
  const Pair scale = cells(materials_->scale, m), rho = cells(materials_->density, m);
  const Pair base_rho = based_ ? cells(materials_->base, component(m, of_mass)) : Pair{};
  const Pair base_eps = based_ ? cells(materials_->base, component(m, of_energy)) : Pair{};
  const auto rows = [&](In in, int c) { return around(*row_, in, c, axis_); };
  const Around V = rows(materials_->volume[static_cast<std::size_t>(m)], 0);
  const Around r = rows(materials_->density, m), e = rows(materials_->specific_energy, m);
  double *FV = theta(m), *FM = mass(m), *FE = energy(m);
  for (int i = 0; i < n_; ++i) {
    const double H = l_ * uf_[i];
    const bool left = H < 0.0;
    const double share = FV[i];
    if (share == 0.0) {
      FV[i] = FM[i] = FE[i] = 0.0;
      continue;
    }
    const double here = volume.at(i, left);
    if (FM[i] != 0.0) {  // takes all
      const double sign = left ? -1.0 : 1.0;
      FV[i] = sign * here * J_.at(i, left);
      FM[i] = sign * M.at(i, left);
      FE[i] = sign * E_L.at(i, left);
      continue;
    }
    const double iJ = iJ_.at(i, left), N = N_.at(i, left), iN = iN_.at(i, left);
    const double rho_L = rho.at(i, left) * iJ, e_L = eps_L.at(i, left);
    double rho_s = based_ ? base_rho.at(i, left) : rho_L;
    double eps_s = based_ ? base_eps.at(i, left) : e_L;
    if (options_->second_order) {
      const double nu = std::fabs(H) * iJ;
      const bool full = left ? V.m[i] > trace && V.p[i] > trace && V.pp[i] > trace
                             : V.mm[i] > trace && V.m[i] > trace && V.p[i] > trace;
      const double mask = options_->masked ? mask_.at(i, left) : 1.0;
      const double weight = full ? (left ? -0.5 : 0.5) * (1.0 - nu) * iJ * mask : 0.0;
      rho_s += weight * donor_slope(r, i, left, nu, 2.0 * iN);
      eps_s += weight * donor_slope(e, i, left, nu, 2.0);
    }
    const double sc = scale.at(i, left);
    if (here == 1.0) {  // caps of one material
      rho_s = smaller(larger(rho_s, 0.1 * rho_L), rho_L * (0.95 + 0.05 * N) * iN);
      eps_s = smaller(larger(eps_s, e_L - 0.9 * sc), e_L + sc * ((0.75 + 0.25 * N) * iN - 1.0));
    } else {
      const double phi = N * share / here;
      const double q = smaller(0.9, 0.5 * larger(0.0, 1.0 - phi) / larger(phi, 0.05));
      rho_s = smaller(larger(rho_s, rho_L * (1.0 - q)), rho_L * (1.0 + q));
      eps_s = smaller(larger(eps_s, e_L - q * sc), e_L + q * sc);
    }
    FV[i] = H * share;
    FM[i] = FV[i] * rho_s;
    FE[i] = FV[i] * eps_s;
  }
}

}  // namespace sluice::ice::mixture

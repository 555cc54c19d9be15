// Fine cells from coarse ones: a limited polynomial in each coarse cell.
//
//   q(x) = q + sum_d s_d x_d [+ sum_d c_d (x_d^2 - 1/12)/2 + sum_de s_de x_d x_e],  |x_d| < 1/2
// for mass, momentum and internal energy; a fine cell gets the mean over itself. Order 1 has slopes
// s = L3 (limiters.hpp). Order 2 adds curvature and cross terms, which fade where the data are not
// smooth: |c_d| <= B_d, |s_de| <= min(B_d, B_e), B = 2 min(|a|,|b|) - max(|a|,|b|) or 0, a and b
// the one-sided differences. All this is homogeneous: where velocity is uniform, momentum varies
// with the density, and where pressure is uniform, it stays so.
//
// Positivity: the terms of mass and momentum are scaled alike, so that no fine density lies below a
// quarter of the coarse one; the terms of energy for themselves.
// Total energy: with w(x) = m(x) - U rho(x), U = m/rho, the fine cells have more kinetic energy
// than the coarse one by K = < |w|^2/(2 rho) >: E(x) is multiplied by 1 - K/E. Where K would take
// more than half of E, w is made smaller.
// Laws whose energy may have any sign: E stands for (p + pi)/G, how far the energy is from where
// the law ends (closure_rows.hpp). A coarse cell with a fine one outside of the law stays constant.
//
// Scalars f that are carried by volume: the amount rho (f - f0) has such a polynomial too, f0 that
// of the coarse cell, and all terms are scaled alike, so that no fine cell lies beyond the values
// around. At one pressure and temperature density, energy and amount are linear in each other: so
// are their limited terms, and the fine cells have that pressure and temperature.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/grid/box_list.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/levels/child_rows.hpp"
#include "ice/levels/coarse_lines.hpp"
#include "ice/levels/gas_transfer.hpp"
#include "ice/levels/limited_polynomial.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

constexpr int max_prolonged_scalars = 2;  // of those that are carried by volume

// Made once for each number of axes and each order: components of momentum and scalars that are
// carried by volume are counted at run time, outside of the loops over cells.
template <int D, int Order>
class Prolonger {
  // threshold: smallest share of the density and energy of a coarse cell that slopes leave to its
  //   fine cells; unit: 1; test: Prolongation.KeepsMassMomentumAndTotalEnergyOfWildStates
  static constexpr double min_kept = 0.25;
  // threshold: largest kinetic energy of velocity differences among fine cells, relative to the
  //   internal energy; unit: 1; test: Prolongation.KeepsMassMomentumAndTotalEnergyOfWildStates
  static constexpr double max_kinetic = 0.5;
  static constexpr int width = D == 3 ? 16 : 64;
  static constexpr int max_components = 3,
                       max_quantities = max_components + 2 + max_prolonged_scalars;
  using Functions = PolynomialBasis<D, Order>;
  using Lines = CoarseLines<D, width>;

 public:
  Prolonger(std::span<const Prolongation> regions, const TransferGeometry& geometry,
            const Children& children, int components, const Fluid& fluid,
            std::span<const std::size_t> by_volume)
      : components_(components),
        energy_at_(components + 1),
        quantities_(components + 2),
        scalars_(static_cast<int>(by_volume.size())),
        fluid_(fluid),
        ideal_(fluid.gamma_law() != nullptr),
        regions_(regions),
        ratio_(geometry.ratio),
        children_(children),
        basis_(children),
        lines_(regions, children.axes()),
        rows_of_children_(regions, children),
        by_volume_(by_volume) {
    std::fill_n(ones_, width, 1.0);
    std::fill_n(nothing_, width, -0.0);
  }

  void run() {
    const auto run_batch = [&](const Batch<width>& batch) { run(batch); };
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (regions_[r].cells.empty()) continue;
      const IndexBox parents = coarsen(regions_[r].cells, ratio_);
      batch_.add(r, parents, longest_direction(parents, children_.axes()), run_batch);
    }
    batch_.flush(run_batch);
  }

 private:
  // The coarse cells of a batch.
  void run(const Batch<width>& batch) {
    const int n = batch.padded();
    lines_.find(batch);
    for (int s = 0; s < scalars_; ++s) find_range(s, batch);
    for (int q = 0; q < quantities_ + scalars_; ++q) find_terms(q, batch);
    if (!ideal_) set_energy_aside(n);
    keep_positive(n);
    take_kinetic_energy(n);
    if (!ideal_) withdraw_inadmissible(n);
    if (children_.ratio(0) == 4)
      emit<4>(batch);
    else if (children_.ratio(0) == 2)
      emit<2>(batch);
    else
      emit<1>(batch);
  }

  std::size_t view(int q) const {
    return q < quantities_ ? static_cast<std::size_t>(q) : by_volume_[q - quantities_];
  }
  // The coarse cells of a batch and their neighbours, or cells shifted along two axes; of a scalar
  // its amount.
  [[gnu::noinline]] void gather_star(int q, const Batch<width>& batch, double (*to)[width]) const {
    lines_.gather_star(view(q), batch, to);
    if (q < quantities_) return;
    double mass[Lines::star][width];
    lines_.gather_star(0, batch, mass);
    for (int k = 0; k < Lines::star; ++k) take_amount(q - quantities_, batch, mass[k], to[k]);
  }
  [[gnu::noinline]] void gather(int q, const Batch<width>& batch, int axis, int shift, int other,
                                int move, double* to) const {
    lines_.gather(view(q), batch, axis, shift, other, move, to);
    if (q < quantities_) return;
    double mass[width];
    lines_.gather(0, batch, axis, shift, other, move, mass);
    take_amount(q - quantities_, batch, mass, to);
  }
  void take_amount(int s, const Batch<width>& batch, const double* mass, double* scalar) const {
    for (int i = 0; i < batch.padded(); ++i) scalar[i] = mass[i] * (scalar[i] - scalar_[s][i]);
  }

  // The scalar of the coarse cells, and its lowest and highest value around.
  void find_range(int s, const Batch<width>& batch) {
    const int n = batch.padded();
    double star[Lines::star][width];
    lines_.gather_star(by_volume_[s], batch, star);
    for (double* of : {scalar_[s], lowest_[s], highest_[s]}) std::copy(star[0], star[0] + n, of);
    for (int k = 1; k < Lines::star; ++k)
      for (int i = 0; i < n; ++i) {
        lowest_[s][i] = smaller(lowest_[s][i], star[k][i]);
        highest_[s][i] = larger(highest_[s][i], star[k][i]);
      }
  }

  // With a call for every slope this takes thrice as long.
  [[gnu::flatten]] void find_terms(int q, const Batch<width>& batch) {
    const int n = batch.padded();
    double smooth[D][width], star[Lines::star][width];
    gather_star(q, batch, star);
    const double* __restrict m = star[0];
    for (int i = 0; i < n; ++i) centre_[q][i] = m[i];
    for (int a = 0; a < D; ++a) {
      const double *low = star[1 + 2 * a], *high = star[2 + 2 * a];
      double* __restrict slope = term_[q][a];
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) slope[i] = central_slope(m[i] - low[i], high[i] - m[i]);
      if constexpr (Order == 2) {
        double* __restrict curve = term_[q][D + a];
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          const double below = m[i] - low[i], above = high[i] - m[i];
          smooth[a][i] = smoothness(below, above);
          curve[i] = bounded(above - below, smooth[a][i]);
        }
      }
    }
    for (int p = 0; p < Functions::pairs; ++p) {
      const int a = pair_axes[p][0], b = pair_axes[p][1];
      double corner[4][width];
      for (int k = 0; k < 4; ++k)
        gather(q, batch, a, k < 2 ? -1 : 1, b, k % 2 == 0 ? -1 : 1, corner[k]);
      const auto& [mm, mp, pm, pp] = corner;
      double* cross = term_[q][2 * D + p];
#pragma GCC ivdep
      for (int i = 0; i < n; ++i)
        cross[i] = bounded(0.25 * ((pp[i] + mm[i]) - (pm[i] + mp[i])),
                           smaller(smooth[a][i], smooth[b][i]));
    }
  }

  // From here on the energy above that at which the law ends is in the energy's place.
  void set_energy_aside(int n) {
    std::copy(centre_[energy_at_], centre_[energy_at_] + n, energy_);
    energy_scale_row(fluid_, n, centre_[0], energy_, centre_[energy_at_]);
  }
  double fine_energy(double change, int i) const {
    return energy_[i] + (change * rest_[i] - centre_[energy_at_][i] * (1.0 - rest_[i]));
  }
  // No terms in cells with a child that is no state of the law.
  void withdraw_inadmissible(int n) {
    double rho[width], E[width], admissible[width], kept[width];
    for (int i = 0; i < n; ++i) kept[i] = 1.0;
    for (int child = 0; child < children_.count(); ++child) {
      const double* f = basis_.value[child];
      for (int i = 0; i < n; ++i) {
        rho[i] = centre_[0][i] + deviation(term_[0], f, i);
        E[i] = fine_energy(deviation(term_[energy_at_], f, i), i);
      }
      admissible_row(fluid_, n, rho, E, admissible);
      for (int i = 0; i < n; ++i) kept[i] = smaller(kept[i], admissible[i]);
    }
    for (int i = 0; i < n; ++i) rest_[i] = kept[i] > 0.0 ? rest_[i] : 1.0;
    for (int q = 0; q < quantities_; ++q) scale(q, n, kept);
  }

  // Factor for the terms of q that keeps every fine value above a share of the coarse one.
  [[gnu::noinline]] void find_factor(int q, int n, double* __restrict factor) const {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      double deepest = 0;
      for (int k = 0; k < Functions::terms; ++k)
        deepest += std::fabs(term_[q][k][i]) * basis_.most[k];
      const double room = (1.0 - min_kept) * centre_[q][i];
      factor[i] = deepest > room ? larger(0.0, room) / deepest : 1.0;
    }
  }
  [[gnu::noinline]] void scale(int q, int n, const double* __restrict factor) {
    for (int k = 0; k < Functions::terms; ++k)
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) term_[q][k][i] *= factor[i];
  }
  // For all terms: no child has more or less of a scalar than the cells around.
  void keep_between(int s, int n, double* __restrict factor) const {
    for (int child = 0; child < children_.count(); ++child) {
      const double* f = basis_.value[child];
      for (int i = 0; i < n; ++i) {
        const double rho = centre_[0][i], change = deviation(term_[0], f, i);
        const double amount = deviation(term_[quantities_ + s], f, i);
        const double above = highest_[s][i] - scalar_[s][i], below = scalar_[s][i] - lowest_[s][i];
        const double up = amount - above * change, down = -amount - below * change;
        if (up > above * rho) factor[i] = smaller(factor[i], above * rho / up);
        if (down > below * rho) factor[i] = smaller(factor[i], below * rho / down);
      }
    }
  }
  void keep_positive(int n) {
    double factor[width];
    if (scalars_ > 0) {
      double of_energy[width];
      find_factor(0, n, factor);
      find_factor(energy_at_, n, of_energy);
      for (int i = 0; i < n; ++i) factor[i] = smaller(factor[i], of_energy[i]);
      for (int s = 0; s < scalars_; ++s) keep_between(s, n, factor);
      for (int q = 0; q < quantities_ + scalars_; ++q) scale(q, n, factor);
      return;
    }
    find_factor(0, n, factor);
    for (int q = 0; q <= components_; ++q) scale(q, n, factor);
    find_factor(energy_at_, n, factor);
    scale(energy_at_, n, factor);
  }

  // What the polynomial adds in a child.
  template <class Terms>
  static double deviation(const Terms& term, const double* f, int i) {
    return Functions::sum([&](int k) { return term[k][i] * f[k]; });
  }

  void take_kinetic_energy(int n) {
    double U[max_components][width];
    for (int c = 0; c < components_; ++c) {
      for (int i = 0; i < n; ++i) U[c][i] = centre_[1 + c][i] / centre_[0][i];
      for (int k = 0; k < Functions::terms; ++k)
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) w_[c][k][i] = term_[1 + c][k][i] - U[c][i] * term_[0][k][i];
    }
    for (int child = 0; child < children_.count(); ++child) {
      const double* f = basis_.value[child];
      double* __restrict kinetic = rows_[child];
      for (int i = 0; i < n; ++i) kinetic[i] = 0;
      for (int c = 0; c < components_; ++c)
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          const double w = deviation(w_[c], f, i);
          kinetic[i] += w * w;
        }
#pragma GCC ivdep
      for (int i = 0; i < n; ++i)
        kinetic[i] = 0.5 * kinetic[i] / (centre_[0][i] + deviation(term_[0], f, i));
    }
    children_.mean(rows_, n);
    double share[width];
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double K = rows_[0][i], E = centre_[energy_at_][i];
      const double room = larger(0.0, max_kinetic * E);
      share[i] = K > room ? std::sqrt(room / K) : 1.0;
      rest_[i] = K > 0.0 ? 1.0 - smaller(K, room) / E : 1.0;
    }
    for (int c = 0; c < components_; ++c)
      for (int k = 0; k < Functions::terms; ++k)
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          // U rho(x) + share w(x): of a small share nothing large may be subtracted.
          const double reduced = U[c][i] * term_[0][k][i] + share[i] * w_[c][k][i];
          term_[1 + c][k][i] = share[i] < 1.0 ? reduced : term_[1 + c][k][i];
        }
  }

  // row[i * Each + x] = f(i, what the polynomial of q adds there): child x on from `child` of
  // cell i.
  template <int Each, class F>
  void for_row(int q, int child, int n, double* __restrict row, F&& f) const {
    double of[Functions::terms][Each];
    for (int x = 0; x < Each; ++x)
      for (int k = 0; k < Functions::terms; ++k) of[k][x] = basis_.value[child + x][k];
    const auto& term = term_[q];
#pragma GCC ivdep
    for (int i = 0; i < n; ++i)
      for (int x = 0; x < Each; ++x)
        row[i * Each + x] = f(i, Functions::sum([&](int k) { return term[k][i] * of[k][x]; }));
  }
  // (centre + what is added) times factor: one loop for all that can be written so, each of its
  // bodies is dear to compile.
  template <int Each>
  [[gnu::noinline]] void find_scaled_row(int q, int child, int n, const double* __restrict centre,
                                         const double* __restrict factor, double* row) const {
    for_row<Each>(q, child, n, row,
                  [=](int i, double change) { return (centre[i] + change) * factor[i]; });
  }
  // A row of children of all cells of a batch.
  template <int Each>
  void find_row(int q, int child, int n, double* row) const {
    if (q > energy_at_)
      find_scalar_row<Each>(q - quantities_, child, n, row);
    else if (q < energy_at_ || ideal_)
      find_scaled_row<Each>(q, child, n, centre_[q], q < energy_at_ ? ones_ : rest_, row);
    else
      for_row<Each>(q, child, n, row,
                    [this](int i, double change) { return fine_energy(change, i); });
  }
  // f0 + amount/rho; of round-off alone beyond the values around.
  template <int Each>
  void find_scalar_row(int s, int child, int n, double* row) const {
    double mass[width * Each];
    find_scaled_row<Each>(0, child, n, centre_[0], ones_, mass);
    find_scaled_row<Each>(quantities_ + s, child, n, nothing_, ones_, row);
    for (int i = 0; i < n; ++i)
      for (int k = i * Each; k < (i + 1) * Each; ++k)
        row[k] = larger(smaller(scalar_[s][i] + row[k] / mass[k], highest_[s][i]), lowest_[s][i]);
  }
  // The fine cells that are asked for.
  template <int Each>
  void emit(const Batch<width>& batch) {
    double row[width * Each];
    for (int z = 0; z < children_.ratio(2); ++z)
      for (int y = 0; y < children_.ratio(1); ++y) {
        if (!rows_of_children_.find(batch, y, z)) continue;
        for (int q = 0; q < quantities_ + scalars_; ++q) {
          find_row<Each>(q, children_.number(0, y, z), batch.padded(), row);
          rows_of_children_.write(view(q), row);
        }
      }
  }

  int components_, energy_at_, quantities_, scalars_;
  const Fluid& fluid_;
  bool ideal_;
  std::span<const Prolongation> regions_;
  IntVec3 ratio_;
  const Children& children_;
  Functions basis_;
  Batch<width> batch_;
  Lines lines_;
  ChildRows<D, width> rows_of_children_;
  std::span<const std::size_t> by_volume_;
  double centre_[max_quantities][width];
  double term_[max_quantities][Functions::terms][width];
  double scalar_[max_prolonged_scalars][width], lowest_[max_prolonged_scalars][width],
      highest_[max_prolonged_scalars][width];
  double w_[max_components][Functions::terms][width];  // terms of momentum about the mean velocity
  double rest_[width];                                 // share of the internal energy that stays
  double energy_[width];                               // of the coarse cells; not of an ideal gas
  double rows_[Children::max_in(D)][width];
  double ones_[width], nothing_[width];  // to add -0.0 changes no bit
};

}  // namespace sluice::ice

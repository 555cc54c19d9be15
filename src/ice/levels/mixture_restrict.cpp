// Coarse cells as means of their fine cells, material by material.
//
//   M = <M_f>,  V = <V_f>,  P = <P_f>,  E = <E_f> + H M/rho,  H = <rho_f |u_f - U|^2>/2,  U = P/rho
// With velocities of their own, S_m = <M_f u_f + S_f> - M U, and <|S_f|^2/2M_f> - |S_m|^2/2M
// joins H.
// with rho the mass of all materials. Of one material the numbers are those of a gas, to the bit.
// At uniform pressure the mean energy per mean volume of a material is that of the pressure again
// if its law is linear in rho e with a constant offset (ideal and stiffened gases).
#include <algorithm>

#include "ice/levels/children.hpp"
#include "ice/levels/mixture_transfer.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {
namespace {

template <int D>
class MixtureRestrictor {
 public:
  static constexpr int width = D == 3 ? 16 : 64, max_components = 3;

  MixtureRestrictor(const StateViews& fine, const StateViews& coarse, const Children& children,
                    int along, const MixtureLayout& layout)
      : fine_(fine),
        coarse_(coarse),
        children_(children),
        along_(along),
        layout_(layout),
        present_(layout.materials) {}

  // n coarse cells along the line.
  void run(IntVec3 first, int n) {
    add_masses(first, n);
    double U[max_components][width];
    for (std::size_t c = 0; c < layout_.components; ++c) {
      gather(layout_.momentum(c), first, n, momentum_[c]);
      mean(momentum_[c], n);
      write(layout_.momentum(c), first, n, rows_[0]);
      for (int i = 0; i < n; ++i) U[c][i] = rows_[0][i] * (1.0 / mean_rho_[i]);
    }
    double heat[width];
    lost_kinetic_energy(U, n, heat);
    if (layout_.multi_velocity)
      for (std::size_t m = 0; m < layout_.materials; ++m) restrict_slip(m, first, n, U, heat);
    for (std::size_t m = 0; m < layout_.materials; ++m) finish(m, first, n, heat);
  }

 private:
  using Rows = double[Children::max_in(D)][width];

  [[gnu::noinline]] void gather(std::size_t q, IntVec3 first, int n, Rows& rows) const {
    children_.gather<D>(fine_[q], along_, first, n, rows);
  }
  // Into rows_[0].
  [[gnu::noinline]] void mean(const Rows& rows, int n) {
    for (int child = 0; child < children_.count(); ++child)
      std::copy(rows[child], rows[child] + n, rows_[child]);
    children_.mean(rows_, n);
  }
  [[gnu::noinline]] void write(std::size_t q, IntVec3 first, int n, const double* values) const {
    const RealView& v = coarse_[q];
    double* to = v.data + v.offset(first);
    const std::ptrdiff_t step = v.stride[along_];
    for (int i = 0; i < n; ++i) to[i * step] = values[i];
  }
  [[gnu::noinline]] bool any(const Rows& rows, int n) const {
    for (int child = 0; child < children_.count(); ++child)
      for (int i = 0; i < n; ++i)
        if (rows[child][i] != 0.0) return true;
    return false;
  }

  // Means of the masses, and the mass of all materials in the fine and the coarse cells.
  void add_masses(IntVec3 first, int n) {
    for (int child = 0; child < children_.count(); ++child)
      std::fill(rho_[child], rho_[child] + n, 0.0);
    std::fill(mean_rho_, mean_rho_ + n, 0.0);
    for (std::size_t m = 0; m < layout_.materials; ++m) {
      gather(layout_.mass(m), first, n, rows_);
      present_[m] = any(rows_, n);
      if (present_[m]) {
        for (int child = 0; child < children_.count(); ++child)
          for (int i = 0; i < n; ++i) rho_[child][i] += rows_[child][i];
        children_.mean(rows_, n);
        for (int i = 0; i < n; ++i) mean_rho_[i] += rows_[0][i];
      }
      write(layout_.mass(m), first, n, rows_[0]);
    }
  }

  void lost_kinetic_energy(const double (*U)[width], int n, double* heat) {
    for (int child = 0; child < children_.count(); ++child) {
      double* __restrict lost = rows_[child];
      const double* __restrict rho = rho_[child];
      for (int i = 0; i < n; ++i) lost[i] = 0;
      for (std::size_t c = 0; c < layout_.components; ++c)
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          const double du = momentum_[c][child][i] * (1.0 / rho[i]) - U[c][i];
          lost[i] += du * du;
        }
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) lost[i] = 0.5 * rho[i] * lost[i];
    }
    children_.mean(rows_, n);
    std::copy(rows_[0], rows_[0] + n, heat);
  }

  // Slip of a material; what its kinetic energy loses joins `heat`.
  void restrict_slip(std::size_t m, IntVec3 first, int n, const double (*U)[width], double* heat) {
    double zero[width] = {};
    if (!present_[m]) {
      for (std::size_t c = 0; c < layout_.components; ++c)
        write(layout_.slip(m, c), first, n, zero);
      return;
    }
    Rows M, S, sum;
    gather(layout_.mass(m), first, n, M);
    double lost[width] = {};
    const RealView& mass = coarse_[layout_.mass(m)];
    const double* mean_M = mass.data + mass.offset(first);
    const std::ptrdiff_t step = mass.stride[along_];
    for (std::size_t c = 0; c < layout_.components; ++c) {
      gather(layout_.slip(m, c), first, n, S);
      for (int child = 0; child < children_.count(); ++child)
        for (int i = 0; i < n; ++i) {
          const double own = M[child][i], s = S[child][i];
          const double u = momentum_[c][child][i] / rho_[child][i] - U[c][i];
          sum[child][i] = own == rho_[child][i] ? own * u : own * u + s;
          rows_[child][i] = own > 0.0 ? 0.5 * (s * s) / own : 0.0;
        }
      children_.mean(rows_, n);
      children_.mean(sum, n);
      for (int i = 0; i < n; ++i) {
        const bool alone = mean_M[i * step] == mean_rho_[i] || !(mean_M[i * step] > 0.0);
        if (alone) sum[0][i] = 0.0;
        // One term a component: the order of two components does not show.
        const double left = alone ? 0.0 : 0.5 * (sum[0][i] * sum[0][i]) / mean_M[i * step];
        lost[i] += rows_[0][i] - left;
      }
      write(layout_.slip(m, c), first, n, sum[0]);
    }
    for (int i = 0; i < n; ++i) heat[i] += lost[i];
  }

  // Energy and volume of a material.
  void finish(std::size_t m, IntVec3 first, int n, const double* heat) {
    double row[width] = {};
    if (!present_[m]) {
      write(layout_.energy(m), first, n, row);
      write(layout_.volume(m), first, n, row);
      return;
    }
    gather(layout_.volume(m), first, n, rows_);
    children_.mean(rows_, n);
    write(layout_.volume(m), first, n, rows_[0]);
    gather(layout_.energy(m), first, n, rows_);
    children_.mean(rows_, n);
    const RealView& mass = coarse_[layout_.mass(m)];
    const double* M = mass.data + mass.offset(first);
    const std::ptrdiff_t step = mass.stride[along_];
    for (int i = 0; i < n; ++i) row[i] = rows_[0][i] + heat[i] * (M[i * step] / mean_rho_[i]);
    write(layout_.energy(m), first, n, row);
  }

  const StateViews& fine_;
  const StateViews& coarse_;
  const Children& children_;
  int along_;
  const MixtureLayout& layout_;
  std::vector<char> present_;  // somewhere in the line
  Rows rho_, momentum_[max_components], rows_;
  double mean_rho_[width];
};

}  // namespace

void MixtureTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                                  const IndexBox& coarse_cells,
                                  const TransferGeometry& geometry) const {
  if (coarse_cells.empty()) return;
  const Children children(geometry);
  const int along = longest_direction(coarse_cells, children.axes());
  const auto on_axes = [&]<int D>() {
    using Lines = MixtureRestrictor<D>;
    Lines lines(fine, coarse, children, along, layout_);
    for_each_line(coarse_cells, along, Lines::width,
                  [&](IntVec3 first, int n) { lines.run(first, n); });
  };
  switch (children.axes().count) {
    case 1:
      return on_axes.template operator()<1>();
    case 2:
      return on_axes.template operator()<2>();
    default:
      return on_axes.template operator()<3>();
  }
}

}  // namespace sluice::ice

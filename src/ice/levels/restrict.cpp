// Coarse cells as means of their fine cells.
//
//   rho = <rho_f>,  m = <m_f>,  E = <E_f> + <rho_f |u_f - U|^2>/2,   U = m/rho
// Mass, momentum and total energy are kept exactly; the kinetic energy that the mean loses is the
// variance of the velocity, computed as such: nothing large is subtracted.
#include <algorithm>

#include "ice/levels/children.hpp"
#include "ice/levels/gas_transfer.hpp"
#include "ice/levels/row_mean.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {
namespace {

template <int D, int C>
class Restrictor {
 public:
  Restrictor(const StateViews& fine, const StateViews& coarse, const Children& children)
      : fine_(fine),
        coarse_(coarse),
        axes_(children.axes()),
        ratio_{children.ratio(0), children.ratio(1), children.ratio(2)},
        average_(ratio_) {}

  static constexpr int width = D == 3 ? 16 : 64;

  // n coarse cells from `first` on along the row.
  void run(IntVec3 first, int n) {
    double* mean[quantities];
    for (int q = 0; q < quantities; ++q) {
      const RealView& to = coarse_[q];
      mean[q] = to.data + to.offset(first);
      find_rows(fine_[q], first, rows_[q]);
      average_(rows_[q], n, mean[q]);
    }
    const double* const* heat = lost_kinetic_energy(mean, n);
    double mean_heat[width];
    average_(heat, n, mean_heat);
    for (int i = 0; i < n; ++i) mean[1 + C][i] += mean_heat[i];
  }

 private:
  static constexpr int quantities = C + 2;
  using Average = RowMean<D, width>;

  // The rows of fine cells above coarse ones.
  void find_rows(const RealView& v, IntVec3 first, const double** rows) const {
    IntVec3 corner = first;
    for (int a = 0; a < D; ++a) corner[axes_.direction[a]] *= ratio_[a];
    const double* low = v.data + v.offset(corner);
    for (int z = 0; z < ratio_[2]; ++z)
      for (int y = 0; y < ratio_[1]; ++y)
        rows[y + ratio_[1] * z] = low + (D > 1 ? y * v.stride[axes_.direction[1]] : 0) +
                                  (D > 2 ? z * v.stride[axes_.direction[2]] : 0);
  }

  // rho_f |u_f - U|^2 / 2, as rows.
  const double* const* lost_kinetic_energy(double* const* mean, int n) {
    const int m = average_.row_length(n);
    for (int c = 0; c < C; ++c)
      for (int i = 0; i < n; ++i) {
        const double U = mean[1 + c][i] * (1.0 / mean[0][i]);
        std::fill_n(U_[c] + i * ratio_[0], ratio_[0], U);
      }
    for (int r = 0; r < average_.rows(); ++r) {
      const double* __restrict rho = rows_[0][r];
      double* __restrict heat = heat_[r];
      for (int i = 0; i < m; ++i) {
        const double w = 1.0 / rho[i];
        double square = 0;
        for (int c = 0; c < C; ++c) {
          const double du = rows_[1 + c][r][i] * w - U_[c][i];
          square += du * du;
        }
        heat[i] = 0.5 * rho[i] * square;
      }
      heat_rows_[r] = heat;
    }
    return heat_rows_;
  }

  const StateViews& fine_;
  const StateViews& coarse_;
  Axes axes_;
  int ratio_[3];
  Average average_;
  const double* rows_[quantities][Average::max_rows];  // of fine cells, by quantity
  const double* heat_rows_[Average::max_rows];
  double heat_[Average::max_rows][Average::longest_row];
  double U_[C][Average::longest_row];
};

}  // namespace

void IceTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                              const IndexBox& coarse_cells,
                              const TransferGeometry& geometry) const {
  if (coarse_cells.empty()) return;
  const Children children(geometry);
  dispatch(children.axes().count, components_, [&]<int D, int C>() {
    using Line = Restrictor<D, C>;
    Line line(fine, coarse, children);
    for_each_line(coarse_cells, children.axes().direction[0], Line::width,
                  [&](IntVec3 first, int n) { line.run(first, n); });
  });
}

}  // namespace sluice::ice

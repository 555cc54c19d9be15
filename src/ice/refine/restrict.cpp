// Coarse cells as means of their fine cells.
//
//   rho = <rho_f>,  m = <m_f>,  E = <E_f> + <rho_f |u_f - U|^2>/2,   U = m/rho
// Mass, momentum and total energy are kept exactly; the kinetic energy that the mean loses is the
// variance of the velocity, computed as such: nothing large is subtracted.
#include <algorithm>

#include "ice/conservative/variables.hpp"
#include "ice/refine/children.hpp"
#include "ice/refine/ice_transfer.hpp"

namespace sluice::ice {
namespace {

template <int D, int C>
class Restrictor {
 public:
  Restrictor(const StateViews& fine, const StateViews& coarse, const Children& children, int along)
      : fine_(fine), coarse_(coarse), children_(children), along_(along) {}

  static constexpr int width = D == 3 ? 16 : 64;

  // The coarse cells of a batch.
  void run(const Batch<width>& batch) {
    const int n = batch.padded();
    double mean[quantities][width];
    for (int q = 0; q < quantities; ++q) {
      gather(q, batch);
      children_.mean(values_[q], rows_, n);
      std::copy_n(rows_[0], n, mean[q]);
    }
    add_heat(mean, n);
    for (int q = 0; q < quantities; ++q) {
      const RealView& v = coarse_[static_cast<std::size_t>(q)];
      const std::ptrdiff_t step = v.stride[along_];
      for (const LinePart& line : batch.parts()) {
        double* to = v.data + v.offset(line.first);
        for (int i = 0; i < line.count; ++i) to[i * step] = mean[q][line.place + i];
      }
    }
  }

 private:
  static constexpr int quantities = C + 2;

  void gather(int q, const Batch<width>& batch) {
    auto& rows = values_[q];
    for (const LinePart& line : batch.parts())
      children_.gather<D>(fine_[static_cast<std::size_t>(q)], along_, line.first, line.count, rows,
                          line.place);
    for (int child = 0; child < children_.count(); ++child) batch.repeat_last(rows[child]);
  }

  void add_heat(double (&mean)[quantities][width], int n) {
    double U[C][width];
    for (int c = 0; c < C; ++c)
      for (int i = 0; i < n; ++i) U[c][i] = mean[1 + c][i] * (1.0 / mean[0][i]);
    for (int child = 0; child < children_.count(); ++child) {
      double* __restrict heat = rows_[child];
      const double* __restrict rho = values_[0][child];
      const double* m[C];
      for (int c = 0; c < C; ++c) m[c] = values_[1 + c][child];
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const double w = 1.0 / rho[i];
        double square = 0;
        for (int c = 0; c < C; ++c) {
          const double du = m[c][i] * w - U[c][i];
          square += du * du;
        }
        heat[i] = 0.5 * rho[i] * square;
      }
    }
    children_.mean(rows_, n);
    for (int i = 0; i < n; ++i) mean[1 + C][i] += rows_[0][i];
  }

  const StateViews& fine_;
  const StateViews& coarse_;
  const Children& children_;
  int along_;
  double values_[quantities][Children::most_in(D)][width];
  double rows_[Children::most_in(D)][width];
};

}  // namespace

void IceTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                              const IndexBox& coarse_cells,
                              const TransferGeometry& geometry) const {
  if (coarse_cells.empty()) return;
  const Children children(geometry);
  const int along = longest_direction(coarse_cells, children.axes());
  dispatch(children.axes().count, components_, [&]<int D, int C>() {
    using Line = Restrictor<D, C>;
    Line line(fine, coarse, children, along);
    Batch<Line::width> batch;
    const auto run = [&](const auto& full) { line.run(full); };
    batch.add(0, coarse_cells, along, run);
    batch.flush(run);
  });
}

}  // namespace sluice::ice

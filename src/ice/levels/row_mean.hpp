// Means of fine cells over coarse ones, on whole rows along the first active direction.
//
// Cells are halved, along all axes of the largest ratio that is left at once, until one is left;
// opposite parts are added first, as Children does: the same bits, without sorting by child.
#pragma once
#include <algorithm>

namespace sluice::ice {

template <int D, int Width>
class RowMean {
 public:
  static constexpr int max_rows = 1 << 2 * (D - 1);
  static constexpr int longest_row = 4 * Width;

  // Ratios by axis: 1, 2 or 4.
  explicit RowMean(const int (&ratio)[3]) { std::copy_n(ratio, 3, ratio_); }

  int rows() const { return ratio_[1] * ratio_[2]; }
  // Of the fine cells over `cells` coarse ones.
  int row_length(int cells) const { return ratio_[0] * cells; }

  // mean[i] of the children of n coarse cells; fine[y + ratio * z] are the rows above them. Of any
  // quantity, in its unit.
  void operator()(const double* const* fine, int n, double* mean) {
    const double* part[max_rows];
    std::copy_n(fine, rows(), part);
    int left[3] = {ratio_[0], ratio_[1], ratio_[2]};
    for (int pass = 0; left[0] * left[1] * left[2] > 1; ++pass) halve(part, left, n, sum_[pass]);
    const double share = 1.0 / (rows() * ratio_[0]);
    const double* __restrict sum = part[0];
    for (int i = 0; i < n; ++i) mean[i] = sum[i] * share;
  }

 private:
  using Sums = double[max_rows][longest_row];

  void halve(const double** part, int (&left)[3], int n, Sums& to) {
    const int most = std::max({left[0], left[1], left[2]});
    const bool x = left[0] == most, y = left[1] == most, z = left[2] == most;
    const int step[2] = {y ? 1 : 0, z ? left[1] : 0};  // to the other half
    const int ny = y ? left[1] / 2 : left[1], nz = z ? left[2] / 2 : left[2];
    if (x) left[0] /= 2;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) {
        const double** const low = part + (j << y) + (k << z) * left[1];
        double* const sum = to[j + ny * k];
        add(x, y, z, n * left[0], low[0], low[step[0]], low[step[1]], low[step[0] + step[1]], sum);
        part[j + ny * k] = sum;
      }
    left[1] = ny;
    left[2] = nz;
  }

  // Rows by their half along y and z: 00, 10, 01, 11.
  static void add(bool x, bool y, bool z, int n, const double* __restrict r00,
                  const double* __restrict r10, const double* __restrict r01,
                  const double* __restrict r11, double* __restrict to) {
    if (x && y && z)
      for (int i = 0; i < n; ++i)
        to[i] = ((r00[2 * i] + r11[2 * i + 1]) + (r00[2 * i + 1] + r11[2 * i])) +
                ((r10[2 * i] + r01[2 * i + 1]) + (r01[2 * i] + r10[2 * i + 1]));
    else if (x && (y || z))
      for (int i = 0; i < n; ++i)
        to[i] = (r00[2 * i] + r11[2 * i + 1]) + (r00[2 * i + 1] + r11[2 * i]);
    else if (x)
      for (int i = 0; i < n; ++i) to[i] = r00[2 * i] + r00[2 * i + 1];
    else if (y && z)
      for (int i = 0; i < n; ++i) to[i] = (r00[i] + r11[i]) + (r10[i] + r01[i]);
    else
      for (int i = 0; i < n; ++i) to[i] = r00[i] + r11[i];
  }

  int ratio_[3];
  Sums sum_[2];
};

}  // namespace sluice::ice

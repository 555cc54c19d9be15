// Smoothing, residuals and transfers of one grid.
#include "framework/solve/multigrid_level.hpp"

#include <algorithm>

namespace sluice::solve {
namespace {

// What the neighbours of cell i of a row contribute; opposite ones are added first, so that mirror
// images give the same bits.
template <class Real>
struct Couplings {
  const Real *low0, *low1, *high1, *low2, *high2;
  const Real *x, *below1, *above1, *below2, *above2;

  template <bool Deep>
  [[gnu::always_inline]] Real across(int i) const {
    Real sum = low0[i] * x[i - 1] + low0[i + 1] * x[i + 1];
    if constexpr (Deep) sum += low2[i] * below2[i] + high2[i] * above2[i];
    return sum;
  }
  [[gnu::always_inline]] Real along(int i) const {
    return low1[i] * below1[i] + high1[i] * above1[i];
  }
};

template <class Real>
Couplings<Real> couplings_of(const DenseShape& s, const RawVector<Real> (&low)[3], const Real* x,
                             std::ptrdiff_t row) {
  const std::ptrdiff_t s1 = s.stride(1), s2 = s.stride(2);
  return {low[0].data() + row,
          low[1].data() + row,
          low[1].data() + row + s1,
          low[2].data() + row,
          low[2].data() + row + s2,
          x + row,
          x + row - s1,
          x + row + s1,
          x + row - s2,
          x + row + s2};
}

// Values of a row, where the cells have the colour. Apart from their computation, which reads
// neighbours: so both loops become vectors.
template <class Real>
[[gnu::always_inline]] inline void take_colour(int n, int parity, const Real* value, Real* x) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) x[i] = ((i ^ parity) & 1) == 0 ? value[i] : x[i];
}

}  // namespace

double DenseEquations::diagonal(std::ptrdiff_t c) const {
  double d = sum[c];
  for (int a = 0; a < 3; ++a) {
    if (a == 2 && !shape.deep()) continue;
    d += low[a][c] + low[a][c + shape.stride(a)];
  }
  return d;
}

DenseEquations::DenseEquations(const DenseShape& s, const Slabs& slabs_of_ranks)
    : shape(s), slabs(slabs_of_ranks), sum(zeros<double>(s, slabs)) {
  for (RawVector<double>& v : low) v = zeros<double>(s, slabs);
}

double DenseEquations::largest_diagonal() const {
  double largest = 0;
  for (int k = slabs.begin(); k < slabs.end(); ++k)
    for (int j = 0; j < shape.count[1]; ++j)
      for (int i = 0; i < shape.count[0]; ++i)
        largest = std::max(largest, diagonal(shape.at(i, j, k)));
  return slabs.largest(largest);
}

// By slices, so that who has which does not show in the sums.
std::array<double, 3> DenseEquations::mean_couplings() const {
  std::array<double, 3> mean{};
  std::vector<double> of_slices(shape.count[2]);
  for (int d = 0; d < 3; ++d) {
    if (shape.count[d] == 1) continue;
    for (int k = slabs.begin(); k < slabs.end(); ++k) {
      double total = 0;
      for (int j = 0; j < shape.count[1]; ++j) {
        const double* row = low[d].data() + shape.at(0, j, k);
        for (int i = 0; i < shape.count[0]; ++i) total += row[i];
      }
      of_slices[k] = total;
    }
    slabs.gather_numbers(of_slices.data());
    for (const double total : of_slices) mean[d] += total;
    mean[d] /= static_cast<double>(shape.cells());
  }
  return mean;
}

void DenseEquations::sum_into(DenseEquations& coarse, std::array<int, 3> ratio) const {
  for (int k = slabs.begin(); k < slabs.end(); ++k)
    for (int j = 0; j < shape.count[1]; ++j)
      for (int i = 0; i < shape.count[0]; ++i) {
        const std::size_t f = shape.at(i, j, k);
        const std::size_t c = coarse.shape.at(i / ratio[0], j / ratio[1], k / ratio[2]);
        coarse.sum[c] += sum[f];
        if (i % ratio[0] == 0) coarse.low[0][c] += low[0][f] / ratio[0];
        if (j % ratio[1] == 0) coarse.low[1][c] += low[1][f] / ratio[1];
        if (k % ratio[2] == 0) coarse.low[2][c] += low[2][f] / ratio[2];
      }
}

DenseEquations DenseEquations::coarsened(std::array<int, 3> ratio) const {
  DenseShape s;
  s.periodic = shape.periodic;
  for (int d = 0; d < 3; ++d) s.count[d] = (shape.count[d] + ratio[d] - 1) / ratio[d];
  DenseEquations coarse(s, slabs.coarsened(s, ratio[2]));
  sum_into(coarse, ratio);
  if (slabs.shared() && !coarse.slabs.shared()) {
    const Slabs made = slabs.grouped(s, ratio[2]);
    for (RawVector<double>& v : coarse.low) made.gather(s, v.data());
    made.gather(s, coarse.sum.data());
  }
  for (int d = 0; d < 3; ++d) {
    double* v = coarse.low[d].data();
    // A cell that has become its own neighbour is not coupled.
    if (s.count[d] == 1) std::fill(coarse.low[d].begin(), coarse.low[d].end(), 0.0);
    for (int k = coarse.slabs.begin(); k < coarse.slabs.end(); ++k) wrap_slice(s, v, k);
    coarse.slabs.exchange(s, v);
  }
  return coarse;
}

template <class Real>
MultigridLevel<Real>::MultigridLevel(const DenseEquations& e, double scale, bool lines)
    : shape_(e.shape),
      slabs_(e.slabs),
      diagonal_(shape_.size()),
      x_(zeros<Real>(shape_, slabs_)),
      b_(zeros<Real>(shape_, slabs_)),
      values_(shape_.row() + 1) {
  if (lines) pivot_ = zeros<Real>(shape_, slabs_);
  for (int d = 0; d < 3; ++d) {
    low_[d] = RawVector<Real>(shape_.size());
    for_places(shape_, slabs_,
               [&](std::size_t c) { low_[d][c] = static_cast<Real>(scale * e.low[d][c]); });
  }
  for_places(shape_, slabs_, [&](std::size_t c) { diagonal_[c] = 1; });
  for (int k = slabs_.begin(); k < slabs_.end(); ++k)
    for (int i = 0; i < shape_.count[0]; ++i) {
      double before = 0;  // the inverse pivot of the cell below
      for (int j = 0; j < shape_.count[1]; ++j) {
        const std::ptrdiff_t c = shape_.at(i, j, k);
        const double diagonal = scale * e.diagonal(c);
        const double low = scale * e.low[1][c];
        sum_ += scale * e.sum[c];
        if (diagonal > 0) diagonal_[c] = static_cast<Real>(diagonal);
        if (!lines) continue;
        const double rest = (diagonal > 0 ? diagonal : 1.0) - (j > 0 ? low * low * before : 0.0);
        before = rest > 1e-13 * diagonal ? 1 / rest : 0.0;
        pivot_[c] = static_cast<Real>(before);
      }
    }
}

template <class Real>
void MultigridLevel<Real>::first_sweep(int k) {
  if (lines()) {
    if (k == slabs_.begin()) for_places(shape_, slabs_, [&](std::size_t c) { x_[c] = 0; });
    sweep(k, 0);
    return;
  }
  const int n = shape_.count[0];
  for (int j = 0; j < shape_.count[1]; ++j) {
    const std::ptrdiff_t row = shape_.at(0, j, k);
    Real* x = x_.data() + row;
    const Real* b = b_.data() + row;
    const Real* diagonal = diagonal_.data() + row;
    const int parity = (j + k) & 1;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const Real value = b[i] / diagonal[i];
      x[i] = ((i ^ parity) & 1) == 0 ? value : Real{0};
    }
  }
}

template <class Real>
template <bool Deep>
void MultigridLevel<Real>::sweep_points(int k, int colour) {
  const int n = shape_.count[0];
  Real* value = values_.data();
  for (int j = 0; j < shape_.count[1]; ++j) {
    const std::ptrdiff_t row = shape_.at(0, j, k);
    Real* x = x_.data() + row;
    const Real* b = b_.data() + row;
    const Real* diagonal = diagonal_.data() + row;
    const Couplings<Real> c = couplings_of<Real>(shape_, low_, x_.data(), row);
    const int parity = (j + k + colour) & 1;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i)
      value[i] = (b[i] + (c.template across<Deep>(i) + c.along(i))) / diagonal[i];
    take_colour(n, parity, value, x);
  }
}

// Forward elimination leaves its values in the ghost-free rows of the solution: the colour's own
// cells hold nothing that is still needed.
template <class Real>
template <bool Deep>
void MultigridLevel<Real>::sweep_lines(int k, int colour) {
  const int n = shape_.count[0];
  const int last = shape_.count[1] - 1;
  const int parity = (k + colour) & 1;
  Real* value = values_.data();
  const std::ptrdiff_t s1 = shape_.stride(1);
  for (int j = 0; j <= last; ++j) {
    const std::ptrdiff_t row = shape_.at(0, j, k);
    Real* x = x_.data() + row;
    const Real* b = b_.data() + row;
    const Real* pivot = pivot_.data() + row;
    const Couplings<Real> c = couplings_of<Real>(shape_, low_, x_.data(), row);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const Real before = c.low1[i] * c.below1[i];
      value[i] = (b[i] + (c.template across<Deep>(i) + before)) * pivot[i];
    }
    take_colour(n, parity, value, x);
  }
  for (int j = last - 1; j >= 0; --j) {
    const std::ptrdiff_t row = shape_.at(0, j, k);
    Real* x = x_.data() + row;
    const Real* high = low_[1].data() + row + s1;
    const Real* pivot = pivot_.data() + row;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) value[i] = x[i] + pivot[i] * high[i] * x[i + s1];
    take_colour(n, parity, value, x);
  }
}

template <class Real>
void MultigridLevel<Real>::sweep(int k, int colour) {
  if (lines()) {
    shape_.deep() ? sweep_lines<true>(k, colour) : sweep_lines<false>(k, colour);
  } else {
    shape_.deep() ? sweep_points<true>(k, colour) : sweep_points<false>(k, colour);
  }
}

template <class Real>
template <bool Deep>
void MultigridLevel<Real>::residual_row(int j, int k) {
  const int n = shape_.count[0];
  const std::ptrdiff_t row = shape_.at(0, j, k);
  const Real* x = x_.data() + row;
  const Real* b = b_.data() + row;
  const Real* diagonal = diagonal_.data() + row;
  const Couplings<Real> c = couplings_of<Real>(shape_, low_, x_.data(), row);
  Real* r = values_.data();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    r[i] = (b[i] - diagonal[i] * x[i]) + (c.template across<Deep>(i) + c.along(i));
  r[n] = 0;  // the missing partner of the last cell
}

template <class Real>
void MultigridLevel<Real>::restrict_residual(int k, MultigridLevel& coarse,
                                             std::array<int, 3> ratio) {
  const int n = coarse.shape_.count[0];
  for (int j = 0; j < shape_.count[1]; ++j) {
    shape_.deep() ? residual_row<true>(j, k) : residual_row<false>(j, k);
    Real* b = coarse.b_.data() + coarse.shape_.at(0, j / ratio[1], k / ratio[2]);
    const Real* r = values_.data();
    if (j % ratio[1] == 0 && k % ratio[2] == 0) std::fill_n(b, n, Real{0});
    if (ratio[0] == 2) {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) b[i] += r[2 * i] + r[2 * i + 1];
    } else {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) b[i] += r[i];
    }
  }
}

template <class Real>
void MultigridLevel<Real>::add_correction(int k, const MultigridLevel& coarse,
                                          std::array<int, 3> ratio) {
  const int n = shape_.count[0];
  for (int j = 0; j < shape_.count[1]; ++j) {
    Real* x = x_.data() + shape_.at(0, j, k);
    const Real* e = coarse.x_.data() + coarse.shape_.at(0, j / ratio[1], k / ratio[2]);
    if (ratio[0] == 2) {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) x[i] += e[i >> 1];
    } else {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) x[i] += e[i];
    }
  }
}

template <class Real>
void MultigridLevel<Real>::solve_one_cell() {
  const std::size_t c = shape_.at(0, 0, 0);
  x_[c] = sum_ > 0 ? b_[c] / static_cast<Real>(sum_) : Real{0};
}

template <class Real>
std::size_t MultigridLevel<Real>::bytes() const {
  return (6 + (lines() ? 1 : 0)) * x_.size() * sizeof(Real);
}

template class MultigridLevel<float>;
template class MultigridLevel<double>;

}  // namespace sluice::solve

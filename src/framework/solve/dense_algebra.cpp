// Products, exact sums and norms of vectors on a window.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/base/text.hpp"
#include "framework/solve/dense_system.hpp"

namespace sluice::solve {
namespace {

// Numbers on their way into an exact sum, which takes whole blocks faster than single ones.
class Collected {
 public:
  template <class F>
  void add_row(int count, F&& number) {
    for (int from = 0; from < count; from += block) {
      const int n = std::min(count - from, block);
      if (held_ + n > block) flush();
      double* to = numbers_ + held_;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) to[i] = number(from + i);
      held_ += n;
    }
  }
  const ExactSum& sum() {
    flush();
    return sum_;
  }

 private:
  void flush() {
    sum_.add(numbers_, held_);
    held_ = 0;
  }
  static constexpr int block = 1024;
  double numbers_[block];
  int held_ = 0;
  ExactSum sum_;
};

}  // namespace

void DenseSystem::apply(DenseVector& x, DenseVector& out) const {
  exchange(x);
  const std::ptrdiff_t s1 = shape_.stride(1), s2 = shape_.stride(2);
  const int n = shape_.count[0];
  for_rows([&](std::ptrdiff_t row) {
    const double* p = x.data() + row;
    const double* low0 = low_[0].data() + row;
    const double* low1 = low_[1].data() + row;
    const double* low2 = low_[2].data() + row;
    const double* diagonal = diagonal_.data() + row;
    double* q = out.data() + row;
    if (shape_.deep()) {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        q[i] = diagonal[i] * p[i] + ((low0[i] * p[i - 1] + low0[i + 1] * p[i + 1]) +
                                     (low1[i] * p[i - s1] + low1[i + s1] * p[i + s1]) +
                                     (low2[i] * p[i - s2] + low2[i + s2] * p[i + s2]));
      }
    } else {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        q[i] = diagonal[i] * p[i] + ((low0[i] * p[i - 1] + low0[i + 1] * p[i + 1]) +
                                     (low1[i] * p[i - s1] + low1[i + s1] * p[i + s1]));
      }
    }
  });
}

void DenseSystem::residual(const DenseVector& b, DenseVector& x, DenseVector& r) const {
  apply(x, r);
  for_rows([&](std::ptrdiff_t row) {
    const double* from = b.data() + row;
    double* to = r.data() + row;
#pragma GCC ivdep
    for (int i = 0; i < shape_.count[0]; ++i) to[i] = from[i] - to[i];
  });
}

double DenseSystem::dot(const DenseVector& a, const DenseVector& b) const {
  Collected all;
  for_rows([&](std::ptrdiff_t row) {
    const double* u = a.data() + row;
    const double* v = b.data() + row;
    all.add_row(shape_.count[0], [&](int i) { return u[i] * v[i]; });
  });
  return slabs_.total(all.sum());
}

double DenseSystem::sum(const DenseVector& v) const {
  Collected all;
  for_rows([&](std::ptrdiff_t row) {
    const double* u = v.data() + row;
    all.add_row(shape_.count[0], [&](int i) { return u[i]; });
  });
  return slabs_.total(all.sum());
}

double DenseSystem::norm(const DenseVector& v, Norm kind) const {
  if (kind == Norm::two) return std::sqrt(dot(v, v));
  if (kind == Norm::one) {
    Collected all;
    for_rows([&](std::ptrdiff_t row) {
      const double* u = v.data() + row;
      all.add_row(shape_.count[0], [&](int i) { return std::fabs(u[i]); });
    });
    return slabs_.total(all.sum());
  }
  double largest = 0;
  for_rows([&](std::ptrdiff_t row) {
    for (std::ptrdiff_t c = row; c < row + shape_.count[0]; ++c) {
      const double size = std::fabs(v[c]);
      if (size > largest || std::isnan(size)) largest = size;  // a NaN wins and stays
    }
  });
  return slabs_.largest(largest);
}

void DenseSystem::remove_mean(DenseVector& v) const {
  const double mean = sum(v) / static_cast<double>(unknowns_);
  for_cells([&](std::size_t c) {
    if (present_[c] != 0) v[c] -= mean;
  });
}

void DenseSystem::need_finite(const DenseVector& v, const char* what) const {
  if (std::isfinite(norm(v, Norm::largest))) return;
  std::string fault;
  for_cells([&](std::size_t c) {
    if (!fault.empty() || std::isfinite(v[c])) return;
    fault = fmt::format("linear system: the {} of {} is {}; a finite number is needed", what,
                        cell_name(static_cast<std::ptrdiff_t>(c)), shortest_text(v[c]));
  });
  need_none(fault);
}

}  // namespace sluice::solve

#include "framework/solve/block/block_rows.hpp"

#include <algorithm>

namespace sluice::solve {
namespace {

constexpr std::size_t rows_at_once = 512;
constexpr std::size_t numbers_at_once = 4096;

template <int B, class Number>
void multiply_rows(const BlockRows& rows, const Number* value, std::size_t first, std::size_t end,
                   const double* x, double* y) {
  for (std::size_t i = first; i < end; ++i) {
    double sum[B] = {};
    const Number* v = value + static_cast<std::size_t>(B * B) * rows.begin[i];
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e, v += B * B) {
      const double* q = x + static_cast<std::ptrdiff_t>(B) * rows.column[e];
      for (int a = 0; a < B; ++a) {
        double product = static_cast<double>(v[B * a]) * q[0];
        for (int b = 1; b < B; ++b) product += static_cast<double>(v[B * a + b]) * q[b];
        sum[a] += product;
      }
    }
    for (int a = 0; a < B; ++a) y[B * i + static_cast<std::size_t>(a)] = sum[a];
  }
}

template <class Number>
void multiply_all(const BlockRows& rows, const Number* value, const Workers& workers,
                  std::span<const double> x, std::span<double> y) {
  for_pieces(workers, rows.count(), rows_at_once, [&](std::size_t first, std::size_t end, int) {
    if (rows.width == 1) multiply_rows<1>(rows, value, first, end, x.data(), y.data());
    if (rows.width == 2) multiply_rows<2>(rows, value, first, end, x.data(), y.data());
    if (rows.width == 3) multiply_rows<3>(rows, value, first, end, x.data(), y.data());
  });
}

// Eight partial sums, which a compiler may hold in one vector.
double dot_of(const double* x, const double* y, std::size_t count) {
  double sums[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8)
    for (std::size_t s = 0; s < 8; ++s) sums[s] += x[i + s] * y[i + s];
  for (; i < count; ++i) sums[0] += x[i] * y[i];
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace

const double* BlockRows::find(std::size_t i, std::int32_t j) const {
  const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin[i]),
             end = column.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
  const auto at = std::lower_bound(first, end, j);
  if (at == end || *at != j) return nullptr;
  return value.data() + static_cast<std::ptrdiff_t>(width * width) * (at - column.begin());
}

void multiply(const BlockRows& rows, const Workers& workers, std::span<const double> x,
              std::span<double> y) {
  multiply_all(rows, rows.value.data(), workers, x, y);
}

void RoundedRows::round(const BlockRows& rows, const Workers& workers) {
  rows_ = &rows;
  value_.resize(rows.value.size());
  for_pieces(workers, value_.size(), numbers_at_once, [&](std::size_t first, std::size_t end, int) {
    for (std::size_t n = first; n < end; ++n) value_[n] = static_cast<float>(rows.value[n]);
  });
}

void RoundedRows::multiply(const Workers& workers, std::span<const double> x,
                           std::span<double> y) const {
  multiply_all(*rows_, value_.data(), workers, x, y);
}

BlockRows symmetric_part(const BlockRows& rows) {
  BlockRows half = rows;
  const auto w = static_cast<std::size_t>(rows.width);
  for (std::size_t i = 0; i < rows.count(); ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
      const double* other =
          rows.find(static_cast<std::size_t>(rows.column[e]), static_cast<std::int32_t>(i));
      double* block = half.value.data() + w * w * e;
      for (std::size_t a = 0; a < w; ++a)
        for (std::size_t b = 0; b < w; ++b)
          block[w * a + b] = 0.5 * (block[w * a + b] + other[w * b + a]);
    }
  return half;
}

double dot(const Workers& workers, std::span<const double> x, std::span<const double> y) {
  std::vector<double> parts((x.size() + numbers_at_once - 1) / numbers_at_once);
  for_pieces(workers, x.size(), numbers_at_once, [&](std::size_t first, std::size_t end, int) {
    parts[first / numbers_at_once] = dot_of(x.data() + first, y.data() + first, end - first);
  });
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

}  // namespace sluice::solve

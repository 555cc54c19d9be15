// Matrices of blocks for tests: elastic cubes of trilinear elements. Numbers have no unit.
#pragma once
#include <cmath>

#include "framework/solve/block/block_rows.hpp"
#include "framework/solve/block/node_numbers.hpp"

namespace sluice::solve {

// Nodes 0 ... cells of each direction; along a direction of no cells, node 0 alone.
inline std::vector<IntVec3> nodes_of(IntVec3 cells) {
  std::vector<IntVec3> nodes;
  for (int z = 0; z <= cells.z; ++z)
    for (int y = 0; y <= cells.y; ++y)
      for (int x = 0; x <= cells.x; ++x) nodes.push_back({x, y, z});
  return nodes;
}

struct Elastic {
  IntVec3 cells{4, 4, 4};
  double bulk = 1, shear = 0.5;
  double inertia = 0;  // on the diagonal
  bool held = true;    // nodes of x = 0
  double skew = 0;     // what makes it not symmetric
};

// The stiffness of one square or cube of size 1 by a 2-point rule: K(i, a, j, b) is added to `add`.
template <class F>
void add_cell(const Elastic& of, int dimensions, F&& add) {
  const double lambda = of.bulk - 2.0 / 3 * of.shear, point = 0.5 / std::sqrt(3.0);
  const int corners = 1 << dimensions;
  for (int q = 0; q < corners; ++q) {
    double g[8][3] = {};
    for (int n = 0; n < corners; ++n)
      for (int d = 0; d < dimensions; ++d) {
        g[n][d] = 1;
        for (int a = 0; a < dimensions; ++a) {
          const double s = 0.5 + ((q >> a & 1) != 0 ? point : -point);
          const bool far = (n >> a & 1) != 0;
          g[n][d] *= a == d ? (far ? 1 : -1) : (far ? s : 1 - s);
        }
      }
    for (int i = 0; i < corners; ++i)
      for (int j = 0; j < corners; ++j)
        for (int a = 0; a < dimensions; ++a)
          for (int b = 0; b < dimensions; ++b) {
            double k = lambda * g[i][a] * g[j][b] + of.shear * g[i][b] * g[j][a];
            k += of.skew * (g[i][a] * g[j][(b + 1) % dimensions]);
            for (int d = 0; d < dimensions && a == b; ++d) k += of.shear * g[i][d] * g[j][d];
            add(i, a, j, b, k / corners);
          }
  }
}

inline BlockRows elastic_rows(const Elastic& of) {
  BlockRows rows;
  rows.width = of.cells.z > 0 ? 3 : of.cells.y > 0 ? 2 : 1;
  rows.place = nodes_of(of.cells);
  NodeNumbers numbers({0, 0, 0}, of.cells + IntVec3::all(1));
  for (const IntVec3 i : rows.place) numbers.mark(i);
  numbers.number();
  rows.begin.assign(1, 0);
  for (const IntVec3 i : rows.place) {
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          if (const std::int32_t j = numbers(i + IntVec3{x, y, z}); j >= 0)
            rows.column.push_back(j);
    rows.begin.push_back(rows.column.size());
  }
  const auto w = static_cast<std::size_t>(rows.width);
  rows.value.assign(w * w * rows.column.size(), 0.0);
  const auto block = [&](IntVec3 i, IntVec3 j) {
    return const_cast<double*>(rows.find(static_cast<std::size_t>(numbers(i)), numbers(j)));
  };
  const IntVec3 cells = max(of.cells, IntVec3::all(1));
  for (const IntVec3 cell : nodes_of(cells - IntVec3::all(1)))
    add_cell(of, rows.width, [&](int i, int a, int j, int b, double k) {
      const IntVec3 from{i & 1, i >> 1 & 1, i >> 2}, to{j & 1, j >> 1 & 1, j >> 2};
      if (of.held && ((cell + from).x == 0 || (cell + to).x == 0)) return;
      block(cell + from, cell + to)[rows.width * a + b] += k;
    });
  for (const IntVec3 i : rows.place)
    if (!of.held || i.x > 0)
      for (std::size_t a = 0; a < w; ++a) block(i, i)[(w + 1) * a] += of.inertia;
  return rows;
}

// A dense matrix, row after row.
struct Dense {
  std::size_t rows, columns;
  std::vector<double> value;
  Dense(std::size_t r, std::size_t c) : rows(r), columns(c), value(r * c) {}
  double& operator()(std::size_t i, std::size_t j) { return value[columns * i + j]; }
  double operator()(std::size_t i, std::size_t j) const { return value[columns * i + j]; }
};

inline std::vector<double> product(const Dense& A, const std::vector<double>& x) {
  std::vector<double> y(A.rows);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.columns; ++j) y[i] += A(i, j) * x[j];
  return y;
}

inline Dense transposed(const Dense& A) {
  Dense to(A.columns, A.rows);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.columns; ++j) to(j, i) = A(i, j);
  return to;
}

inline Dense product(const Dense& A, const Dense& B) {
  Dense to(A.rows, B.columns);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t k = 0; k < A.columns; ++k)
      for (std::size_t j = 0; j < B.columns && A(i, k) != 0; ++j) to(i, j) += A(i, k) * B(k, j);
  return to;
}

// A x = b by Gauss's elimination with row pivots; rows of zeros give x = 0.
inline std::vector<double> solved(Dense A, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i)
    if (A(i, i) == 0) A(i, i) = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::fabs(A(i, k)) > std::fabs(A(pivot, k))) pivot = i;
    for (std::size_t j = 0; j < n; ++j) std::swap(A(k, j), A(pivot, j));
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = A(i, k) / A(k, k);
      for (std::size_t j = k; j < n && factor != 0; ++j) A(i, j) -= factor * A(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= A(k, j) * b[j];
    b[k] /= A(k, k);
  }
  return b;
}

inline Dense dense(const BlockRows& rows) {
  const auto w = static_cast<std::size_t>(rows.width);
  Dense to(rows.unknowns(), rows.unknowns());
  for (std::size_t i = 0; i < rows.count(); ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e)
      for (std::size_t a = 0; a < w; ++a)
        for (std::size_t b = 0; b < w; ++b)
          to(w * i + a, w * static_cast<std::size_t>(rows.column[e]) + b) =
              rows.value[w * w * e + w * a + b];
  return to;
}

// Numbers without a pattern; 0 for unknowns whose row is 0.
inline std::vector<double> right_side(const BlockRows& rows) {
  std::vector<double> b(rows.unknowns());
  std::uint32_t seed = 7;
  const auto w = static_cast<std::size_t>(rows.width);
  for (std::size_t i = 0; i < b.size(); ++i) {
    seed = seed * 1664525U + 1013904223U;
    const double* block = rows.find(i / w, static_cast<std::int32_t>(i / w));
    b[i] = block[(w + 1) * (i % w)] == 0 ? 0 : (seed >> 8) / static_cast<double>(1 << 24) - 0.5;
  }
  return b;
}

inline double size_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum);
}

inline double distance(std::vector<double> x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= y[i];
  return size_of(x);
}

}  // namespace sluice::solve

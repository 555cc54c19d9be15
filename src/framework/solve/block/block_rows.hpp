// A sparse matrix of small blocks: one to three unknowns at each node of a grid.
//
// Every number is a sum in a fixed order, so that no bit depends on the number of threads.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::solve {

// Who works through independent pieces: the calling thread alone, or a team of the caller's.
struct Workers {
  int count = 1;
  using Work = std::function<void(std::size_t piece, int worker)>;
  // Runs work(piece, worker) for every piece below a number; worker is below `count`.
  std::function<void(std::size_t pieces, const Work& work)> run = [](std::size_t pieces,
                                                                     const Work& work) {
    for (std::size_t piece = 0; piece < pieces; ++piece) work(piece, 0);
  };
};

// Rows begin[i] ... begin[i + 1] - 1 of `column` belong to node i; columns rise, the pattern is
// symmetric and has the diagonal. Block e has width x width numbers from value[width^2 e] on, row
// after row. An unknown that is not solved for has zeros in its row and its column, on the diagonal
// too.
struct BlockRows {
  int width = 3;
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> column;
  std::vector<double> value;
  std::vector<IntVec3> place;  // index of each node on the grid; 0 along directions without cells

  std::size_t count() const { return place.size(); }
  std::size_t unknowns() const { return count() * static_cast<std::size_t>(width); }
  // The block of row i and column j; null where the pattern has none.
  const double* find(std::size_t i, std::int32_t j) const;
};

// y = A x; both have rows.unknowns() numbers and differ.
void multiply(const BlockRows& rows, const Workers& workers, std::span<const double> x,
              std::span<double> y);
// A matrix whose numbers are rounded to single precision, for products that read half of the
// memory; sums are in double precision. A symmetric matrix stays symmetric; eigenvalues change by
// 6e-8 of the largest.
class RoundedRows {
 public:
  // The matrix must stay; a change of it needs another call.
  void round(const BlockRows& rows, const Workers& workers);
  // y = A x, as multiply().
  void multiply(const Workers& workers, std::span<const double> x, std::span<double> y) const;

 private:
  const BlockRows* rows_ = nullptr;
  std::vector<float> value_;
};

// (A + A^T)/2.
BlockRows symmetric_part(const BlockRows& rows);

// x . y, in a fixed order.
double dot(const Workers& workers, std::span<const double> x, std::span<const double> y);

// Pieces of at most `size` of `count` things: f(first, end, worker).
template <class F>
void for_pieces(const Workers& workers, std::size_t count, std::size_t size, F&& f) {
  workers.run((count + size - 1) / size, [&](std::size_t piece, int worker) {
    f(piece * size, std::min(count, (piece + 1) * size), worker);
  });
}

}  // namespace sluice::solve

#include "framework/solve/block/block_coarsening.hpp"

#include <algorithm>
#include <memory>

#include "framework/solve/block/node_numbers.hpp"

namespace sluice::solve {
namespace {

constexpr std::size_t nodes_at_once = 1024;

// The coarse nodes that a fine one lies between: f(index, weight).
template <class F>
void for_parents(IntVec3 fine, F&& f) {
  // >> rounds down below 0 too
  const IntVec3 lower{fine.x >> 1, fine.y >> 1, fine.z >> 1};
  const IntVec3 more{fine.x & 1, fine.y & 1, fine.z & 1};
  const double weight = 1.0 / ((1 + more.x) * (1 + more.y) * (1 + more.z));
  for (int z = 0; z <= more.z; ++z)
    for (int y = 0; y <= more.y; ++y)
      for (int x = 0; x <= more.x; ++x) f(lower + IntVec3{x, y, z}, weight);
}

NodeNumbers number_coarse(std::span<const IntVec3> fine, std::vector<IntVec3>& coarse) {
  IntVec3 low = fine.front(), high = fine.front();
  for (const IntVec3 i : fine) {
    low = min(low, i);
    high = max(high, i);
  }
  NodeNumbers numbers({low.x >> 1, low.y >> 1, low.z >> 1},
                      {(high.x >> 1) + 2, (high.y >> 1) + 2, (high.z >> 1) + 2});
  for (const IntVec3 i : fine)
    for_parents(i, [&](IntVec3 parent, double) { numbers.mark(parent); });
  coarse = numbers.number();
  return numbers;
}

Interpolation::Rows transposed(const Interpolation::Rows& rows, std::size_t columns) {
  Interpolation::Rows to;
  to.begin.assign(columns + 1, 0);
  for (const std::int32_t n : rows.node) ++to.begin[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n < columns; ++n) to.begin[n + 1] += to.begin[n];
  to.node.resize(rows.node.size());
  to.weight.resize(rows.node.size());
  std::vector<std::size_t> next(to.begin.begin(), to.begin.end() - 1);
  for (std::size_t i = 0; i + 1 < rows.begin.size(); ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
      const std::size_t at = next[static_cast<std::size_t>(rows.node[e])]++;
      to.node[at] = static_cast<std::int32_t>(i);
      to.weight[at] = rows.weight[e];
    }
  return to;
}

// Blocks of one row, by column, in the order in which columns come.
template <int S>
class RowSum {
 public:
  explicit RowSum(std::size_t columns) : place_(columns, -1) {}

  void add(std::int32_t column, double weight, const double* block) {
    std::int32_t& place = place_[static_cast<std::size_t>(column)];
    if (place < 0) {
      place = static_cast<std::int32_t>(columns_.size());
      columns_.push_back(column);
      values_.resize(values_.size() + S);
      double* to = values_.data() + values_.size() - S;
      for (int a = 0; a < S; ++a) to[a] = weight * block[a];
      return;
    }
    double* to = values_.data() + static_cast<std::ptrdiff_t>(S) * place;
    for (int a = 0; a < S; ++a) to[a] += weight * block[a];
  }
  const std::vector<std::int32_t>& columns() const { return columns_; }
  const double* block(std::size_t n) const { return values_.data() + S * n; }
  // Appends the row, columns rising.
  void append(std::vector<std::int32_t>& columns, std::vector<double>& values) {
    std::sort(columns_.begin(), columns_.end());
    columns.insert(columns.end(), columns_.begin(), columns_.end());
    for (const std::int32_t c : columns_) {
      const double* from =
          values_.data() + static_cast<std::ptrdiff_t>(S) * place_[static_cast<std::size_t>(c)];
      values.insert(values.end(), from, from + S);
    }
  }
  void clear() {
    for (const std::int32_t c : columns_) place_[static_cast<std::size_t>(c)] = -1;
    columns_.clear();
    values_.clear();
  }

 private:
  std::vector<std::int32_t> place_, columns_;
  std::vector<double> values_;
};

// What one piece of coarse rows gives.
struct Piece {
  std::vector<std::size_t> ends;
  std::vector<std::int32_t> column;
  std::vector<double> value;
};

template <int B>
void product_rows(const BlockRows& fine, const Interpolation& between, std::size_t first,
                  std::size_t end, RowSum<B * B>& half, RowSum<B * B>& row, Piece& piece) {
  for (std::size_t I = first; I < end; ++I) {
    for (std::size_t t = between.to_coarse.begin[I]; t < between.to_coarse.begin[I + 1]; ++t) {
      const auto i = static_cast<std::size_t>(between.to_coarse.node[t]);
      const double weight = between.to_coarse.weight[t];
      const double* block = fine.value.data() + static_cast<std::size_t>(B * B) * fine.begin[i];
      for (std::size_t e = fine.begin[i]; e < fine.begin[i + 1]; ++e, block += B * B)
        half.add(fine.column[e], weight, block);  // P^T A
    }
    for (std::size_t n = 0; n < half.columns().size(); ++n) {
      const auto j = static_cast<std::size_t>(half.columns()[n]);
      for (std::size_t t = between.to_fine.begin[j]; t < between.to_fine.begin[j + 1]; ++t)
        row.add(between.to_fine.node[t], between.to_fine.weight[t], half.block(n));  // (P^T A) P
    }
    row.append(piece.column, piece.value);
    piece.ends.push_back(piece.column.size());
    half.clear();
    row.clear();
  }
}

void join(const std::vector<Piece>& pieces, BlockRows& rows) {
  std::size_t columns = 0, values = 0;
  for (const Piece& p : pieces) {
    columns += p.column.size();
    values += p.value.size();
  }
  rows.column.reserve(columns);
  rows.value.reserve(values);
  rows.begin.assign(1, 0);
  for (const Piece& p : pieces) {
    const std::size_t before = rows.column.size();
    for (const std::size_t end : p.ends) rows.begin.push_back(before + end);
    rows.column.insert(rows.column.end(), p.column.begin(), p.column.end());
    rows.value.insert(rows.value.end(), p.value.begin(), p.value.end());
  }
}

template <int B>
BlockRows product_of(const BlockRows& fine, const Interpolation& between, const Workers& workers) {
  BlockRows rows;
  rows.width = B;
  rows.place = between.coarse;
  const std::size_t count = rows.place.size();
  std::vector<Piece> pieces((count + nodes_at_once - 1) / nodes_at_once);
  struct Scratch {
    RowSum<B * B> half, row;
  };
  std::vector<std::unique_ptr<Scratch>> scratch(static_cast<std::size_t>(workers.count));
  for_pieces(workers, count, nodes_at_once, [&](std::size_t first, std::size_t end, int worker) {
    auto& mine = scratch[static_cast<std::size_t>(worker)];
    if (mine == nullptr)
      mine = std::make_unique<Scratch>(Scratch{RowSum<B * B>(fine.count()), RowSum<B * B>(count)});
    product_rows<B>(fine, between, first, end, mine->half, mine->row,
                    pieces[first / nodes_at_once]);
  });
  join(pieces, rows);
  return rows;
}

// to[i] (+)= sum of weight from[node], `width` numbers per node.
template <bool adds>
void apply(const Interpolation::Rows& rows, const Workers& workers, int width,
           std::span<const double> from, std::span<double> to) {
  const auto w = static_cast<std::size_t>(width);
  for_pieces(workers, rows.begin.size() - 1, nodes_at_once,
             [&](std::size_t first, std::size_t end, int) {
               for (std::size_t i = first; i < end; ++i) {
                 double sum[3] = {};
                 for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
                   const double* x = from.data() + w * static_cast<std::size_t>(rows.node[e]);
                   for (std::size_t a = 0; a < w; ++a) sum[a] += rows.weight[e] * x[a];
                 }
                 for (std::size_t a = 0; a < w; ++a)
                   to[w * i + a] = (adds ? to[w * i + a] : 0) + sum[a];
               }
             });
}

}  // namespace

void Interpolation::add_to_fine(const Workers& workers, int width,
                                std::span<const double> coarse_values,
                                std::span<double> fine) const {
  apply<true>(to_fine, workers, width, coarse_values, fine);
}

void Interpolation::sum_to_coarse(const Workers& workers, int width, std::span<const double> fine,
                                  std::span<double> coarse_values) const {
  apply<false>(to_coarse, workers, width, fine, coarse_values);
}

Interpolation interpolation_between(std::span<const IntVec3> fine) {
  Interpolation p;
  const NodeNumbers numbers = number_coarse(fine, p.coarse);
  p.to_fine.begin.assign(1, 0);
  for (const IntVec3 i : fine) {
    for_parents(i, [&](IntVec3 parent, double weight) {
      p.to_fine.node.push_back(numbers(parent));
      p.to_fine.weight.push_back(weight);
    });
    p.to_fine.begin.push_back(p.to_fine.node.size());
  }
  p.to_coarse = transposed(p.to_fine, p.coarse.size());
  return p;
}

BlockRows galerkin_product(const BlockRows& fine, const Interpolation& between,
                           const Workers& workers) {
  if (fine.width == 1) return product_of<1>(fine, between, workers);
  if (fine.width == 2) return product_of<2>(fine, between, workers);
  return product_of<3>(fine, between, workers);
}

}  // namespace sluice::solve

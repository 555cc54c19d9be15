#include "mpm/implicit/stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

constexpr int most_nodes = 64;  // of a particle: cubic functions in three directions

int width_of(const Level& level) {
  int width = 0;
  for (const bool active : level.active) width += active ? 1 : 0;
  return width;
}

// Nodes of one particle that have a slope.
template <int D>
struct Reached {
  int count = 0;
  bool signs = false;  // some component changes its sign at some node
  std::int32_t node[most_nodes];
  double slope[most_nodes][D], sign[most_nodes][D];

  Reached(const Stencils& s, std::size_t particle, const std::array<int, 3>& axes) {
    for (std::size_t e = s.first(particle); e < s.first(particle + 1); ++e) {
      const std::array<double, 3>& g = s.slope[e];
      if (g[0] == 0 && g[1] == 0 && g[2] == 0) continue;
      node[count] = s.node[e];
      signs |= s.flipped[e] != 0;
      for (int c = 0; c < D; ++c) {
        slope[count][c] = g[static_cast<std::size_t>(axes[static_cast<std::size_t>(c)])];
        sign[count][c] = s.sign(e, axes[static_cast<std::size_t>(c)]);
      }
      ++count;
    }
  }
};

// A of the directions with cells: A[i j][k m], or its symmetric part.
template <int D>
void reduce(const double* A, const std::array<int, 3>& axes, bool symmetric,
            double (&to)[D * D][D * D]) {
  int entry[D * D];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      entry[D * i + j] = 3 * axes[static_cast<std::size_t>(i)] + axes[static_cast<std::size_t>(j)];
  for (int q = 0; q < D * D; ++q)
    for (int r = 0; r < D * D; ++r) {
      const double upper = A[9 * entry[q] + entry[r]];
      to[q][r] = symmetric ? 0.5 * (upper + A[9 * entry[r] + entry[q]]) : upper;
    }
}

// M[m][i k] = sum_j A[i j][k m] g_j.
template <int D>
void contract(const double (&A)[D * D][D * D], const double (&g)[D], double (&M)[D][D * D]) {
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m) {
        double sum = A[D * i][D * k + m] * g[0];
        for (int j = 1; j < D; ++j) sum += A[D * i + j][D * k + m] * g[j];
        M[m][D * i + k] = sum;
      }
}

// block[i k] += sum_m M[m][i k] h_m.
template <int D>
void add_block(const double (&M)[D][D * D], const double (&h)[D], double* block) {
  for (int z = 0; z < D * D; ++z) {
    double sum = M[0][z] * h[0];
    for (int m = 1; m < D; ++m) sum += M[m][z] * h[m];
    block[z] += sum;
  }
}

template <int D>
void add_block(const double (&M)[D][D * D], const double (&h)[D], const double (&row)[D],
               const double (&column)[D], double* block) {
  double own[D * D] = {};
  add_block<D>(M, h, own);
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) block[D * i + k] += row[i] * column[k] * own[D * i + k];
}

}  // namespace

Stiffness::Stiffness(const NodesOfStep::Parts& parts, NodePairs& pairs,
                     const solve::Workers& workers)
    : parts_(parts),
      pairs_(&pairs),
      workers_(&workers),
      rows_(pairs.number(width_of(*parts.level))) {
  std::size_t c = 0;
  for (int d = 0; d < 3; ++d)
    if (parts.level->active[static_cast<std::size_t>(d)]) axes_[c++] = d;
}

// To rows of nodes first, ..., end - 1.
template <int D>
void Stiffness::add_particles(const ParticleStresses& particles, bool symmetric, std::size_t first,
                              std::size_t end) {
  for (std::size_t k = 0; k < particles.kinds(); ++k) {
    if (parts_.solids->materials[k].rigid) continue;
    const Stencils& s = parts_.reached->of(k);
    for (std::size_t p = 0; p < parts_.particles->kind(k).now.size(); ++p) {
      const Reached<D> of(s, p, axes_);
      double A[D * D][D * D], M[D][D * D];
      reduce<D>(particles.tangent(k).data() + 81 * p, axes_, symmetric, A);
      for (int a = 0; a < of.count; ++a) {
        const std::int32_t i = of.node[a];
        if (static_cast<std::size_t>(i) < first || static_cast<std::size_t>(i) >= end) continue;
        contract<D>(A, of.slope[a], M);
        for (int b = 0; b < of.count; ++b) {
          const std::int32_t j = of.node[b];
          if (symmetric && j < i) continue;
          double* block =
              rows_.value.data() + static_cast<std::size_t>(D * D) * pairs_->block(rows_, i, j);
          if (of.signs)
            add_block<D>(M, of.slope[b], of.sign[a], of.sign[b], block);
          else
            add_block<D>(M, of.slope[b], block);
        }
      }
    }
  }
}

void Stiffness::assemble(const ParticleStresses& particles, bool symmetric) {
  std::fill(rows_.value.begin(), rows_.value.end(), 0.0);
  const std::size_t n = rows_.count();
  const std::size_t pieces =
      workers_->count == 1 ? 1 : 4 * static_cast<std::size_t>(workers_->count);
  workers_->run(pieces, [&](std::size_t piece, int) {
    const std::size_t first = piece * n / pieces, end = (piece + 1) * n / pieces;
    if (width() == 1) add_particles<1>(particles, symmetric, first, end);
    if (width() == 2) add_particles<2>(particles, symmetric, first, end);
    if (width() == 3) add_particles<3>(particles, symmetric, first, end);
  });
  if (symmetric) copy_upper_half();
}

void Stiffness::copy_upper_half() {
  const auto w = static_cast<std::size_t>(width());
  solve::for_pieces(*workers_, rows_.count(), 512, [&](std::size_t first, std::size_t end, int) {
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t e = rows_.begin[i]; e < rows_.begin[i + 1]; ++e) {
        const std::int32_t j = rows_.column[e];
        if (static_cast<std::size_t>(j) >= i) break;
        const double* from =
            rows_.value.data() + w * w * pairs_->block(rows_, j, static_cast<std::int32_t>(i));
        double* to = rows_.value.data() + w * w * e;
        for (std::size_t a = 0; a < w; ++a)
          for (std::size_t b = 0; b < w; ++b) to[w * a + b] = from[w * b + a];
      }
  });
}

void Stiffness::add(std::int32_t i, std::int32_t j, double c) {
  const auto w = static_cast<std::size_t>(width());
  double* block = rows_.value.data() + w * w * pairs_->block(rows_, i, j);
  for (std::size_t a = 0; a < w; ++a) block[(w + 1) * a] += c;
}

void Stiffness::add_inertia(const NodesOfStep& nodes) {
  if (!nodes.dynamic()) return;
  for (std::size_t n = 0; n < rows_.count(); ++n)
    add(static_cast<std::int32_t>(n), static_cast<std::int32_t>(n), nodes.inertia(n));
}

void Stiffness::leave_out(const NodesOfStep& nodes, double least_part) {
  const auto w = static_cast<std::size_t>(width());
  std::vector<std::uint8_t> free(rows_.unknowns());
  std::vector<double> diagonal(rows_.unknowns());
  double most = 0;
  for (std::size_t n = 0; n < rows_.count(); ++n) {
    const double* block = diagonal_block(n);
    for (std::size_t a = 0; a < w; ++a) {
      diagonal[w * n + a] = std::fabs(block[(w + 1) * a]);
      if (nodes.is_free(n, axes_[a])) most = std::max(most, diagonal[w * n + a]);
    }
  }
  for (std::size_t n = 0; n < rows_.count(); ++n)
    for (std::size_t a = 0; a < w; ++a)
      free[w * n + a] = nodes.is_free(n, axes_[a]) && diagonal[w * n + a] > least_part * most;
  for (std::size_t i = 0; i < rows_.count(); ++i)
    for (std::size_t e = rows_.begin[i]; e < rows_.begin[i + 1]; ++e) {
      const auto j = static_cast<std::size_t>(rows_.column[e]);
      double* block = rows_.value.data() + w * w * e;
      for (std::size_t a = 0; a < w; ++a)
        for (std::size_t b = 0; b < w; ++b)
          if (free[w * i + a] == 0 || free[w * j + b] == 0) block[w * a + b] = 0;
    }
}

const double* Stiffness::diagonal_block(std::size_t n) const {
  const auto i = static_cast<std::int32_t>(n);
  return rows_.value.data() +
         static_cast<std::size_t>(width() * width()) * pairs_->block(rows_, i, i);
}

double Stiffness::diagonal_sum() const {
  const auto w = static_cast<std::size_t>(width());
  double sum = 0;
  for (std::size_t i = 0; i < rows_.count(); ++i)
    for (std::size_t a = 0; a < w; ++a) sum += diagonal_block(i)[(w + 1) * a];
  return sum;
}

}  // namespace sluice::mpm

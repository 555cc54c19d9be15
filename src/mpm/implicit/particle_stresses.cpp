#include "mpm/implicit/particle_stresses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <mutex>

namespace sluice::mpm {
namespace {

double least_spacing(const Level& level) {
  double least = 1e300;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) least = std::min(least, level.spacing[d]);
  return least;
}

// Rows and columns of A that vary: those of two directions with cells.
std::vector<int> varying(const std::array<bool, 3>& active) {
  std::vector<int> entries;
  for (int e = 0; e < 9; ++e)
    if (active[static_cast<std::size_t>(e / 3)] && active[static_cast<std::size_t>(e % 3)])
      entries.push_back(e);
  return entries;
}

void make_positive_one(const std::vector<int>& entries, double* A) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;
  const auto n = static_cast<Eigen::Index>(entries.size());
  const auto at = [&](Eigen::Index q, Eigen::Index r) -> double& {
    return A[9 * entries[static_cast<std::size_t>(q)] + entries[static_cast<std::size_t>(r)]];
  };
  Matrix half(n, n);
  for (Eigen::Index q = 0; q < n; ++q)
    for (Eigen::Index r = 0; r < n; ++r) half(q, r) = 0.5 * (at(q, r) + at(r, q));
  const Eigen::LDLT<Matrix> factor(half);
  if (!factor.isPositive()) {
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(half);
    half = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
           eigen.eigenvectors().transpose();
  }
  for (Eigen::Index q = 0; q < n; ++q)
    for (Eigen::Index r = 0; r < n; ++r) at(q, r) = 0.5 * (half(q, r) + half(r, q));
}

}  // namespace

ParticleStresses::ParticleStresses(const NodesOfStep::Parts& parts, const ThreadTeam& team,
                                   double time)
    : parts_(parts),
      team_(&team),
      time_(time),
      T_(parts.particles->count()),
      A_(T_.size()),
      modulus_(T_.size()),
      stiffest_(T_.size()) {
  for (std::size_t k = 0; k < T_.size(); ++k) {
    if (parts.solids->materials[k].rigid) continue;
    const std::size_t n = parts.particles->kind(k).now.size();
    T_[k].resize(9 * n);
    modulus_[k].resize(n);
    stiffest_[k].assign(n, 0.0);
    for (std::size_t at = 0; at < n; at += chunk_size)
      chunks_.push_back({k, at, static_cast<int>(std::min<std::size_t>(chunk_size, n - at))});
  }
}

void ParticleStresses::deformation(const NodesOfStep& nodes, std::size_t kind,
                                   const Response::Span& span, const Response& response,
                                   ChunkOfMatrices& phi) const {
  response.at_rest(span, phi);
  const Stencils& s = parts_.reached->of(kind);
  for (int q = 0; q < span.count; ++q) {
    const std::size_t p = span.at + static_cast<std::size_t>(q);
    double sum[9] = {};
    for (std::size_t e = s.first(p); e < s.first(p + 1); ++e) {
      Vec3 u = nodes.u[static_cast<std::size_t>(s.node[e])];
      const std::array<double, 3>& g = s.slope[e];
      if (s.flipped[e] != 0) u = {s.sign(e, 0) * u.x, s.sign(e, 1) * u.y, s.sign(e, 2) * u.z};
      for (std::size_t k = 0; k < 3; ++k) {
        sum[k] += u.x * g[k];
        sum[3 + k] += u.y * g[k];
        sum[6 + k] += u.z * g[k];
      }
    }
    for (int e = 0; e < 9; ++e) phi.e[e][q] += sum[e];
  }
}

bool ParticleStresses::evaluate(const NodesOfStep& nodes, std::string& reason) {
  return evaluate_all(nodes, false, reason);
}

bool ParticleStresses::evaluate_tangents(const NodesOfStep& nodes, std::string& reason) {
  for (std::size_t k = 0; k < A_.size(); ++k) A_[k].resize(9 * T_[k].size());
  if (!evaluate_all(nodes, true, reason)) return false;
  measure_tangents();
  return true;
}

void ParticleStresses::keep(const Chunk& chunk, const Response& response,
                            const ChunkOfMatrices& T) {
  const ParticleSet& set = parts_.particles->kind(chunk.kind).now;
  const Columns& c = (*parts_.carried)[chunk.kind].columns;
  const double* m = set.column(static_cast<std::size_t>(c.mass)) + chunk.at;
  const double* V = set.column(static_cast<std::size_t>(c.volume)) + chunk.at;
  double* to = T_[chunk.kind].data() + 9 * chunk.at;
  double* modulus = modulus_[chunk.kind].data() + chunk.at;
  for (int q = 0; q < chunk.count; ++q) {
    for (int e = 0; e < 9; ++e) to[9 * q + e] = T.e[e][q];
    const double speed = response.wave_speed()[q];
    modulus[q] = m[q] / V[q] * speed * speed;
  }
}

// False: a particle cannot take these displacements; of several the first is reported.
bool ParticleStresses::evaluate_all(const NodesOfStep& nodes, bool with_tangents,
                                    std::string& reason) {
  struct Scratch {
    std::vector<std::unique_ptr<Response>> of;
    ChunkOfMatrices phi, T;
  };
  std::vector<std::unique_ptr<Scratch>> scratch(static_cast<std::size_t>(team_->size()));
  std::mutex guard;
  std::pair<std::size_t, std::size_t> worst{~std::size_t{0}, 0};
  team_->for_each(chunks_.size(), [&](std::size_t n, int thread) {
    const Chunk& chunk = chunks_[n];
    auto& mine = scratch[static_cast<std::size_t>(thread)];
    if (mine == nullptr) {
      mine = std::make_unique<Scratch>();
      mine->of.resize(T_.size());
    }
    auto& response = mine->of[chunk.kind];
    if (response == nullptr)
      response = std::make_unique<Response>(*parts_.solids, parts_.solids->materials[chunk.kind],
                                            (*parts_.carried)[chunk.kind],
                                            least_spacing(*parts_.level), parts_.level->active);
    const Response::Span span{&parts_.particles->kind(chunk.kind).now, chunk.at, chunk.count, time_,
                              nodes.dt()};
    deformation(nodes, chunk.kind, span, *response, mine->phi);
    const auto fault = with_tangents ? response->tangents(span, mine->phi, mine->T,
                                                          A_[chunk.kind].data() + 81 * chunk.at)
                                     : response->trial_forces(span, mine->phi, mine->T);
    if (fault) {
      const std::lock_guard lock(guard);
      const std::pair place{chunk.kind, fault->particle};
      if (place >= worst) return;
      worst = place;
      reason = describe_fault(*span.set, chunk.kind, parts_.solids->materials[chunk.kind], *fault);
      return;
    }
    keep(chunk, *response, mine->T);
  });
  return worst.first == ~std::size_t{0};
}

// Tangents of failed particles, which have no stiffness, are round-off: they do not count.
void ParticleStresses::measure_tangents() {
  constexpr double counts = 1e-8;  // of the largest of all
  std::vector<std::vector<double>> apart(stiffest_);
  const std::vector<int> entries = varying(parts_.level->active);
  team_->for_each(chunks_.size(), [&](std::size_t n, int) {
    const Chunk& chunk = chunks_[n];
    for (std::size_t p = chunk.at; p < chunk.at + static_cast<std::size_t>(chunk.count); ++p) {
      const double* A = A_[chunk.kind].data() + 81 * p;
      double &most = stiffest_[chunk.kind][p], &difference = apart[chunk.kind][p];
      most = difference = 0;
      for (const int q : entries)
        for (const int r : entries) {
          most = std::max(most, std::fabs(A[9 * q + r]));
          difference = std::max(difference, std::fabs(A[9 * q + r] - A[9 * r + q]));
        }
    }
  });
  double largest = 0;
  for (const std::vector<double>& of_kind : stiffest_)
    for (const double most : of_kind) largest = std::max(largest, most);
  asymmetry_ = 0;
  for (std::size_t k = 0; k < stiffest_.size(); ++k)
    for (std::size_t p = 0; p < stiffest_[k].size(); ++p)
      if (stiffest_[k][p] > counts * largest)
        asymmetry_ = std::max(asymmetry_, apart[k][p] / stiffest_[k][p]);
}

void ParticleStresses::make_positive() {
  const std::vector<int> entries = varying(parts_.level->active);
  team_->for_each(chunks_.size(), [&](std::size_t n, int) {
    const Chunk& chunk = chunks_[n];
    for (std::size_t p = chunk.at; p < chunk.at + static_cast<std::size_t>(chunk.count); ++p)
      make_positive_one(entries, A_[chunk.kind].data() + 81 * p);
  });
  asymmetry_ = 0;
}

}  // namespace sluice::mpm

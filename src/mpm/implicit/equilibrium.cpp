#include "mpm/implicit/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace sluice::mpm {
namespace {

constexpr double round_off = 1e-13;  // of the forces in a residual
constexpr double strained = 0.1;     // of stiffness, beside these: a strain of 1e-14
constexpr double still = 1e-14;      // of a cell: no displacement at all
constexpr int most_halvings = 8;

double least_spacing(const Level& level) {
  double least = 1e300;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) least = std::min(least, level.spacing[d]);
  return least;
}

}  // namespace

Equilibrium::Equilibrium(const NodesOfStep::Parts& parts, const ThreadTeam& team, double time)
    : parts_(parts), team_(&team), time_(time), T_(parts.particles->count()), A_(T_.size()) {
  for (std::size_t k = 0; k < T_.size(); ++k) {
    if (parts.solids->materials[k].rigid) continue;
    const std::size_t n = parts.particles->kind(k).now.size();
    T_[k].resize(9 * n);
    A_[k].assign(81 * n, 0.0);
    for (std::size_t at = 0; at < n; at += chunk_size)
      chunks_.push_back({k, at, static_cast<int>(std::min<std::size_t>(chunk_size, n - at))});
  }
}

void Equilibrium::deformation(const NodesOfStep& nodes, std::size_t kind,
                              const Response::Span& span, const Response& response,
                              ChunkOfMatrices& phi) const {
  response.at_rest(span, phi);
  const Stencils& s = parts_.reached->of(kind);
  for (int q = 0; q < span.count; ++q) {
    const std::size_t p = span.at + static_cast<std::size_t>(q);
    for (std::size_t e = s.first(p); e < s.first(p + 1); ++e) {
      const Vec3& u = nodes.u[static_cast<std::size_t>(s.node[e])];
      for (int d = 0; d < 3; ++d) {
        const double way = s.sign(e, d) * u[d];
        for (std::size_t k = 0; k < 3; ++k)
          phi.e[3 * static_cast<std::size_t>(d) + k][q] += way * s.slope[e][k];
      }
    }
  }
}

// T and A of all particles; false: one cannot take these displacements.
bool Equilibrium::evaluate(const NodesOfStep& nodes, std::string& reason) {
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
    const auto fault =
        response->tangents(span, mine->phi, mine->T, A_[chunk.kind].data() + 81 * chunk.at);
    if (fault) {
      const std::lock_guard lock(guard);
      const std::pair place{chunk.kind, fault->particle};
      if (place >= worst) return;
      worst = place;
      const ParticleSet& set = *span.set;
      const Vec3 x = set.position(fault->particle);
      reason = fmt::format("particle {} of material {} '{}' at [{:g}, {:g}, {:g}]: {} ({:g})",
                           set.id(fault->particle), chunk.kind,
                           parts_.solids->materials[chunk.kind].name, x.x, x.y, x.z, fault->reason,
                           fault->value);
      return;
    }
    double* T = T_[chunk.kind].data() + 9 * chunk.at;
    for (int q = 0; q < chunk.count; ++q)
      for (int e = 0; e < 9; ++e) T[9 * q + e] = mine->T.e[e][q];
  });
  return worst.first == ~std::size_t{0};
}

void Equilibrium::number_unknowns(const NodesOfStep& nodes) {
  unknown_.assign(nodes.count(), {-1, -1, -1});
  unknowns_ = 0;
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (int d = 0; d < 3; ++d)
      if (nodes.is_free(n, d)) unknown_[n][static_cast<std::size_t>(d)] = unknowns_++;
}

void Equilibrium::find_pattern() {
  near_.assign(unknown_.size(), {});
  team_->for_each(unknown_.size(), [&](std::size_t n, int) {
    std::vector<std::int32_t>& near = near_[n];
    for (const ReachedNodes::Entry& e : parts_.reached->reaching(n)) {
      if (parts_.solids->materials[e.kind].rigid) continue;
      const Stencils& s = parts_.reached->of(e.kind);
      const auto first = s.node.begin() + static_cast<std::ptrdiff_t>(s.first(e.particle));
      near.insert(near.end(), first, first + s.per);
      if (near.size() > 4096) {
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    near.shrink_to_fit();
  });
  rows_.begin.assign(1, 0);
  rows_.column.clear();
  for (std::size_t n = 0; n < unknown_.size(); ++n)
    for (const int row : unknown_[n]) {
      if (row < 0) continue;
      for (const std::int32_t m : near_[n])
        for (const int column : unknown_[static_cast<std::size_t>(m)])
          if (column >= 0) rows_.column.push_back(column);
      rows_.begin.push_back(static_cast<int>(rows_.column.size()));
    }
  rows_.value.assign(rows_.column.size(), 0.0);
}

// One node: its rows, its part of the right-hand side. The sum of the sizes of forces in it.
double Equilibrium::assemble_row(const NodesOfStep& nodes, std::size_t n, bool gives,
                                 std::vector<int>& place, std::vector<double>& blocks) {
  const std::vector<std::int32_t>& near = near_[n];
  for (std::size_t j = 0; j < near.size(); ++j)
    place[static_cast<std::size_t>(near[j])] = static_cast<int>(j);
  blocks.assign(9 * near.size(), 0.0);
  Vec3 inner{};
  double size = 0;
  for (const ReachedNodes::Entry& entry : parts_.reached->reaching(n)) {
    if (parts_.solids->materials[entry.kind].rigid) continue;
    const Stencils& s = parts_.reached->of(entry.kind);
    const double* T = T_[entry.kind].data() + 9 * static_cast<std::size_t>(entry.particle);
    const double* A = A_[entry.kind].data() + 81 * static_cast<std::size_t>(entry.particle);
    const std::array<double, 3>& g = s.slope[entry.entry];
    double M[3][9];
    for (int a = 0; a < 3; ++a) {
      const double sign = s.sign(entry.entry, a);
      const double f = sign * (T[3 * a] * g[0] + T[3 * a + 1] * g[1] + T[3 * a + 2] * g[2]);
      inner[a] -= f;
      size += std::fabs(f);
      const double* row = A + 27 * a;
      double stiffest = 0;
      for (int e = 0; e < 9; ++e) {
        M[a][e] = sign * (row[e] * g[0] + row[9 + e] * g[1] + row[18 + e] * g[2]);
        stiffest = std::max(stiffest, std::fabs(M[a][e]));
      }
      size += strained * stiffest;
    }
    for (std::size_t e = s.first(entry.particle); e < s.first(entry.particle + 1); ++e) {
      double* block =
          blocks.data() + 9 * static_cast<std::size_t>(place[static_cast<std::size_t>(s.node[e])]);
      const std::array<double, 3>& h = s.slope[e];
      for (int b = 0; b < 3; ++b) {
        const double sign = s.sign(e, b);
        for (int a = 0; a < 3; ++a)
          block[3 * a + b] +=
              sign * (M[a][3 * b] * h[0] + M[a][3 * b + 1] * h[1] + M[a][3 * b + 2] * h[2]);
      }
    }
  }
  inner_[n] = inner;
  const Vec3 acceleration = nodes.acceleration(n);
  for (std::size_t a = 0; a < 3; ++a) {
    const int row = unknown_[n][a];
    if (row < 0) continue;
    const auto d = static_cast<int>(a);
    double& right = right_[static_cast<std::size_t>(row)];
    right = nodes.force[n][d] + inner[d] - nodes.mass[n] * acceleration[d];
    size += std::fabs(nodes.force[n][d]) + nodes.inertia(n) * std::fabs(nodes.u[n][d]);
    auto to = static_cast<std::size_t>(rows_.begin[static_cast<std::size_t>(row)]);
    for (std::size_t j = 0; j < near.size(); ++j) {
      const auto m = static_cast<std::size_t>(near[j]);
      for (std::size_t b = 0; b < 3; ++b) {
        double value = blocks[9 * j + 3 * a + b];
        if (m == n && a == b) value += nodes.inertia(n);
        if (unknown_[m][b] >= 0)
          rows_.value[to++] = value;
        else if (gives)
          right -= value * gap_[m][static_cast<int>(b)];
      }
    }
  }
  return size;
}

// The largest sum of sizes of forces on a node.
double Equilibrium::assemble(const NodesOfStep& nodes, bool gives) {
  right_.assign(static_cast<std::size_t>(unknowns_), 0.0);
  inner_.assign(nodes.count(), Vec3{});
  gap_.assign(nodes.count(), Vec3{});
  if (gives)
    for (std::size_t n = 0; n < nodes.count(); ++n)
      for (int d = 0; d < 3; ++d)
        if (nodes.given[n][static_cast<std::size_t>(d)])
          gap_[n][d] = nodes.way[n][d] - nodes.u[n][d];
  struct Scratch {
    std::vector<int> place;
    std::vector<double> blocks;
    double size = 0;
  };
  std::vector<Scratch> scratch(static_cast<std::size_t>(team_->size()));
  team_->for_each(nodes.count(), [&](std::size_t n, int thread) {
    if (!nodes.deforms[n]) return;
    Scratch& mine = scratch[static_cast<std::size_t>(thread)];
    mine.place.resize(nodes.count());
    mine.size = std::max(mine.size, assemble_row(nodes, n, gives, mine.place, mine.blocks));
  });
  double size = 0;
  for (const Scratch& s : scratch) size = std::max(size, s.size);
  return size;
}

// u moves by a share of the change; |du|^2 of all of it, in squares of cells.
double Equilibrium::move(NodesOfStep& nodes, const std::vector<double>& change, double share,
                         bool gives) const {
  double square = 0;
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (int d = 0; d < 3; ++d) {
      const int row = unknown_[n][static_cast<std::size_t>(d)];
      double du = row >= 0 ? change[static_cast<std::size_t>(row)] : 0;
      if (row < 0 && gives) du = gap_[n][d];
      nodes.u[n][d] += share * du;
      const double cells = du / parts_.level->spacing[d];
      square += cells * cells;
    }
  return square;
}

NewtonReport Equilibrium::find(NodesOfStep& nodes, SparseSolver& solver) {
  const ImplicitSettings& settings = *parts_.solids->implicit;
  NewtonReport report;
  number_unknowns(nodes);
  find_pattern();
  double most_square = 0, first_energy = 0;
  bool gives = true;
  if (!evaluate(nodes, report.reason)) {
    // The predictor goes too far.
    for (Vec3& u : nodes.u) u = {};
    if (!evaluate(nodes, report.reason)) return report;
  }
  for (;;) {
    const double size = assemble(nodes, gives);
    double most = 0;
    for (const double r : right_) most = std::max(most, std::fabs(r));
    report.residuals.push_back(most);
    if (!std::isfinite(most)) {
      report.reason = "Newton's method: a force is no number";
      return report;
    }
    const bool given = std::any_of(gap_.begin(), gap_.end(), [](Vec3 g) { return g != Vec3{}; });
    if (most <= round_off * size && !given) {
      report.converged = true;
      return report;
    }
    if (report.iterations == settings.max_iterations) {
      report.reason = fmt::format(
          "Newton's method has not converged in {} iterations (iters_before_timestep_restart); the "
          "largest force on a node that is not balanced is {:g} of {:g} N",
          report.iterations, most, size);
      return report;
    }
    ++report.iterations;
    std::vector<double> change;
    if (!solver.solve(rows_, right_, change)) {
      report.reason =
          "the stiffness of the nodes is singular: a body that nothing holds has no equilibrium "
          "without inertia (<dynamic>true</dynamic>)";
      return report;
    }
    double energy = 0;
    for (std::size_t i = 0; i < change.size(); ++i) energy += change[i] * right_[i];
    energy = std::fabs(energy);
    const double square = move(nodes, change, 1, gives);
    if (report.iterations == 1) first_energy = energy;
    most_square = std::max(most_square, square);
    if (!evaluate(nodes, report.reason)) {
      double share = 1;
      int halvings = 0;
      do {
        if (++halvings > most_halvings) return report;
        move(nodes, change, -0.5 * share, gives);
        share *= 0.5;
      } while (!evaluate(nodes, report.reason));
      // What is given has come part of its way: the rest enters with the next iteration.
      continue;
    }
    gives = false;
    if (square <= still * still * static_cast<double>(change.size()) ||
        (square <= settings.displacement_criterion * most_square &&
         energy <= settings.energy_criterion * first_energy)) {
      assemble(nodes, false);
      report.converged = true;
      return report;
    }
  }
}

}  // namespace sluice::mpm

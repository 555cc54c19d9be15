#include "mpm/implicit/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

constexpr double round_off = 1e-13;     // of the forces in a residual
constexpr double strained = 0.1;        // of stiffness, beside these: a strain of 1e-14
constexpr double still = 1e-14;         // of a cell: no displacement at all
constexpr double no_stiffness = 1e-16;  // of the largest: unknowns that are not moved
constexpr int most_halvings = 8;
// Of inexact solutions: the residual of a linear system over its right-hand side, of Newton's
// method over its first; and by how much an iteration reduces it with a matrix that serves on.
constexpr double linear_tolerance = 0.01, last_residual = 1e-6, serves = 0.3;
constexpr int most_solves = 4;                // per iteration that the deck allows
constexpr double least_increment = 1. / 256;  // of the loads
constexpr int easy_iterations = 6;            // the next increment may be twice as large

std::string reason_of_failure(const NodeSolver::Solution& solution, bool directly) {
  constexpr const char* advice =
      "a body that nothing holds has no equilibrium without inertia (<dynamic>true</dynamic>)";
  if (directly) return fmt::format("the stiffness of the nodes is singular: {}", advice);
  return fmt::format(
      "the linear system of the displacements is not solved: after {} iterations of conjugate "
      "gradients the residual is {:.3g} of the right-hand side; {}; <solver>simple</solver> solves "
      "directly",
      solution.iterations, solution.residual, advice);
}

}  // namespace

// Of one series of iterations.
struct Equilibrium::Progress {
  int iterations = 0, solves = 0;
  double size = 0;  // the largest sum of sizes of forces on a node, N
  double most = 0;  // the largest residual, N
  double norm = 0, before = 0,
         first = 0;  // of the residual: now, before, with what is given at first
  double most_square = 0, first_energy = 0;
  bool gives = true;              // given displacements have not come all of their way
  bool gap = false;               // and some way is left
  bool fresh = true;              // the next iteration takes new tangents
  NodeSolver::Solution solution;  // of the last linear system
  bool near = false;              // the last change is as small as the deck wants
  bool still = false;             // it is round-off
};

Equilibrium::Equilibrium(const NodesOfStep::Parts& parts, const ThreadTeam& team, double time)
    : parts_(parts), team_(&team), workers_(workers_of(team)), particles_(parts, team, time) {}
Equilibrium::~Equilibrium() = default;

void Equilibrium::prepare(const NodesOfStep& nodes, SparseSolver& direct) {
  const bool smooths = SecondDifferences::needed(parts_, nodes, particles_);
  pairs_ = std::make_unique<NodePairs>(parts_, NodePairs::Which{false, smooths}, workers_);
  if (smooths) second_ = SecondDifferences(parts_, nodes, particles_, *pairs_);
  stiffness_ = std::make_unique<Stiffness>(parts_, *pairs_, workers_);
  NodeSolver::System system{
      &stiffness_->rows(), {}, stiffness_->width(), parts_.solids->implicit->direct, true};
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (int c = 0; c < stiffness_->width(); ++c)
      system.free.push_back(nodes.is_free(n, stiffness_->axis(c)) ? 1 : 0);
  solver_ = std::make_unique<NodeSolver>(std::move(system), workers_, direct);
}

NewtonReport Equilibrium::find(NodesOfStep& nodes, SparseSolver& direct) {
  NewtonReport report;
  if (!particles_.evaluate(nodes, report.reason)) {
    // The predictor goes too far.
    for (Vec3& u : nodes.u) u = {};
    if (!particles_.evaluate(nodes, report.reason)) return report;
  }
  prepare(nodes, direct);
  report.unknowns = solver_->unknowns();
  report.directly = solver_->solves_directly();
  choose_start(nodes);
  iterate(nodes, 1, report);
  if (!report.converged && !nodes.dynamic()) apply_in_increments(nodes, report);
  return report;
}

// Without inertia the predictor goes on as in the step before; under loads that rest the place of
// the start is better. From where the residual is smaller, unless given displacements go on.
void Equilibrium::choose_start(NodesOfStep& nodes) {
  if (nodes.dynamic() || std::any_of(nodes.way.begin(), nodes.way.end(),
                                     [](const Vec3& way) { return way != Vec3{}; }))
    return;
  const auto residual = [&] {
    find_forces(nodes);
    find_residual(nodes, 1);
    return solve::dot(workers_, right_, right_);
  };
  const double predicted = residual();
  std::vector<Vec3> u(nodes.count());
  std::swap(u, nodes.u);
  std::string ignored;
  if (particles_.evaluate(nodes, ignored) && residual() <= predicted) return;
  std::swap(u, nodes.u);
  particles_.evaluate(nodes, ignored);
}

void Equilibrium::iterate(NodesOfStep& nodes, double share, NewtonReport& report) {
  const int most = parts_.solids->implicit->max_iterations;
  Progress now;
  report.converged = false;
  for (;;) {
    now.size = find_forces(nodes);
    now.most = find_residual(nodes, share);
    now.before = now.norm;
    if (now.solves > 0) now.norm = solver_->norm(right_);
    report.residuals.push_back(now.most);
    if (!std::isfinite(now.most)) {
      report.reason = "Newton's method: a force is not a number";
      return;
    }
    now.gap = now.gives && find_gap(nodes, share);
    report.converged = has_converged(now);
    if (report.converged) {
      report.reason.clear();  // of attempts before
      return;
    }
    if (now.iterations >= most || now.solves >= most_solves * most) {
      report.reason = fmt::format(
          "Newton's method has not converged in {} iterations (iters_before_timestep_restart); the "
          "largest force on a node that is not balanced is {:g} of {:g} N",
          now.iterations, now.most, now.size);
      return;
    }
    if (!solve(nodes, now, report) || !step(nodes, now, report)) return;
  }
}

bool Equilibrium::has_converged(const Progress& now) const {
  if (now.most <= round_off * now.size && !now.gap) return true;
  if (now.still) return true;
  return now.near && (solver_->solves_directly() || now.norm <= last_residual * now.first);
}

// The largest sum of sizes of forces on a node. Each node's sum runs over particles in their order.
double Equilibrium::find_forces(const NodesOfStep& nodes) {
  const std::size_t n = nodes.count(),
                    pieces = workers_.count == 1 ? 1 : 4 * static_cast<std::size_t>(workers_.count);
  inner_.assign(n, Vec3{});
  smoothing_.assign(n, Vec3{});
  size_.assign(n, 0.0);
  workers_.run(pieces, [&](std::size_t piece, int) {
    for (std::size_t k = 0; k < particles_.kinds(); ++k)
      if (!parts_.solids->materials[k].rigid)
        add_particle_forces(k, piece * n / pieces, (piece + 1) * n / pieces);
  });
  second_.add_forces(nodes, smoothing_);
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!nodes.deforms[i]) continue;
    double size = size_[i];
    for (int d = 0; d < 3; ++d)
      if (nodes.is_free(i, d))
        size += std::fabs(nodes.force[i][d]) + nodes.inertia(i) * std::fabs(nodes.u[i][d]);
    most = std::max(most, size);
  }
  return most;
}

// Of a kind, to nodes first, ..., end - 1.
void Equilibrium::add_particle_forces(std::size_t k, std::size_t first, std::size_t end) {
  const Stencils& s = parts_.reached->of(k);
  const ParticleSet& set = parts_.particles->kind(k).now;
  const double* V = set.column(static_cast<std::size_t>((*parts_.carried)[k].columns.volume));
  for (std::size_t p = 0; p < set.size(); ++p) {
    double T[9];
    std::copy_n(particles_.stress(k).data() + 9 * p, 9, T);
    const double stiffness = 3 * strained * particles_.modulus(k)[p] * V[p];
    for (std::size_t e = s.first(p); e < s.first(p + 1); ++e) {
      const auto node = static_cast<std::size_t>(s.node[e]);
      if (node < first || node >= end) continue;
      const std::array<double, 3>& g = s.slope[e];
      Vec3 f{T[0] * g[0] + T[1] * g[1] + T[2] * g[2], T[3] * g[0] + T[4] * g[1] + T[5] * g[2],
             T[6] * g[0] + T[7] * g[1] + T[8] * g[2]};
      if (s.flipped[e] != 0) f = {s.sign(e, 0) * f.x, s.sign(e, 1) * f.y, s.sign(e, 2) * f.z};
      inner_[node] -= f;
      size_[node] += std::fabs(f.x) + std::fabs(f.y) + std::fabs(f.z) +
                     stiffness * std::max({std::fabs(g[0]), std::fabs(g[1]), std::fabs(g[2])});
    }
  }
}

// Of what is free, with a share of what has been added since the last equilibrium; the largest, N.
double Equilibrium::find_residual(const NodesOfStep& nodes, double share) {
  const auto w = static_cast<std::size_t>(stiffness_->width());
  right_.assign(w * nodes.count(), 0.0);
  double most = 0;
  for (std::size_t n = 0; n < nodes.count(); ++n) {
    const Vec3 acceleration = nodes.acceleration(n);
    for (std::size_t c = 0; c < w; ++c) {
      const int d = stiffness_->axis(static_cast<int>(c));
      if (!nodes.is_free(n, d)) continue;
      double r =
          nodes.force[n][d] + inner_[n][d] + smoothing_[n][d] - nodes.mass[n] * acceleration[d];
      if (share < 1) r -= (1 - share) * held_[n][d];
      right_[w * n + c] = r;
      most = std::isfinite(r) ? std::max(most, std::fabs(r)) : r;
      if (!std::isfinite(r)) return r;
    }
  }
  return most;
}

bool Equilibrium::find_gap(const NodesOfStep& nodes, double share) {
  gap_.assign(nodes.count(), Vec3{});
  bool any = false;
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (int d = 0; d < 3; ++d)
      if (nodes.given[n][static_cast<std::size_t>(d)]) {
        gap_[n][d] = share * nodes.way[n][d] - nodes.u[n][d];
        any |= gap_[n][d] != 0;
      }
  return any;
}

// New tangents, or those at hand without their negative eigenvalues; the matrix of them, and the
// part of the right-hand side that given displacements make.
bool Equilibrium::renew(const NodesOfStep& nodes, bool positive, Progress& now,
                        NewtonReport& report) {
  if (positive)
    particles_.make_positive();
  else if (!particles_.evaluate_tangents(nodes, report.reason))
    return false;
  stiffness_->assemble(particles_, solver_->takes_symmetric(particles_.asymmetry()));
  second_.add_stiffness(*stiffness_);
  const double of_bodies = stiffness_->diagonal_sum();
  stiffness_->add_inertia(nodes);
  const double all = stiffness_->diagonal_sum();
  if (now.gap) find_given_forces(nodes);
  // A direct solution deals with unknowns without stiffness itself.
  stiffness_->leave_out(nodes, solver_->solves_directly() ? 0 : no_stiffness);
  solver_->set_up(particles_.asymmetry(), all > 0 ? 1 - of_bodies / all : 0);
  return true;
}

// -K times the gap, on what is free.
void Equilibrium::find_given_forces(const NodesOfStep& nodes) {
  const auto w = static_cast<std::size_t>(stiffness_->width());
  std::vector<double> gap(right_.size()), force(right_.size());
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (std::size_t c = 0; c < w; ++c)
      gap[w * n + c] = gap_[n][stiffness_->axis(static_cast<int>(c))];
  solve::multiply(stiffness_->rows(), workers_, gap, force);
  given_.assign(right_.size(), 0.0);
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (std::size_t c = 0; c < w; ++c)
      if (nodes.is_free(n, stiffness_->axis(static_cast<int>(c))))
        given_[w * n + c] = -force[w * n + c];
}

// The largest force on a free node, N.
double Equilibrium::add_given_forces() {
  double most = 0;
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] += given_[i];
    most = std::max(most, std::fabs(right_[i]));
  }
  return most;
}

// The change of u, with new tangents if they are due.
bool Equilibrium::solve(const NodesOfStep& nodes, Progress& now, NewtonReport& report) {
  const bool renewed =
      now.fresh || now.gap || solver_->solves_directly() || now.norm > serves * now.before;
  const std::vector<double> residual = right_;
  const auto attempt = [&](bool positive) {
    if (positive || renewed) {
      if (!renew(nodes, positive, now, report)) return false;
      right_ = residual;
      if (now.gap) report.residuals.back() = add_given_forces();
    }
    now.solution = solver_->solve(right_, change_, linear_tolerance);
    ++now.solves;
    ++report.solves;
    report.gradient_iterations += now.solution.iterations;
    return true;
  };
  if (renewed) {
    ++now.iterations;
    ++report.iterations;
  }
  now.fresh = false;
  if (!attempt(false)) return false;
  // Direct solutions go on with matrices that are not definite, unless that has failed.
  if (now.solution.negative_curvature && (!solver_->solves_directly() || in_increments_)) {
    ++report.projected;
    now.fresh = true;
    if (!attempt(true)) return false;
  }
  now.norm = solver_->norm(right_);  // with the matrix of this iteration
  if (now.first == 0) now.first = now.norm;
  if (now.solution.solved) return true;
  now.fresh = true;
  if (now.solution.helps) return true;
  report.reason = reason_of_failure(now.solution, solver_->solves_directly());
  return false;
}

// False: no part of the change is possible.
bool Equilibrium::step(NodesOfStep& nodes, Progress& now, NewtonReport& report) {
  const ImplicitSettings& settings = *parts_.solids->implicit;
  const double energy = std::fabs(solve::dot(workers_, change_, right_));
  const double square = move(nodes, 1, now.gap);
  if (now.first_energy == 0) now.first_energy = energy;
  now.most_square = std::max(now.most_square, square);
  now.near = now.still = false;
  if (!particles_.evaluate(nodes, report.reason)) {
    double share = 1;
    int halvings = 0;
    do {
      if (++halvings > most_halvings) return false;
      move(nodes, -0.5 * share, now.gap);
      share *= 0.5;
    } while (!particles_.evaluate(nodes, report.reason));
    // What is given has come part of its way: the rest enters with the next iteration.
    now.fresh = true;
    return true;
  }
  now.gives = false;
  if (!now.solution.solved) return true;
  now.still = square <= still * still * static_cast<double>(change_.size());
  now.near = square <= settings.displacement_criterion * now.most_square &&
             energy <= settings.energy_criterion * now.first_energy;
  return true;
}

// u moves by a share of the change; |du|^2 of all of it, in squares of cells.
double Equilibrium::move(NodesOfStep& nodes, double share, bool gives) const {
  const auto w = static_cast<std::size_t>(stiffness_->width());
  double square = 0;
  for (std::size_t n = 0; n < nodes.count(); ++n)
    for (std::size_t c = 0; c < w; ++c) {
      const int d = stiffness_->axis(static_cast<int>(c));
      double du = 0;
      if (nodes.is_free(n, d))
        du = change_[w * n + c];
      else if (gives)
        du = gap_[n][d];
      nodes.u[n][d] += share * du;
      const double cells = du / parts_.level->spacing[d];
      square += cells * cells;
    }
  return square;
}

// From the last equilibrium, where u = 0 and the residual is what has been added since.
void Equilibrium::apply_in_increments(NodesOfStep& nodes, NewtonReport& report) {
  const std::string at_once = report.reason;
  in_increments_ = true;
  for (Vec3& u : nodes.u) u = {};
  if (!particles_.evaluate(nodes, report.reason)) return;
  find_forces(nodes);
  held_.assign(nodes.count(), Vec3{});
  for (std::size_t n = 0; n < nodes.count(); ++n) held_[n] = nodes.force[n] + inner_[n];
  std::vector<Vec3> reached_u = nodes.u;
  double reached = 0, increment = 0.5;
  while (reached < 1) {
    const int before = report.iterations;
    const double next = std::min(1.0, reached + increment);
    iterate(nodes, next, report);
    if (report.converged) {
      ++report.increments;
      reached = next;
      reached_u = nodes.u;
      if (report.iterations - before <= easy_iterations) increment *= 2;
      continue;
    }
    increment *= 0.5;
    if (increment < least_increment) {
      report.reason = fmt::format(
          "{}; in increments {:.4g} of what the step adds to loads and given displacements was "
          "reached: {}. If the body buckles or falls, it needs inertia (<dynamic>true</dynamic>)",
          at_once, reached, report.reason);
      return;
    }
    nodes.u = reached_u;
    std::string ignored;
    particles_.evaluate(nodes, ignored);
  }
}

}  // namespace sluice::mpm

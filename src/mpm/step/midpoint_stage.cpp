// The midpoint transfer: new velocities and spins of particles at the places of the middle of a
// step, from which these go to the nodes once more (SolidLevels::map_back); mpm_transfers.md.
//
//   v+ = v + sum S dv_i,   w+ = w + I^-1 sum S r x dv_i,   x' = x + dt v+/2
//   vh_i = sum m S' (v+ + w+ x (x_i - x'))/sum m S',   L = sum vh_i (x) grad S'
//   F+ = (I - dt L/2)^-1 (I + dt L/2) F,   x+ = x + dt sum S' vh_i
//
// Forces on nodes and velocities of nodes are adjoint in both maps, so that stress neither loses
// nor gains energy by them, and what turns is mapped as it turns.
#include "mpm/step/midpoint_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/thread_report.hpp"
#include "mpm/step/travel.hpp"

namespace sluice::mpm {
namespace {

constexpr double spin_relaxation = 0.001;  // kappa: spins follow the grid in h/(kappa c)
constexpr double least_inertia = 1e-3;     // of I, h^2 for each direction

}  // namespace

void to_end_of_step(double dt, int n, GridAtParticles& read) {
  const double half = 0.5 * dt, two = 2 / dt;
  auto& L = read.L;
#pragma GCC ivdep
  for (int q = 0; q < n; ++q) {
    const double a = 1 - half * L[0][q], b = -half * L[1][q], c = -half * L[2][q];
    const double d = -half * L[3][q], e = 1 - half * L[4][q], f = -half * L[5][q];
    const double g = -half * L[6][q], h = -half * L[7][q], i = 1 - half * L[8][q];
    const double A = e * i - f * h, B = c * h - b * i, C = b * f - c * e;
    const double factor = two / (a * A + d * B + g * C);
    L[0][q] = factor * A - two;
    L[1][q] = factor * B;
    L[2][q] = factor * C;
    L[3][q] = factor * (f * g - d * i);
    L[4][q] = factor * (a * i - c * g) - two;
    L[5][q] = factor * (c * d - a * f);
    L[6][q] = factor * (d * h - e * g);
    L[7][q] = factor * (b * g - a * h);
    L[8][q] = factor * (a * e - b * d) - two;
  }
}

// Velocities and spins after the kick, places of the middle of the step.
void SolidStep::kick_particles(const BlockWork& w, const StageScope& scope, std::size_t at, int n,
                               ThreadReport& report) {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const bool loaded = outside_->acts(w.kind), corners = c.corners >= 0;
  ImpulsesAtParticles& got = report.impulses;
  interpolate_impulses(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                       static_cast<int>(at), n, loaded || corners, report.window, got);
  double way = 0;  // farthest, cells
  for (int d = 0; d < 3; ++d) {
    const double* x = w.set->coordinate(d) + at;
    const double* v = w.set->column(static_cast<std::size_t>(c.velocity + d)) + at;
    double* middle = w.next->coordinate(d) + at;
    double* to_v = w.next->column(static_cast<std::size_t>(c.velocity + d)) + at;
    const double half = 0.5 * scope.step.dt, inverse = 1 / level_.spacing[d];
    for (int q = 0; q < n; ++q) {
      to_v[q] = v[q] + got.dv[d][q];
      middle[q] = x[q] + half * to_v[q];
    }
    keep_larger(way, largest(0, static_cast<std::size_t>(n), 0,
                             [&](auto of) { return magnitude(half * of(to_v)) * inverse; }));
    const double* spin = w.set->column(static_cast<std::size_t>(c.spin + d)) + at;
    double* to_spin = w.next->column(static_cast<std::size_t>(c.spin + d)) + at;
    if (!turns(level_, d)) {
      std::fill_n(to_spin, n, 0.0);
      continue;
    }
    double least = 0;
    for (int k = 0; k < 3; ++k)
      if (k != d) least += least_inertia * level_.spacing[k] * level_.spacing[k];
    for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
      const auto inertia = q(got.inertia[d]);
      q.put(q(spin) + q(got.turn[d]) / larger(inertia, decltype(inertia){} + least), to_spin);
    });
  }
  book_kick(w, at, n, report);
  begin_losses(w, at, n, got);
  if (corners) keep_larger(way, halve_corners(w, 0.5 * scope.step.dt, at, n, got.corner));
  if (!(way <= farthest_middle)) {
    stay(w, at, n);
    report.keep_fault(0, fmt::format("particles of material {} '{}' would move {:g} cells in half "
                                     "this step, more than {:g}",
                                     w.kind, body.material->name, way, farthest_middle));
  }
  for (int d = 0; d < 3 && loaded; ++d) {
    std::copy_n(got.u[d], n, report.read.u[d]);
    std::copy_n(got.dv[d], n, report.read.dv[d]);
  }
  take_outside_forces(w, at, n, report.read, report.books);
  add_bounds(w, at, n, report);
}

// The step is not finished: its middle is its start, so that windows hold what is there.
void SolidStep::stay(const BlockWork& w, std::size_t at, int n) const {
  const Columns& c = bodies_[static_cast<std::size_t>(w.kind)].carried->columns;
  for (int d = 0; d < 3; ++d) std::copy_n(w.set->coordinate(d) + at, n, w.next->coordinate(d) + at);
  for (int k = 0; k < 3 * c.corner_count; ++k) {
    const auto column = static_cast<std::size_t>(c.corners + k);
    std::copy_n(w.set->column(column) + at, n, w.next->column(column) + at);
  }
}

// Corners that particles share go to the middle of the step with velocities that they share. The
// farthest way of one, cells.
double SolidStep::halve_corners(const BlockWork& w, double half, std::size_t at, int n,
                                const VelocitiesAtCorners& v) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  move_corners(body, w, at, n, body.units.reference, half, v);
  double way = 0;
  for (int k = 0; k < 3 * c.corner_count; ++k) {
    const auto column = static_cast<std::size_t>(c.corners + k);
    const double *from = w.set->column(column) + at, *to = w.next->column(column) + at;
    const double inverse = 1 / level_.spacing[k % 3];
    way = largest(0, static_cast<std::size_t>(n), way,
                  [&](auto of) { return magnitude(of(to) - of(from)) * inverse; });
    if (way != way) break;
  }
  return way;
}

// What velocities and spins of each particle get, m dv . (v + v+)/2 + m (w+ - w) . I (w + w+)/2;
// and the energies of spins, for the guard.
void SolidStep::book_kick(const BlockWork& w, std::size_t at, int n, ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  alignas(64) double gain[chunk_size] = {}, before[chunk_size] = {}, middle[chunk_size] = {},
                     after[chunk_size] = {}, spins[chunk_size];
  for (int d = 0; d < 3; ++d) {
    const double* v = w.set->column(static_cast<std::size_t>(c.velocity + d)) + at;
    const double* to_v = w.next->column(static_cast<std::size_t>(c.velocity + d)) + at;
    const double* spin = w.set->column(static_cast<std::size_t>(c.spin + d)) + at;
    const double* to_spin = w.next->column(static_cast<std::size_t>(c.spin + d)) + at;
    const double* inertia = report.impulses.inertia[d];
    for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
      const auto sum = q(spin) + q(to_spin);
      q.put(q(gain) + (q(to_v) * q(to_v) - q(v) * q(v)), gain);
      q.put(q(before) + q(inertia) * (q(spin) * q(spin)), before);
      q.put(q(middle) + q(inertia) * (sum * sum), middle);
      q.put(q(after) + q(inertia) * (q(to_spin) * q(to_spin)), after);
    });
  }
  const double* mass = w.set->column(static_cast<std::size_t>(c.mass)) + at;
  for (int q = 0; q < n; ++q) {
    gain[q] = 0.5 * mass[q] * (gain[q] + (after[q] - before[q]));
    spins[q] = 0.5 * mass[q] * (after[q] - before[q]);
    before[q] *= 0.5 * mass[q];
    middle[q] *= 0.125 * mass[q];
    after[q] *= 0.5 * mass[q];
  }
  using Of = BodyEnergySums;
  BodyEnergySums& to = report.books.bodies[static_cast<std::size_t>(w.kind)];
  const double unit = body.energy_units.energy;
  add_rounded(gain, n, unit, to[Of::kick_gain]);
  add_rounded(spins, n, unit, to[Of::inner_gain]);
  add_rounded(before, n, unit, to[Of::kinetic_before]);
  add_rounded(middle, n, unit, to[Of::kinetic_middle]);
  add_rounded(after, n, unit, to[Of::kinetic_after]);
}

// Spins are drawn to what the grid shows; the energy that this takes.
void SolidStep::relax_spins(const BlockWork& w, double dt, std::size_t at, int n,
                            ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const double beta = std::min(1.0, spin_relaxation * dt * body.rates.wave);
  alignas(64) double gain[chunk_size] = {};
  for (int k = 0; k < 3; ++k) {
    if (!turns(level_, k)) continue;
    double inertia = 0;
    for (int d = 0; d < 3; ++d)
      if (d != k) inertia += body.energy_units.moment[d];
    double* spin = w.next->column(static_cast<std::size_t>(c.spin + k)) + at;
    for (int q = 0; q < n; ++q) {
      const double before = spin[q];
      spin[q] += beta * (spin_of(report.read, k, q) - spin[q]);
      gain[q] += inertia * (spin[q] * spin[q] - before * before);
    }
  }
  const double* mass = w.set->column(static_cast<std::size_t>(c.mass)) + at;
  for (int q = 0; q < n; ++q) gain[q] *= 0.5 * mass[q];
  using Of = BodyEnergySums;
  BodyEnergySums& to = report.books.bodies[static_cast<std::size_t>(w.kind)];
  add_rounded(gain, n, body.energy_units.energy, to[Of::kinetic_after]);
  add_rounded(gain, n, body.energy_units.energy, to[Of::inner_gain]);
  if (c.lost_heat < 0) return;
  double* losses = w.next->column(static_cast<std::size_t>(c.lost_heat)) + at;
  for (int q = 0; q < n; ++q) losses[q] -= gain[q];
}

// Of new velocities and spins, and of places of the middle of the step.
void SolidStep::add_bounds(const BlockWork& w, std::size_t at, int n, ThreadReport& report) const {
  const Columns& c = bodies_[static_cast<std::size_t>(w.kind)].carried->columns;
  KindRates& rates = report.rates[static_cast<std::size_t>(w.kind)];
  for (int d = 0; d < 3; ++d) {
    const double* v = w.next->column(static_cast<std::size_t>(c.velocity + d));
    const double* spin = w.next->column(static_cast<std::size_t>(c.spin + d));
    const double* x = w.next->coordinate(d);
    const std::size_t end = at + static_cast<std::size_t>(n);
    const auto most = [&](double from, const auto& of) { return largest(at, end, from, of); };
    rates.up[d] = most(rates.up[d], [&](auto of) { return of(v); });
    rates.down[d] = most(rates.down[d], [&](auto of) { return -of(v); });
    if (turns(level_, d))
      rates.affine = most(rates.affine, [&](auto of) { return magnitude(of(spin)); });
    report.up[d] = most(report.up[d], [&](auto of) { return of(x); });
    report.down[d] = most(report.down[d], [&](auto of) { return -of(x); });
  }
}

std::vector<KindRates> SolidStep::kick_all(const StageScope& scope, std::string& fault) {
  std::vector<ThreadReport> reports = new_reports(scope);
  scope.levels.front()->team()->for_each(work_.size(), [&](std::size_t i, int thread) {
    BlockWork& w = work_[i];
    const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    ThreadReport& report = reports[static_cast<std::size_t>(thread)];
    if (!body.material->rigid) report.window.load(w.lowest, w.highest, body.table, body.nodes);
    report.up = report.down = KindRates::none();
    for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
      const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
      if (body.material->rigid)
        move_particles(w, scope, at, n, report);
      else
        kick_particles(w, scope, at, n, report);
    }
    if (body.material->rigid) return;
    find_middle_nodes(w, report);
  });
  return take_first_reports(scope, reports, fault);
}

// How far corners may be from their particle then, cells.
double SolidStep::extent_of_middle(const Body& body) const {
  return body.rates.extent + (solids_->carries_corners() ? 2 * farthest_middle : 0.0);
}

// Nodes around the places of the middle of the step, of all particles of a block.
void SolidStep::find_middle_nodes(BlockWork& w, const ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const int reach = by_corners(solids_->basis)
                        ? static_cast<int>(std::floor(extent_of_middle(body) + max_stray)) + 1
                        : 1;
  w.middle_lowest = w.lowest;
  w.middle_highest = w.highest;
  for (int d = 0; d < 3; ++d) {
    if (shape_.edge[d] == 1) continue;
    const Axis& axis = body.grid.axes[static_cast<std::size_t>(d)];
    const auto cell = [&](double place) {
      return static_cast<int>(std::floor(axis.place(place) + axis.first));
    };
    // A step in which a particle would go farther is not finished.
    w.middle_lowest[d] = std::max(cell(-report.down[d]) - reach, w.lowest[d] - 1);
    w.middle_highest[d] = std::min(cell(report.up[d]) + 1 + reach, w.highest[d] + 1);
  }
}

// Places at which mapped velocities are read.
std::array<const double*, 3> SolidStep::places_of_gradients(const BlockWork& w) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  if (!solids_->midpoint() || body.material->rigid) return places_of(*w.set, body.carried->columns);
  return {w.next->coordinate(0), w.next->coordinate(1), w.next->coordinate(2)};
}

// Corners that particles carry are those of the middle of the step; the shape of others is that of
// its start, so that a gradient that is constant in a particle is read as it is.
ParticleShape SolidStep::shape_of_gradients(const BlockWork& w) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  ParticleShape shape = shape_of(*w.set, c);
  if (solids_->midpoint() && !body.material->rigid) shape.corners = corners_of(*w.next, c);
  return shape;
}

// What was read at the middle of the step makes its end.
void SolidStep::finish_motion(const BlockWork& w, double dt, std::size_t at, int n,
                              ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  GridAtParticles& read = report.read;
  relax_spins(w, dt, at, n, report);
  to_end_of_step(dt, n, read);
  for (int d = 0; d < 3; ++d) {
    const double reference = body.mapped_units.reference[d];
    const double* x = w.set->coordinate(d) + at;
    double* to = w.next->coordinate(d) + at;
    for (int q = 0; q < n; ++q) to[q] = x[q] + dt * (reference + read.u[d][q]);
    if (c.displacement < 0) continue;
    const double* way = w.set->column(static_cast<std::size_t>(c.displacement + d)) + at;
    double* to_way = w.next->column(static_cast<std::size_t>(c.displacement + d)) + at;
    for (int q = 0; q < n; ++q) to_way[q] = way[q] + dt * (reference + read.u[d][q]);
  }
  if (c.corners >= 0) move_corners(body, w, at, n, body.mapped_units.reference, dt, read.corner);
  report.travel = std::max(report.travel, farthest_way(*w.set, *w.next, at, n, level_.spacing));
  report.left |= any_outside(level_, *w.next, at, n);
}

}  // namespace sluice::mpm

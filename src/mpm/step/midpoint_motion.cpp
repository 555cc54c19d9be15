#include "mpm/step/midpoint_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/midpoint_books.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {

static constexpr double least_inertia = 1e-3;  // of I, h^2 for each direction

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

void MidpointMotion::load_first(const BlockWork& w, const Body& body, ChunkBuffers& buffers) const {
  buffers.window.load(w.lowest, w.highest, body.table, body.nodes);
  buffers.up = buffers.down = KindRates::none();
}

// `way`: the farthest of a particle in half the step, cells.
void MidpointMotion::kick_along(const Chunk& chunk, int d, double& way) const {
  const Columns& c = chunk.columns();
  const Vec3 spacing = nodes_->level.spacing;
  const ImpulsesAtParticles& got = chunk.buffers->impulses;
  const int n = chunk.n;
  const double *x = chunk.work->set->coordinate(d) + chunk.at, *v = chunk.old(c.velocity + d);
  double *middle = chunk.work->next->coordinate(d) + chunk.at, *to_v = chunk.made(c.velocity + d);
  const double half = 0.5 * chunk.dt(), inverse = 1 / spacing[d];
  for (int q = 0; q < n; ++q) {
    to_v[q] = v[q] + got.dv[d][q];
    middle[q] = x[q] + half * to_v[q];
  }
  keep_larger(way, largest(0, static_cast<std::size_t>(n), 0,
                           [&](auto of) { return magnitude(half * of(to_v)) * inverse; }));
  const double* spin = chunk.old(c.spin + d);
  double* to_spin = chunk.made(c.spin + d);
  if (!turns(nodes_->level, d)) {
    std::fill_n(to_spin, n, 0.0);
    return;
  }
  double least = 0;
  for (int k = 0; k < 3; ++k)
    if (k != d) least += least_inertia * spacing[k] * spacing[k];
  for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
    const auto inertia = q(got.inertia[d]);
    q.put(q(spin) + q(got.turn[d]) / larger(inertia, decltype(inertia){} + least), to_spin);
  });
}

void MidpointMotion::first(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  const Columns& c = chunk.columns();
  const int n = chunk.n;
  const bool loaded = outside_->acts(w.kind), corners = c.corners >= 0;
  ImpulsesAtParticles& got = chunk.buffers->impulses;
  interpolate_impulses(solids_->basis, chunk.body->grid, places_of(*w.set, c), shape_of(*w.set, c),
                       static_cast<int>(chunk.at), n, loaded || corners, chunk.buffers->window,
                       got);
  double way = 0;
  for (int d = 0; d < 3; ++d) kick_along(chunk, d, way);
  book_kick(chunk);
  if (corners) keep_larger(way, halve_corners(chunk));
  if (!(way <= farthest_middle)) {
    stay(chunk);
    chunk.report->keep_fault(
        0, fmt::format("particles of material {} '{}' would move {:g} cells in half "
                       "this step, more than {:g}",
                       w.kind, chunk.body->material->name, way, farthest_middle));
  }
  for (int d = 0; d < 3 && loaded; ++d) {
    std::copy_n(got.u[d], n, chunk.read().u[d]);
    std::copy_n(got.dv[d], n, chunk.read().dv[d]);
  }
  add_bounds(chunk);
}

// The step is not finished: its middle is its start, so that windows hold what is there.
void MidpointMotion::stay(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  for (int d = 0; d < 3; ++d)
    std::copy_n(chunk.work->set->coordinate(d) + chunk.at, chunk.n,
                chunk.work->next->coordinate(d) + chunk.at);
  for (int k = 0; k < 3 * c.corner_count; ++k)
    std::copy_n(chunk.old(c.corners + k), chunk.n, chunk.made(c.corners + k));
}

// Corners that particles share go to the middle of the step with velocities that they share. The
// farthest way of one, cells.
double MidpointMotion::halve_corners(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  move_corners(*chunk.body, *chunk.work, chunk.at, chunk.n, chunk.body->units.reference,
               0.5 * chunk.dt(), chunk.buffers->impulses.corner);
  double way = 0;
  for (int k = 0; k < 3 * c.corner_count; ++k) {
    const double *from = chunk.old(c.corners + k), *to = chunk.made(c.corners + k);
    const double inverse = 1 / nodes_->level.spacing[k % 3];
    way = largest(0, static_cast<std::size_t>(chunk.n), way,
                  [&](auto of) { return magnitude(of(to) - of(from)) * inverse; });
    if (way != way) break;
  }
  return way;
}

// Of new velocities and spins, and of places of the middle of the step.
void MidpointMotion::add_bounds(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  KindRates& rates = chunk.report->rates[static_cast<std::size_t>(chunk.kind())];
  ChunkBuffers& buffers = *chunk.buffers;
  const auto count = static_cast<std::size_t>(chunk.n);
  const auto most = [&](double from, const auto& of) { return largest(0, count, from, of); };
  for (int d = 0; d < 3; ++d) {
    const double *v = chunk.made(c.velocity + d), *spin = chunk.made(c.spin + d);
    const double* x = chunk.work->next->coordinate(d) + chunk.at;
    rates.up[d] = most(rates.up[d], [&](auto of) { return of(v); });
    rates.down[d] = most(rates.down[d], [&](auto of) { return -of(v); });
    if (turns(nodes_->level, d))
      rates.affine = most(rates.affine, [&](auto of) { return magnitude(of(spin)); });
    buffers.up[d] = most(buffers.up[d], [&](auto of) { return of(x); });
    buffers.down[d] = most(buffers.down[d], [&](auto of) { return -of(x); });
  }
}

// Nodes around the places of the middle of the step, of all particles of the block.
void MidpointMotion::end_first(BlockWork& w, const Chunk& block) const {
  const Body& body = *block.body;
  const int reach =
      by_corners(solids_->basis)
          ? static_cast<int>(std::floor(extent_of_middle(*solids_, body) + max_stray)) + 1
          : 1;
  w.middle_lowest = w.lowest;
  w.middle_highest = w.highest;
  for (int d = 0; d < 3; ++d) {
    if (nodes_->shape.edge[d] == 1) continue;
    const Axis& axis = body.grid.axes[static_cast<std::size_t>(d)];
    const auto cell = [&](double place) {
      return static_cast<int>(std::floor(axis.place(place) + axis.first));
    };
    // A step in which a particle would go farther is not finished.
    w.middle_lowest[d] = std::max(cell(-block.buffers->down[d]) - reach, w.lowest[d] - 1);
    w.middle_highest[d] = std::min(cell(block.buffers->up[d]) + 1 + reach, w.highest[d] + 1);
  }
}

void MidpointMotion::load(const BlockWork& w, const Body& body, ChunkBuffers& buffers) const {
  buffers.window.load(w.middle_lowest, w.middle_highest, body.table, mapped_->of(w.kind));
}

void MidpointMotion::read(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  read_velocities(solids_->basis, chunk.body->grid, places_of_gradients(w, chunk.columns(), true),
                  shape_of_gradients(w, chunk.columns(), true), static_cast<int>(chunk.at), chunk.n,
                  chunk.buffers->window, chunk.read());
  if (solids_->axisymmetric)
    add_hoop_rate(*w.next, mapped_->units(w.kind).reference.x, chunk.at, chunk.n, chunk.read());
}

void MidpointMotion::read_gradient(const Chunk& chunk) const {
  read(chunk);
  to_end_of_step(chunk.dt(), chunk.n, chunk.read());
}

void MidpointMotion::last(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  const double dt = chunk.dt();
  const Vec3 references = mapped_->units(chunk.kind()).reference;
  GridAtParticles& read_there = chunk.read();
  read(chunk);
  relax_spins(nodes_->level, chunk);
  to_end_of_step(dt, chunk.n, read_there);
  for (int d = 0; d < 3; ++d) {
    const double reference = references[d];
    const double* x = chunk.work->set->coordinate(d) + chunk.at;
    double* to = chunk.work->next->coordinate(d) + chunk.at;
    for (int q = 0; q < chunk.n; ++q) to[q] = x[q] + dt * (reference + read_there.u[d][q]);
    if (c.displacement < 0) continue;
    const double* way = chunk.old(c.displacement + d);
    double* to_way = chunk.made(c.displacement + d);
    for (int q = 0; q < chunk.n; ++q) to_way[q] = way[q] + dt * (reference + read_there.u[d][q]);
  }
  if (c.corners >= 0)
    move_corners(*chunk.body, *chunk.work, chunk.at, chunk.n, references, dt, read_there.corner);
  report_ways(nodes_->level, chunk);
}

void MidpointMotion::hold_start(BlockWork& w, const Chunk& block, bool spins) const {
  const Columns& c = block.columns();
  block.buffers->up = block.buffers->down = KindRates::none();
  for (int d = 0; d < 3; ++d) {
    std::copy_n(block.old(c.velocity + d), block.n, block.made(c.velocity + d));
    std::copy_n(block.old(c.spin + d), block.n, block.made(c.spin + d));
    if (!spins) std::fill_n(block.made(c.spin + d), block.n, 0.0);
  }
  stay(block);
  add_bounds(block);
  end_first(w, block);
}

void MidpointMotion::take_spins(const Chunk& chunk, ParticleSet& to) const {
  const BlockWork& w = *chunk.work;
  read_velocities(solids_->basis, chunk.body->grid, places_of_gradients(w, chunk.columns(), true),
                  shape_of_gradients(w, chunk.columns(), true), static_cast<int>(chunk.at), chunk.n,
                  chunk.buffers->window, chunk.read());
  for (int k = 0; k < 3; ++k) {
    double* spin = to.column(static_cast<std::size_t>(chunk.columns().spin + k)) + chunk.at;
    for (int q = 0; q < chunk.n; ++q)
      spin[q] = turns(nodes_->level, k) ? spin_of(chunk.read(), k, q) : 0.0;
  }
}

}  // namespace sluice::mpm

#include "mpm/step/particle_motion.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "mpm/shape/second_moment.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/travel.hpp"

namespace sluice::mpm {
namespace {

// New places, velocities and ways along a direction. The filter of XPIC has left S v where the new
// velocities will stand: dv is then u - S v.
void move_along(const MpmScene& solids, const Chunk& chunk, int d) {
  const Columns& c = chunk.columns();
  const double dt = chunk.dt(), reference = chunk.body->units.reference[d];
  const int n = chunk.n;
  const double *x = chunk.work->set->coordinate(d) + chunk.at, *v = chunk.old(c.velocity + d);
  double *to_x = chunk.work->next->coordinate(d) + chunk.at, *to_v = chunk.made(c.velocity + d);
  double *u = chunk.read().u[d], *dv = chunk.read().dv[d];
  if (solids.transfer == Transfer::xpic) {
    for (int q = 0; q < n; ++q) {
      const double before = to_v[q];  // S v - v_ref
      to_v[q] = reference + dv[q];
      dv[q] = u[q] - before;
      to_x[q] = x[q] + dt * (solids.xpic2_of_format ? (reference + before) + 0.5 * (to_v[q] - v[q])
                                                    : reference + u[q]);
    }
  } else {
    for (int q = 0; q < n; ++q) to_x[q] = x[q] + dt * (reference + u[q]);
    if (solids.transfer == Transfer::pic || solids.transfer == Transfer::apic)
      for (int q = 0; q < n; ++q) to_v[q] = reference + u[q];
    else
      for (int q = 0; q < n; ++q) to_v[q] = v[q] + dv[q];
  }
  if (c.displacement < 0) return;
  const double* way = chunk.old(c.displacement + d);
  double* to = chunk.made(c.displacement + d);
  if (solids.xpic2_of_format)
    for (int q = 0; q < n; ++q) to[q] = way[q] + (to_x[q] - x[q]);
  else
    for (int q = 0; q < n; ++q) to[q] = way[q] + dt * (reference + u[q]);
}

// Affine transfer of rate kappa: velocities are drawn to u, v = beta u + (1 - beta)(v + dv) with
// beta = min(1, kappa dt max(c_p)/h): what is damped in a time does not depend on dt.
void damp(const MpmScene& solids, const Chunk& chunk) {
  if (solids.transfer != Transfer::affine) return;
  const double beta = std::min(1.0, solids.affine_damping * chunk.dt() * chunk.body->rates.wave);
  for (int d = 0; d < 3; ++d) {
    double* v = chunk.made(chunk.columns().velocity + d);
    const double reference = chunk.body->units.reference[d];
    for (int q = 0; q < chunk.n; ++q)
      v[q] = beta * (reference + chunk.read().u[d][q]) + (1 - beta) * v[q];
  }
}

void add_hoop(const MpmScene& solids, const Chunk& chunk, double reference) {
  if (solids.axisymmetric)
    add_hoop_rate(*chunk.work->set, reference, chunk.at, chunk.n, chunk.read());
}

}  // namespace

void move_by_transfer(const MpmScene& solids, const Level& level, const Chunk& chunk) {
  for (int d = 0; d < 3; ++d) move_along(solids, chunk, d);
  if (chunk.columns().corners >= 0)
    move_corners(*chunk.body, *chunk.work, chunk.at, chunk.n, chunk.body->units.reference,
                 chunk.dt(), chunk.read().corner);
  report_ways(level, chunk);
}

void report_ways(const Level& level, const Chunk& chunk) {
  StepReport& report = *chunk.report;
  const ParticleSet &set = *chunk.work->set, &next = *chunk.work->next;
  report.travel =
      std::max(report.travel, farthest_way(set, next, chunk.at, chunk.n, level.spacing));
  report.left |= any_outside(level, next, chunk.at, chunk.n);
}

void report_velocities(const Chunk& block) {
  const BlockRun& run = block.work->run;
  KindRates& rates = block.report->rates[static_cast<std::size_t>(block.kind())];
  const auto v = read_columns<3>(*block.work->next, block.columns().velocity);
  for (int d = 0; d < 3; ++d) {
    const double* along = v[static_cast<std::size_t>(d)];
    Most up(rates.up[d]), down(rates.down[d]);
    for_eights(run.begin, run.end, [&](auto p) {
      up.add(p(along));
      down.add(-p(along));
    });
    rates.up[d] = up.value();
    rates.down[d] = down.value();
  }
}

void OnePassMotion::load(const BlockWork& w, const Body& body, ChunkBuffers& buffers) const {
  buffers.window.load(w.lowest, w.highest, body.table, body.nodes);
}

void OnePassMotion::read_gradient(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  read_velocities(solids_->basis, chunk.body->grid, places_of(*w.set, chunk.columns()),
                  shape_of(*w.set, chunk.columns()), static_cast<int>(chunk.at), chunk.n,
                  chunk.buffers->window, chunk.read());
  add_hoop(*solids_, chunk, chunk.body->units.reference.x);
}

void OnePassMotion::last(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  read_window(solids_->basis, chunk.body->grid, places_of(*w.set, chunk.columns()),
              shape_of(*w.set, chunk.columns()), static_cast<int>(chunk.at), chunk.n,
              solids_->transfer == Transfer::apic, chunk.buffers->window, chunk.read());
  move_by_transfer(*solids_, *level_, chunk);
  damp(*solids_, chunk);
  add_hoop(*solids_, chunk, chunk.body->units.reference.x);
}

void MuslMotion::load_first(const BlockWork& w, const Body& body, ChunkBuffers& buffers) const {
  buffers.window.load(w.lowest, w.highest, body.table, body.nodes);
}

void MuslMotion::first(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  read_motion(solids_->basis, chunk.body->grid, places_of(*w.set, chunk.columns()),
              shape_of(*w.set, chunk.columns()), static_cast<int>(chunk.at), chunk.n,
              chunk.buffers->window, chunk.read());
  move_by_transfer(*solids_, *level_, chunk);
  damp(*solids_, chunk);
}

void MuslMotion::end_first(BlockWork& /*work*/, const Chunk& block) const {
  report_velocities(block);
}

void MuslMotion::load(const BlockWork& w, const Body& body, ChunkBuffers& buffers) const {
  buffers.window.load(w.lowest, w.highest, body.table, mapped_->of(w.kind));
}

void MuslMotion::read_gradient(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  read_velocities(solids_->basis, chunk.body->grid, places_of(*w.set, chunk.columns()),
                  shape_of(*w.set, chunk.columns()), static_cast<int>(chunk.at), chunk.n,
                  chunk.buffers->window, chunk.read());
  add_hoop(*solids_, chunk, mapped_->units(w.kind).reference.x);
}

void RigidMotion::first(const Chunk& chunk) const {
  read(chunk, true);
  move_by_transfer(*solids_, *level_, chunk);
}

// In the midpoint transfer nothing of them goes back to nodes.
void RigidMotion::end_first(BlockWork& /*work*/, const Chunk& block) const {
  if (!solids_->midpoint()) report_velocities(block);
}

void RigidMotion::read_gradient(const Chunk& chunk) const {
  read(chunk, false);
}

void RigidMotion::last(const Chunk& chunk) const {
  if (solids_->maps_back())
    read(chunk, false);
  else
    first(chunk);
  add_hoop(*solids_, chunk, chunk.body->units.reference.x);
}

// `booked`: for good, so that what moves them is booked too. As XPIC has it, the new velocity
// stands in dv and the one before in the column of the new ones.
void RigidMotion::read(const Chunk& chunk, bool booked) const {
  const Columns& c = chunk.columns();
  const MasterMotion* motion = rules_ != nullptr ? rules_->motion_of(chunk.kind()) : nullptr;
  GridAtParticles& read = chunk.read();
  const std::array<double, 9> L = motion != nullptr ? motion->gradient() : std::array<double, 9>{};
  for (std::size_t e = 0; e < 9; ++e) {
    const double h = level_->spacing[static_cast<int>(e % 3)];
    const double second_moment = h * h / second_moment_factor(solids_->basis);
    std::fill_n(read.L[e], chunk.n, L[e]);
    std::fill_n(read.moment[e], chunk.n, L[e] * second_moment);
  }
  for (int d = 0; d < 3 && c.outside_force >= 0; ++d)
    std::fill_n(chunk.made(c.outside_force + d), chunk.n, 0.0);
  const Vec3 pushed = transmitted_->pushed(chunk.kind());
  for (int q = 0; q < chunk.n; ++q) read_particle(chunk, q, motion, pushed, booked);
}

void RigidMotion::read_particle(const Chunk& chunk, int q, const MasterMotion* motion, Vec3 pushed,
                                bool booked) const {
  const Columns& c = chunk.columns();
  const BlockWork& w = *chunk.work;
  GridAtParticles& read = chunk.read();
  const std::size_t p = chunk.at + static_cast<std::size_t>(q);
  const bool filtered = solids_->transfer == Transfer::xpic;
  Vec3 before;
  for (int d = 0; d < 3; ++d) before[d] = chunk.old(c.velocity + d)[q];
  const Vec3 after = motion != nullptr ? motion->at(w.set->position(p)) : before + pushed;
  for (int d = 0; d < 3; ++d) {
    const bool active = level_->active[static_cast<std::size_t>(d)];
    read.u[d][q] = active ? after[d] : 0;
    read.dv[d][q] = active ? after[d] - before[d] : 0;
    const double impulse = chunk.old(c.mass)[q] * read.dv[d][q];
    if (filtered && booked) {
      chunk.made(c.velocity + d)[q] = active ? before[d] : 0;
      read.dv[d][q] = active ? after[d] : 0;
    }
    // Where it transmits forces, what it got is booked with them.
    if (impulse == 0 || !booked || pushed != Vec3{}) continue;
    chunk.report->books.add(StepSums::impulse_x + d, impulse);
    chunk.report->books.add(StepSums::work, 0.5 * impulse * (before[d] + after[d]));
  }
  for (int k = 0; k < c.corner_count; ++k) {
    const Vec3 of_corner = motion != nullptr ? motion->at(corner_at(*w.set, c, k, p)) : after;
    for (int d = 0; d < 3; ++d)
      read.corner[k][d][q] = level_->active[static_cast<std::size_t>(d)] ? of_corner[d] : 0;
  }
}

}  // namespace sluice::mpm

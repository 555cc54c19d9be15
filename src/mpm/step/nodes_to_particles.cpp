#include "mpm/step/nodes_to_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mpm/shape/second_moment.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/deformation.hpp"
#include "mpm/step/particles_to_nodes.hpp"
#include "mpm/step/resting.hpp"

namespace sluice::mpm {
namespace {

double least_spacing(const Level& level) {
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) least = std::min(least, level.spacing[d]);
  return least;
}

// Total Lagrangian: what was read is dF/dt = sum v* (x) grad_X S; L = dF/dt F^-1.
void to_spatial_gradient(const ParticleShape& shape, std::size_t at, int n, GridAtParticles& read) {
  for (int q = 0; q < n; ++q) {
    const auto f = [&](int r, int c) {
      return shape
          .F[static_cast<std::size_t>(3 * (r % 3) + c % 3)][at + static_cast<std::size_t>(q)];
    };
    double adjoint[3][3], rate[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        adjoint[r][c] = f(c + 1, r + 1) * f(c + 2, r + 2) - f(c + 1, r + 2) * f(c + 2, r + 1);
    const double J = f(0, 0) * adjoint[0][0] + f(0, 1) * adjoint[1][0] + f(0, 2) * adjoint[2][0];
    for (int e = 0; e < 9; ++e) rate[e] = read.L[e][q] / J;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        read.L[3 * r + c][q] = rate[3 * r] * adjoint[0][c] + rate[3 * r + 1] * adjoint[1][c] +
                               rate[3 * r + 2] * adjoint[2][c];
  }
}

// What has failed moves on as it is: L = 0. (Corners that neighbours share deform it still.)
void hold_failed(const Material& law, const Batch& b, GridAtParticles& read) {
  const double* failed = b.old_history[static_cast<std::size_t>(law.failed_column())];
  for (double* L : read.L)
    for (int q = 0; q < b.count; ++q)
      if (failed[q] != 0) L[q] = 0;
}

// A particle of which the step cannot go on.
void tell(const Chunk& chunk, int q, const char* reason, double value) {
  const BlockWork& w = *chunk.work;
  const std::size_t i = chunk.at + static_cast<std::size_t>(q);
  const Vec3 p = w.set->position(i);
  chunk.report->keep_fault(
      w.set->id(i),
      fmt::format("particle {} of material {} '{}' at [{:g}, {:g}, {:g}]: {} ({:g})", w.set->id(i),
                  w.kind, chunk.body->material->name, p.x, p.y, p.z, reason, value));
}

}  // namespace

NodesToParticles::NodesToParticles(const MpmScene& solids, const LevelNodes& nodes,
                                   const std::vector<Body>& bodies, const SolidEffects& effects,
                                   const ContactStage* contact, const MappedBack* mapped)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      effects_(effects.all()),
      // Steps of a prescribed deformation are exact at first order.
      order_of_F_(solids.prescribed_file.empty() ? solids.subcycles_of_F : 1),
      first_(solids.materials.size()) {
  if (solids.midpoint()) {
    auto midpoint = std::make_unique<MidpointMotion>(solids, nodes, effects.outside(), *mapped);
    midpoint_ = midpoint.get();
    deforming_ = std::move(midpoint);
  } else if (mapped != nullptr) {
    deforming_ = std::make_unique<MuslMotion>(solids, nodes.level, *mapped);
  } else {
    deforming_ = std::make_unique<OnePassMotion>(solids, nodes.level);
  }
  rigid_ = std::make_unique<RigidMotion>(
      solids, nodes.level, contact != nullptr ? &contact->rules() : nullptr, effects.transmitted());
  if (solids.pressure_stabilised) dilatation_ = std::make_unique<SharedDilatation>(solids, nodes);
}

void NodesToParticles::make_room() {
  const auto threads = static_cast<std::size_t>(nodes_->team->size());
  while (buffers_.size() < threads) buffers_.emplace_back(nodes_->shape);
  reports_.clear();
  for (std::size_t t = 0; t < threads; ++t) reports_.emplace_back(bodies_->size());
}

Chunk NodesToParticles::chunk_of(const StageScope& scope, const BlockWork& w, int thread) {
  const auto t = static_cast<std::size_t>(thread);
  Chunk chunk{&w, &(*bodies_)[static_cast<std::size_t>(w.kind)], &scope, &buffers_[t],
              &reports_[t]};
  chunk.thread = thread;
  chunk.at = w.run.begin;
  chunk.n = static_cast<int>(w.run.end - w.run.begin);
  return chunk;
}

std::vector<KindRates> NodesToParticles::first_pass(const StageScope& scope,
                                                    std::vector<BlockWork>& work,
                                                    std::string& fault) {
  make_room();
  nodes_->team->for_each(work.size(), [&](std::size_t n, int thread) {
    const Chunk block = chunk_of(scope, work[n], thread);
    const ParticleMotion& motion = motion_of(*block.body);
    motion.load_first(work[n], *block.body, *block.buffers);
    for_each_chunk(block, [&](const Chunk& chunk) {
      motion.first(chunk);
      if (chunk.body->material->rigid) return;
      for (SolidEffect* effect : effects_) effect->moved(chunk);
    });
    motion.end_first(work[n], block);
  });
  first_ = StepReport(bodies_->size());
  std::vector<KindRates> bounds(bodies_->size());
  keep_resting(nodes_->level, *bodies_, scope.step, bounds);
  for (const StepReport& r : reports_) {
    first_.travel = std::max(first_.travel, r.travel);
    first_.left |= r.left;
    first_.books.merge(r.books);
    for (std::size_t k = 0; k < bounds.size(); ++k) bounds[k].add(r.rates[k]);
    if (!r.fault.empty() && (fault.empty() || r.fault < fault)) fault = r.fault;
  }
  return bounds;
}

StepReport NodesToParticles::last_pass(const StageScope& scope, std::span<const BlockWork> work) {
  make_room();
  nodes_->team->for_each(work.size(), [&](std::size_t n, int thread) {
    advance_block(chunk_of(scope, work[n], thread));
  });
  StepReport all = std::move(reports_.front());
  for (std::size_t t = 1; t < reports_.size(); ++t) all.merge(reports_[t]);
  if (solids_->maps_back()) all.merge(first_);
  for (const SolidEffect* effect : effects_) effect->limit(all);
  all.rate = std::max(all.rate, keep_resting(nodes_->level, *bodies_, scope.step, all.rates));
  return all;
}

void NodesToParticles::advance_block(const Chunk& block) {
  const ParticleMotion& motion = motion_of(*block.body);
  motion.load(*block.work, *block.body, *block.buffers);
  for (SolidEffect* effect : effects_) effect->load(*block.work, block.thread);
  std::vector<double>* shared = nullptr;
  if (dilatation_ != nullptr && !block.body->material->rigid) {
    shared = &block.buffers->shared;
    dilatation_->find(motion, block, *shared);
  }
  for_each_chunk(block, [&](const Chunk& chunk) { advance(chunk, shared); });
}

void NodesToParticles::advance(const Chunk& chunk, const std::vector<double>* shared) {
  motion_of(*chunk.body).last(chunk);
  if (in_one_pass(*chunk.body))
    for (SolidEffect* effect : effects_) effect->moved(chunk);
  carry_affine(chunk);
  if (solids_->total_lagrangian && !chunk.body->material->rigid)
    to_spatial_gradient(shape_of(*chunk.work->set, chunk.columns()), chunk.at, chunk.n,
                        chunk.read());
  if (!update(chunk, shared)) return;
  for (SolidEffect* effect : effects_) effect->to_particles(chunk);
  report_limits(chunk);
}

// New deformation gradient, volume, stress; false: a particle has a fault.
bool NodesToParticles::update(const Chunk& chunk, const std::vector<double>* shared) {
  const BlockWork& w = *chunk.work;
  const Body& body = *chunk.body;
  const Columns& c = chunk.columns();
  const Material& law = *body.material->law;
  ChunkBuffers& buffers = *chunk.buffers;
  Batch& b = buffers.columns.between(*w.set, *w.next, *body.carried, chunk.at, chunk.n);
  b.time = chunk.scope->step.time;
  b.spacing = least_spacing(nodes_->level);
  b.dt = chunk.dt();
  if (c.corners < 0 && law.failed_keep_their_shape()) hold_failed(law, b, chunk.read());
  for (std::size_t e = 0; e < 9; ++e) b.L[e] = chunk.read().L[e];
  std::fill_n(buffers.heating, chunk.n, 0.0);
  b.wave_speed = buffers.wave_speed;
  b.heating = buffers.heating;
  if (c.loss_temperature >= 0) {
    std::fill_n(buffers.isentropic, chunk.n, 0.0);
    b.isentropic = buffers.isentropic;
  }
  double* volume = chunk.made(c.volume);
  const int bad = deform(order_of_F_, b.dt, b, volume);
  if (bad >= 0) {
    tell(chunk, bad, "the deformation gradient of the step turns it inside out, det F",
         volume[bad] / b.volume_0[bad]);
    return false;
  }
  std::optional<BatchFault> fault;
  if (c.corners >= 0) fault = deform_to_corners(body, w, chunk.at, b, chunk.read());
  if (!fault) {
    if (shared != nullptr) dilatation_->take(chunk, b, *shared);
    fault = law.update(b);
  }
  if (fault) tell(chunk, fault->particle, fault->reason, fault->value);
  return !fault;
}

// C of affine transfers: grad v, or for APIC the moments over the second moment of S.
void NodesToParticles::carry_affine(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  if (c.affine < 0) return;
  for (int e = 0; e < 9; ++e) {
    double* to = chunk.made(c.affine + e);
    const double h = nodes_->level.spacing[e % 3];
    const double factor = second_moment_factor(solids_->basis) / (h * h);
    if (solids_->transfer == Transfer::apic)
      for (int q = 0; q < chunk.n; ++q) to[q] = factor * chunk.read().moment[e][q];
    else
      for (int q = 0; q < chunk.n; ++q) to[q] = chunk.read().L[e][q];
  }
}

// What the next step rests on.
void NodesToParticles::report_limits(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  const Columns& c = chunk.columns();
  const double* waves = chunk.buffers->wave_speed;
  StepReport& report = *chunk.report;
  report.rate = std::max(
      report.rate,
      step_rate(nodes_->level, *w.next, c, *chunk.body->material->law, chunk.at, chunk.n, waves));
  KindRates rates = rates_of(solids_->basis, chunk.body->grid, *w.set, *w.next, c, chunk.at,
                             chunk.at + static_cast<std::size_t>(chunk.n));
  rates.wave = wave_rate(nodes_->level, chunk.n, waves);
  report.rates[static_cast<std::size_t>(w.kind)].add(rates);
}

std::vector<KindRates> NodesToParticles::hold_start(const StageScope& scope,
                                                    std::vector<BlockWork>& work, bool spins) {
  make_room();
  nodes_->team->for_each(work.size(), [&](std::size_t n, int thread) {
    const Chunk block = chunk_of(scope, work[n], thread);
    if (block.body->material->rigid) return;
    find_nodes_of(*solids_, nodes_->shape, *block.body, work[n]);
    midpoint_->hold_start(work[n], block, spins);
  });
  std::vector<KindRates> bounds(bodies_->size());
  for (const StepReport& r : reports_)
    for (std::size_t k = 0; k < bounds.size(); ++k) bounds[k].add(r.rates[k]);
  return bounds;
}

void NodesToParticles::take_spins(const StageScope& scope, std::span<const BlockWork> work) {
  make_room();
  nodes_->team->for_each(work.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work[n];
    const Chunk block = chunk_of(scope, w, thread);
    if (block.body->material->rigid) return;
    midpoint_->load(w, *block.body, *block.buffers);
    ParticleSet& set = scope.particles->store(w.kind).set(nodes_->level.index, w.box);
    for_each_chunk(block, [&](const Chunk& chunk) { midpoint_->take_spins(chunk, set); });
  });
}

}  // namespace sluice::mpm

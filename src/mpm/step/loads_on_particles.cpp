#include "mpm/step/loads_on_particles.hpp"

#include <algorithm>

namespace sluice::mpm {

// Cohesive zones bound their forces with these.
static bool acts(const MpmScene& solids, const OutsideForces& outside) {
  return outside.any() || !solids.cohesive_zones.empty();
}

bool LoadsOnParticles::possible(const MpmScene& solids, const OutsideForces& outside,
                                const std::vector<Carried>& carried) {
  return acts(solids, outside) ||
         std::any_of(carried.begin(), carried.end(), [](const Carried& of) {
           return of.columns.outside_force >= 0 || of.columns.heat_source >= 0;
         });
}

LoadsOnParticles::LoadsOnParticles(const MpmScene& solids, OutsideForces& outside,
                                   const LevelNodes& nodes, const std::vector<BlockWork>& work)
    : outside_(&outside),
      nodes_(&nodes),
      work_(&work),
      most_(solids.materials.size()),
      acts_(acts(solids, outside)) {}

void LoadsOnParticles::begin(const StageScope& scope) {
  if (!acts_) return;
  std::fill(most_.begin(), most_.end(), 0.0);
  const std::vector<double>& maxima = scope.maxima->front();
  outside_->count(*scope.particles, *scope.ranks,
                  std::span(maxima).subspan(rate_count(most_.size())));
  outside_->make_room(*scope.particles, nodes_->level.index);
  const ThreadTeam& team = *nodes_->team;
  std::vector<std::vector<double>> most(static_cast<std::size_t>(team.size()), most_);
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    if (!outside_->acts(w.kind)) return;
    double& m = most[static_cast<std::size_t>(thread)][static_cast<std::size_t>(w.kind)];
    m = std::max(m, outside_->fill(w.kind, w.box, *w.set, w.run.begin, w.run.end, scope.step.time));
  });
  for (const std::vector<double>& of : most)
    for (std::size_t k = 0; k < most_.size(); ++k) most_[k] = std::max(most_[k], of[k]);
}

void LoadsOnParticles::after_nodes(const NodeStep& step, NodeBooks& /*books*/) {
  kick_ = step.kick;
}

// The columns of forces and of heat by loads (none, unless heat moves), where they are saved.
void LoadsOnParticles::save(const Chunk& chunk) const {
  const BlockWork& w = *chunk.work;
  const Columns& c = chunk.columns();
  if (c.heat_source >= 0) std::fill_n(chunk.made(c.heat_source), chunk.n, 0.0);
  if (c.outside_force < 0) return;
  const OutsideForces::Columns3 f = outside_->forces(w.kind, w.box);
  for (int d = 0; d < 3; ++d) {
    double* to = chunk.made(c.outside_force + d);
    for (int q = 0; q < chunk.n; ++q) {
      const std::size_t p = chunk.at + static_cast<std::size_t>(q);
      to[q] = f[0] == nullptr ? 0.0 : f[static_cast<std::size_t>(d)][p];
      if (d == 0) to[q] -= outside_->hoop(w.kind, *w.set, p);
    }
  }
}

// Impulse dk f and work dk f . (v + v*)/2 at the places of the particles: with the weights of the
// particle sum to the same over nodes. The work of loads on corners is booked with these.
void LoadsOnParticles::moved(const Chunk& chunk) {
  save(chunk);
  const BlockWork& w = *chunk.work;
  const OutsideForces::Columns3 f = outside_->forces(w.kind, w.box);
  if (f[0] == nullptr) return;
  const OutsideForces::Columns3 middle = outside_->middle_forces(w.kind, w.box);
  const Vec3 reference = chunk.body->units.reference;
  const GridAtParticles& read = chunk.read();
  NodeBooks& books = chunk.report->books;
  for (int q = 0; q < chunk.n; ++q) {
    const std::size_t p = chunk.at + static_cast<std::size_t>(q);
    const Vec3 whole{f[0][p], f[1][p], f[2][p]};
    if (whole == Vec3{}) continue;
    for (int d = 0; d < 3; ++d) books.add(StepSums::force_x + d, kick_ * whole[d]);
    Vec3 force = middle[0] == nullptr ? Vec3{} : Vec3{middle[0][p], middle[1][p], middle[2][p]};
    force.x -= outside_->hoop(w.kind, *w.set, p);
    double power = 0;
    for (int d = 0; d < 3; ++d)
      power += force[d] * (reference[d] + read.u[d][q] - 0.5 * read.dv[d][q]);
    books.add(StepSums::force_work, kick_ * power);
    chunk.sums()[BodyEnergySums::load_work].add(kick_ * power);
  }
}

}  // namespace sluice::mpm

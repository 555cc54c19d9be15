#include "mpm/step/friction_heat.hpp"

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

FrictionHeat::FrictionHeat(const MpmScene& solids, const LevelNodes& nodes,
                           const std::vector<Body>& bodies)
    : solids_(&solids), nodes_(&nodes), bodies_(&bodies), rise_(solids.materials.size()) {}

void FrictionHeat::begin(const StageScope& /*scope*/) {
  const auto threads = static_cast<std::size_t>(nodes_->team->size());
  if (reads_.size() != threads) reads_.assign(threads, Reads(nodes_->shape));
}

void FrictionHeat::make_room(bool acts) {
  for (std::size_t m = 0; m < rise_.size(); ++m) {
    rise_[m].clear();
    if (acts) rise_[m].fit((*bodies_)[m].table);
  }
}

void FrictionHeat::keep(std::span<const BlockMember> group, std::span<const BlockImpulses> impulses,
                        const std::array<double, block_nodes>& work) {
  for (std::size_t n = 0; n < block_nodes; ++n) {
    double loss = work[n], mass = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const Body& body = (*bodies_)[static_cast<std::size_t>(group[k].body)];
      const std::int64_t* node = body.nodes.sums(group[k].block) + n * lanes;
      if (body.material->rigid || node[count_lane] == 0) continue;
      const double m = as_real(node[3]);
      mass += m;
      for (int d = 0; d < 3; ++d)  // vb = v* - (v* - v)/2
        loss -= impulses[k][n].met[d] *
                (as_real(node[d]) + body.units.reference[d] - 0.5 * as_real(node[4 + d]));
    }
    if (loss == 0 || !(mass > 0)) continue;
    for (const BlockMember& of : group) {
      const Body& body = (*bodies_)[static_cast<std::size_t>(of.body)];
      const std::int64_t* node = body.nodes.sums(of.block) + n * lanes;
      if (!warms(body) || node[count_lane] == 0) continue;
      // What would cool stays in the account of contact, or lessens what the body has lost.
      if (loss < 0 && !body.material->lost_energy_heats) continue;
      rise(of.body).sums(of.block)[n * lanes] =
          as_bits(loss / (mass * body.material->constants.specific_heat));
    }
  }
}

void FrictionHeat::unfold() {
  for (std::size_t m = 0; m < rise_.size(); ++m) {
    if (rise_[m].blocks() == 0) continue;  // no bodies meet
    nodes_->boundary->unfold_scalars(static_cast<int>(m), (*bodies_)[m].table, rise_[m]);
  }
}

void FrictionHeat::after_nodes(const NodeStep& /*step*/, NodeBooks& /*books*/) {
  unfold();
}

void FrictionHeat::load(const BlockWork& w, int thread) {
  const auto m = static_cast<std::size_t>(w.kind);
  Reads& reads = reads_[static_cast<std::size_t>(thread)];
  reads.warms = warms((*bodies_)[m]) && rise_[m].blocks() > 0;
  if (!reads.warms) return;
  reads.window.load(w.lowest, w.highest, (*bodies_)[m].table, rise_[m]);
  reads.warms = reads.window.any_in(0);
}

void FrictionHeat::to_particles(const Chunk& chunk) {
  const Reads& reads = reads_[static_cast<std::size_t>(chunk.thread)];
  if (!reads.warms) return;
  const Body& body = *chunk.body;
  const BlockWork& w = *chunk.work;
  const Columns& c = chunk.columns();
  GridAtParticles& read = chunk.read();
  read_velocities(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                  static_cast<int>(chunk.at), chunk.n, reads.window, read);
  if (c.lost_energy >= 0) {
    const double* mass = chunk.old(c.mass);
    double *loss = chunk.made(c.lost_energy), *open = chunk.made(c.open_energy);
    alignas(64) double taken[chunk_size];
    for (int q = 0; q < chunk.n; ++q) {
      taken[q] = mass[q] * body.material->constants.specific_heat * read.u[0][q];
      loss[q] += taken[q];
      open[q] += taken[q];  // heat of the next step
    }
    using Of = BodyEnergySums;
    for (const auto sum : {Of::contact_heat, Of::open_gain})
      add_rounded(taken, chunk.n, body.energy_units.energy, chunk.sums()[sum]);
    return;
  }
  double* T = chunk.made(c.temperature);
  for (int q = 0; q < chunk.n; ++q) T[q] += read.u[0][q];
}

}  // namespace sluice::mpm

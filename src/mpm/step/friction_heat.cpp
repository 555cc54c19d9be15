// Heat of friction: what contact takes at a node from the kinetic energy of bodies (mpm_scheme,
// section 6), shared by mass, goes to the particles around, dT_p = sum D_i/(c_v sum_m M_m) S_ip.
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/thread_report.hpp"

namespace sluice::mpm {

// Of the blocks of a group, which are finished.
void SolidStep::keep_friction_heat(std::span<const BlockMember> members,
                                   const MeetingScratch& scratch) {
  for (std::size_t n = 0; n < block_nodes; ++n) {
    double loss = scratch.work[n], mass = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const Body& body = bodies_[static_cast<std::size_t>(members[k].body)];
      const std::int64_t* node = body.nodes.sums(members[k].block) + n * lanes;
      if (body.material->rigid || node[count_lane] == 0) continue;
      const double m = as_real(node[3]);
      mass += m;
      for (int d = 0; d < 3; ++d)  // vb = v* - (v* - v)/2
        loss -= scratch.impulses[k][n].met[d] *
                (as_real(node[d]) + body.units.reference[d] - 0.5 * as_real(node[4 + d]));
    }
    if (loss == 0 || !(mass > 0)) continue;
    for (const BlockMember& of : members) {
      Body& body = bodies_[static_cast<std::size_t>(of.body)];
      const std::int64_t* node = body.nodes.sums(of.block) + n * lanes;
      if (!warms_by_friction(body) || node[count_lane] == 0) continue;
      // What would cool stays in the account of contact, or lessens what the body has lost.
      if (loss < 0 && !body.material->lost_energy_heats) continue;
      body.friction.sums(of.block)[n * lanes] =
          as_bits(loss / (mass * body.material->constants.specific_heat));
    }
  }
}

void SolidStep::unfold_friction() {
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    if (bodies_[m].friction.blocks() == 0) continue;  // no bodies meet
    boundary_->unfold_scalars(static_cast<int>(m), bodies_[m].table, bodies_[m].friction);
  }
}

// The rise of temperature of particles at, ..., at + n - 1; nodes of the window hold it in lane 0.
// Where lost energy heats it is part of that.
void SolidStep::warm_by_friction(const BlockWork& w, std::size_t at, int n,
                                 ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  GridAtParticles& read = report.read;
  read_velocities(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                  static_cast<int>(at), n, report.friction, read);
  if (c.lost_energy >= 0) {
    const double* mass = w.set->column(static_cast<std::size_t>(c.mass)) + at;
    double* loss = w.next->column(static_cast<std::size_t>(c.lost_energy)) + at;
    alignas(64) double taken[chunk_size];
    for (int q = 0; q < n; ++q) {
      taken[q] = mass[q] * body.material->constants.specific_heat * read.u[0][q];
      loss[q] += taken[q];
    }
    add_rounded(
        taken, n, body.energy_units.energy,
        report.books.bodies[static_cast<std::size_t>(w.kind)][BodyEnergySums::contact_heat]);
    return;
  }
  double* T = w.next->column(static_cast<std::size_t>(c.temperature)) + at;
  for (int q = 0; q < n; ++q) T[q] += read.u[0][q];
}

}  // namespace sluice::mpm

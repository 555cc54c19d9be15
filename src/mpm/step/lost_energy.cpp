#include "mpm/step/lost_energy.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {
namespace {

// Velocities of a body relative to its own, m/s: of what is mapped back, less that of the body's
// nodes; and the latter itself.
struct References {
  double shift[3] = {}, own[3] = {};
};

// Lanes u, dv . u - j . (u - (v + v*)/2) of nodes with v* - v_ref, - | dv, -; j: change of velocity
// by body forces; all velocities relative to v_ref.
void to_work(const Window& nodes, const Window* mapped, const References& of, const NodeStep& step,
             bool before, Window& to) {
  const IntVec3 size{nodes.size(0), nodes.size(1), nodes.size(2)};
  to.move_to(nodes.lower(), nodes.lower() + size - IntVec3{1, 1, 1});
  const auto count = static_cast<std::ptrdiff_t>(size.x) * size.y * size.z;
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    const std::int64_t* from = nodes.at(0, 0, 0) + n * lanes;
    const std::int64_t* moved = mapped != nullptr ? mapped->at(0, 0, 0) + n * lanes : nullptr;
    // Particles may have left a node until the middle of the step.
    const bool known = moved != nullptr && as_real(moved[3]) != 0 && from[count_lane] != node_met;
    std::int64_t* node = to.at(0, 0, 0) + n * lanes;
    double work = 0;
    for (int d = 0; d < 3; ++d) {
      const double dv = as_real(from[4 + d]);
      double u = as_real(from[d]);
      if (before)
        u -= dv;
      else if (known)
        u = as_real(moved[d]) + of.shift[d];
      node[d] = as_bits(u);
      const double v = as_real(from[d]) - dv;
      const double j = step.kick * (step.gravity[d] - step.damping * (v + of.own[d]));
      work += dv * u - j * (u - (v + 0.5 * dv));
    }
    node[3] = as_bits(work);
  }
}

// sigma : L of symmetric tensors and gradients.
constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};

}  // namespace

LostEnergy::LostEnergy(const MpmScene& solids, const LevelNodes& nodes,
                       const std::vector<Body>& bodies, const MappedBack* mapped)
    : solids_(&solids), nodes_(&nodes), bodies_(&bodies), mapped_(mapped) {}

void LostEnergy::begin(const StageScope& /*scope*/) {
  const auto threads = static_cast<std::size_t>(nodes_->team->size());
  if (reads_.size() != threads) reads_.assign(threads, Reads(nodes_->shape));
}

void LostEnergy::after_nodes(const NodeStep& step, NodeBooks& /*books*/) {
  step_ = step;
}

void LostEnergy::moved(const Chunk& chunk) {
  const Columns& c = chunk.columns();
  if (c.lost_energy < 0) return;
  const int n = chunk.n;
  double *first = chunk.made(c.lost_energy), *second = chunk.made(c.lost_heat);
  const double* mass = chunk.old(c.mass);
  std::fill_n(first, n, 0.0);
  std::fill_n(second, n, 0.0);
  for (int d = 0; d < 3; ++d) {
    const double *v = chunk.old(c.velocity + d), *to_v = chunk.made(c.velocity + d);
    const double reference = chunk.body->units.reference[d];
    for (int p = 0; p < n; ++p) {
      const double half = 0.5 * mass[p] * (to_v[p] - v[p]);
      first[p] -= half * (v[p] - reference);
      second[p] -= half * (to_v[p] - reference);
    }
    if (c.spin < 0) continue;
    const double *spin = chunk.old(c.spin + d), *to_spin = chunk.made(c.spin + d);
    const double* inertia = chunk.buffers->impulses.inertia[d];
    for (int p = 0; p < n; ++p) {
      const double half = 0.5 * mass[p] * inertia[p] * (to_spin[p] - spin[p]);
      first[p] -= half * spin[p];
      second[p] -= half * to_spin[p];
    }
  }
}

void LostEnergy::load(const BlockWork& w, int thread) {
  const Body& body = (*bodies_)[static_cast<std::size_t>(w.kind)];
  if (body.carried->columns.lost_energy < 0) return;
  Reads& reads = reads_[static_cast<std::size_t>(thread)];
  reads.nodes.load(w.lowest, w.highest, body.table, body.nodes);
  References of;
  for (int d = 0; d < 3; ++d) of.own[d] = body.units.reference[d];
  const Window* moved = nullptr;
  if (mapped_ != nullptr) {
    reads.mapped.load(w.lowest, w.highest, body.table, mapped_->of(w.kind));
    const Vec3 from = mapped_->units(w.kind).reference;
    for (int d = 0; d < 3; ++d) of.shift[d] = from[d] - body.units.reference[d];
    moved = &reads.mapped;
  }
  to_work(reads.nodes, moved, of, step_, true, reads.before);
  to_work(reads.nodes, moved, of, step_, false, reads.after);
}

// Adds the halves of P.
void LostEnergy::add_works(const Chunk& chunk, Reads& reads) const {
  const Body& body = *chunk.body;
  const BlockWork& w = *chunk.work;
  const Columns& c = chunk.columns();
  const int n = chunk.n;
  const double *mass = chunk.old(c.mass), *volume = chunk.old(c.volume);
  const double* q = c.viscous >= 0 ? chunk.old(c.viscous) : nullptr;
  GridAtParticles& read = reads.at;
  for (const bool after : {false, true}) {
    double* to = chunk.made(after ? c.lost_heat : c.lost_energy);
    read_velocities(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                    static_cast<int>(chunk.at), n, after ? reads.after : reads.before, read);
    if (solids_->axisymmetric) add_hoop_rate(*w.set, body.units.reference.x, chunk.at, n, read);
    alignas(64) double power[chunk_size] = {};
    for (int e = 0; e < 6; ++e) {
      const double* sigma = chunk.old(c.stress + e);
      const double *one = read.L[3 * row[e] + column[e]], *other = read.L[3 * column[e] + row[e]];
      if (e < 3)
        for (int p = 0; p < n; ++p)
          power[p] += (q != nullptr ? sigma[p] - q[p] : sigma[p]) * one[p];
      else
        for (int p = 0; p < n; ++p) power[p] += sigma[p] * (one[p] + other[p]);
    }
    for (int p = 0; p < n; ++p)
      to[p] += 0.5 * (mass[p] * read.fourth[p] + step_.kick * volume[p] * power[p]);
  }
}

// E of particles, J; of affine velocities, which hold it, what it gained instead.
void LostEnergy::find_inner(const Chunk& chunk, double* within, double* gained) const {
  const Columns& c = chunk.columns();
  const int n = chunk.n;
  std::fill_n(within, n, 0.0);
  std::fill_n(gained, n, 0.0);
  for (int e = 0; e < 9; ++e) {
    const double moment = chunk.body->energy_units.moment[e % 3];
    if (c.affine >= 0) {
      const double *C = chunk.old(c.affine + e), *to_C = chunk.made(c.affine + e);
      for (int p = 0; p < n; ++p) gained[p] += moment * (to_C[p] * to_C[p] - C[p] * C[p]);
      continue;
    }
    const double *L = chunk.read().L[e], *turned = chunk.read().L[3 * (e % 3) + e / 3];
    const bool spins = c.spin >= 0;
    for (int p = 0; p < n; ++p) {
      const double rate = spins ? 0.5 * (L[p] + turned[p]) : L[p];
      within[p] += moment * (rate * rate);
    }
  }
  const double* mass = chunk.old(c.mass);
  for (int p = 0; p < n; ++p) {
    within[p] *= 0.5 * mass[p];
    gained[p] *= 0.5 * mass[p];
  }
}

void LostEnergy::carry_temperature(const Chunk& chunk) const {
  const Columns& c = chunk.columns();
  const double *before = chunk.old(c.loss_temperature), *isentropic = chunk.buffers->isentropic;
  double* T = chunk.made(c.loss_temperature);
  for (int p = 0; p < chunk.n; ++p) T[p] = before[p] * (1 + isentropic[p]);
  if (c.viscous_heat < 0) return;
  const double capacity = chunk.body->material->constants.specific_heat;
  const double *mass = chunk.old(c.mass), *old = chunk.old(c.viscous_heat);
  const double* viscous = chunk.made(c.viscous_heat);
  for (int p = 0; p < chunk.n; ++p) T[p] += (viscous[p] - old[p]) / (mass[p] * capacity);
}

void LostEnergy::to_particles(const Chunk& chunk) {
  const Columns& c = chunk.columns();
  if (c.lost_energy < 0) return;
  const int n = chunk.n;
  carry_temperature(chunk);
  add_works(chunk, reads_[static_cast<std::size_t>(chunk.thread)]);
  const double *energy = chunk.old(c.energy), *new_energy = chunk.made(c.energy);
  const double *before = chunk.old(c.lost_energy), *heat = chunk.old(c.lost_heat);
  const double* viscous = c.viscous_heat >= 0 ? chunk.made(c.viscous_heat) : nullptr;
  double *to = chunk.made(c.lost_energy), *to_heat = chunk.made(c.lost_heat),
         *to_open = chunk.made(c.open_energy);
  const double* open_before = chunk.old(c.open_energy);
  alignas(64) double within[chunk_size], gained[chunk_size];
  find_inner(chunk, within, gained);
  alignas(64) double wanted[chunk_size], taken[chunk_size], all[chunk_size], opened[chunk_size];
  const bool first = chunk.scope->dt_before == 0;
  for (int p = 0; p < n; ++p) {
    const double closing = to[p] - 0.5 * gained[p], opening = to_heat[p] - 0.5 * gained[p];
    const double loss = first ? 0.0 : before[p] + closing;
    const double open = (first ? closing + opening : opening) - (new_energy[p] - energy[p]);
    to[p] = loss + open;
    const double least = viscous != nullptr ? -std::max(0.0, viscous[p]) : 0.0;
    all[p] = loss - within[p];
    to_heat[p] = std::max(least, all[p]);
    to_open[p] = open + within[p];
    opened[p] = to_open[p] - open_before[p];
    wanted[p] = std::max(0.0, to_heat[p]);
    taken[p] = std::min(0.0, to_heat[p]);
  }
  using Of = BodyEnergySums;
  BodyEnergySums& sums = chunk.sums();
  const double unit = chunk.body->energy_units.energy;
  add_rounded(wanted, n, unit, sums[Of::heat_wanted]);
  add_rounded(taken, n, unit, sums[Of::heat_taken]);
  add_rounded(all, n, unit, sums[Of::lost]);
  add_rounded(heat, n, unit, sums[Of::heat_before]);
  add_rounded(opened, n, unit, sums[Of::open_gain]);
}

void LostEnergy::give_heat(std::span<const BlockWork> work, int kind, double share,
                           double dt) const {
  const Body& body = (*bodies_)[static_cast<std::size_t>(kind)];
  const Columns& c = body.carried->columns;
  const double capacity = body.material->constants.specific_heat;
  for (const BlockWork& w : work) {
    if (w.kind != kind) continue;
    const auto made = [&](int of) { return w.next->column(static_cast<std::size_t>(of)); };
    const double* mass = w.set->column(static_cast<std::size_t>(c.mass));
    const double* before = w.set->column(static_cast<std::size_t>(c.lost_heat));
    double *heat = made(c.lost_heat), *T = made(c.temperature), *T_l = made(c.loss_temperature);
    const double* viscous = c.viscous_heat >= 0 ? made(c.viscous_heat) : nullptr;
    double* rate = c.heating >= 0 ? made(c.heating) : nullptr;
    for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
      if (heat[p] > 0) heat[p] *= share;
      const double given = heat[p] - before[p];
      const double all = before[p] + (viscous != nullptr ? viscous[p] : 0.0);
      const double warmed = given >= 0 || !(all > 0) ? given / (mass[p] * capacity)
                                                     : T_l[p] * std::max(-1.0, given / all);
      T[p] += warmed;
      T_l[p] += warmed;
      if (rate != nullptr) rate[p] += warmed / dt;
    }
  }
}

}  // namespace sluice::mpm

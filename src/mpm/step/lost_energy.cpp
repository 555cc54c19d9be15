// What transfer and integration take from the energy of particles becomes heat of them.
//
// A particle gives its share of mass to nodes, and its stress pushes them. Of a step, with any
// velocity u of nodes,
//
//   P = sum m S dv . u + dk V sigma : sum u (x) grad S
//   loss = P - (change of its kinetic energy, its spin's too) - (U+ - U)
//
// adds up to the energy account's T + R, as M dv is the impulse of all stress on a node. Taken
// are the velocities by which energy passes: u = (v + vh)/2, v as particles gave it, vh those of
// which L is taken, v* where nothing is mapped back. Of v* alone some particles would lose for
// ever what others win, without any loss of all.
//
// Of a wave that still swings with the step: forces of one time work on velocities half a step
// before and behind. With v and the first half of the change of kinetic energy in the interval
// before, and vh, the second half and U+ - U in the interval behind, it does not. A particle keeps
//
//   B = loss of all intervals so far, and what is open of the next one
//   G = max(-D, g) for g < 0, phi g for g > 0,   g = loss of all intervals - E
//
// with E = m sum_ed (L - W)_ed^2 <r_d^2>/2, kinetic energy within a cell, which nodes have and
// particles do not. G is heat; D is that of the artificial viscosity. A gain takes heat back, but
// no more than what these two have given: no particle is cooled below the temperature that its
// deformation gives it. What a particle where it crosses kinks of shape functions loses others win:
// phi <= 1, one for each body, is such that all its heat is what the body has lost, and no more.
#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/thread_report.hpp"

namespace sluice::mpm {
namespace {

// Lanes u, dv . u of nodes with v* - v_ref, - | dv, -; all velocities relative to v_ref.
void to_work(const Window& nodes, const Window* mapped, const double (&shift)[3], bool before,
             Window& to) {
  const IntVec3 size{nodes.size(0), nodes.size(1), nodes.size(2)};
  to.move_to(nodes.lower(), nodes.lower() + size - IntVec3{1, 1, 1});
  const auto count = static_cast<std::ptrdiff_t>(size.x) * size.y * size.z;
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    const std::int64_t* from = nodes.at(0, 0, 0) + n * lanes;
    const std::int64_t* moved = mapped != nullptr ? mapped->at(0, 0, 0) + n * lanes : nullptr;
    // Particles may have left a node until the middle of the step.
    const bool known = moved != nullptr && as_real(moved[3]) != 0;
    std::int64_t* node = to.at(0, 0, 0) + n * lanes;
    double work = 0;
    for (int d = 0; d < 3; ++d) {
      const double dv = as_real(from[4 + d]);
      double u = as_real(from[d]);
      if (before)
        u -= dv;
      else if (known)
        u = as_real(moved[d]) + shift[d];
      node[d] = as_bits(u);
      work += dv * u;
    }
    node[3] = as_bits(work);
  }
}

// sigma : L of symmetric tensors and gradients.
constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};

}  // namespace

// Of velocities, and of spins where there are: minus both halves of the change of kinetic energy.
void SolidStep::begin_losses(const BlockWork& w, std::size_t at, int n,
                             const ImpulsesAtParticles& got) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  if (c.lost_energy < 0) return;
  const auto old = [&](int of) { return w.set->column(static_cast<std::size_t>(of)) + at; };
  const auto made = [&](int of) { return w.next->column(static_cast<std::size_t>(of)) + at; };
  double *first = made(c.lost_energy), *second = made(c.lost_heat);
  const double* mass = old(c.mass);
  std::fill_n(first, n, 0.0);
  std::fill_n(second, n, 0.0);
  for (int d = 0; d < 3; ++d) {
    const double *v = old(c.velocity + d), *to_v = made(c.velocity + d);
    const double reference = body.units.reference[d];
    for (int p = 0; p < n; ++p) {
      const double half = 0.5 * mass[p] * (to_v[p] - v[p]);
      first[p] -= half * (v[p] - reference);
      second[p] -= half * (to_v[p] - reference);
    }
    if (c.spin < 0) continue;
    const double *spin = old(c.spin + d), *to_spin = made(c.spin + d), *inertia = got.inertia[d];
    for (int p = 0; p < n; ++p) {
      const double half = 0.5 * mass[p] * inertia[p] * (to_spin[p] - spin[p]);
      first[p] -= half * spin[p];
      second[p] -= half * to_spin[p];
    }
  }
}

// Windows of the nodes at the start of the step, with the velocities of both halves.
void SolidStep::load_losses(const BlockWork& w, ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  Window &nodes = report.loss_nodes, &mapped = report.loss_mapped;
  nodes.load(w.lowest, w.highest, body.table, body.nodes);
  double shift[3] = {};
  if (solids_->maps_back()) {
    mapped.load(w.lowest, w.highest, body.table, body.mapped);
    for (int d = 0; d < 3; ++d) shift[d] = body.mapped_units.reference[d] - body.units.reference[d];
  }
  const Window* moved = solids_->maps_back() ? &mapped : nullptr;
  to_work(nodes, moved, shift, true, report.loss_before);
  to_work(nodes, moved, shift, false, report.loss_after);
}

// Adds the halves of P.
void SolidStep::add_works(const BlockWork& w, std::size_t at, int n, ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const auto old = [&](int of) { return w.set->column(static_cast<std::size_t>(of)) + at; };
  const double *mass = old(c.mass), *volume = old(c.volume);
  const double* q = c.viscous >= 0 ? old(c.viscous) : nullptr;
  GridAtParticles& read = report.loss_read;
  for (const bool after : {false, true}) {
    double* to = w.next->column(static_cast<std::size_t>(after ? c.lost_heat : c.lost_energy)) + at;
    read_velocities(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                    static_cast<int>(at), n, after ? report.loss_after : report.loss_before, read);
    if (solids_->axisymmetric) add_hoop_rate(*w.set, body.units.reference.x, at, n, read);
    alignas(64) double power[chunk_size] = {};
    for (int e = 0; e < 6; ++e) {
      const double* sigma = old(c.stress + e);
      const double *one = read.L[3 * row[e] + column[e]], *other = read.L[3 * column[e] + row[e]];
      if (e < 3)
        for (int p = 0; p < n; ++p)
          power[p] += (q != nullptr ? sigma[p] - q[p] : sigma[p]) * one[p];
      else
        for (int p = 0; p < n; ++p) power[p] += sigma[p] * (one[p] + other[p]);
    }
    for (int p = 0; p < n; ++p)
      to[p] += 0.5 * (mass[p] * read.fourth[p] + kick_ * volume[p] * power[p]);
  }
}

// E of particles, J; of affine velocities, which hold it, what it gained instead.
void SolidStep::find_inner(const BlockWork& w, std::size_t at, int n, const GridAtParticles& read,
                           double* within, double* gained) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  std::fill_n(within, n, 0.0);
  std::fill_n(gained, n, 0.0);
  for (int e = 0; e < 9; ++e) {
    const double moment = body.energy_units.moment[e % 3];
    if (c.affine >= 0) {
      const double* C = w.set->column(static_cast<std::size_t>(c.affine + e)) + at;
      const double* to_C = w.next->column(static_cast<std::size_t>(c.affine + e)) + at;
      for (int p = 0; p < n; ++p) gained[p] += moment * (to_C[p] * to_C[p] - C[p] * C[p]);
      continue;
    }
    const double *L = read.L[e], *turned = read.L[3 * (e % 3) + e / 3];
    const bool spins = c.spin >= 0;
    for (int p = 0; p < n; ++p) {
      const double rate = spins ? 0.5 * (L[p] + turned[p]) : L[p];
      within[p] += moment * (rate * rate);
    }
  }
  const double* mass = w.set->column(static_cast<std::size_t>(c.mass)) + at;
  for (int p = 0; p < n; ++p) {
    within[p] *= 0.5 * mass[p];
    gained[p] *= 0.5 * mass[p];
  }
}

// Losses of particles that have their new state; where their heat will stand, g or -D.
void SolidStep::settle_losses(const BlockWork& w, const StageScope& scope, std::size_t at, int n,
                              ThreadReport& report) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  add_works(w, at, n, report);
  const auto old = [&](int of) { return w.set->column(static_cast<std::size_t>(of)) + at; };
  const auto made = [&](int of) { return w.next->column(static_cast<std::size_t>(of)) + at; };
  const double *energy = old(c.energy), *new_energy = made(c.energy);
  const double *before = old(c.lost_energy), *heat = old(c.lost_heat);
  const double* viscous = c.viscous_heat >= 0 ? made(c.viscous_heat) : nullptr;
  double *to = made(c.lost_energy), *to_heat = made(c.lost_heat);
  alignas(64) double within[chunk_size], gained[chunk_size];
  find_inner(w, at, n, report.read, within, gained);
  alignas(64) double wanted[chunk_size], taken[chunk_size], all[chunk_size];
  const bool first = scope.dt_before == 0;
  for (int p = 0; p < n; ++p) {
    const double closing = to[p] - 0.5 * gained[p], opening = to_heat[p] - 0.5 * gained[p];
    const double loss = first ? 0.0 : before[p] + closing;
    const double open = (first ? closing + opening : opening) - (new_energy[p] - energy[p]);
    to[p] = loss + open;
    const double least = viscous != nullptr ? -std::max(0.0, viscous[p]) : 0.0;
    all[p] = loss - within[p];
    to_heat[p] = std::max(least, all[p]);
    wanted[p] = std::max(0.0, to_heat[p]);
    taken[p] = std::min(0.0, to_heat[p]);
  }
  using Of = BodyEnergySums;
  BodyEnergySums& sums = report.books.bodies[static_cast<std::size_t>(w.kind)];
  const double unit = body.energy_units.energy;
  add_rounded(wanted, n, unit, sums[Of::heat_wanted]);
  add_rounded(taken, n, unit, sums[Of::heat_taken]);
  add_rounded(all, n, unit, sums[Of::lost]);
  add_rounded(heat, n, unit, sums[Of::heat_before]);
}

// G and the temperature of it; `share`: phi.
void SolidStep::give_heat(int kind, double share, double dt) {
  const Body& body = bodies_[static_cast<std::size_t>(kind)];
  const Columns& c = body.carried->columns;
  const double capacity = body.material->constants.specific_heat;
  for (const BlockWork& w : work_) {
    if (w.kind != kind) continue;
    const auto made = [&](int of) { return w.next->column(static_cast<std::size_t>(of)); };
    const double* mass = w.set->column(static_cast<std::size_t>(c.mass));
    const double* before = w.set->column(static_cast<std::size_t>(c.lost_heat));
    double *heat = made(c.lost_heat), *T = made(c.temperature);
    double* rate = c.heating >= 0 ? made(c.heating) : nullptr;
    for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
      if (heat[p] > 0) heat[p] *= share;
      const double warmed = (heat[p] - before[p]) / (mass[p] * capacity);
      T[p] += warmed;
      if (rate != nullptr) rate[p] += warmed / dt;
    }
  }
}

}  // namespace sluice::mpm

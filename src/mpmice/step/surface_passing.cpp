// What passes the surface, and who gets it: each pair gives the same integer to both of its sides.
#include <algorithm>
#include <cmath>

#include "mpm/step/solid_step.hpp"
#include "mpmice/step/surface_exchange.hpp"

namespace sluice::mpmice {
namespace {

// Pairs take no more than their cell of the fluid has; sums behind have room for so many of those.
constexpr double most_cells = 8;

}  // namespace

template <int D>
double SurfaceExchange<D>::inverse_mass(std::size_t node) const {
  return solid_.rigid ? 0.0 : 1 / solid_mass_[node];
}

template <int D>
double SurfaceExchange<D>::inverse_capacity(std::size_t node) const {
  return solid_.rigid ? 0.0 : 1 / (solid_mass_[node] * solid_.specific_heat);
}

template <int D>
double SurfaceExchange<D>::value(int lane, std::size_t cell, double scale) const {
  return lane < 0 ? 0.0 : from_sum(sums_.lane(lane)[cell]) * scale;
}

// A sum of 1 in the lanes of heat and momentum; of energies of motion times the speed.
template <int D>
double SurfaceExchange<D>::unit_of_heat() const {
  return most_.fluid_capacity * most_.temperature * most_cells;
}

template <int D>
double SurfaceExchange<D>::unit_of_impulse() const {
  return most_.fluid_mass * most_.speed * most_cells;
}

template <int D>
void SurfaceExchange<D>::pass(const StageScope& scope) {
  const auto take_lanes = [&](int& lane, int n) {
    lane = lanes_.count;
    lanes_.count += n;
  };
  if (films_.any_heat()) {
    take_lanes(lanes_.heat_of_fluid, static_cast<int>(fluids_));
    take_lanes(lanes_.heat, 1);
    take_lanes(lanes_.relaxation, 1);
  }
  if (films_.any_drag()) {
    take_lanes(lanes_.momentum, D);
    take_lanes(lanes_.energy, 1);
    take_lanes(lanes_.impulse, D);
    take_lanes(lanes_.given, 1);
  }
  sums_.begin(frame_.cells, lanes_.count);
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    if (films_.any_heat()) pass_heat(n, scope.step.dt);
    if (films_.any_drag()) pass_drag(n, scope.step.dt);
  }
  sums_.sum_over_ranks(*scope.ranks);
}

template <int D>
void SurfaceExchange<D>::pass_heat(std::size_t pair, double dt) {
  const Pair& of = pairs_[pair];
  const std::size_t g = contacts_[of.contact].fluid, s = of.solid;
  const double unit = unit_of_heat();
  for (std::size_t m = 0; m < fluids_; ++m) {
    const double G = heat_[pair * fluids_ + m], C = capacity_[of.contact * fluids_ + m];
    if (!(G > 0) || !(C > 0)) continue;
    const double kappa =
        passes(G, dt, heat_in_front_[m][g], 1 / C, heat_behind_[s], inverse_capacity(s));
    const double Q = kappa * (temperature_[of.contact * fluids_ + m] - solid_temperature_[s]);
    const std::uint64_t whole = to_sum(Q / unit);
    sums_.lane(lanes_.heat_of_fluid + static_cast<int>(m))[g] -= whole;
    sums_.lane(lanes_.heat)[s] += whole;
    sums_.lane(lanes_.relaxation)[s] += to_sum(kappa * inverse_capacity(s));
    if (solid_.rigid) work_.add(-from_sum(whole) * unit * frame_.cell_volume);
  }
}

// The pair's share of the solid moves on with I S_s/(G M_s); what that costs more than one motion
// of all that is behind becomes heat there (give_to_set).
template <int D>
void SurfaceExchange<D>::pass_drag(std::size_t pair, double dt) {
  const Pair& of = pairs_[pair];
  const std::size_t g = contacts_[of.contact].fluid, s = of.solid;
  if (!(of.drag > 0) || !(mass_[of.contact] > 0)) return;
  const double kappa = passes(of.drag, dt, drag_in_front_[g], 1 / mass_[of.contact],
                              drag_behind_[s], inverse_mass(s));
  const double unit = unit_of_impulse();
  double given = 0;
  for (std::size_t d = 0; d < D; ++d) {
    if (component_[d] < 0) continue;
    const double u = solid_velocity_[d][s];
    const std::uint64_t whole = to_sum(kappa * (velocity_[of.contact][d] - u) / unit);
    const double I = from_sum(whole) * unit;
    sums_.lane(lanes_.momentum + static_cast<int>(d))[g] -= whole;
    sums_.lane(lanes_.impulse + static_cast<int>(d))[s] += whole;
    given += I * (u + 0.5 * I * (drag_behind_[s] / of.drag) * inverse_mass(s));
    if (solid_.rigid) impulse_[d].add(-I * frame_.cell_volume);
  }
  const double unit_of_energy = unit * most_.speed;
  const std::uint64_t whole = to_sum(given / unit_of_energy);
  sums_.lane(lanes_.energy)[g] -= whole;
  sums_.lane(lanes_.given)[s] += whole;
  if (solid_.rigid) work_.add(-from_sum(whole) * unit_of_energy * frame_.cell_volume);
}

// Heat goes to the fluid that gave or took it; what one fluid alone has is told as `kinetic`.
template <int D>
void SurfaceExchange<D>::give_to_fluid() {
  const double heat = unit_of_heat(), impulse = unit_of_impulse();
  frame_.cells.for_each_cell(frame_.domain, [&](const Cell<D>&, std::size_t i) {
    bool any = false;
    for (std::size_t m = 0; m < fluids_ && lanes_.heat_of_fluid >= 0; ++m) {
      const double Q = value(lanes_.heat_of_fluid + static_cast<int>(m), i, heat);
      (fluids_ > 1 ? amounts_.energy[m] : amounts_.kinetic)[i] += Q;
      any |= Q != 0;
    }
    for (std::size_t d = 0; d < D && lanes_.momentum >= 0; ++d) {
      const double I = value(lanes_.momentum + static_cast<int>(d), i, impulse);
      if (I == 0) continue;
      amounts_.momentum[static_cast<std::size_t>(component_[d])][i] += I;
      any = true;
    }
    const double energy = value(lanes_.energy, i, impulse * most_.speed);
    amounts_.kinetic[i] += energy;
    if (any || energy != 0) amounts_.touched[i] = 1;
  });
}

template <int D>
typename SurfaceExchange<D>::Gain SurfaceExchange<D>::gain_of(std::size_t node) const {
  Gain gain;
  if (!(solid_mass_[node] > 0)) return gain;
  const double unit = unit_of_impulse(), inverse = 1 / solid_mass_[node];
  gain.energy = value(lanes_.given, node, unit * most_.speed) * inverse;
  for (std::size_t d = 0; d < D && lanes_.impulse >= 0; ++d) {
    gain.kick[d] = value(lanes_.impulse + static_cast<int>(d), node, unit) * inverse;
    gain.energy -= gain.kick[d] * solid_velocity_[d][node];
  }
  if (lanes_.heat >= 0 && solid_.specific_heat > 0) {
    gain.warm = value(lanes_.heat, node, unit_of_heat()) * inverse_capacity(node);
    gain.relaxation = value(lanes_.relaxation, node, 1);
  }
  return gain;
}

template <int D>
void SurfaceExchange<D>::give_to_set(SolidSet<D>& s, std::size_t n, ExactSum& heated,
                                     ExactSum& moved) const {
  const double c = solid_.specific_heat;
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  std::array<double*, D> v;
  for (std::size_t d = 0; d < D; ++d)
    v[d] = s.next->column(static_cast<std::size_t>(s.columns->velocity + frame_.direction[d]));
  for (std::size_t q = ends_[n]; q < ends_[n + 1]; ++q) {
    const std::size_t p = near_[q].first;
    Gain all;
    for (const NodeShare<D>& at : near_[q].second) {
      const Gain gain = gain_of(at.node);
      for (std::size_t d = 0; d < D; ++d) all.kick[d] += at.weight * gain.kick[d];
      all.warm += at.weight * (gain.warm + gain.relaxation * (solid_temperature_[at.node] - T[p]));
      all.energy += at.weight * gain.energy;
    }
    // What the kick itself is, k^2/2 beside u.k; what is left is heat.
    for (std::size_t d = 0; d < D; ++d) {
      const double k = all.kick[d];
      all.energy -= 0.5 * k * k;
      moved.add(mass[p] * (k * (v[d][p] + 0.5 * k)));
      v[d][p] += k;
    }
    T[p] += all.warm;
    if (c > 0) T[p] += all.energy / c;
    heated.add(mass[p] * (c * all.warm + all.energy));
  }
}

// What rigid solids give comes from outside.
template <int D>
void SurfaceExchange<D>::book_rigid(CouplingBooks& books) const {
  for (std::size_t d = 0; d < D; ++d)
    books.of_exchange(mpm::StepSums::impulse_x + frame_.direction[d]).merge(impulse_[d]);
  books.of_exchange(mpm::StepSums::work).merge(work_);
}

template class SurfaceExchange<1>;
template class SurfaceExchange<2>;
template class SurfaceExchange<3>;

}  // namespace sluice::mpmice

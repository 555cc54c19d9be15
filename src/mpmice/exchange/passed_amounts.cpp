#include "mpmice/exchange/passed_amounts.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {
namespace {

// Pairs take no more than their cell of the fluid has; sums behind have room for so many of those.
constexpr double most_cells = 8;

}  // namespace

template <int D>
PassedAmounts<D>::Lanes::Lanes(const FilmCoefficients& films, int fluids) {
  const auto take = [&](int& lane, int n) {
    lane = count;
    count += n;
  };
  if (films.any_heat()) {
    take(heat_of_fluid, fluids);
    take(heat, 1);
    take(relaxation, 1);
  }
  if (films.any_drag()) {
    take(momentum, D);
    take(energy, 1);
    take(impulse, D);
    take(given, 1);
  }
}

// A sum of 1 in the lanes of heat and momentum; of energies of motion times the speed.
template <int D>
double PassedAmounts<D>::unit_of_heat() const {
  return most_.fluid_capacity * most_.temperature * most_cells;
}

template <int D>
double PassedAmounts<D>::unit_of_impulse() const {
  return most_.fluid_mass * most_.speed * most_cells;
}

template <int D>
void PassedAmounts<D>::pass(const NearCells<D>& near, const KeptArray<SurfaceContact<D>>& contacts,
                            const Conductances<D>& joined, const FilmCoefficients& films, double dt,
                            Communicator& ranks) {
  const double cell_volume = near.frame().cell_volume;
  lanes_ = Lanes(films, static_cast<int>(front_.fluids()));
  sums_.begin(near.frame().cells, lanes_.count);
  std::vector<ByRigid> given(range_count(near.team(), joined.pairs().size()));
  add_in_ranges<D>(
      near.team(), joined.pairs().size(), sums_,
      [&](std::size_t begin, std::size_t end, std::size_t range, CellSums<D>& sums) {
        for (std::size_t n = begin; n < end; ++n) {
          const OnePair pair{n, contacts[joined.pairs()[n].contact].fluid, dt, cell_volume};
          if (films.any_heat()) pass_heat(joined, pair, sums, given[range]);
          if (films.any_drag()) pass_drag(joined, pair, sums, given[range]);
        }
      });
  for (const ByRigid& of : given) {
    for (std::size_t d = 0; d < D; ++d) by_rigid_.impulse[d].merge(of.impulse[d]);
    by_rigid_.work.merge(of.work);
  }
  sums_.sum_over_ranks(ranks);
}

template <int D>
void PassedAmounts<D>::pass_heat(const Conductances<D>& joined, const OnePair& pair,
                                 CellSums<D>& sums, ByRigid& given) const {
  const auto& of = joined.pairs()[pair.number];
  const std::size_t s = of.node, g = pair.cell;
  const double unit = unit_of_heat();
  for (std::size_t m = 0; m < front_.fluids(); ++m) {
    const double G = joined.heat(pair.number, m), C = front_.capacity(of.contact, m);
    if (!(G > 0) || !(C > 0)) continue;
    const double kappa = passes(G, pair.dt, joined.heat_in_front(m, g), 1 / C,
                                joined.heat_behind(s), behind_.inverse_capacity(s));
    const double Q = kappa * (front_.temperature(of.contact, m) - behind_.temperature(s));
    const std::uint64_t whole = to_sum(Q / unit);
    sums.lane(lanes_.heat_of_fluid + static_cast<int>(m))[g] -= whole;
    sums.lane(lanes_.heat)[s] += whole;
    sums.lane(lanes_.relaxation)[s] += to_sum(kappa * behind_.inverse_capacity(s));
    if (behind_.solid().rigid) given.work.add(-from_sum(whole) * unit * pair.cell_volume);
  }
}

// The pair's share of the solid moves on with I S_s/(G M_s); what that costs more than one motion
// of all that is behind becomes heat there (give_to_set).
template <int D>
void PassedAmounts<D>::pass_drag(const Conductances<D>& joined, const OnePair& pair,
                                 CellSums<D>& sums, ByRigid& given) const {
  const auto& of = joined.pairs()[pair.number];
  const std::size_t s = of.node, g = pair.cell;
  const double M = front_.mass(of.contact);
  if (!(of.drag > 0) || !(M > 0)) return;
  const double kappa = passes(of.drag, pair.dt, joined.drag_in_front(g), 1 / M,
                              joined.drag_behind(s), behind_.inverse_mass(s));
  const double unit = unit_of_impulse();
  double energy = 0;
  for (std::size_t d = 0; d < D; ++d) {
    if (front_.component(d) < 0) continue;
    const double u = behind_.velocity(d, s);
    const std::uint64_t whole = to_sum(kappa * (front_.velocity(of.contact, d) - u) / unit);
    const double I = from_sum(whole) * unit;
    sums.lane(lanes_.momentum + static_cast<int>(d))[g] -= whole;
    sums.lane(lanes_.impulse + static_cast<int>(d))[s] += whole;
    energy += I * (u + 0.5 * I * (joined.drag_behind(s) / of.drag) * behind_.inverse_mass(s));
    if (behind_.solid().rigid) given.impulse[d].add(-I * pair.cell_volume);
  }
  const double unit_of_energy = unit * most_.speed;
  const std::uint64_t whole = to_sum(energy / unit_of_energy);
  sums.lane(lanes_.energy)[g] -= whole;
  sums.lane(lanes_.given)[s] += whole;
  if (behind_.solid().rigid) given.work.add(-from_sum(whole) * unit_of_energy * pair.cell_volume);
}

// Heat goes to the fluid that gave or took it; what one fluid alone has stands in `kinetic`.
template <int D>
void PassedAmounts<D>::give_to_fluid(const NearCells<D>& near, CellAmounts<D>& amounts) const {
  const std::size_t fluids = front_.fluids();
  const double heat = unit_of_heat(), impulse = unit_of_impulse();
  near.for_each([&](const Cell<D>&, std::size_t i) {
    bool any = false;
    for (std::size_t m = 0; m < fluids && lanes_.heat_of_fluid >= 0; ++m) {
      const double Q = value(lanes_.heat_of_fluid + static_cast<int>(m), i, heat);
      (fluids > 1 ? amounts.energy[m] : amounts.kinetic)[i] += Q;
      any |= Q != 0;
    }
    for (std::size_t d = 0; d < D && lanes_.momentum >= 0; ++d) {
      const double I = value(lanes_.momentum + static_cast<int>(d), i, impulse);
      if (I == 0) continue;
      amounts.momentum[static_cast<std::size_t>(front_.component(d))][i] += I;
      any = true;
    }
    const double energy = value(lanes_.energy, i, impulse * most_.speed);
    amounts.kinetic[i] += energy;
    if (any || energy != 0) amounts.touched[i] = 1;
  });
}

template <int D>
typename PassedAmounts<D>::Gain PassedAmounts<D>::gain_of(std::size_t node) const {
  Gain gain;
  if (!(behind_.mass(node) > 0)) return gain;
  const double unit = unit_of_impulse(), inverse = 1 / behind_.mass(node);
  gain.energy = value(lanes_.given, node, unit * most_.speed) * inverse;
  for (std::size_t d = 0; d < D && lanes_.impulse >= 0; ++d) {
    gain.kick[d] = value(lanes_.impulse + static_cast<int>(d), node, unit) * inverse;
    gain.energy -= gain.kick[d] * behind_.velocity(d, node);
  }
  if (lanes_.heat >= 0 && behind_.solid().specific_heat > 0) {
    gain.warm = value(lanes_.heat, node, unit_of_heat()) * behind_.inverse_capacity(node);
    gain.relaxation = value(lanes_.relaxation, node, 1);
  }
  return gain;
}

template <int D>
void PassedAmounts<D>::give_to_set(const NearCells<D>& near, SolidSet<D>& s, std::size_t n,
                                   CouplingBooks& books) const {
  const auto threads = static_cast<std::size_t>(near.team().size());
  const std::vector<typename SolidBehind<D>::Counted>& ranges = behind_.counted(n);
  std::vector<ExactSum> heated(threads), moved(threads);
  near.team().for_each(ranges.size(), [&](std::size_t range, int thread) {
    const auto k = static_cast<std::size_t>(thread);
    give_to_particles(near.frame(), s, ranges[range], heated[k], moved[k]);
  });
  for (std::size_t k = 0; k < threads; ++k) {
    books.of_exchange(Booked::heat_from_fluid).merge(heated[k]);
    books.of_exchange(Booked::exchange_gain).merge(moved[k]);
  }
}

template <int D>
void PassedAmounts<D>::give_to_particles(const Frame<D>& frame, SolidSet<D>& s,
                                         const typename SolidBehind<D>::Counted& counted,
                                         ExactSum& heated, ExactSum& moved) const {
  const double c = behind_.solid().specific_heat;
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  std::array<double*, D> v;
  for (std::size_t d = 0; d < D; ++d)
    v[d] = s.next->column(static_cast<std::size_t>(s.columns->velocity + frame.direction[d]));
  for (const auto& [p, nodes] : counted) {
    Gain all;
    for (const NodeShare<D>& at : nodes) {
      const Gain gain = gain_of(at.node);
      for (std::size_t d = 0; d < D; ++d) all.kick[d] += at.weight * gain.kick[d];
      all.warm += at.weight * (gain.warm + gain.relaxation * (behind_.temperature(at.node) - T[p]));
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
void PassedAmounts<D>::book_rigid(const Frame<D>& frame, CouplingBooks& books) const {
  for (std::size_t d = 0; d < D; ++d)
    books.of_exchange(Booked::impulse, frame.direction[d]).merge(by_rigid_.impulse[d]);
  books.of_exchange(Booked::work).merge(by_rigid_.work);
}

template class PassedAmounts<1>;
template class PassedAmounts<2>;
template class PassedAmounts<3>;

}  // namespace sluice::mpmice

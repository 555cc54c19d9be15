// What lies on the two sides of a surface, and how well they are joined.
#include "mpmice/step/surface_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/base/reduction.hpp"

namespace sluice::mpmice {
namespace {

// Sums of conductances in a cell have room for so many of the largest.
constexpr double most_contacts = 1024;

// Lanes of what is behind.
constexpr int mass_lane = 0, heat_lane = 1, velocity_lane = 2;

// Of the heaviest particles, so many have room in the sums of a node.
constexpr double most_particles = 1024;

// How far heat comes in a time with k/(rho c): as if what lies there had met at its beginning.
double reach_of_heat(double k, double capacity, double time) {
  return std::sqrt(std::numbers::pi * k / capacity * time);
}

}  // namespace

bool FilmCoefficients::any_drag() const {
  return std::any_of(drag.begin(), drag.end(), [](double k) { return k > 0; });
}

bool FilmCoefficients::any_heat() const {
  return std::any_of(heat.begin(), heat.end(), [](double k) { return k > 0; });
}

template <int D>
SurfaceExchange<D>::SurfaceExchange(const Frame<D>& frame, const SolidFields<D>& fields,
                                    CellAmounts<D>& amounts, std::vector<SolidSet<D>>& sets,
                                    const ice::FluidPart& fluid, int kind,
                                    const SolidConstants& solid, const FilmCoefficients& films)
    : frame_(frame),
      fields_(fields),
      amounts_(amounts),
      sets_(sets),
      fluid_(fluid),
      kind_(kind),
      solid_(solid),
      films_(films),
      fluids_(fluid.options().materials.fluids.size()) {
  component_.fill(-1);
  for (std::size_t k = 0; k < amounts.momentum.size(); ++k)
    for (std::size_t d = 0; d < D; ++d)
      if (fluid.options().grid.direction[k] == frame.direction[d])
        component_[d] = static_cast<int>(k);
}

template <int D>
void SurfaceExchange<D>::run(const StageScope& scope, CouplingBooks& books) {
  find_contacts();
  find_scales(scope);
  find_solid(scope);
  find_pairs(scope);
  sum_conductances(scope);
  pass(scope);
  give_to_fluid();
  if (solid_.rigid) return book_rigid(books);
  std::size_t n = 0;
  for (SolidSet<D>& s : sets_)
    if (s.kind == kind_)
      give_to_set(s, n++, books.of_exchange(mpm::StepSums::heat_from_fluid),
                  books.of_exchange(mpm::StepSums::exchange_gain));
}

template <int D>
void SurfaceExchange<D>::find_contacts() {
  contacts_ = surface_contacts<D>(frame_, fields_, amounts_, sets_, kind_);
  share_.assign(contacts_.size() * fluids_, 0);
  temperature_ = capacity_ = share_;
  mass_.assign(contacts_.size(), 0);
  velocity_.assign(contacts_.size(), {});
  for (std::size_t n = 0; n < contacts_.size(); ++n) look_at_fluid(n);
}

// The largest of everything, of particles too.
template <int D>
void SurfaceExchange<D>::find_scales(const StageScope& scope) {
  for (const SolidSet<D>& s : sets_) {
    if (s.kind != kind_) continue;
    const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
    const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      most_.mass = std::max(most_.mass, m[p]);
      most_.temperature = std::max(most_.temperature, std::fabs(T[p]));
    }
    for (const int d : frame_.direction) {
      const double* v = s.next->column(static_cast<std::size_t>(s.columns->velocity + d));
      for (std::size_t p = 0; p < s.set->size(); ++p)
        most_.speed = std::max(most_.speed, std::fabs(v[p]));
    }
  }
  Reduction all;
  double* const each[] = {&most_.mass, &most_.speed, &most_.temperature, &most_.fluid_mass,
                          &most_.fluid_capacity};
  std::vector<Reduction::Maximum> slots;
  for (const double* most : each) slots.push_back(all.add_maximum(*most));
  scope.ranks->reduce(all);
  for (std::size_t n = 0; n < slots.size(); ++n) *each[n] = all.maximum(slots[n]);
}

// The fluids of the cell in front, with the energy of their mixture as a state will have it.
template <int D>
void SurfaceExchange<D>::look_at_fluid(std::size_t contact) {
  const std::size_t i = contacts_[contact].fluid;
  const std::vector<ice::Fluid>& fluids = fluid_.options().materials.fluids;
  const double all = amounts_.mass_of_all(i), rest = amounts_.kinetic[i] - amounts_.moving(i);
  double filled = 0;
  for (std::size_t m = 0; m < fluids_; ++m) filled += std::max(amounts_.filled[m][i], 0.0);
  for (std::size_t m = 0; m < fluids_; ++m) {
    const double M = amounts_.mass[m][i], V = amounts_.filled[m][i];
    if (!(M > 0) || !(V > 0)) continue;
    const double rho = M / V, rho_e = (amounts_.energy[m][i] + rest * (M / all)) / V;
    if (!fluids[m].admissible(rho, rho_e)) continue;
    const std::size_t at = contact * fluids_ + m;
    share_[at] = V / filled;
    temperature_[at] = fluids[m].temperature(rho, rho_e);
    capacity_[at] = M * fluids[m].heat_capacity(rho, rho_e);
    most_.temperature = std::max(most_.temperature, std::fabs(temperature_[at]));
    most_.fluid_capacity = std::max(most_.fluid_capacity, capacity_[at]);
  }
  mass_[contact] = all;
  most_.fluid_mass = std::max(most_.fluid_mass, all);
  for (std::size_t d = 0; d < D; ++d) {
    if (component_[d] < 0) continue;
    const double u = amounts_.momentum[static_cast<std::size_t>(component_[d])][i] / all;
    velocity_[contact][d] = u;
    most_.speed = std::max(most_.speed, std::fabs(u));
  }
}

// Cells in which the middles of particles lie that may count at a node behind a surface: one cell
// to the particle that has the face, one to its nodes, one to others there.
template <int D>
CellMask SurfaceExchange<D>::cells_that_exchange() const {
  CellMask mask(frame_.cells.size(), 0);
  frame_.cells.for_each_cell(frame_.domain, [&](const Cell<D>&, std::size_t i) {
    mask[i] = amounts_.volume[i] > 0 ? 1 : 0;
  });
  dilate(frame_, 3, mask);
  return mask;
}

// What particles have at nodes.
template <int D>
void SurfaceExchange<D>::add_solid(const SolidSet<D>& s) {
  const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  std::array<const double*, D> v;
  for (std::size_t d = 0; d < D; ++d)
    v[d] = s.next->column(static_cast<std::size_t>(s.columns->velocity + frame_.direction[d]));
  for (std::size_t p = 0; p < s.set->size(); ++p) {
    if (meets_[frame_.cells.index(cell_of_middle<D>(frame_, *s.next, p))] == 0) continue;
    const Nodes& nodes =
        near_.emplace_back(static_cast<std::uint32_t>(p), nodes_around<D>(frame_, *s.next, p))
            .second;
    for (const NodeShare<D>& at : nodes) {
      const double share = at.weight * (m[p] / most_.mass / most_particles);
      sums_.lane(mass_lane)[at.node] += to_sum(share);
      sums_.lane(heat_lane)[at.node] += to_sum(share * (T[p] / most_.temperature));
      for (std::size_t d = 0; d < D; ++d)
        sums_.lane(velocity_lane + static_cast<int>(d))[at.node] +=
            to_sum(share * (v[d][p] / most_.speed));
    }
  }
  ends_.push_back(near_.size());
}

template <int D>
void SurfaceExchange<D>::find_solid(const StageScope& scope) {
  meets_ = cells_that_exchange();
  sums_.begin(frame_.cells, velocity_lane + D);
  near_.clear();
  ends_.assign(1, 0);
  for (const SolidSet<D>& s : sets_)
    if (s.kind == kind_) add_solid(s);
  sums_.sum_over_ranks(*scope.ranks);
  sums_.values(mass_lane, solid_mass_);
  const auto mean = [&](int lane, double scale, Column& to) {
    sums_.values(lane, to);
    for (std::size_t i = 0; i < to.size(); ++i)
      to[i] = solid_mass_[i] > 0 ? to[i] / solid_mass_[i] * scale : 0.0;
  };
  mean(heat_lane, most_.temperature, solid_temperature_);
  for (int d = 0; d < D; ++d)
    mean(velocity_lane + d, most_.speed, solid_velocity_[static_cast<std::size_t>(d)]);
  for (double& mass : solid_mass_) mass *= most_.mass * most_particles / frame_.cell_volume;
}

template <int D>
void SurfaceExchange<D>::find_pairs(const StageScope& scope) {
  const double time = scope.step.time + scope.step.dt;
  for (std::size_t n = 0; n < contacts_.size(); ++n) pair_up(n, time);
  for (const Pair& pair : pairs_) most_.drag = std::max(most_.drag, pair.drag);
  for (const double G : heat_) most_.heat = std::max(most_.heat, G);
  Reduction all;
  const auto drag = all.add_maximum(most_.drag), heat = all.add_maximum(most_.heat);
  scope.ranks->reduce(all);
  most_.drag = all.maximum(drag) * most_contacts;
  most_.heat = all.maximum(heat) * most_contacts;
}

// A contact with the nodes behind it.
template <int D>
void SurfaceExchange<D>::pair_up(std::size_t contact, double time) {
  const SurfaceContact<D>& c = contacts_[contact];
  const double behind = solid_resistance(c, time);
  for (const NodeShare<D>& at : nodes_around<D>(frame_, *sets_[c.set].next, c.particle)) {
    if (!(at.weight > 0) || !(solid_mass_[at.node] > 0)) continue;
    Pair pair{static_cast<std::uint32_t>(contact), at.node, 0};
    for (std::size_t m = 0; m < fluids_; ++m) {
      const double f = share_[contact * fluids_ + m], part = at.weight * c.area;
      pair.drag += part * f * films_.drag[m] * (c.width / 4);
      heat_.push_back(f > 0 ? part * heat_conductance(contact, m, behind, time) : 0.0);
    }
    pairs_.push_back(pair);
  }
}

// d_s/k_s.
template <int D>
double SurfaceExchange<D>::solid_resistance(const SurfaceContact<D>& c, double time) const {
  const double k = solid_.conductivity;
  if (!(k > 0) || !(solid_.specific_heat > 0)) return 0;
  const SolidSet<D>& s = sets_[c.set];
  double depth = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const int of = frame_.direction[d];
    depth += c.normal[d] * (frame_.anchor[of] + frame_.spacing[of] * c.place[d] -
                            s.next->coordinate(of)[c.particle]);
  }
  const double m = s.set->column(static_cast<std::size_t>(s.columns->mass))[c.particle],
               V = s.next->column(static_cast<std::size_t>(s.columns->volume))[c.particle];
  const double reach = reach_of_heat(k, m / V * solid_.specific_heat, time);
  return std::min(std::max(depth, 0.0), reach) / k;
}

// d_g/k_g of one fluid, over its share f of the surface.
template <int D>
double SurfaceExchange<D>::fluid_resistance(std::size_t contact, std::size_t m, double time) const {
  const double k = fluid_.options().transport.conductivities[m];
  if (!(k > 0)) return 0;
  const SurfaceContact<D>& c = contacts_[contact];
  const double f = share_[contact * fluids_ + m], C = capacity_[contact * fluids_ + m];
  const double reach = reach_of_heat(k, C / (f * amounts_.volume[c.fluid]), time);
  return std::min(c.to_fluid, reach) / (f * k);
}

// Per area.
template <int D>
double SurfaceExchange<D>::heat_conductance(std::size_t contact, std::size_t m, double behind,
                                            double time) const {
  const double K = films_.heat[m], f = share_[contact * fluids_ + m];
  if (!(K > 0) || !(solid_.specific_heat > 0)) return 0;
  const double film = 4 / (f * K * contacts_[contact].width);
  return 1 / (film + fluid_resistance(contact, m, time) + behind);
}

// As integers, so that the sums hold each of them to the bit.
template <int D>
void SurfaceExchange<D>::sum_conductances(const StageScope& scope) {
  const int fluids = static_cast<int>(fluids_), drag = fluids, behind = fluids + 1;
  sums_.begin(frame_.cells, fluids + 3);
  const auto add = [&](int in_front, int back, const Pair& pair, double& G, double scale) {
    const std::uint64_t whole = to_sum(G / scale);
    G = from_sum(whole) * scale;
    sums_.lane(in_front)[contacts_[pair.contact].fluid] += whole;
    sums_.lane(back)[pair.solid] += whole;
  };
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    add(drag, behind, pairs_[n], pairs_[n].drag, most_.drag);
    for (int m = 0; m < fluids; ++m)
      add(m, behind + 1, pairs_[n], heat_[n * fluids_ + static_cast<std::size_t>(m)], most_.heat);
  }
  sums_.sum_over_ranks(*scope.ranks);
  const auto take = [&](int lane, double scale, Column& to) {
    sums_.values(lane, to);
    for (double& G : to) G *= scale;
  };
  heat_in_front_.resize(fluids_);
  for (int m = 0; m < fluids; ++m) take(m, most_.heat, heat_in_front_[static_cast<std::size_t>(m)]);
  take(drag, most_.drag, drag_in_front_);
  take(behind, most_.drag, drag_behind_);
  take(behind + 1, most_.heat, heat_behind_);
}

template class SurfaceExchange<1>;
template class SurfaceExchange<2>;
template class SurfaceExchange<3>;

}  // namespace sluice::mpmice

// Solids that become fluid: mass, momentum, energy and volume of particles, given to cells.
//
// A particle keeps its corners and the kernel over them; what of its volume is left, `filled`,
// falls with its mass, and surfaces count by it (geometry/outer_faces.hpp). So stress and J stay as
// they are, the body stays closed, no fragment can turn inside out, and a burned particle leaves
// nothing. With f the share of the mass m that burns:
//
//   m, V, V_0, W: (1 - f) of them;  fluid: + f m, f m v, heat f (W + m c_s T + m Q), f m v^2/2
//
// in the cells of the particle, where its volume opens. Redistribution then joins what little cells
// hold with their neighbours at once: products alone in a crack would tear the body.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "ice/fluid/labels.hpp"
#include "mpmice/burn/burn_law.hpp"
#include "mpmice/burn/exposed_area.hpp"
#include "mpmice/burn/vanished_faces.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/level_coupling.hpp"
#include "mpmice/step/redistribute.hpp"

namespace sluice::mpmice {
namespace {

constexpr double least_filled = 1e-3;  // of a particle: the rest burns with it
constexpr double least_share = 1e-9;   // of its mass that burns in a step
constexpr double seen_volume = 0.2;    // fluids that fill less of a cell do not count as hot

}  // namespace

// Hottest fluid in a cell, or around it where asked or where the cell has little; 0: none.
template <int D>
double LevelCoupling<D>::hottest_fluid(const Cell<D>& c, bool around) const {
  const std::size_t here = frame_.box.index(c);
  if (!around && amounts_.volume[here] > seen_volume) return heat_of(here).temperature;
  double most = 0;
  for_each_around(c, 1, [&](std::size_t i) {
    if (amounts_.near[i] != 0 && amounts_.volume[i] > seen_volume)
      most = std::max(most, heat_of(i).temperature);
  });
  return most;
}

// Shares of the particles' masses that their surfaces lose.
template <int D>
void LevelCoupling<D>::burn_surfaces(const models::SolidBurn& burn, const SolidSet<D>& s, double dt,
                                     Column& shares) {
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const bool marks = burning_.lanes() > 0;
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_piece<D>(s.faces, When::start, 0, s.faces.size(),
                    [&](std::size_t i, int, const FacetNodes<D>&, const Piece<D>& piece) {
                      const std::size_t p = s.faces.particle[i];
                      if ((s.outer[p] >> s.faces.face[i] & 1) == 0 || !(s.filled[p] > 0)) return;
                      Cell<D> c = piece.cell;
                      for (std::size_t d = 0; d < D; ++d)
                        if (!frame_.periodic[d] &&
                            (c[d] < frame_.domain.lower[d] || c[d] >= frame_.domain.upper[d]))
                          return;  // on a side of the domain
                      c = frame_.inside(c);
                      const std::size_t k = frame_.box.index(c);
                      if (!wet(k)) return;
                      AtSurface at;
                      at.pressure = fields_.pressure[k];
                      at.solid_temperature = T[p];
                      at.hottest = std::max(T[p], hottest_fluid(c, looks_around(burn)));
                      at.density = mass[p] / volume[p];
                      std::array<double, D> area = piece.area;
                      for (int d = 0; d < D; ++d)
                        area[static_cast<std::size_t>(d)] *= frame_.face_area(d);
                      const double flux = surface_flux(burn, at);
                      if (flux > 0 && marks) ++burning_.lane(0)[k];
                      exposed[p].add(s.faces.face[i], area, flux);
                    });
  for (std::size_t p = 0; p < shares.size(); ++p)
    if (s.stays[p] > 0) shares[p] = dt * exposed[p].flow() / (mass[p] * s.stays[p]);
}

// For the archive, by all ranks' pieces of surface.
template <int D>
void LevelCoupling<D>::store_burning(const StageScope& scope, int slot) {
  Warehouse& state = scope.levels.front()->state();
  burning_.reach(frame_.box);
  burning_.sum_over_ranks(*scope.ranks);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView to = state.view(slot, 0, b);
    for_each_cell(frame_.held(state.local_boxes()[static_cast<std::size_t>(b)].cells),
                  [&](IntVec3 c) {
                    if (burning_.lane(0)[frame_.box.index(frame_.cell(c))] > 0) to(c) = 1;
                  });
  }
}

// Of what burns everywhere: the share that burns in each cell.
template <int D>
void LevelCoupling<D>::burn_cells(const StageScope& scope, const models::SolidBurn& burn,
                                  Column& shares) {
  shares.assign(frame_.box.cells(), 0.0);
  const auto& exchange = std::get<models::MassExchange>(burn.law);
  if (!exchange.by_pressure) {
    std::fill(shares.begin(), shares.end(), exchange.share(scope.step.time, scope.step.dt));
    return;
  }
  const models::JwlPp* law = &*exchange.by_pressure;
  Column reactant, pressure;
  mean_in_cells(scope, burn.solid, reactant, pressure);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (!(reactant[i] > 0) || amounts_.near[i] == 0) return;
    const double theta = fields_.theta_next[i], V = wet(i) ? amounts_.volume[i] : 0.0;
    const double p = (V * fields_.pressure[i] + theta * pressure[i]) / (V + theta);
    if (!law->burns(p, theta)) return;
    shares[i] = law->burned(scope.step.dt, p, reactant[i],
                            amounts_.mass[static_cast<std::size_t>(burn.product)][i]) /
                reactant[i];
  });
}

// Mass per cell volume of a solid, and its mean pressure.
template <int D>
void LevelCoupling<D>::mean_in_cells(const StageScope& scope, int kind, Column& mass,
                                     Column& pressure) {
  double most_mass = 1e-300, most_pressure = 1e-300;
  const auto pressure_of = [](const std::array<const double*, 6>& stress, std::size_t p) {
    return -(stress[0][p] + stress[1][p] + stress[2][p]) / 3;
  };
  const auto for_particles = [&](auto&& act) {
    for (const SolidSet<D>& s : sets_) {
      if (s.kind != kind) continue;
      const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
      const auto stress = mpm::read_columns<6>(*s.next, s.columns->stress);
      for (std::size_t p = 0; p < s.set->size(); ++p)
        act(s, p, m[p] * s.stays[p], pressure_of(stress, p));
    }
  };
  for_particles([&](const SolidSet<D>&, std::size_t, double m, double p) {
    most_mass = std::max(most_mass, m);
    most_pressure = std::max(most_pressure, std::fabs(p));
  });
  Reduction all;
  const auto a = all.add_maximum(most_mass), b = all.add_maximum(most_pressure);
  scope.ranks->reduce(all);
  most_mass = all.maximum(a);
  most_pressure = all.maximum(b);
  CellSums<D> sums;
  sums.begin(frame_.box, 2);
  sums.reach(frame_.box);
  for_particles([&](const SolidSet<D>& s, std::size_t p, double m, double pressure_of_p) {
    const double share = m / most_mass / most_parts<D>;
    for_each_part<D>(frame_, corner_columns<D>(frame_, *s.columns, *s.next), *s.next, p,
                     [&](std::size_t cell) {
                       sums.lane(0)[cell] += to_sum(share);
                       sums.lane(1)[cell] += to_sum(share * (pressure_of_p / most_pressure));
                     });
  });
  sums.sum_over_ranks(*scope.ranks);
  sums.values(0, mass);
  sums.values(1, pressure);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    pressure[i] = mass[i] > 0 ? pressure[i] / mass[i] * most_pressure + reference_pressure_ : 0.0;
    mass[i] *= most_mass * (most_parts<D> / (1 << D)) / frame_.cell_volume;
  }
}

// Particles lose their shares.
template <int D>
std::vector<typename LevelCoupling<D>::Given> LevelCoupling<D>::take_from_particles(
    const models::SolidBurn& burn, const std::vector<Column>& shares) {
  const mpm::MaterialConstants& constants =
      solids_->scene().materials[static_cast<std::size_t>(burn.solid)].constants;
  const double c_s = constants.specific_heat, Q = heat_of_reaction(burn);
  std::vector<Given> given;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    SolidSet<D>& s = sets_[n];
    if (s.kind != burn.solid) continue;
    const auto next = [&](int c) { return s.next->column(static_cast<std::size_t>(c)); };
    const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
    const double* T = next(s.columns->temperature);
    double *W = next(s.columns->energy), *volume = next(s.columns->volume);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      double f = std::min(shares[n][p], 1.0);
      if (!(f > least_share) || !(s.stays[p] > 0)) continue;
      if (s.filled[p] * (1 - f) < least_filled) f = 1;
      const double rest = f < 1 ? 1 - f : 0.0;
      Given g{n, p, m[p] * s.stays[p] - m[p] * (s.stays[p] * rest), 0, 0, {}};
      g.energy = W[p] * f / g.mass + c_s * T[p] + Q;
      for (int d = 0; d < 3; ++d) {
        g.velocity[d] = next(s.columns->velocity + d)[p];
        g.kinetic += 0.5 * g.velocity[d] * g.velocity[d];
      }
      burned_.add(burn.solid, solids_->material_count() + burn.product, g.mass, Q * g.mass,
                  (c_s * T[p] + Q) * g.mass + constants.reference_pressure * (volume[p] * f));
      s.stays[p] *= rest;
      s.filled[p] *= rest;
      W[p] *= rest;
      volume[p] *= rest;
      given.push_back(g);
    }
  }
  return given;
}

// The largest number of parts of the giving particles in a cell: sums need room for no more.
template <int D>
double LevelCoupling<D>::most_parts_given(const StageScope& scope,
                                          const std::vector<Given>& given) const {
  CellSums<D> parts;
  parts.begin(frame_.box, 1);
  parts.reach(frame_.box);
  for (const Given& g : given) {
    const SolidSet<D>& s = sets_[g.set];
    for_each_part<D>(frame_, corner_columns<D>(frame_, *s.columns, *s.next), *s.next, g.particle,
                     [&](std::size_t i) { ++parts.lane(0)[i]; });
  }
  parts.sum_over_ranks(*scope.ranks);
  return static_cast<double>(*std::max_element(parts.lane(0), parts.lane(0) + frame_.box.cells()));
}

// Cells get what particles have given: each cell of a particle as many parts as lie in it, by
// `in_cells` where that is not empty. False: no rank has anything.
template <int D>
bool LevelCoupling<D>::give_to_cells(const StageScope& scope, int product,
                                     const std::vector<Given>& given, const Column& in_cells) {
  constexpr int mass = 0, energy = 1, kinetic = 2, momentum = 3;
  const int components = static_cast<int>(amounts_.momentum.size());
  double most_mass = 1e-300, most_energy = 1e-300, most_kinetic = 1e-300, most_speed = 1e-300;
  for (const Given& g : given) {
    most_mass = std::max(most_mass, g.mass);
    most_energy = std::max(most_energy, std::fabs(g.energy));
    most_kinetic = std::max(most_kinetic, g.kinetic);
    for (int d = 0; d < 3; ++d) most_speed = std::max(most_speed, std::fabs(g.velocity[d]));
  }
  Reduction all;
  const std::array<Reduction::Maximum, 4> maxima{
      all.add_maximum(most_mass), all.add_maximum(most_energy), all.add_maximum(most_kinetic),
      all.add_maximum(most_speed)};
  const auto any = all.add_any(!given.empty());
  scope.ranks->reduce(all);
  if (!all.any(any)) return false;
  most_mass = all.maximum(maxima[0]);
  most_energy = all.maximum(maxima[1]);
  most_kinetic = all.maximum(maxima[2]);
  most_speed = all.maximum(maxima[3]);
  const double room = most_parts_given(scope, given);
  CellSums<D> sums;
  sums.begin(frame_.box, momentum + components);
  sums.reach(frame_.box);
  const auto weight = [&](std::size_t i) { return in_cells.empty() ? 1.0 : in_cells[i]; };
  for (const Given& g : given) {
    const SolidSet<D>& s = sets_[g.set];
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    double whole = 0;  // of the weights of its parts
    for_each_part<D>(frame_, x, *s.next, g.particle, [&](std::size_t i) { whole += weight(i); });
    for_each_part<D>(frame_, x, *s.next, g.particle, [&](std::size_t i) {
      const double share = g.mass / most_mass / room * (weight(i) / whole);
      sums.lane(mass)[i] += to_sum(share);
      sums.lane(energy)[i] += to_sum(share * (g.energy / most_energy));
      sums.lane(kinetic)[i] += to_sum(share * (g.kinetic / most_kinetic));
      for (int k = 0; k < components; ++k) {
        const int d = fluid_->options().direction[static_cast<std::size_t>(k)];
        sums.lane(momentum + k)[i] += to_sum(share * (g.velocity[d] / most_speed));
      }
    });
  }
  sums.sum_over_ranks(*scope.ranks);
  const double to_density = most_mass * room / frame_.cell_volume;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (sums.lane(mass)[i] == 0) return;
    const auto value = [&](int lane) { return from_sum(sums.lane(lane)[i]) * to_density; };
    std::array<double, 3> P{};
    for (int k = 0; k < components; ++k)
      P[static_cast<std::size_t>(k)] = value(momentum + k) * most_speed;
    add_product(i, product, value(mass), value(energy) * most_energy, value(kinetic) * most_kinetic,
                P);
  });
  return true;
}

template <int D>
void LevelCoupling<D>::add_product(std::size_t i, int product, double mass, double energy,
                                   double kinetic, const std::array<double, 3>& momentum) {
  const auto m = static_cast<std::size_t>(product);
  amounts_.mass[m][i] += mass;
  products_[m][i] += mass;
  amounts_.energy[m][i] += energy;
  amounts_.kinetic[i] += kinetic;
  for (std::size_t k = 0; k < amounts_.momentum.size(); ++k) amounts_.momentum[k][i] += momentum[k];
  amounts_.touched[i] = 1;
}

// Whose neighbours have vanished has more outer faces.
template <int D>
void LevelCoupling<D>::expose_neighbours(const StageScope& scope) {
  VanishedFaces<D> gone;
  for (const SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p)
      if (s.stays[p] == 0) gone.add(s.kind, x, p);
  }
  gone.tell_all(*scope.ranks);
  vanished_ = !gone.empty();
  if (!vanished_) return;
  for (SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p)
      if (s.stays[p] > 0) s.outer[p] |= gone.faces_of(s.kind, x, p);
  }
}

// What is left becomes the particles' own when the step is accepted.
template <int D>
void LevelCoupling<D>::note_burned(const StageScope& scope) {
  scope.journal->at_acceptance([this] {
    for (SolidSet<D>& s : sets_) {
      if (s.part < 0) continue;
      ParticleSet& set = *s.present;
      const auto column = [&](int c) { return set.column(static_cast<std::size_t>(c)); };
      double *mass = column(s.columns->mass), *volume_0 = column(s.columns->volume_0),
             *filled = column(s.part), *outer = column(s.columns->outer);
      for (std::size_t p = 0; p < s.stays.size(); ++p) {
        mass[p] *= s.stays[p];
        volume_0[p] *= s.stays[p];
        filled[p] = s.filled[p];
        outer[p] = s.outer[p];
      }
    }
  });
}

template <int D>
void LevelCoupling<D>::begin_burning() {
  burned_.begin(solids_->material_count() + fluid_->material_count());
  products_.assign(amounts_.mass.size(), Column(frame_.box.cells(), 0.0));
  for (SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    s.stays.assign(s.set->size(), 1.0);
    const double* bits = s.set->column(static_cast<std::size_t>(s.columns->outer));
    s.outer.resize(s.set->size());
    for (std::size_t p = 0; p < s.outer.size(); ++p)
      s.outer[p] = static_cast<std::uint8_t>(bits[p]);
  }
}

template <int D>
bool LevelCoupling<D>::burn_by(const StageScope& scope, const models::SolidBurn& burn) {
  Column in_cells;
  if (!burns_surfaces(burn)) burn_cells(scope, burn, in_cells);
  const int kept = scope.levels.front()->state().find(ice::labels().burning_in_step, burn.solid);
  burning_.begin(frame_.box, kept < 0 ? 0 : 1);
  std::vector<Column> shares(sets_.size());
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const SolidSet<D>& s = sets_[n];
    if (s.kind != burn.solid) continue;
    shares[n].assign(s.set->size(), 0.0);
    if (in_cells.empty()) {
      burn_surfaces(burn, s, scope.step.dt, shares[n]);
      continue;
    }
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.set->size(); ++p)
      for_each_part<D>(frame_, x, *s.next, p,
                       [&](std::size_t i) { shares[n][p] += in_cells[i] / (1 << D); });
  }
  if (kept >= 0) store_burning(scope, kept);
  return give_to_cells(scope, burn.product, take_from_particles(burn, shares), in_cells);
}

template <int D>
Verdict LevelCoupling<D>::burn(const StageScope& scope) {
  vanished_ = false;
  if (burns_.empty()) return Verdict::good;
  begin_burning();
  bool any = false;
  for (const models::SolidBurn& law : burns_) any |= burn_by(scope, law);
  if (!any) return Verdict::good;
  burned_.add_to(*scope.ranks, *scope.sums,
                 static_cast<std::size_t>(solids_->reduction_sums() + fluid_->reduction_sums()));
  expose_neighbours(scope);
  note_burned(scope);
  return open_burned_volume(scope);
}

// theta and a once more, with what is left of the particles. The products fill what opens.
template <int D>
Verdict LevelCoupling<D>::open_burned_volume(const StageScope& scope) {
  find_all_faces(scope, true);
  add_geometry(scope, When::end, fields_.theta_next, fields_.covered_next);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    const double volume = 1 - fields_.theta_next[i], opened = volume - amounts_.volume[i];
    if (opened == 0) return;
    amounts_.volume[i] = volume;
    amounts_.touched[i] = 1;
    double all = 0;
    for (const Column& mass : products_) all += mass[i];
    if (amounts_.mass.size() == 1) {
      amounts_.filled[0][i] = volume;
    } else if (all > 0) {
      for (std::size_t m = 0; m < products_.size(); ++m)
        amounts_.filled[m][i] += opened * (products_[m][i] / all);
    }
  });
  return share_small_cells(scope);
}

// Once particles are taken over: those that are burned go.
template <int D>
Verdict LevelCoupling<D>::remove_burned(const StageScope& scope) {
  if (!vanished_) return Verdict::good;
  scope.journal->at_acceptance([this, cloud = scope.particles] {
    for (int k = 0; k < solids_->material_count(); ++k) {
      const mpm::Carried& carried = solids_->carried()[static_cast<std::size_t>(k)];
      const mpm::Columns& c = carried.columns;
      if (carried.filled < 0) continue;
      ParticleStore& store = cloud->store(k);
      for (int l = 0; l < store.level_count(); ++l)
        for (int b = 0; b < store.box_count(l); ++b) {
          const ParticleSet& set = store.set(l, b);
          const double* mass = set.column(static_cast<std::size_t>(c.mass));
          std::vector<std::uint32_t> kept;
          for (std::size_t p = 0; p < set.size(); ++p)
            if (mass[p] > 0) kept.push_back(static_cast<std::uint32_t>(p));
          if (kept.size() < set.size()) cloud->keep_only(k, l, b, kept);
        }
    }
    step_->relocate(*cloud);
  });
  return Verdict::good;
}

template Verdict LevelCoupling<1>::burn(const StageScope&);
template Verdict LevelCoupling<2>::burn(const StageScope&);
template Verdict LevelCoupling<3>::burn(const StageScope&);
template Verdict LevelCoupling<1>::remove_burned(const StageScope&);
template Verdict LevelCoupling<2>::remove_burned(const StageScope&);
template Verdict LevelCoupling<3>::remove_burned(const StageScope&);

}  // namespace sluice::mpmice

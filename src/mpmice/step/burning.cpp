// Solids that become fluid: mass, momentum, energy and volume of particles, given to cells.
//
// A particle keeps its corners and the kernel over them; what of its volume is left, `filled`,
// falls with its mass, and surfaces count by it (geometry/outer_faces.hpp). So stress and J stay as
// they are, the body stays closed, no fragment can turn inside out, and a burned particle leaves
// nothing. With f the share of the mass m that burns:
//
//   m, V, V_0, W: (1 - f) of them;  fluid: + f m, f m v, heat f (W + m c_s T + m Q), f m v^2/2
//
// in the cells of the particle, where its volume opens (burn_products.cpp).
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "ice/fluid/labels.hpp"
#include "mpmice/burn/vanished_faces.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

constexpr double least_filled = 1e-3;  // of a particle: the rest burns with it
constexpr double least_share = 1e-9;   // of its mass that burns in a step

}  // namespace

// Of what burns everywhere: the share that burns in each cell.
template <int D>
void LevelCoupling<D>::burn_cells(const StageScope& scope, const models::SolidBurn& burn,
                                  const models::CellLaw& law, Column& shares) {
  shares.assign(frame_.cells.size(), 0.0);
  const double t = scope.step.time, dt = scope.step.dt;
  if (!law.depends_on_state()) {
    std::fill(shares.begin(), shares.end(), law.share({}, t, dt));
    return;
  }
  Column reactant, pressure;
  mean_in_cells(scope, burn.solid, reactant, pressure);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (!(reactant[i] > 0) || amounts_.near[i] == 0) return;
    const double theta = fields_.theta_next[i], V = wet(i) ? amounts_.volume[i] : 0.0;
    const double p = (V * fields_.pressure[i] + theta * pressure[i]) / (V + theta);
    const double product = amounts_.mass[static_cast<std::size_t>(burn.product)][i];
    shares[i] = law.share({p, theta, reactant[i], product}, t, dt);
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
  sums.begin(frame_.cells, 2);
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
    int solid, int product, double Q, const std::vector<Column>& shares) {
  const mpm::MaterialConstants& constants =
      solids_->scene().materials[static_cast<std::size_t>(solid)].constants;
  const double c_s = constants.specific_heat;
  std::vector<Given> given;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    SolidSet<D>& s = sets_[n];
    if (s.kind != solid) continue;
    const mpm::Columns& c = *s.columns;
    const auto next = [&](int of) { return s.next->column(static_cast<std::size_t>(of)); };
    const double* m = s.set->column(static_cast<std::size_t>(c.mass));
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
      // Of its heat, that of lost energy is among the energies of solids already.
      const double lost_heat = c.lost_heat >= 0 ? next(c.lost_heat)[p] * f : 0;
      burned_.add(
          solid, solids_->material_count() + product, g.mass, Q * g.mass,
          (c_s * T[p] + Q) * g.mass - lost_heat + constants.reference_pressure * (volume[p] * f));
      for (const int column : c.of_losses())
        if (column >= 0) next(column)[p] *= rest;
      s.stays[p] *= rest;
      s.filled[p] *= rest;
      W[p] *= rest;
      volume[p] *= rest;
      given.push_back(g);
    }
  }
  return given;
}

// Whose neighbours have vanished has more outer faces, and goes on where they have ended.
template <int D>
void LevelCoupling<D>::expose_neighbours(const StageScope& scope) {
  VanishedFaces<D> gone(periods());
  for (const SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p)
      if (s.stays[p] == 0)
        gone.add(s.kind, x, p, s.surface.empty() ? models::SurfaceHistory{} : s.surface[p]);
  }
  vanished_ = on_any(scope, !gone.empty());
  if (!vanished_) return;
  gone.tell_neighbours(sharers_.get());
  for (SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p) {
      if (!(s.stays[p] > 0)) continue;
      const auto exposed = gone.exposed(s.kind, x, p);
      s.outer[p] |= exposed.faces;
      if (!s.surface.empty() && !s.surface[p].lit()) s.surface[p] = exposed.surface;
    }
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
      for (std::size_t p = 0; p < s.surface.size(); ++p) {
        column(s.surface_column)[p] = s.surface[p].temperature;
        column(s.surface_column + 1)[p] = s.surface[p].gradient;
      }
    }
  });
}

template <int D>
void LevelCoupling<D>::begin_burning() {
  const int materials = solids_->material_count() + fluid_->material_count();
  burned_.begin(materials);
  next_switch_ = 0;
  products_.assign(amounts_.mass.size(), Column(frame_.cells.size(), 0.0));
  for (SolidSet<D>& s : sets_) {
    if (s.part < 0) continue;
    s.stays.assign(s.set->size(), 1.0);
    const double* bits = s.set->column(static_cast<std::size_t>(s.columns->outer));
    s.outer.resize(s.set->size());
    for (std::size_t p = 0; p < s.outer.size(); ++p)
      s.outer[p] = static_cast<std::uint8_t>(bits[p]);
    read_surfaces(s);
    read_flames(s);
  }
}

template <int D>
void LevelCoupling<D>::burn_particles(const models::SolidBurn& burn, const Column& in_cells,
                                      std::vector<Column>& shares) const {
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const SolidSet<D>& s = sets_[n];
    if (s.kind != burn.solid) continue;
    shares[n].assign(s.set->size(), 0.0);
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.set->size(); ++p)
      for_each_part<D>(frame_, x, *s.next, p,
                       [&](std::size_t i) { shares[n][p] += in_cells[i] / (1 << D); });
  }
}

// What a law asks of the step, by its form.
template <int D>
class LevelCoupling<D>::Forms final : public models::BurningForms {
 public:
  Forms(LevelCoupling& coupling, const StageScope& scope, const models::SolidBurn& burn)
      : coupling_(coupling), scope_(scope), burn_(burn), shares_(coupling.sets_.size()) {}

  bool burn_surfaces(const models::SurfaceLaw& law) override {
    coupling_.burn_surfaces(scope_, burn_, law, shares_);
    return give({});
  }
  bool burn_cells(const models::CellLaw& law) override {
    Column in_cells;
    coupling_.burn_cells(scope_, burn_, law, in_cells);
    coupling_.burn_particles(burn_, in_cells, shares_);
    return give(in_cells);
  }
  bool burn_explosive(const models::Ddt1& law) override {
    return coupling_.burn_ddt(scope_, burn_, law);
  }

 private:
  bool give(const Column& in_cells) {
    return coupling_.give_to_cells(
        scope_, burn_.product,
        coupling_.take_from_particles(burn_.solid, burn_.product, burn_.law->heat_of_reaction(),
                                      shares_),
        in_cells);
  }

  LevelCoupling& coupling_;
  const StageScope& scope_;
  const models::SolidBurn& burn_;
  std::vector<Column> shares_;  // of the particles' masses that burn, by set of particles
};

template <int D>
bool LevelCoupling<D>::burn_by(const StageScope& scope, const models::SolidBurn& burn) {
  Forms forms(*this, scope, burn);
  return burn.law->burn(forms);
}

// Mass per cell volume that burning has made, of all products.
template <int D>
Column LevelCoupling<D>::all_products() const {
  Column all(frame_.cells.size(), 0.0);
  for (const Column& of_one : products_)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += of_one[i];
  return all;
}

// modelMass_src, where the deck saves it. `given`: by solid, mass per cell volume.
template <int D>
void LevelCoupling<D>::keep_given_mass(const StageScope& scope,
                                       const std::vector<Column>& given) const {
  const Label kept = ice::labels().kept_model_mass;
  const auto keep = [&](int material, const Column& mass, double sign) {
    if (mass.empty() || scope.levels.front()->state().find(kept, material) < 0) return;
    Column of_cells = mass;
    for (double& m : of_cells) m *= sign * frame_.cell_volume;
    keep_in_cells(scope, kept, material, of_cells);
  };
  for (std::size_t k = 0; k < given.size(); ++k) keep(static_cast<int>(k), given[k], -1);
  for (std::size_t m = 0; m < products_.size(); ++m)
    keep(solids_->material_count() + static_cast<int>(m), products_[m], 1);
}

template <int D>
void LevelCoupling<D>::burn(const StageScope& scope) {
  vanished_ = false;
  if (burns_.empty()) return;
  begin_burning();
  bool any = false;
  std::vector<Column> given(static_cast<std::size_t>(solids_->material_count()));
  for (const models::SolidBurn& law : burns_) {
    const Column before = all_products();
    any |= burn_by(scope, law);
    const Column now = all_products();
    Column& of_solid = given[static_cast<std::size_t>(law.solid)];
    of_solid.resize(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) of_solid[i] += now[i] - before[i];
  }
  keep_given_mass(scope, given);
  if (!any) return;
  burned_.add_to(*scope.ranks, places_.burned.of(*scope.sums));
  expose_neighbours(scope);
  note_burned(scope);
  open_burned_volume(scope);
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

template void LevelCoupling<1>::mean_in_cells(const StageScope&, int, Column&, Column&);
template void LevelCoupling<1>::burn_particles(const models::SolidBurn&, const Column&,
                                               std::vector<Column>&) const;
template std::vector<LevelCoupling<1>::Given> LevelCoupling<1>::take_from_particles(
    int, int, double, const std::vector<Column>&);
template void LevelCoupling<2>::mean_in_cells(const StageScope&, int, Column&, Column&);
template void LevelCoupling<2>::burn_particles(const models::SolidBurn&, const Column&,
                                               std::vector<Column>&) const;
template std::vector<LevelCoupling<2>::Given> LevelCoupling<2>::take_from_particles(
    int, int, double, const std::vector<Column>&);
template void LevelCoupling<3>::mean_in_cells(const StageScope&, int, Column&, Column&);
template void LevelCoupling<3>::burn_particles(const models::SolidBurn&, const Column&,
                                               std::vector<Column>&) const;
template std::vector<LevelCoupling<3>::Given> LevelCoupling<3>::take_from_particles(
    int, int, double, const std::vector<Column>&);
template void LevelCoupling<1>::burn(const StageScope&);
template void LevelCoupling<2>::burn(const StageScope&);
template void LevelCoupling<3>::burn(const StageScope&);
template Verdict LevelCoupling<1>::remove_burned(const StageScope&);
template Verdict LevelCoupling<2>::remove_burned(const StageScope&);
template Verdict LevelCoupling<3>::remove_burned(const StageScope&);

}  // namespace sluice::mpmice

#include "mpmice/burn/burned_particles.hpp"

#include <algorithm>

#include "mpmice/fields/agreement.hpp"
#include "mpmice/surfaces/separation.hpp"
#include "mpmice/surfaces/vanished_faces.hpp"

namespace sluice::mpmice {
namespace {

constexpr double least_filled = 1e-3;  // of a particle: the rest burns with it
constexpr double least_share = 1e-9;   // of its mass that burns in a step

// Of one box: the particles that have mass.
std::vector<std::uint32_t> with_mass(const ParticleSet& set, int mass_column) {
  const double* mass = set.column(static_cast<std::size_t>(mass_column));
  std::vector<std::uint32_t> kept;
  for (std::size_t p = 0; p < set.size(); ++p)
    if (mass[p] > 0) kept.push_back(static_cast<std::uint32_t>(p));
  return kept;
}

}  // namespace

template <int D>
void BurnedParticles<D>::begin(SolidSets<D>& sets) {
  burned_.begin(materials_);
  vanished_ = false;
  for (SolidSet<D>& s : sets.all()) {
    if (!s.burns()) continue;
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
std::vector<GivenByParticle> BurnedParticles<D>::take(SolidSets<D>& sets, int solid, int product,
                                                      double Q, const std::vector<Column>& shares) {
  const int first_fluid = static_cast<int>(sets.kinds().size());
  std::vector<GivenByParticle> given;
  for (std::size_t n = 0; n < sets.all().size(); ++n) {
    SolidSet<D>& s = sets.all()[n];
    if (s.kind != solid) continue;
    const solids::SolidKind& kind = sets.kind_of(s);
    const solids::ParticleColumns& c = *s.columns;
    const double c_s = kind.specific_heat;
    const auto next = [&](int of) { return s.next->column(static_cast<std::size_t>(of)); };
    const double* m = s.set->column(static_cast<std::size_t>(c.mass));
    const double* T = next(c.temperature);
    double *W = next(c.energy), *volume = next(c.volume);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      double f = std::min(shares[n][p], 1.0);
      if (!(f > least_share) || !(s.stays[p] > 0)) continue;
      if (s.filled[p] * (1 - f) < least_filled) f = 1;
      const double rest = f < 1 ? 1 - f : 0.0;
      GivenByParticle g{n, p, m[p] * s.stays[p] - m[p] * (s.stays[p] * rest), 0, 0, {}};
      const double open = c.open_energy >= 0 ? next(c.open_energy)[p] : 0;
      g.energy = (W[p] + open) * f / g.mass + c_s * T[p] + Q;
      for (int d = 0; d < 3; ++d) {
        g.velocity[d] = next(c.velocity + d)[p];
        g.kinetic += 0.5 * g.velocity[d] * g.velocity[d];
      }
      // Of its heat, that of lost energy is among the energies of solids already.
      const double lost_heat = c.lost_heat >= 0 ? next(c.lost_heat)[p] * f : 0;
      burned_.add(
          solid, first_fluid + product, g.mass, Q * g.mass,
          (c_s * T[p] + Q) * g.mass - lost_heat + kind.reference_pressure * (volume[p] * f));
      for (const int column : c.with_mass)
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

template <int D>
void BurnedParticles<D>::expose_neighbours(const NearCells<D>& near, SolidSets<D>& sets,
                                           Communicator& ranks) {
  const Frame<D>& frame = near.frame();
  VanishedFaces<D> gone(periods_of(frame, *solids_));
  for (const SolidSet<D>& s : sets.all()) {
    if (!s.burns()) continue;
    const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p)
      if (s.stays[p] == 0)
        gone.add(s.kind, x, p, s.surface.empty() ? models::SurfaceHistory{} : s.surface[p]);
  }
  vanished_ = on_any(ranks, !gone.empty());
  if (!vanished_) return;
  gone.tell_neighbours(near.sharers());
  for (SolidSet<D>& s : sets.all()) {
    if (!s.burns()) continue;
    const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.stays.size(); ++p) {
      if (!(s.stays[p] > 0)) continue;
      const auto exposed = gone.exposed(s.kind, x, p);
      s.outer[p] |= exposed.faces;
      if (!s.surface.empty() && !s.surface[p].lit()) s.surface[p] = exposed.surface;
    }
  }
}

template <int D>
void BurnedParticles<D>::note(StepJournal& journal, SolidSets<D>& sets) const {
  journal.at_acceptance([&sets] {
    for (SolidSet<D>& s : sets.all()) {
      if (!s.burns()) continue;
      ParticleSet& set = *s.present;
      const auto column = [&](int c) { return set.column(static_cast<std::size_t>(c)); };
      double *mass = column(s.columns->mass), *volume_0 = column(s.columns->volume_0),
             *filled = column(s.columns->filled), *outer = column(s.columns->outer);
      for (std::size_t p = 0; p < s.stays.size(); ++p) {
        mass[p] *= s.stays[p];
        volume_0[p] *= s.stays[p];
        filled[p] = s.filled[p];
        outer[p] = s.outer[p];
      }
      for (std::size_t p = 0; p < s.surface.size(); ++p) {
        column(s.columns->surface)[p] = s.surface[p].temperature;
        column(s.columns->surface + 1)[p] = s.surface[p].gradient;
      }
    }
  });
}

template <int D>
void BurnedParticles<D>::remove(const StageScope& scope) const {
  if (!vanished_) return;
  scope.journal->at_acceptance([solids = solids_, cloud = scope.particles] {
    for (int k = 0; k < static_cast<int>(solids->kinds().size()); ++k) {
      const solids::ParticleColumns& c = solids->kinds()[static_cast<std::size_t>(k)].columns;
      if (c.filled < 0) continue;
      ParticleStore& store = cloud->store(k);
      for (int l = 0; l < store.level_count(); ++l)
        for (int b = 0; b < store.box_count(l); ++b) {
          const ParticleSet& set = store.set(l, b);
          const std::vector<std::uint32_t> kept = with_mass(set, c.mass);
          if (kept.size() < set.size()) cloud->keep_only(k, l, b, kept);
        }
    }
    solids->relocate(*cloud);
  });
}

template class BurnedParticles<1>;
template class BurnedParticles<2>;
template class BurnedParticles<3>;

}  // namespace sluice::mpmice

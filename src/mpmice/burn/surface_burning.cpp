#include "mpmice/burn/surface_burning.hpp"

#include <algorithm>
#include <cmath>

#include "mpmice/burn/burning_outputs.hpp"
#include "mpmice/burn/exposed_area.hpp"
#include "mpmice/surfaces/surface_pieces.hpp"

namespace sluice::mpmice {
namespace {

// What of the particles' surfaces burns; `pieces`: which, where somebody asks.
template <int D>
std::vector<ExposedArea<D>> exposed_areas(const BurningStep<D>& step, const models::SurfaceLaw& law,
                                          std::size_t n, std::vector<BurningPiece>* pieces) {
  const SolidSet<D>& s = step.sets.all()[n];
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_open_piece(step.frame(), step.solid, s,
                      [&](std::size_t p, int face, const std::array<double, D>& area,
                          const Cell<D>& c, std::size_t k) {
                        models::AtSurface at;
                        at.pressure = step.pressure[k];
                        at.solid_temperature = T[p];
                        at.hottest = std::max(T[p], hottest_fluid<D>(step, c, law.looks_around()));
                        at.density = mass[p] / volume[p];
                        const models::BurningSurface surface = law.steady_surface(at);
                        if (surface.flux > 0 && pieces != nullptr) pieces->push_back({n, p, k});
                        exposed[p].add(face, area, surface);
                      });
  return exposed;
}

// Surfaces that remember burn at rates of their own.
template <int D>
void delay_burning(const models::SurfaceDelay& law, SolidSet<D>& s,
                   const std::vector<ExposedArea<D>>& exposed, double dt, Column& shares) {
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < shares.size(); ++p) {
    const models::BurningSurface steady = exposed[p].burning();
    if (!(steady.flux > 0) || !(s.stays[p] > 0)) continue;
    const double density = mass[p] / volume[p];
    s.surface[p] = law.after(dt, s.surface[p], steady, T[p], density);
    shares[p] *= law.flux(s.surface[p], steady.flux, density) / steady.flux;
  }
}

}  // namespace

template <int D>
void burn_surfaces(const BurningStep<D>& step, const models::SolidBurn& burn,
                   const models::SurfaceLaw& law, std::vector<Column>& shares) {
  const double dt = step.scope.step.dt;
  const std::vector<BurningField> fields = saved_fields(step, burn);
  std::vector<BurningPiece> pieces;
  for (std::size_t n = 0; n < step.sets.all().size(); ++n) {
    SolidSet<D>& s = step.sets.all()[n];
    if (s.kind != burn.solid) continue;
    const std::vector<ExposedArea<D>> exposed =
        exposed_areas(step, law, n, fields.empty() ? nullptr : &pieces);
    const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
    shares[n].assign(s.set->size(), 0.0);
    for (std::size_t p = 0; p < shares[n].size(); ++p)
      if (s.stays[p] > 0) shares[n][p] = dt * exposed[p].flow() / (mass[p] * s.stays[p]);
    if (const models::SurfaceDelay* delay = law.delay())
      delay_burning(*delay, s, exposed, dt, shares[n]);
  }
  if (!fields.empty()) store_burning_surfaces(step, burn, fields, pieces);
}

template <int D>
void burn_cells(const BurningStep<D>& step, const models::SolidBurn& burn,
                const models::CellLaw& law, Column& shares) {
  shares.assign(step.near.size(), 0.0);
  const double t = step.scope.step.time, dt = step.scope.step.dt;
  if (!law.depends_on_state()) {
    std::fill(shares.begin(), shares.end(), law.share({}, t, dt));
    return;
  }
  const CellAmounts<D>& amounts = step.amounts;
  Column reactant, pressure;
  mean_in_cells(step, burn.solid, reactant, pressure);
  step.near.for_each([&](const Cell<D>&, std::size_t i) {
    if (!(reactant[i] > 0) || amounts.near[i] == 0) return;
    const double theta = step.solid.theta_next[i], V = step.wet(i) ? amounts.volume[i] : 0.0;
    const double p = (V * step.pressure[i] + theta * pressure[i]) / (V + theta);
    const double product = amounts.mass[static_cast<std::size_t>(burn.product)][i];
    shares[i] = law.share({p, theta, reactant[i], product}, t, dt);
  });
}

template <int D>
void share_by_cells(const BurningStep<D>& step, const models::SolidBurn& burn,
                    const Column& in_cells, std::vector<Column>& shares) {
  for (std::size_t n = 0; n < step.sets.all().size(); ++n) {
    const SolidSet<D>& s = step.sets.all()[n];
    if (s.kind != burn.solid) continue;
    shares[n].assign(s.set->size(), 0.0);
    const CornerColumns<D> x = corner_columns<D>(step.frame(), *s.columns, *s.next);
    for (std::size_t p = 0; p < s.set->size(); ++p)
      for_each_part<D>(step.frame(), x, *s.next, p,
                       [&](std::size_t i) { shares[n][p] += in_cells[i] / (1 << D); });
  }
}

#define SLUICE_IN_DIRECTIONS(D)                                                                \
  template void burn_surfaces(const BurningStep<D>&, const models::SolidBurn&,                 \
                              const models::SurfaceLaw&, std::vector<Column>&);                \
  template void burn_cells(const BurningStep<D>&, const models::SolidBurn&,                    \
                           const models::CellLaw&, Column&);                                   \
  template void share_by_cells(const BurningStep<D>&, const models::SolidBurn&, const Column&, \
                               std::vector<Column>&);
SLUICE_IN_DIRECTIONS(1)
SLUICE_IN_DIRECTIONS(2)
SLUICE_IN_DIRECTIONS(3)
#undef SLUICE_IN_DIRECTIONS

}  // namespace sluice::mpmice

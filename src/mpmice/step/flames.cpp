// Flames that need time to come to explosive (FlameSpread in models/burn/ddt1.hpp).
//
// A flame sets out to a particle at the surface from hot fluid beside it, to one that is cracked
// from what burns beside it; in a cell that burns it is there at once. Its way is that of the
// nearest so far, from middle to middle of cells.
#include <algorithm>
#include <cmath>

#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// The shortest way into cell c, to a particle whose surface has this normal (none: 0).
template <int D>
typename LevelCoupling<D>::FlameWay LevelCoupling<D>::way_to(
    const models::Ddt1& law, const ExplosiveCells& cells, const Cell<D>& c,
    const std::array<double, D>& normal, bool open, bool hot, bool cracked) const {
  using models::Ignition;
  const auto spacing = [&](std::size_t a) { return frame_.spacing[frame_.direction[a]]; };
  double size = 0;
  for (const double n : normal) size += n * n;
  size = std::sqrt(size);
  double across = spacing(0);  // the cell, along the normal
  if (size > 0) {
    across = 0;
    for (std::size_t a = 0; a < D; ++a) across += std::fabs(normal[a]) / size * spacing(a);
  }
  FlameWay best;
  const auto take = [&](double length, Ignition::Kind kind) {
    if (length < best.length) best = {length, kind};
  };
  if (hot) take(law.spread->head_on * across, Ignition::surface);
  for_each_offset(c, 1, [&](std::size_t j, const std::array<int, D>& offset) {
    const bool heats = open && cells.hot_fluid[j] != 0;
    const unsigned burns = cells.burning[j];
    if (!heats && burns == 0) return;
    double distance = 0, along = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double x = offset[a] * spacing(a);
      distance += x * x;
      along += x * normal[a];
    }
    distance = std::sqrt(distance);
    const bool surface = (burns >> Ignition::surface & 1u) != 0,
               in_cracks = (burns >> Ignition::cracks & 1u) != 0;
    // At a surface flames of surfaces come first, behind it those of cracks.
    const Ignition::Kind kind =
        (open ? surface : !in_cracks) ? Ignition::surface : Ignition::cracks;
    if (distance == 0) {
      if (burns != 0) take(0, kind);
      if (heats) take(law.spread->head_on * across, Ignition::surface);
      return;
    }
    const double cosine = size > 0 ? along / (distance * size) : 0.0;
    const double share = open ? law.spread->share(cosine) : law.spread->head_on;
    if (heats) take(distance * share, Ignition::surface);
    if (burns != 0 && cracked) take(distance * share, open ? kind : Ignition::cracks);
  });
  return best;
}

template <int D>
void LevelCoupling<D>::spread_flames(const models::Ddt1& law, const ExplosiveCells& cells,
                                     std::size_t n, double dt) {
  SolidSet<D>& s = sets_[n];
  std::vector<std::array<double, D>> normals(s.set->size());
  KeptArray<std::uint8_t> open(s.set->size());
  for_each_open_piece(
      s, [&](std::size_t p, int, const std::array<double, D>& area, const Cell<D>&, std::size_t) {
        open[p] = 1;
        for (std::size_t a = 0; a < D; ++a) normals[p][a] += area[a];
      });
  const double* radius = crack_radii(s);
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < s.flame.size(); ++p) {
    models::Ignition& flame = s.flame[p];
    if (!(s.stays[p] > 0) || flame.burns()) continue;
    const Cell<D> c = middle_of(*s.next, p);
    const std::size_t i = frame_.cells.index(c);
    const double pressure = cells.pressure[i];
    if (!law.deflagrates(pressure) || cells.beside_detonation[i] != 0) continue;
    const bool hot = open[p] != 0 && T[p] > law.flame.ignition_temperature,
               cracked = radius != nullptr && law.cracked(radius[p], pressure);
    const FlameWay way = way_to(law, cells, c, normals[p], open[p] != 0, hot, cracked);
    if (!flame.lit()) {
      if (way.kind == models::Ignition::none) continue;
      flame = {way.kind, 0, 0, way.length};
    }
    flame.way = std::min(flame.way, way.length);
    flame = law.spread->after(dt, flame, pressure);
  }
}

// What particles know of flames becomes their own when the step is accepted.
template <int D>
void LevelCoupling<D>::note_flames(const StageScope& scope) {
  scope.journal->at_acceptance([this] {
    for (SolidSet<D>& s : sets_)
      for (std::size_t p = 0; p < s.flame.size(); ++p) {
        const auto put = [&](int column, double value) {
          s.present->column(static_cast<std::size_t>(s.flame_column + column))[p] = value;
        };
        put(0, s.flame[p].kind);
        put(1, s.flame[p].come);
        put(2, s.flame[p].time);
        put(3, s.flame[p].way);
      }
  });
}

template void LevelCoupling<1>::spread_flames(const models::Ddt1&, const ExplosiveCells&,
                                              std::size_t, double);
template void LevelCoupling<2>::spread_flames(const models::Ddt1&, const ExplosiveCells&,
                                              std::size_t, double);
template void LevelCoupling<3>::spread_flames(const models::Ddt1&, const ExplosiveCells&,
                                              std::size_t, double);
template void LevelCoupling<1>::note_flames(const StageScope&);
template void LevelCoupling<2>::note_flames(const StageScope&);
template void LevelCoupling<3>::note_flames(const StageScope&);

}  // namespace sluice::mpmice

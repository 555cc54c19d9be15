#include "mpmice/burn/flames.hpp"

#include <algorithm>
#include <cmath>

#include "mpmice/surfaces/surface_pieces.hpp"

namespace sluice::mpmice {
namespace {

struct FlameWay {
  double length = 1e300;
  models::Ignition::Kind kind = models::Ignition::none;
};

// The shortest way into cell c, to a particle whose surface has this normal (none: 0).
template <int D>
FlameWay way_to(const NearCells<D>& near, const models::Ddt1& law, const ExplosiveCells& cells,
                const Cell<D>& c, const std::array<double, D>& normal, bool open, bool hot,
                bool cracked) {
  using models::Ignition;
  const auto spacing = [&](std::size_t a) {
    return near.frame().spacing[near.frame().direction[a]];
  };
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
  near.for_each_offset(c, 1, [&](std::size_t j, const std::array<int, D>& offset) {
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

}  // namespace

template <int D>
void spread_flames(const BurningStep<D>& step, const models::Ddt1& law, const ExplosiveCells& cells,
                   std::size_t n) {
  const Frame<D>& frame = step.frame();
  SolidSet<D>& s = step.sets.all()[n];
  std::vector<std::array<double, D>> normals(s.set->size());
  KeptArray<std::uint8_t> open(s.set->size());
  for_each_open_piece(
      frame, step.solid, s,
      [&](std::size_t p, int, const std::array<double, D>& area, const Cell<D>&, std::size_t) {
        open[p] = 1;
        for (std::size_t a = 0; a < D; ++a) normals[p][a] += area[a];
      });
  const double* radius = crack_radii(s);
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < s.flame.size(); ++p) {
    models::Ignition& flame = s.flame[p];
    if (!(s.stays[p] > 0) || flame.burns()) continue;
    const Cell<D> c = cell_of_middle(frame, *s.next, p);
    const std::size_t i = frame.cells.index(c);
    const double pressure = cells.pressure[i];
    if (!law.deflagrates(pressure) || cells.beside_detonation[i] != 0) continue;
    const bool hot = open[p] != 0 && T[p] > law.flame.ignition_temperature,
               cracked = radius != nullptr && law.cracked(radius[p], pressure);
    const FlameWay way =
        way_to<D>(step.near, law, cells, c, normals[p], open[p] != 0, hot, cracked);
    if (!flame.lit()) {
      if (way.kind == models::Ignition::none) continue;
      flame = {way.kind, 0, 0, way.length};
    }
    flame.way = std::min(flame.way, way.length);
    flame = law.spread->after(step.scope.step.dt, flame, pressure);
  }
}

template <int D>
void note_flames(StepJournal& journal, SolidSets<D>& sets) {
  journal.at_acceptance([&sets] {
    for (SolidSet<D>& s : sets.all())
      for (std::size_t p = 0; p < s.flame.size(); ++p) {
        const auto put = [&](int column, double value) {
          s.present->column(static_cast<std::size_t>(s.columns->flame + column))[p] = value;
        };
        put(0, s.flame[p].kind);
        put(1, s.flame[p].come);
        put(2, s.flame[p].time);
        put(3, s.flame[p].way);
      }
  });
}

#define SLUICE_IN_DIRECTIONS(D)                                                                  \
  template void spread_flames(const BurningStep<D>&, const models::Ddt1&, const ExplosiveCells&, \
                              std::size_t);                                                      \
  template void note_flames(StepJournal&, SolidSets<D>&);
SLUICE_IN_DIRECTIONS(1)
SLUICE_IN_DIRECTIONS(2)
SLUICE_IN_DIRECTIONS(3)
#undef SLUICE_IN_DIRECTIONS

}  // namespace sluice::mpmice

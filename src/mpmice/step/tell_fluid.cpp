// What solids do to cells and faces, into the work slots of the sweep: ghost cells too, beyond the
// sides of the domain as in a mirror.
#include "ice/fluid/labels.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// Not 0 for each block with solids or faces that they cover, or beside one that has: a cell beside
// one without fluid is told the pressure on the wall even where bodies that overlap cover nothing
// between them. Elsewhere there is nothing to tell.
template <int D>
KeptArray<std::uint8_t> LevelCoupling<D>::blocks_to_tell() const {
  constexpr std::size_t n = CellBlocks<D>::block_cells;
  std::vector<const Column*> fields{&fields_.theta, &fields_.theta_next};
  for (std::size_t d = 0; d < D; ++d)
    for (const auto* of :
         {&fields_.covered, &fields_.covered_next, &fields_.mean_covered, &fields_.swept})
      fields.push_back(&(*of)[d]);
  KeptArray<std::uint8_t> told(1 + frame_.cells.block_count(), 0);
  for (std::size_t b = told.size(); b-- > 1;) {
    for (const Column* field : fields) {
      bool any = false;
      for (std::size_t i = b * n; i < (b + 1) * n; ++i) any |= (*field)[i] != 0;
      if (any) told[b] = 2;
    }
  }
  for (std::size_t b = 1; b < told.size(); ++b)
    for (int d = 0; d < D; ++d) {
      const std::size_t above = frame_.cells.above(b, d);
      if (above == 0) continue;
      if (told[above] >= 2) told[b] |= 1;
      if (told[b] >= 2) told[above] |= 1;
    }
  return told;
}

// May cells of the domain or beyond its sides see, in a mirror too, one of these blocks.
template <int D>
bool LevelCoupling<D>::sees_any(const CellBox<D>& part, const KeptArray<std::uint8_t>& told) const {
  CellBox<D> seen;
  for (std::size_t a = 0; a < D; ++a) {
    const int low = frame_.domain.lower[a], high = frame_.domain.upper[a];
    const bool beyond = part.lower[a] < low || part.upper[a] > high;
    if (beyond && frame_.periodic[a]) return true;
    seen.lower[a] = std::max(part.lower[a], low);
    seen.upper[a] = std::min(part.upper[a], high);
    if (part.lower[a] < low) {
      seen.lower[a] = low;
      seen.upper[a] = std::max(seen.upper[a], 2 * low - part.lower[a] + 1);
    }
    if (part.upper[a] > high) {
      seen.upper[a] = high + 1;
      seen.lower[a] = std::min(seen.lower[a], 2 * high - part.upper[a]);
    }
  }
  return frame_.cells.any_block(seen, [&](std::size_t b) { return told[b] != 0; });
}

// Of a box with its ghosts, the cells (along < 0) or the low faces along a direction that see what
// the arrays hold, and where it lies there.
template <int D>
SeenPlaces LevelCoupling<D>::places_seen(const IndexBox& box, int along,
                                         const KeptArray<std::uint8_t>& told) const {
  SeenPlaces seen;
  const auto look = [&](const Cell<D>& at) {
    const IntVec3 c = frame_.index(at);
    bool flipped = false;
    const Cell<D> cell = along < 0
                             ? frame_.mirrored(at)
                             : frame_.mirrored_face(at, static_cast<std::size_t>(along), flipped);
    const std::size_t i = frame_.cells.index(cell);
    if (i >= CellBlocks<D>::block_cells) seen.places.push_back({c, i, flipped});
  };
  const CellBox<D> all = frame_.box(box);
  for_each_cell_of<D>(BlockDirectory<D>::blocks_of(all), [&](const Cell<D>& b) {
    const CellBox<D> part = common<D>(BlockDirectory<D>::cells_of(b), all);
    if (!sees_any(part, told)) return;
    seen.parts.push_back(frame_.part_of(box, part));
    for_each_cell_of<D>(part, look);
  });
  return seen;
}

// The velocity of the solid at the low faces of the cells along the n-th direction: the mean of
// both cells by mass. Between cells that keep fluid faces have its velocity.
template <int D>
Column LevelCoupling<D>::velocity_at_faces(std::size_t n) const {
  Column to(frame_.cells.size(), 0.0);
  const Column &mass = fields_.mass, &v = fields_.velocity[n];
  frame_.cells.for_each_cell(frame_.held(), [&](const Cell<D>& face, std::size_t at) {
    Cell<D> below = face;
    --below[n];
    const std::size_t i = frame_.cells.index(frame_.inside(below)),
                      j = frame_.cells.index(frame_.inside(face));
    const auto fluid = [&](std::size_t c) {
      return fields_.theta[c] < 1 && fields_.theta_next[c] < 1;
    };
    if (fluid(i) && fluid(j)) return;
    const double M = mass[i] + mass[j];
    if (M > 0) to[at] = (mass[i] * v[i] + mass[j] * v[j]) / M;
  });
  return to;
}

template <int D>
void LevelCoupling<D>::tell_fluid(const StageScope& scope) {
  Warehouse& state = scope.levels.front()->state();
  const ice::Labels& l = ice::labels();
  std::array<Column, D> velocity;
  for (std::size_t n = 0; n < D; ++n) velocity[n] = velocity_at_faces(n);
  const KeptArray<std::uint8_t> told = blocks_to_tell();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    SeenPlaces seen;
    IndexBox seen_of;
    int seen_along = -2;
    const auto tell = [&](Label label, int along, const Column& from, bool turns = false) {
      const int slot = state.find(label, fluid_->options().place(0));
      const RealView to = state.view(slot, 0, b);
      if (along != seen_along || !(to.box == seen_of)) seen = places_seen(to.box, along, told);
      seen_along = along;
      seen_of = to.box;
      // Others write fractions too: those of a state that was taken over.
      if (label == l.solid_fraction)
        state.clear(slot, b);
      else
        state.clear_for(slot, b, seen.parts);
      for (const SeenPlace& s : seen.places)
        to(s.cell) = turns && s.flipped ? -from[s.at] : from[s.at];
    };
    tell(l.solid_fraction, -1, fields_.theta);
    tell(l.solid_fraction_next, -1, fields_.theta_next);
    tell(l.wall_pressure, -1, fields_.wall_pressure);
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      const int d = frame_.direction[n];
      tell(l.covered[d], a, fields_.covered[n]);
      tell(l.mean_covered[d], a, fields_.mean_covered[n]);
      tell(l.swept[d], a, fields_.swept[n], true);
      tell(l.solid_face_velocity[d], a, velocity[n], true);
    }
    state.forget_where(b, [&](const IndexBox& cells) { return frame_.holds_any(cells); });
  }
}

template void LevelCoupling<1>::tell_fluid(const StageScope&);
template void LevelCoupling<2>::tell_fluid(const StageScope&);
template void LevelCoupling<3>::tell_fluid(const StageScope&);

}  // namespace sluice::mpmice

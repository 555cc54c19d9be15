// What solids do to cells and faces, into the work slots of the sweep: ghost cells too, beyond the
// sides of the domain as in a mirror.
#include "ice/fluid/labels.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// Of cells of a box with its ghosts, those that may see what the arrays hold, in a mirror too.
template <int D>
IndexBox LevelCoupling<D>::seen_from(IndexBox cells) const {
  const IndexBox all = cells;
  for (std::size_t a = 0; a < D; ++a) {
    const int d = frame_.direction[a];
    // Behind a side that the window reaches lie ghosts alone.
    if (frame_.window.lower[a] > frame_.domain.lower[a])
      cells.lower[d] = std::max(all.lower[d], frame_.box.lower[a]);
    if (frame_.window.upper[a] < frame_.domain.upper[a])
      cells.upper[d] = std::min(all.upper[d], frame_.box.upper[a]);
    cells.upper[d] = std::max(cells.upper[d], cells.lower[d]);
  }
  return cells;
}

// Of a box with its ghosts, the cells (along < 0) or the low faces along a direction that see what
// the arrays hold, and where it lies there.
template <int D>
std::vector<SeenPlace> LevelCoupling<D>::places_seen(const IndexBox& box, int along) const {
  std::vector<SeenPlace> seen;
  for_each_cell(seen_from(box), [&](IntVec3 c) {
    bool flipped = false;
    const Cell<D> cell =
        along < 0 ? frame_.mirrored(frame_.cell(c))
                  : frame_.mirrored_face(frame_.cell(c), static_cast<std::size_t>(along), flipped);
    if (frame_.holds(cell)) seen.push_back({c, frame_.box.index(cell), flipped});
  });
  return seen;
}

// The velocity of the solid at the low faces of the cells along the n-th direction: the mean of
// both cells by mass.
template <int D>
Column LevelCoupling<D>::velocity_at_faces(std::size_t n) const {
  Column to(frame_.box.cells(), 0.0);
  const Column &mass = fields_.mass, &v = fields_.velocity[n];
  for_each_cell_in(frame_.box, [&](const Cell<D>& face, std::size_t at) {
    Cell<D> below = face;
    --below[n];
    if (!frame_.holds(below)) return;
    const std::size_t i = frame_.box.index(frame_.inside(below)),
                      j = frame_.box.index(frame_.inside(face));
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
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    std::vector<SeenPlace> seen;
    IndexBox seen_of;
    int seen_along = -2;
    const auto tell = [&](Label label, int along, const Column& from, bool turns = false) {
      const int slot = state.find(label, fluid_->options().place(0));
      const RealView to = state.view(slot, 0, b);
      if (along != seen_along || !(to.box == seen_of)) seen = places_seen(to.box, along);
      seen_along = along;
      seen_of = to.box;
      state.clear(slot, b);
      for (const SeenPlace& s : seen) to(s.cell) = turns && s.flipped ? -from[s.at] : from[s.at];
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
    state.forget(b, seen_from(state.local_boxes()[static_cast<std::size_t>(b)].cells));
  }
}

template void LevelCoupling<1>::tell_fluid(const StageScope&);
template void LevelCoupling<2>::tell_fluid(const StageScope&);
template void LevelCoupling<3>::tell_fluid(const StageScope&);

}  // namespace sluice::mpmice

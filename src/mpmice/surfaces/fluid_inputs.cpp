#include "mpmice/surfaces/fluid_inputs.hpp"

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

// Not 0 for each block with solids or faces that they cover, or beside one that has: a cell beside
// one without fluid gets the pressure on the wall even where bodies that overlap cover nothing
// between them. Elsewhere there is nothing to write.
template <int D>
KeptArray<std::uint8_t> FluidInputs<D>::blocks_to_write() const {
  constexpr std::size_t n = CellBlocks<D>::block_cells;
  const Frame<D>& frame = near_.frame();
  std::vector<const Column*> fields{&solid_.theta, &solid_.theta_next};
  for (std::size_t d = 0; d < D; ++d)
    for (const auto* of :
         {&solid_.covered, &solid_.covered_next, &solid_.mean_covered, &solid_.swept})
      fields.push_back(&(*of)[d]);
  KeptArray<std::uint8_t> blocks(1 + frame.cells.block_count(), 0);
  for (std::size_t b = blocks.size(); b-- > 1;) {
    for (const Column* field : fields) {
      bool any = false;
      for (std::size_t i = b * n; i < (b + 1) * n; ++i) any |= (*field)[i] != 0;
      if (any) blocks[b] = 2;
    }
  }
  for (std::size_t b = 1; b < blocks.size(); ++b)
    for (int d = 0; d < D; ++d) {
      const std::size_t above = frame.cells.above(b, d);
      if (above == 0) continue;
      if (blocks[above] >= 2) blocks[b] |= 1;
      if (blocks[b] >= 2) blocks[above] |= 1;
    }
  return blocks;
}

// May cells of the domain or beyond its sides see, in a mirror too, one of these blocks.
template <int D>
bool FluidInputs<D>::sees_any(const CellBox<D>& part, const KeptArray<std::uint8_t>& blocks) const {
  const Frame<D>& frame = near_.frame();
  CellBox<D> seen;
  for (std::size_t a = 0; a < D; ++a) {
    const int low = frame.domain.lower[a], high = frame.domain.upper[a];
    const bool beyond = part.lower[a] < low || part.upper[a] > high;
    if (beyond && frame.periodic[a]) return true;
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
  return frame.cells.any_block(seen, [&](std::size_t b) { return blocks[b] != 0; });
}

// Of a box with its ghosts, the cells (along < 0) or the low faces along a direction that see what
// the arrays hold, and where it lies there.
template <int D>
SeenPlaces FluidInputs<D>::places_seen(const IndexBox& box, int along,
                                       const KeptArray<std::uint8_t>& blocks) const {
  const Frame<D>& frame = near_.frame();
  SeenPlaces seen;
  const auto look = [&](const Cell<D>& at) {
    bool flipped = false;
    const Cell<D> cell = along < 0
                             ? frame.mirrored(at)
                             : frame.mirrored_face(at, static_cast<std::size_t>(along), flipped);
    const std::size_t i = frame.cells.index(cell);
    if (i >= CellBlocks<D>::block_cells) seen.places.push_back({frame.index(at), i, flipped});
  };
  const CellBox<D> all = frame.box(box);
  for_each_cell_of<D>(BlockDirectory<D>::blocks_of(all), [&](const Cell<D>& b) {
    const CellBox<D> part = common<D>(BlockDirectory<D>::cells_of(b), all);
    // Inside of the domain all see themselves.
    if (common<D>(part, frame.domain) == part) {
      const std::size_t n = frame.cells.index(part.lower) / CellBlocks<D>::block_cells;
      if (blocks[n] == 0) return;
      seen.parts.push_back(frame.part_of(box, part));
      frame.cells.for_each_cell_of_block(n, part, [&](const Cell<D>& at, std::size_t i) {
        seen.places.push_back({frame.index(at), i, false});
      });
      return;
    }
    if (!sees_any(part, blocks)) return;
    seen.parts.push_back(frame.part_of(box, part));
    for_each_cell_of<D>(part, look);
  });
  return seen;
}

template <int D>
void FluidInputs<D>::write(Warehouse& state, int place) const {
  const Frame<D>& frame = near_.frame();
  const ice::Labels& l = ice::labels();
  std::array<Column, D> velocity;
  for (std::size_t n = 0; n < D; ++n) velocity[n] = motion_.at_faces(n, near_, solid_);
  const KeptArray<std::uint8_t> blocks = blocks_to_write();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    SeenPlaces seen;
    IndexBox seen_of;
    int seen_along = -2;
    const auto write = [&](Label label, int along, const Column& from, bool turns = false) {
      const int slot = state.find(label, place);
      const RealView to = state.view(slot, 0, b);
      if (along != seen_along || !(to.box == seen_of)) seen = places_seen(to.box, along, blocks);
      seen_along = along;
      seen_of = to.box;
      // Others write fractions too: those of a state that was taken over.
      if (label == l.solid_fraction)
        state.clear(slot, b);
      else
        state.clear_for(slot, b, seen.parts);
      for_each_range(near_.team(), seen.places.size(),
                     [&](std::size_t begin, std::size_t end, std::size_t, int) {
                       for (std::size_t n = begin; n < end; ++n) {
                         const SeenPlace& s = seen.places[n];
                         to(s.cell) = turns && s.flipped ? -from[s.at] : from[s.at];
                       }
                     });
    };
    write(l.solid_fraction, -1, solid_.theta);
    write(l.solid_fraction_next, -1, solid_.theta_next);
    write(l.wall_pressure, -1, wall_pressure_);
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      const int d = frame.direction[n];
      write(l.covered[d], a, solid_.covered[n]);
      write(l.mean_covered[d], a, solid_.mean_covered[n]);
      write(l.swept[d], a, solid_.swept[n], true);
      write(l.solid_face_velocity[d], a, velocity[n], true);
    }
    state.forget_where(b, [&](const IndexBox& cells) { return frame.holds_any(cells); });
  }
}

template class FluidInputs<1>;
template class FluidInputs<2>;
template class FluidInputs<3>;

}  // namespace sluice::mpmice

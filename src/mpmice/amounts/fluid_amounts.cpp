#include "mpmice/amounts/fluid_amounts.hpp"

namespace sluice::mpmice {

// Places of what is shared of a cell: kinetic energy, momentum, then mass, volume and energy of
// each material, then scalars.
template <int D>
struct FluidAmounts<D>::Lanes {
  explicit Lanes(const FluidCells& fluid)
      : first(momentum + fluid.components), scalar(first + 3 * fluid.materials()) {}
  static constexpr int kinetic = 0, momentum = 1;
  int first, scalar;
};

template <int D>
int FluidAmounts<D>::columns(const ice::FluidPart& fluid) {
  const ice::SchemeOptions& o = fluid.options();
  return 1 + o.grid.components + 3 * static_cast<int>(o.materials.fluids.size()) +
         static_cast<int>(o.materials.scalars.size());
}

template <int D>
void FluidAmounts<D>::begin(const NearCells<D>& near, const SolidGeometry<D>& solid) {
  theta_swept_ = solid.theta_next;
  swept_with_solid_.assign(near.size(), 0);
  near.for_each([&](const Cell<D>&, std::size_t i) { swept_with_solid_[i] = solid.has_solid(i); });
}

// Which cells take part, and the volume that is left to the fluid in them.
template <int D>
void FluidAmounts<D>::mark(const NearCells<D>& near, const SolidGeometry<D>& solid) {
  amounts_.volume.assign(near.size(), 1.0);
  amounts_.near.assign(near.size(), 0);
  amounts_.touched.assign(near.size(), 0);
  near.for_each([&](const Cell<D>&, std::size_t i) {
    amounts_.volume[i] = 1 - solid.theta_next[i];
    if (!solid.has_solid(i) && swept_with_solid_[i] == 0) return;
    amounts_.touched[i] = amounts_.near[i] = 1;
  });
  // What it may share with, and what dry cells see of these.
  dilate(near.frame(), 2, amounts_.near);
}

template <int D>
void FluidAmounts<D>::put_cell(const FluidCells& fluid, const FluidBox& cells, const Lanes& lanes,
                               IntVec3 at, std::size_t i) {
  const bool solid = swept_with_solid_[i] != 0;
  const int M = fluid.materials();
  double rho = 0, squares = 0;
  for (int m = 0; m < M; ++m) {
    rho += cells.mass(m, at);
    // One fluid beside a solid: its energy stands in `kinetic`.
    const bool apart = M > 1 || !solid;
    known_.put(lanes.first + 3 * m, i, cells.mass(m, at));
    known_.put(lanes.first + 3 * m + 1, i, M > 1 ? cells.volume(m, at) : amounts_.volume[i]);
    known_.put(lanes.first + 3 * m + 2, i, apart ? cells.energy(m, at) : 0.0);
  }
  // What a cell with a solid has is an amount already.
  for (std::size_t s = 0; s < fluid.scalar.size(); ++s) {
    const double carried = solid ? 1.0 : cells.mass(static_cast<int>(fluid.carrier[s]), at);
    known_.put(lanes.scalar + static_cast<int>(s), i, carried * cells.scalar(s, at));
  }
  for (int c = 0; c < fluid.components; ++c) {
    const double m = cells.momentum(c, at);
    known_.put(Lanes::momentum + c, i, m);
    squares += m * m;
  }
  known_.put(Lanes::kinetic, i,
             !solid  ? 0.5 * squares / rho + cells.energy_of_slip(at)
             : M > 1 ? cells.fraction(at)
                     : cells.energy(0, at));
}

template <int D>
void FluidAmounts<D>::gather(const NearCells<D>& near, const SolidGeometry<D>& solid,
                             const Warehouse& state, Communicator& ranks) {
  const Frame<D>& frame = near.frame();
  const FluidCells fluid(*fluid_, state);
  const Lanes lanes(fluid);
  const std::size_t materials = static_cast<std::size_t>(fluid.materials());
  known_.begin(frame.cells, lanes.scalar + static_cast<int>(fluid.scalar.size()));
  mark(near, solid);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    frame.for_each_held(state.local_boxes()[static_cast<std::size_t>(b)].cells,
                        [&](IntVec3 at, std::size_t i) {
                          if (amounts_.near[i] != 0) put_cell(fluid, cells, lanes, at, i);
                        });
  }
  known_.share(ranks);
  known_.take(Lanes::kinetic, amounts_.kinetic);
  amounts_.momentum.resize(static_cast<std::size_t>(fluid.components));
  for (int c = 0; c < fluid.components; ++c)
    known_.take(Lanes::momentum + c, amounts_.momentum[static_cast<std::size_t>(c)]);
  for (auto* columns : {&amounts_.mass, &amounts_.filled, &amounts_.energy})
    columns->resize(materials);
  for (std::size_t m = 0; m < materials; ++m) {
    const int first = lanes.first + 3 * static_cast<int>(m);
    known_.take(first, amounts_.mass[m]);
    known_.take(first + 1, amounts_.filled[m]);
    known_.take(first + 2, amounts_.energy[m]);
  }
  amounts_.scalar.resize(fluid.scalar.size());
  for (std::size_t s = 0; s < amounts_.scalar.size(); ++s)
    known_.take(lanes.scalar + static_cast<int>(s), amounts_.scalar[s]);
}

template <int D>
void FluidAmounts<D>::refresh(const NearCells<D>& near, Communicator& ranks) {
  if (ranks.size() == 1) return;
  std::vector<Column*> columns{&amounts_.volume};
  amounts_.for_each_amount([&](Column& column) { columns.push_back(&column); });
  const int count = static_cast<int>(columns.size());
  known_.begin(near.frame().cells, count + 2);
  near.for_each_own([&](const Cell<D>&, std::size_t i) {
    for (int c = 0; c < count; ++c) known_.put(c, i, (*columns[static_cast<std::size_t>(c)])[i]);
    known_.put(count, i, amounts_.near[i]);
    if (!amounts_.inadmissible.empty()) known_.put(count + 1, i, amounts_.inadmissible[i]);
  });
  known_.share(ranks);
  for (int c = 0; c < count; ++c) known_.take(c, *columns[static_cast<std::size_t>(c)]);
  for (std::size_t i = CellBlocks<D>::block_cells; i < amounts_.near.size(); ++i) {
    amounts_.near[i] = known_.value(count, i) != 0 ? 1 : 0;
    if (!amounts_.inadmissible.empty())
      amounts_.inadmissible[i] = known_.value(count + 1, i) != 0 ? 1 : 0;
  }
}

template class FluidAmounts<1>;
template class FluidAmounts<2>;
template class FluidAmounts<3>;

}  // namespace sluice::mpmice

#include "mpmice/step/coupling.hpp"

#include "framework/base/communicator.hpp"
#include "ice/fluid/labels.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

template <class F>
auto dispatch(const Level& level, F&& f) {
  switch (level.active_count()) {
    case 1:
      return f.template operator()<1>();
    case 2:
      return f.template operator()<2>();
    default:
      return f.template operator()<3>();
  }
}

// The parts of the domain whose solids this rank has to know at the start: those near its boxes.
template <int D>
std::vector<IndexBox> parts_to_start(const Frame<D>& frame, const Level& level,
                                     const Communicator& ranks) {
  if (ranks.size() == 1) return {level.domain};
  const BlockSharers<D> sharers(boxes_of_ranks<D>(frame, level), frame.all_sides(), frame.room(),
                                ranks);
  std::vector<IndexBox> parts;
  for (const CellBox<D>& block : sharers.cells()) {
    const CellBox<D> part = common<D>(block, frame.domain);
    if (!part.empty()) parts.push_back(frame.part_of(level.domain, part));
  }
  return parts;
}

template <int D>
void start_fractions_of(Warehouse& state, const ice::FluidPart& fluid,
                        const ParticleMethod& particles,
                        const std::vector<solids::SolidKind>& kinds) {
  Frame<D> frame(state.level());
  const std::vector<IndexBox> parts = parts_to_start<D>(frame, state.level(), world());
  std::vector<ParticleSet> sets;
  OccupiedCells<D> occupied;
  occupied.begin(frame.room());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    ParticleSet& set = sets.emplace_back(particles.kinds()[k].columns());
    for (const IndexBox& part : parts)
      particles.start(static_cast<int>(k), state.level(), part, set);
    const CornerColumns<D> corners = corner_columns<D>(frame, kinds[k].columns, set);
    add_cells_of<D>(frame, corners, set.size(), {}, occupied);
  }
  occupied.grow();
  frame.look_at(occupied);
  std::vector<SolidSet<D>> of_kinds(sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    SolidSet<D>& s = of_kinds[k];
    s.columns = &kinds[k].columns;
    s.set = &sets[k];
    read_filled<D>(s);
    find_faces<D>(frame, s, false, outer_faces_of<D>(s));
    s.pieces.cut(s.faces);
  }
  SurfaceGeometry<D> geometry;
  SolidInCells<D> found;
  geometry.begin_at_start(frame, of_kinds);
  geometry.finish_at_start(frame, of_kinds, nullptr, found);
  clean_volume_fractions(found.theta);
  const int slot = state.find(ice::labels().solid_fraction, fluid.options().place(0));
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView to = state.view(slot, 0, b);
    for_each_cell(to.box, [&](IntVec3 c) {
      const Cell<D> cell = frame.mirrored(frame.cell(c));
      to(c) = found.theta[frame.cells.index(cell)];
    });
  }
}

}  // namespace

std::unique_ptr<Coupling> make_coupling(const Level& level, const ice::FluidPart& fluid,
                                        std::shared_ptr<solids::CoupledSolids> solids,
                                        const std::vector<models::SolidBurn>& burns,
                                        const BurnReductions& places) {
  return dispatch(level, [&]<int D>() -> std::unique_ptr<Coupling> {
    return std::make_unique<LevelCoupling<D>>(level, fluid, std::move(solids), burns, places);
  });
}

bool exchanges_through_surfaces(const ice::FluidPart& fluid, int solids) {
  for (int k = 0; k < solids; ++k)
    if (films_of(fluid.scene(), k).any()) return true;
  return false;
}

void start_fractions(Warehouse& state, const ice::FluidPart& fluid, const ParticleMethod& particles,
                     const std::vector<solids::SolidKind>& kinds) {
  dispatch(state.level(), [&]<int D>() { start_fractions_of<D>(state, fluid, particles, kinds); });
}

}  // namespace sluice::mpmice

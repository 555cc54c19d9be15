#include "ice/fluid_blocks.hpp"

#include "framework/refine/volume_faces.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/sources/sources.hpp"

namespace sluice::ice {

// A block with one material alone needs the graph of that material only.
int FluidBlocks::kinds() const {
  const int of_fluids = part_->material_count() == 1 ? 1 : part_->material_count() + 1;
  return of_fluids + (part_->scene().solids > 0 ? 1 : 0);
}

// Does a solid meet these cells in this step.
bool FluidBlocks::meets_solid(const Warehouse& state, int box, const IndexBox& cells) const {
  for (const Label label : {labels().solid_fraction, labels().solid_fraction_next})
    if (state.any_nonzero(state.find(label, part_->options().place(0)), 0, box, cells)) return true;
  return false;
}

int FluidBlocks::kind_of(const Warehouse& old_state, int local_box,
                         const IndexBox& cells_with_ghosts) const {
  if (part_->scene().solids > 0 && meets_solid(old_state, local_box, cells_with_ghosts))
    return cut_kind();
  const int mixed = part_->material_count();
  if (mixed == 1) return 0;
  int only = -1;
  for (int m = 0; m < mixed; ++m) {
    const int slot = old_state.find(labels().mass, part_->options().place(m));
    if (!old_state.any_nonzero(slot, 0, local_box, cells_with_ghosts)) continue;
    if (only >= 0) return mixed;
    only = m;
  }
  // A source may bring others in.
  if (only >= 0 && part_->has_sources() && part_->options().forces.sources->takes_from(only))
    return mixed;
  return only >= 0 ? only : mixed;
}

std::optional<double> FluidBlocks::absent_value(Label label, int material, int kind) const {
  const IndexOffsets& places = part_->options().budgets.places;
  return label == labels().volume && material == places.material_of(kind) ? 1.0 : 0.0;
}

// What passes through a control volume's side must be counted in uniform flow as well. Materials
// that exchange heat change where nothing flows; so may those that a finer level left at pressures
// of their own.
bool FluidBlocks::skipping_allowed() const {
  if (part_->material_count() > 1 &&
      (part_->options().materials.heat_exchange.any() ||
       part_->options().materials.multi_velocity || part_->run_scene().grid.levels.size() > 1))
    return false;
  for (const models::TransportedScalar& s : part_->scene().models.scalars)
    if (s.grows()) return false;
  return !part_->options().forces.on && !part_->options().scheme.implicit &&
         !part_->has_sources() && control_volumes(part_->run_scene().analysis).empty();
}

}  // namespace sluice::ice

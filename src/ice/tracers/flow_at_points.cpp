// Looking up the fields of a box.
#include "ice/tracers/flow_at_points.hpp"

#include "ice/fluid/labels.hpp"

namespace sluice::ice {

FlowAtPoints::FlowAtPoints(const Warehouse& state, int box, int material, const FlowStorage& flow,
                           const Warehouse& walls)
    : level_(&state.level()) {
  for (int m = 0; m < flow.materials; ++m)
    masses_.push_back(state.view(state.find(labels().mass, flow.places.material_of(m)), 0, box));
  const auto components = [&](Label label, int of_material) {
    std::vector<Component> list;
    const int slot = state.find(label, flow.places.material_of(of_material));
    for (std::size_t c = 0; c < flow.directions.size(); ++c)
      if (level_->active[flow.directions[c]])
        list.push_back({flow.directions[c], state.view(slot, static_cast<int>(c), box)});
    return list;
  };
  momentum_ = components(labels().momentum, 0);
  known_ = masses_.front().box;
  if (flow.solids) {
    const int place = flow.places.material_of(0);
    fraction_ = state.view(state.find(labels().solid_fraction, place), 0, box);
    for (int d = 0; d < 3; ++d)
      if (level_->active[d])
        solids_.push_back(
            {d, walls.view(walls.find(labels().solid_face_velocity[d], place), 0, box)});
  }
  if (!flow.multi_velocity) return;
  slip_ = components(labels().slip, material);
  own_mass_ = masses_[material];
}

}  // namespace sluice::ice

#include "mpmice/burn/burning_cells.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

std::vector<BurningField> burning_fields(const models::SolidBurn& burn) {
  const auto field = [](SurfaceValue value, const ice::Labels::AtSurfaces& l) {
    return BurningField{value, l.saved, l.kept};
  };
  const ice::Labels& l = ice::labels();
  if (std::holds_alternative<models::SteadyBurn>(burn.law))
    return {field(SurfaceValue::burns, l.burning_steady)};
  if (std::holds_alternative<models::UnsteadyBurn>(burn.law))
    return {field(SurfaceValue::burns, l.burning_unsteady),
            field(SurfaceValue::temperature, l.surface_temperature),
            field(SurfaceValue::gradient, l.surface_gradient)};
  return {};
}

BurningCells::BurningCells(const Scene& scene, const std::vector<models::SolidBurn>& burns) {
  const std::vector<SaveRequest>& saves = scene.output.saves;
  for (const models::SolidBurn& burn : burns)
    for (const BurningField& field : burning_fields(burn))
      if (std::any_of(saves.begin(), saves.end(),
                      [&](const SaveRequest& r) { return r.label == field.saved.name(); })) {
        slots_.push_back({field.kept, burn.solid, 1, 0});
        saved_.push_back(field.saved);
      }
}

void BurningCells::clear(Warehouse& state) const {
  for (const SlotInfo& s : slots_) {
    const int slot = state.find(s.label, s.material);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
      const RealView v = state.view(slot, 0, b);
      fill(v, v.box, 0.0);
    }
  }
}

void BurningCells::declare(TaskList& diagnostics, int effect) const {
  Places all;
  all.effect = effect;
  diagnostics.enter(all);
  for (std::size_t n = 0; n < slots_.size(); ++n) {
    const SlotInfo& s = slots_[n];
    TaskBuilder task = diagnostics.task("save " + saved_[n].name(), 0);
    const In from = task.read(diagnostics.old_state(s.label, s.material, 1));
    const Out to = task.write(diagnostics.output(saved_[n], s.material));
    task.kernel([=](const Row& row) { std::copy_n(row(from), row.count(), row(to)); });
  }
}

}  // namespace sluice::mpmice

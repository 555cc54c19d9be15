#include "mpmice/burn/burning_cells.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

std::vector<BurningField> burning_fields(const models::SolidBurn& burn) {
  const auto field = [](BurningValue value, const ice::Labels::AtSurfaces& l) {
    return BurningField{value, l.saved, l.kept};
  };
  const ice::Labels& l = ice::labels();
  if (std::holds_alternative<models::SteadyBurn>(burn.law))
    return {field(BurningValue::burns, l.burning_steady)};
  if (std::holds_alternative<models::UnsteadyBurn>(burn.law))
    return {field(BurningValue::burns, l.burning_unsteady),
            field(BurningValue::temperature, l.surface_temperature),
            field(BurningValue::gradient, l.surface_gradient)};
  if (const auto* ddt = std::get_if<models::Ddt1>(&burn.law)) {
    std::vector<BurningField> fields = {
        field(BurningValue::detonates, l.detonating),
        field(BurningValue::kind, l.burning),
        {BurningValue::share, l.burned_share, l.kept_burned_share},
        {BurningValue::gain, l.burned_in_step, l.kept_burned_in_step}};
    if (ddt->spread) {
      fields.push_back(field(BurningValue::delay, l.induction_time));
      fields.push_back(field(BurningValue::waited, l.count_time));
    }
    return fields;
  }
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

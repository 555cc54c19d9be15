#include "mpmice/burn/burning_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

namespace {

// Labels that laws of burning name as their outputs.
BurningField field_of(const models::BurningOutput& output) {
  const ice::Labels& l = ice::labels();
  for (const ice::Labels::AtSurfaces& pair :
       {l.burning_steady, l.burning_unsteady, l.surface_temperature, l.surface_gradient,
        l.detonating, l.burning, l.induction_time, l.count_time,
        ice::Labels::AtSurfaces{l.burned_share, l.kept_burned_share},
        ice::Labels::AtSurfaces{l.burned_in_step, l.kept_burned_in_step}})
    if (pair.saved.name() == output.label) return {output.value, pair.saved, pair.kept};
  throw std::logic_error(
      fmt::format("no work field holds the output {} of a burn model", output.label));
}

}  // namespace

std::vector<BurningField> burning_fields(const models::SolidBurn& burn) {
  std::vector<BurningField> fields;
  for (const models::BurningOutput& output : burn.law->outputs())
    fields.push_back(field_of(output));
  return fields;
}

BurningCells::BurningCells(const Scene& scene, const std::vector<models::SolidBurn>& burns,
                           int first_fluid, bool other_sources) {
  const auto add = [&](Label saved, Label kept, int material) {
    const std::vector<SaveRequest>& saves = scene.output.saves;
    const SlotInfo slot{kept, material, 1, 0};
    if (std::any_of(slots_.begin(), slots_.end(),
                    [&](const SlotInfo& s) { return s.label == kept && s.material == material; }))
      return;
    if (std::none_of(saves.begin(), saves.end(),
                     [&](const SaveRequest& r) { return r.label == saved.name(); }))
      return;
    slots_.push_back(slot);
    saved_.push_back(saved);
  };
  const ice::Labels& l = ice::labels();
  for (const models::SolidBurn& burn : burns) {
    for (const BurningField& field : burning_fields(burn)) add(field.saved, field.kept, burn.solid);
    add(l.model_mass, l.kept_model_mass, burn.solid);
    if (!other_sources)
      for (const int product : burn.law->products(burn.product))
        add(l.model_mass, l.kept_model_mass, first_fluid + product);
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
  IndexOffsets all;
  all.effect = effect;
  diagnostics.begin_part(all);
  for (std::size_t n = 0; n < slots_.size(); ++n) {
    const SlotInfo& s = slots_[n];
    TaskBuilder task = diagnostics.task("save " + saved_[n].name(), 0);
    const In from = task.read(diagnostics.old_state(s.label, s.material, 1));
    const Out to = task.write(diagnostics.output(saved_[n], s.material));
    task.kernel([=](const Row& row) { std::copy_n(row(from), row.count(), row(to)); });
  }
}

}  // namespace sluice::mpmice

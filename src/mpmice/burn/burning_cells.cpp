#include "mpmice/burn/burning_cells.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

BurningCells::BurningCells(const Scene& scene, const std::vector<models::SolidBurn>& burns) {
  const std::vector<SaveRequest>& saves = scene.output.saves;
  const bool saved = std::any_of(saves.begin(), saves.end(), [](const SaveRequest& r) {
    return r.label == ice::labels().burning_cells.name();
  });
  if (!saved) return;
  for (const models::SolidBurn& burn : burns)
    if (std::holds_alternative<models::SteadyBurn>(burn.law))
      slots_.push_back({ice::labels().burning_in_step, burn.solid, 1, 0});
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
  for (const SlotInfo& s : slots_) {
    TaskBuilder task = diagnostics.task("save " + ice::labels().burning_cells.name(), 0);
    const In from = task.read(diagnostics.old_state(s.label, s.material, 1));
    const Out to = task.write(diagnostics.output(ice::labels().burning_cells, s.material));
    task.kernel([=](const Row& row) { std::copy_n(row(from), row.count(), row(to)); });
  }
}

}  // namespace sluice::mpmice

// What small components have in common.
#include "framework/run/component/plain_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/deck/faults.hpp"

namespace sluice {

PlainComponent::PlainComponent(const Scene& scene, std::string name, std::string equation_name)
    : scene_(scene), name_(std::move(name)) {
  effects_.add({std::move(equation_name), true, "it is computed by the component", {}});
  effects_.add({"saved fields", true, "copies of the state", {}});
}

void PlainComponent::declare_diagnostics(TaskList& list, int /*level*/) const {
  for (const SlotInfo& s : slots()) {
    TaskBuilder copy = list.task("save " + s.label.name(), saved);
    const In from = copy.read(list.old_state(s.label, s.material, s.components));
    const Out to = copy.write(list.output(s.label, s.material));
    copy.kernel([=](const Row& row) { std::copy_n(row(from), row.count(), row(to)); });
  }
}

const DeckNode* need_block(const Deck& deck, const Scene& scene, const char* name,
                           std::vector<Fault>& faults) {
  const DeckNode* block = deck.root->child(name);
  if (block == nullptr)
    add_error(faults, deck.root->where,
              fmt::format("a {} deck needs the block <{}>", scene.component, name),
              fmt::format("see sluice help {}", name));
  return block;
}

void need_one_level(const Scene& scene, std::vector<Fault>& faults) {
  if (scene.grid.levels.size() < 2) return;
  const Location& second = scene.grid_settings.levels[1].where;
  add_error(faults, second, fmt::format("{} runs on one level", scene.component),
            "remove the other levels");
}

void fill_state(Warehouse& state, double value) {
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView v = state.view(0, 0, b);
    fill(v, v.box, value);
  }
}

RowPart part_in(const Row& row, const IndexBox& box, int along) {
  IntVec3 cell = row.cell();
  const int first = cell[along];
  cell[along] = box.lower[along];
  if (!box.contains(cell)) return {};
  const int begin = std::max(0, box.lower[along] - first);
  const int end = std::min(row.count(), box.upper[along] - first);
  return end > begin ? RowPart{begin, end} : RowPart{};
}

}  // namespace sluice

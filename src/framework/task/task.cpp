// Collecting declarations.
#include "framework/task/task.hpp"

namespace sluice {

VariableId TaskList::add(Variable v) {
  variables_.push_back(std::move(v));
  return {static_cast<int>(variables_.size()) - 1};
}

void TaskList::begin_part(IndexOffsets part) {
  part_ = std::make_shared<const IndexOffsets>(std::move(part));
}

VariableId TaskList::state(Storage storage, const char* when, Label label, int material,
                           int components) {
  const int place = part_->output_of(label, material);
  for (std::size_t v = 0; v < variables_.size(); ++v)
    if (variables_[v].storage == storage && variables_[v].label == label &&
        variables_[v].material == place)
      return {static_cast<int>(v)};
  return add({label.name() + when, storage, components, label, place,
              closing_layers(label.info().centring)});
}

VariableId TaskList::old_state(Label label, int material, int components) {
  return state(Storage::old_state, " (old)", label, material, components);
}

VariableId TaskList::new_state(Label label, int material, int components) {
  return state(Storage::new_state, " (new)", label, material, components);
}

VariableId TaskList::output(Label label, int material) {
  return add({label.name(), Storage::output, component_count(label.info().type), label,
              part_->output_of(label, material), closing_layers(label.info().centring)});
}

VariableId TaskList::temporary(std::string name, int components, int face_direction) {
  IntVec3 closing{};
  if (face_direction >= 0) closing[face_direction] = 1;
  return add({std::move(name), Storage::temporary, components, Label{}, 0, closing});
}

TaskBuilder TaskList::task(std::string name, int effect) {
  Task t;
  t.name = std::move(name);
  t.effect = part_->effect + effect;
  t.owner = part_;
  tasks_.push_back(std::move(t));
  return TaskBuilder(*this, tasks_.size() - 1);
}

In TaskBuilder::read(VariableId v, Stencil s) {
  auto& reads = list_->tasks_[task_].reads;
  reads.push_back({v, s});
  return {static_cast<int>(reads.size()) - 1};
}

Out TaskBuilder::write(VariableId v) {
  auto& writes = list_->tasks_[task_].writes;
  writes.push_back(v);
  return {static_cast<int>(writes.size()) - 1};
}

TaskBuilder& TaskBuilder::kernel(RowKernel k) {
  list_->tasks_[task_].kernel = std::move(k);
  return *this;
}

TaskBuilder& TaskBuilder::always() {
  list_->tasks_[task_].always = true;
  return *this;
}

TaskBuilder& TaskBuilder::needs_box() {
  list_->tasks_[task_].needs_box = true;
  return *this;
}

TaskBuilder& TaskBuilder::only_in(BlockPart part) {
  list_->tasks_[task_].part = std::move(part);
  return *this;
}

}  // namespace sluice

// Rows of one material, the account, the labels.
#include "ice/sources/source_tasks.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

// A component of the change into one of the sums.
void add_cells(const Row& row, In change, int component, ExactSum& sum, int first, int end) {
  const double volume = cell_volume(row);
  const double* q = row(change, component);
  add_to_sum(sum, first, end, [=](int i) { return q[i] * volume; });
}

// Cells first to end - 1 of the row.
void account_cells(const Row& row, In change, const SchemeOptions& o, int first, int end) {
  using C = SourceChange;
  const C layout = source_change(o);
  const int material = o.materials.mixture ? 0 : o.materials.index;
  const int beside = static_cast<int>(o.materials.fluids.size());
  const auto add = [&](int component, int slot) {
    add_cells(row, change, component, row.reductions().sum(o.budgets.source_sums, slot), first,
              end);
  };
  for (int m = 0; m < layout.materials; ++m) {
    add(layout.of(m, C::mass), material + m);
    for (int c = 0; c < o.grid.components; ++c)
      add(layout.of(m, C::momentum) + c, beside + SourceSums::momentum + o.grid.direction[c]);
  }
  constexpr std::pair<C::OfCell, int> of_cells[] = {
      {C::total_energy, SourceSums::total_energy},
      {C::heat, SourceSums::heat},
      {C::exchanged_mass, SourceSums::exchanged_mass},
      {C::exchanged_energy, SourceSums::exchanged_energy},
      {C::burned_mass, SourceSums::burned_mass},
      {C::released_heat, SourceSums::released_heat}};
  for (const auto& [what, slot] : of_cells) add(layout.of(what), beside + slot);
}

struct SourceLabel {
  Label label;
  SourceChange::OfMaterial what;
};

void save(TaskList& list, VariableId of_sources, const SchemeOptions& o, int effect,
          const SourceLabel& s, int material, int local) {
  TaskBuilder task = list.task("save " + s.label.name(), effect);
  const SourceChange layout = source_change(o);
  const bool vector = s.what == SourceChange::momentum;
  const In change = task.read(of_sources);
  const Out out = task.write(list.output(s.label, material));
  task.kernel([=](const Row& row) {
    for (int d = 0; d < (vector ? 3 : 1); ++d) std::fill_n(row(out, d), row.count(), 0.0);
    if (o.forces.sources == nullptr) return;
    const double volume = cell_volume(row);
    for (int c = 0; c < (vector ? o.grid.components : 1); ++c) {
      const double* from = row(change, layout.of(local, s.what) + c);
      double* to = row(out, vector ? o.grid.direction[c] : 0);
      for (int i = 0; i < row.count(); ++i) to[i] = from[i] * volume;
    }
  });
}

void save_share(TaskList& list, VariableId of_sources, const SchemeOptions& o, int effect,
                Label label, SourceChange::OfCell what, int material) {
  TaskBuilder task = list.task("save " + label.name(), effect);
  const SourceChange layout = source_change(o);
  const In change = task.read(of_sources);
  const Out out = task.write(list.output(label, material));
  task.kernel([=](const Row& row) {
    if (o.forces.sources != nullptr)
      std::copy_n(row(change, layout.of(what)), row.count(), row(out));
    else
      std::fill_n(row(out), row.count(), 0.0);
  });
}

}  // namespace

SourceHandles declare_sources(TaskBuilder& task, VariableId source_change, const SchemeOptions& o) {
  SourceHandles h;
  if (o.forces.sources != nullptr) h.change = task.write(source_change);
  return h;
}

void add_sources_of_one(const Row& row, const SourceHandles& h, const SchemeOptions& o, Out mass,
                        Out momentum, Out energy) {
  if (o.forces.sources == nullptr) return;
  SourceRows rows;
  rows.row = &row;
  rows.change = h.change;
  rows.layout = source_change(o);
  rows.first_material = o.materials.index;
  rows.mass[0] = row(mass);
  rows.energy[0] = row(energy);
  for (int c = 0; c < o.grid.components; ++c) rows.momentum[c] = row(momentum, c);
  o.forces.sources->apply(rows);
}

void add_source_budget(TaskList& list, VariableId source_change, const SchemeOptions& o,
                       int effect) {
  if (o.forces.sources == nullptr) return;
  TaskBuilder task = list.task("source account", effect);
  const In change = task.read(source_change);
  task.always().kernel([=](const Row& row) {
    for_uncovered(row, o, [&](int first, int end) { account_cells(row, change, o, first, end); });
  });
}

void declare_source_labels(TaskList& list, VariableId of_sources, const SchemeOptions& o,
                           int effect) {
  const Labels& l = labels();
  const SourceLabel all[] = {{l.model_mass, SourceChange::mass},
                             {l.model_momentum, SourceChange::momentum},
                             {l.model_energy, SourceChange::energy},
                             {l.model_volume, SourceChange::volume}};
  const int first = o.materials.mixture ? 0 : o.materials.index;
  for (const SourceLabel& s : all)
    for (int m = 0; m < source_change(o).materials; ++m)
      save(list, of_sources, o, effect, s, first + m, m);
  for (int m = 0; m < source_change(o).materials; ++m)
    save_share(list, of_sources, o, effect, l.burned_in_step, SourceChange::burned_in_step,
               first + m);
  // Of all: where products are alone the reactant's F is 1, as beside a rest of it.
  for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m)
    save_share(list, of_sources, o, effect, l.burned_share, SourceChange::burned_share, m);
}

}  // namespace sluice::ice

// What a deck saves, held against what its run computes.
#include "framework/run/simulation/run_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/format_labels.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/spelling.hpp"
#include "framework/run/levels/particle_archive.hpp"

namespace sluice {
namespace {

void add_outputs(const TaskList& list, std::set<Label>& labels) {
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) labels.insert(v.label);
}

class SavesOfRun {
 public:
  SavesOfRun(const Component& component, const RunLabels& labels, std::vector<Fault>& faults)
      : component_(component), labels_(labels), names_(labels.names()), faults_(faults) {}

  // False: nothing can be saved of it.
  bool settle(SaveRequest& save) {
    if (labels_.has(save.label)) return true;
    if (read_other_spelling(save)) return true;
    tell(save);
    return false;
  }

 private:
  // p.kappa and p.Kappa are two variables of the format.
  bool read_other_spelling(SaveRequest& save) {
    if (find_label(save.label) || format_has_label(save.label)) return false;
    const std::string* meant = nullptr;
    for (const std::string& name : names_) {
      if (plain_spelling(name) != plain_spelling(save.label)) continue;
      if (meant != nullptr) return false;
      meant = &name;
    }
    if (meant == nullptr) return false;
    add_warning(
        faults_, save.where,
        fmt::format("<save label=\"{}\"> is an old spelling; read as \"{}\"", save.label, *meant));
    save.label = *meant;
    return true;
  }

  void tell(const SaveRequest& save) {
    const std::string what = fmt::format("variable '{}'", save.label);
    const ParticleMethod* particles = component_.particles();
    const auto nearest = nearest_name(save.label, names_);
    const std::string advice = nearest ? fmt::format("the nearest of this run is '{}'", *nearest)
                                       : "sluice help --labels describes each label";
    if (const ForeignLabel* foreign = find_foreign_label(save.label))
      add_warning(faults_, save.where,
                  refusal_of(*foreign, save.label) + "; nothing is saved of it", foreign->instead);
    else if (particles != nullptr && particles->is_absent(save.label))
      return;
    else if (find_label(save.label) || format_has_label(save.label))
      add_warning(faults_, save.where,
                  what + " is not computed by this run; nothing is saved of it", advice);
    else
      add_error(faults_, save.where, fmt::format("there is no variable '{}'", save.label),
                suggest_name(save.label, names_));
  }

  const Component& component_;
  const RunLabels& labels_;
  std::vector<std::string> names_;
  std::vector<Fault>& faults_;
};

}  // namespace

RunLabels::RunLabels(const Component& component, std::vector<std::string> histories)
    : histories_(std::move(histories)) {
  TaskList step, diagnostics;
  StepVariant general;
  general.kind = component.blocks().kinds() - 1;
  component.step().declare(step, general);
  component.outputs().declare_diagnostics(diagnostics, 0);
  add_outputs(step, labels_);
  add_outputs(diagnostics, labels_);
  const ParticleMethod* particles = component.particles();
  if (particles == nullptr) return;
  for (const Label label : savable_labels(*particles)) labels_.insert(label);
  for (const Label label : particles->grid_labels()) labels_.insert(label);
}

bool RunLabels::has(const std::string& name) const {
  if (std::find(histories_.begin(), histories_.end(), name) != histories_.end()) return true;
  const auto label = find_label(name);
  return label && labels_.contains(*label);
}

std::vector<std::string> RunLabels::names() const {
  std::vector<std::string> names = histories_;
  for (const Label label : labels_) names.push_back(label.name());
  return names;
}

void settle_saves(OutputSettings& output, const Component& component, const RunLabels& labels,
                  std::vector<Fault>& faults) {
  if (output.saves.empty()) return;
  SavesOfRun saves(component, labels, faults);
  const SaveRequest first = output.saves.front();
  const std::size_t before = faults.size();
  std::erase_if(output.saves, [&](SaveRequest& save) { return !saves.settle(save); });
  const bool refused =
      std::any_of(faults.begin() + static_cast<std::ptrdiff_t>(before), faults.end(),
                  [](const Fault& f) { return f.severity == Severity::error; });
  if (output.saves.empty() && !refused)
    add_error(faults, first.where, "no variable that this deck saves is computed by its run",
              "sluice help --labels lists all labels");
}

}  // namespace sluice

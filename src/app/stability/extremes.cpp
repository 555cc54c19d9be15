#include "app/stability/extremes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "framework/archive/archive.hpp"
#include "framework/archive/extremes/field_extremes.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

void require_component(const FieldInfo& field, const LabelRequest& label) {
  if (label.component < field.components()) return;
  throw InputError(fmt::format("{} has {} components, so that there is no component {}", label.name,
                               field.components(), label.component));
}

// Adds a level; a value that is not a number is both extremes from there on.
void merge(std::optional<Extremes>& found, const FieldExtremes& of_level, const StepInfo& info) {
  const auto placed = [&](const ValuePlace& v) {
    return PlacedValue{v.value, fmt::format("step {}, t = {:g}, level {}, {}", info.step, info.time,
                                            of_level.field.level, place_text(of_level.field, v))};
  };
  if (found && std::isnan(found->least.value)) return;
  if (of_level.first_nan) {
    found = {placed(*of_level.first_nan), placed(*of_level.first_nan)};
    return;
  }
  if (!of_level.least) return;
  if (!found) found = {placed(*of_level.least), placed(*of_level.most)};
  if (of_level.least->value < found->least.value) found->least = placed(*of_level.least);
  if (of_level.most->value > found->most.value) found->most = placed(*of_level.most);
}

std::optional<Extremes> extremes_of_step(const ArchiveStep& step, const LabelRequest& label) {
  std::optional<Extremes> found;
  bool saved = false;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level) {
    const FieldInfo* field = step.find(label.name, label.material, level);
    if (field == nullptr) field = step.find_particles(label.name, label.material, level);
    if (field == nullptr) continue;
    require_component(*field, label);
    saved = true;
    merge(found, extremes_of(step, *field, label.component), step.info());
  }
  if (!saved)
    throw InputError(
        fmt::format("{}: there is no '{}' of material {}; save it with <save label=\"{}\"/>",
                    step.folder().string(), label.name, label.material, label.name));
  return found;
}

}  // namespace

std::vector<Extremes> extremes_of(const std::string& path, const LabelRequest& label,
                                  bool all_outputs) {
  const Archive archive = Archive::open(path);
  const auto& outputs = archive.outputs();
  if (outputs.empty()) throw InputError(path + ": the archive has no output");
  std::vector<Extremes> found;
  for (std::size_t n = all_outputs ? 0 : outputs.size() - 1; n < outputs.size(); ++n)
    if (const auto extremes = extremes_of_step(archive.read_output(outputs[n]), label))
      found.push_back(*extremes);
  return found;
}

}  // namespace sluice

#include "app/stability/extremes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

class Search {
 public:
  // place(): text, made for new extremes alone.
  template <class Place>
  void add(double value, Place&& place) {
    if (found_ && std::isnan(extremes_.least.value)) return;
    const bool bad = std::isnan(value);
    if (!found_ || bad || value < extremes_.least.value) extremes_.least = {value, place()};
    if (!found_ || bad || value > extremes_.most.value) extremes_.most = {value, place()};
    found_ = true;
  }
  std::optional<Extremes> extremes() const {
    return found_ ? std::optional(extremes_) : std::nullopt;
  }

 private:
  Extremes extremes_;
  bool found_ = false;
};

void require_component(const FieldInfo& field, const LabelRequest& label) {
  if (label.component < field.components()) return;
  throw InputError(fmt::format("{} has {} components, so that there is no component {}", label.name,
                               field.components(), label.component));
}

std::optional<Extremes> extremes_of_step(const ArchiveStep& step, const LabelRequest& label) {
  Search search;
  bool saved = false;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level) {
    const std::string when =
        fmt::format("step {}, t = {:g}, level {}", step.info().step, step.info().time, level);
    if (const FieldInfo* field = step.find(label.name, label.material, level)) {
      require_component(*field, label);
      saved = true;
      const DenseField values = step.read(*field);
      for_each_cell(values.cells, [&](IntVec3 c) {
        if (values.has(c))
          search.add(values.at(c, label.component),
                     [&] { return fmt::format("{}, cell [{}, {}, {}]", when, c.x, c.y, c.z); });
      });
    } else if (const FieldInfo* particles =
                   step.find_particles(label.name, label.material, level)) {
      require_component(*particles, label);
      saved = true;
      const auto values = step.read_particles(*particles);
      for (std::size_t p = 0; p < values[0].size(); ++p)
        search.add(values[static_cast<std::size_t>(label.component)][p],
                   [&] { return fmt::format("{}, particle {}", when, p); });
    }
  }
  if (!saved)
    throw InputError(
        fmt::format("{}: there is no '{}' of material {}; save it with <save label=\"{}\"/>",
                    step.folder().string(), label.name, label.material, label.name));
  return search.extremes();
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

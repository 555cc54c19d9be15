// One pass over the stored values of a label.
#include "framework/archive/extremes/field_extremes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/archive/particle_table.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {
namespace {

void add(FieldExtremes& found, const ValuePlace& v) {
  if (std::isnan(v.value)) {
    if (found.not_numbers++ == 0) found.first_nan = v;
    return;
  }
  ++found.values;
  if (!found.least || v.value < found.least->value) found.least = v;
  if (!found.most || v.value > found.most->value) found.most = v;
}

void of_particles(const ArchiveStep& step, FieldExtremes& found) {
  const FieldInfo& field = found.field;
  const auto companion = [&](const char* name) {
    const FieldInfo* info = step.find_particles(name, field.material, field.level);
    return info == nullptr ? std::vector<std::vector<double>>() : step.read_particles(*info);
  };
  const auto values = step.read_particles(field), places = companion(particle_position_name),
             ids = companion(particle_id_name);
  const std::vector<double>& own = values[static_cast<std::size_t>(found.component)];
  for (std::size_t p = 0; p < own.size(); ++p) {
    ValuePlace v;
    v.value = own[p];
    if (!places.empty()) v.at = {places[0][p], places[1][p], places[2][p]};
    v.particle = static_cast<std::int64_t>(ids.empty() ? static_cast<double>(p) : ids[0][p]);
    add(found, v);
  }
}

void of_grid(const ArchiveStep& step, FieldExtremes& found) {
  const FieldInfo& field = found.field;
  const Level& level = step.grid().levels.at(static_cast<std::size_t>(field.level));
  const DenseField values =
      step.read(field, intersection(step.range(field), index_range(level, field.centring)));
  for_each_cell(values.cells, [&](IntVec3 c) {
    if (values.has(c))
      add(found, {values.at(c, found.component), position(level, field.centring, c), c, -1});
  });
}

}  // namespace

std::string place_text(const FieldInfo& field, const ValuePlace& place) {
  if (place.particle >= 0) return fmt::format("particle {}", place.particle);
  return fmt::format("{} [{}, {}, {}]", name_of(field.centring), place.index.x, place.index.y,
                     place.index.z);
}

FieldExtremes extremes_of(const ArchiveStep& step, const FieldInfo& field, int component) {
  FieldExtremes found;
  found.field = field;
  found.component = component;
  if (field.centring == Centring::particle)
    of_particles(step, found);
  else
    of_grid(step, found);
  return found;
}

std::vector<FieldExtremes> all_extremes(const ArchiveStep& step) {
  std::vector<FieldExtremes> all;
  for (const std::vector<FieldInfo>* fields : {&step.fields(), &step.particle_fields()})
    for (const FieldInfo& field : *fields)
      for (int c = 0; c < field.components() && field.name != particle_id_name; ++c)
        all.push_back(extremes_of(step, field, c));
  return all;
}

}  // namespace sluice

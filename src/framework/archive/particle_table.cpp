// Lists of levels put together and sorted.
#include "framework/archive/particle_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace sluice {
namespace {

const FieldInfo& need(const ArchiveStep& step, const char* name, int material, int level) {
  const FieldInfo* info = step.find_particles(name, material, level);
  if (info == nullptr)
    throw DamageError(fmt::format("{}: particles of material {} on level {} have no {}",
                                  step.folder().string(), material, level, name));
  return *info;
}

template <class T>
void permute(std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t n : order) sorted.push_back(values[n]);
  values.swap(sorted);
}

void sort_by_id(ParticleTable& table) {
  std::vector<std::size_t> order(table.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return table.ids[a] < table.ids[b]; });
  permute(table.ids, order);
  permute(table.levels, order);
  for (ParticleColumn& column : table.columns)
    for (std::vector<double>& values : column.components) permute(values, order);
}

}  // namespace

const ParticleColumn* ParticleTable::find(std::string_view name) const {
  for (const ParticleColumn& column : columns)
    if (column.info.name == name) return &column;
  return nullptr;
}

Vec3 ParticleTable::position(std::size_t n) const {
  const ParticleColumn& x = *find(particle_position_name);
  return {x.components[0][n], x.components[1][n], x.components[2][n]};
}

std::vector<int> particle_materials(const ArchiveStep& step) {
  std::set<int> materials;
  for (const FieldInfo& f : step.particle_fields()) materials.insert(f.material);
  return {materials.begin(), materials.end()};
}

namespace {

// The numbers of a level's particles; none in a raw archive: nullopt.
std::optional<std::vector<std::int64_t>> read_ids(const ArchiveStep& step, int material,
                                                  int level) {
  const bool raw = step.storage().format == ArchiveFormat::raw;
  if (raw && step.find_particles(particle_id_name, material, level) == nullptr) return std::nullopt;
  return step.read_particle_integers(need(step, particle_id_name, material, level));
}

void add_level(const ArchiveStep& step, int level, const std::set<std::string>& names,
               ParticleTable& table) {
  const std::size_t before = table.size();
  std::size_t count = 0;
  auto column = table.columns.begin();
  for (const std::string& name : names) {
    const FieldInfo& info = need(step, name.c_str(), table.material, level);
    const auto values = step.read_particles(info);
    if (column->components.empty())
      *column = {info, std::vector<std::vector<double>>(values.size())};
    if (column == table.columns.begin()) count = values.front().size();
    if (values.front().size() != count || values.size() != column->components.size())
      throw DamageError(fmt::format(
          "{}: {} of material {} on level {} has {} values for {} particles",
          step.folder().string(), name, table.material, level, values.front().size(), count));
    for (std::size_t c = 0; c < values.size(); ++c) {
      auto& all = column->components[c];
      all.insert(all.end(), values[c].begin(), values[c].end());
    }
    ++column;
  }
  const auto ids = read_ids(step, table.material, level);
  table.numbered = table.numbered && ids.has_value();
  if (ids && ids->size() != count)
    throw DamageError(fmt::format(
        "{}: {} of material {} on level {} has {} values for {} particles", step.folder().string(),
        particle_id_name, table.material, level, ids->size(), count));
  table.ids.resize(before + count);
  if (ids)
    std::copy(ids->begin(), ids->end(), table.ids.end() - static_cast<std::ptrdiff_t>(count));
  table.levels.resize(before + count, level);
}

}  // namespace

ParticleTable read_particles(const ArchiveStep& step, int material, const LabelFilter& labels) {
  ParticleTable table;
  table.material = material;
  std::set<std::string> names{particle_position_name};
  std::set<int> levels;
  for (const FieldInfo& f : step.particle_fields()) {
    if (f.material != material) continue;
    levels.insert(f.level);
    if (labels.selects(f.name) && f.name != particle_id_name) names.insert(f.name);
  }
  table.columns.resize(names.size());
  for (const int level : levels) add_level(step, level, names, table);
  if (!table.numbered) std::iota(table.ids.begin(), table.ids.end(), std::int64_t{0});
  sort_by_id(table);
  return table;
}

}  // namespace sluice

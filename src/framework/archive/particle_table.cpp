// Lists of levels put together and sorted.
#include "framework/archive/particle_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
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
  for (const int level : levels) {
    const auto ids = step.read_particles(need(step, particle_id_name, material, level)).front();
    for (const double id : ids) table.ids.push_back(static_cast<std::int64_t>(id));
    table.levels.insert(table.levels.end(), ids.size(), level);
    auto column = table.columns.begin();
    for (const std::string& name : names) {
      const FieldInfo& info = need(step, name.c_str(), material, level);
      const auto values = step.read_particles(info);
      if (column->components.empty())
        *column = {info, std::vector<std::vector<double>>(values.size())};
      for (std::size_t c = 0; c < values.size(); ++c) {
        if (values[c].size() != ids.size())
          throw DamageError(fmt::format(
              "{}: {} of material {} on level {} has {} values for {} particles",
              step.folder().string(), name, material, level, values[c].size(), ids.size()));
        auto& all = column->components[c];
        all.insert(all.end(), values[c].begin(), values[c].end());
      }
      ++column;
    }
  }
  sort_by_id(table);
  return table;
}

}  // namespace sluice

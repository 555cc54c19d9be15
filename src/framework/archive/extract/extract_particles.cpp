// Rows of particles by number; of all levels where none is chosen.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include "framework/archive/extract/extract_parts.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

// InputError where none of the chosen material and level have the label.
void require_such_particles(const ArchiveStep& step, const ExtractOptions& options,
                            const Quantity& q) {
  std::set<int> materials, levels;
  bool found = false;
  for (const FieldInfo& f : step.particle_fields()) {
    if (f.name != q.label) continue;
    materials.insert(f.material);
    levels.insert(f.level);
    found = found || ((!options.material || f.material == *options.material) &&
                      (options.level < 0 || f.level == options.level));
  }
  if (found) return;
  throw InputError(fmt::format("{} has no such {}: it is stored for materials {} and levels {}",
                               step.folder().string(), q.label, fmt::join(materials, ", "),
                               fmt::join(levels, ", ")));
}

// Which particles of a step are chosen; of others, the nearest.
class ParticleChoice {
 public:
  ParticleChoice(const ExtractOptions& options, const FollowedParticles& followed)
      : options_(options), followed_(followed), box_(options) {}

  bool selects(const ParticleTable& table, std::size_t n) {
    const std::int64_t id = table.ids[n];
    if (options_.level >= 0 && table.levels[n] != options_.level) return false;
    if (followed_) {
      const auto list = followed_->find(table.material);
      return list != followed_->end() &&
             std::binary_search(list->second.begin(), list->second.end(), id);
    }
    if (!options_.particles.empty() && !has_number(id)) return false;
    return box_.contains(table.position(n), [&] { return fmt::format("particle {}", id); });
  }

  // Why nothing was selected.
  std::string nothing(const Quantity& q) const {
    if (!box_.nearest().empty())
      return fmt::format("no point of {} lies in the box: the nearest is {}", q.label,
                         box_.nearest());
    if (options_.particles.empty() || !nearest_) return "";
    return fmt::format("no particle has the number {}: the nearest is {}",
                       fmt::join(options_.particles, ", "), *nearest_);
  }

 private:
  bool has_number(std::int64_t id) {
    for (const std::int64_t wanted : options_.particles) {
      const std::int64_t away = std::llabs(id - wanted);
      if (away == 0) return true;
      if (!nearest_ || away < away_) {
        nearest_ = id;
        away_ = away;
      }
    }
    return false;
  }

  const ExtractOptions& options_;
  const FollowedParticles& followed_;
  BoxOfPoints box_;
  std::optional<std::int64_t> nearest_;
  std::int64_t away_ = 0;
};

void add_row(const ArchiveStep& step, const ParticleTable& table, const ParticleColumn& column,
             std::size_t n, const Quantity& q, ValueRows& rows) {
  std::array<double, 9> components{};
  const int count = column.info.components();
  for (int c = 0; c < count; ++c) components[c] = column.components[c][n];
  rows.add(step.info().time);
  rows.add(table.levels[n]);
  rows.add(table.material);
  if (table.numbered)
    rows.add(table.ids[n]);
  else
    rows.add_nothing();
  const Vec3 p = table.position(n);
  for (int d = 0; d < 3; ++d) rows.add(p[d]);
  add_values(q, components.data(), count, rows);
  rows.end_row();
}

}  // namespace

std::string extract_particles(const ArchiveStep& step, const ExtractOptions& options,
                              const Quantity& q, FollowedParticles& followed, ValueRows& rows) {
  const std::int64_t before = rows.rows();
  std::map<int, std::vector<std::int64_t>> found;
  ParticleChoice choice(options, followed);
  for (const int material : particle_materials(step)) {
    if (options.material && *options.material != material) continue;
    const ParticleTable table = read_particles(step, material, {{q.label}, {}});
    const ParticleColumn* column = table.find(q.label);
    if (column == nullptr) continue;
    if (!table.numbered && (options.follow || !options.particles.empty()))
      throw InputError(
          fmt::format("{}: the particles of material {} have no numbers to choose or "
                      "to follow them by",
                      step.folder().string(), material));
    std::vector<std::string> columns = {"time", "level", "material", "id", "x", "y", "z"};
    for (std::string& name : value_columns(q, column->info.type))
      columns.push_back(std::move(name));
    rows.head(options.label, column->info.unit, columns);
    for (std::size_t n = 0; n < table.size(); ++n) {
      if (!choice.selects(table, n)) continue;
      add_row(step, table, *column, n, q, rows);
      if (options.follow && !followed) found[material].push_back(table.ids[n]);
    }
  }
  if (rows.rows() > before) {
    if (options.follow && !followed) followed = std::move(found);
    return "";
  }
  require_such_particles(step, options, q);
  if (std::string why = choice.nothing(q); !why.empty()) return why;
  return fmt::format("{} holds no value of {} at t = {:g} (step {})", step.folder().string(),
                     q.label, step.info().time, step.info().step);
}

}  // namespace sluice

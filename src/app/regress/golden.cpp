// Golden results: how they are made and compared.
#include "app/regress/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/particle_table.hpp"
#include "framework/archive/selection.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

std::vector<std::string> with_values(std::vector<std::string> columns, int components) {
  for (int c = 0; c < components; ++c)
    columns.emplace_back(components == 1 ? "value" : component_name(components, c));
  return columns;
}

GoldenTable table_of(const ArchiveStep& step, const FieldInfo& info) {
  GoldenTable t;
  t.title = fmt::format("{}, material {}, level {}", info.name, info.material, info.level);
  t.columns = with_values({"i", "j", "k"}, info.components());
  const DenseField field = step.read(info);
  for_each_cell(field.cells, [&](IntVec3 at) {
    if (!field.has(at)) return;
    GoldenTable::Row row{{at.x, at.y, at.z}, {}};
    for (int c = 0; c < info.components(); ++c) row.values.push_back(field.at(at, c));
    t.rows.push_back(std::move(row));
  });
  return t;
}

// Of each material that has the variable.
std::vector<GoldenTable> particle_tables(const ArchiveStep& step, const std::string& variable) {
  std::vector<GoldenTable> tables;
  for (const int material : particle_materials(step)) {
    const bool has = std::any_of(
        step.particle_fields().begin(), step.particle_fields().end(),
        [&](const FieldInfo& f) { return f.material == material && f.name == variable; });
    if (!has) continue;
    const ParticleTable particles = read_particles(step, material, {{variable}, {}});
    const ParticleColumn& column = *particles.find(variable);
    GoldenTable t;
    t.title = fmt::format("{}, material {}", variable, material);
    t.columns = with_values({"id"}, column.info.components());
    for (std::size_t n = 0; n < particles.size(); ++n) {
      GoldenTable::Row row{{particles.ids[n], 0, 0}, {}};
      for (const std::vector<double>& values : column.components) row.values.push_back(values[n]);
      t.rows.push_back(std::move(row));
    }
    tables.push_back(std::move(t));
  }
  return tables;
}

std::string text_of(const GoldenTable& table, const GoldenTable::Row& row) {
  if (table.place_columns() == 1) return fmt::format("particle {}", row.place[0]);
  return fmt::format("[{}]", fmt::join(row.place, ","));
}

std::string table_difference(const GoldenTable& golden, const GoldenTable& now, double tolerance) {
  if (golden.title != now.title || golden.columns != now.columns)
    return fmt::format("contains {} ({}), the golden file {} ({})", now.title,
                       fmt::join(now.columns, " "), golden.title, fmt::join(golden.columns, " "));
  if (golden.rows.size() != now.rows.size())
    return fmt::format("{}: {} values, the golden file has {}", golden.title, now.rows.size(),
                       golden.rows.size());
  for (std::size_t n = 0; n < golden.rows.size(); ++n)
    if (golden.rows[n].place != now.rows[n].place)
      return fmt::format("{}: found {}, the golden file has {}", golden.title,
                         text_of(now, now.rows[n]), text_of(golden, golden.rows[n]));
  for (std::size_t c = 0; c + golden.place_columns() < golden.columns.size(); ++c) {
    double scale = 0;
    for (const GoldenTable::Row& r : golden.rows) scale = std::max(scale, std::fabs(r.values[c]));
    double worst = 0;
    std::size_t where = 0, count = 0;
    for (std::size_t n = 0; n < golden.rows.size(); ++n) {
      const double d = std::fabs(golden.rows[n].values[c] - now.rows[n].values[c]);
      if (d <= tolerance * scale) continue;
      if (count++ == 0) where = n;  // a NaN gets here too
      if (d <= worst) continue;
      worst = d;
      where = n;
    }
    if (count > 0)
      return fmt::format("{}: {} differs in {} of {} values, most in {}: {:.17g}, golden {:.17g}",
                         golden.title, golden.columns[golden.place_columns() + c], count,
                         golden.rows.size(), text_of(golden, golden.rows[where]),
                         now.rows[where].values[c], golden.rows[where].values[c]);
  }
  return {};
}

}  // namespace

std::size_t GoldenTable::place_columns() const {
  return !columns.empty() && columns.front() == "id" ? 1 : 3;
}

Golden golden_of(const Archive& archive, const std::vector<std::string>& variables) {
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  Golden g;
  g.steps = step.info().step;
  g.time = step.info().time;
  g.last_dt = step.info().old_delt;
  for (const std::string& variable : variables) {
    std::vector<GoldenTable> tables = particle_tables(step, variable);
    if (tables.empty())
      for (const FieldInfo& info : select_fields(step, variable, std::nullopt, -1))
        tables.push_back(table_of(step, info));
    std::move(tables.begin(), tables.end(), std::back_inserter(g.tables));
  }
  return g;
}

bool of_one_end(const Golden& golden, const Golden& now) {
  constexpr double most = 2;  // steps: another scheme may end a run by a step of another size
  return golden.steps == now.steps || std::fabs(golden.time - now.time) <= most * now.last_dt;
}

std::string golden_difference(const Golden& golden, const Golden& now, double tolerance) {
  if (golden.steps != now.steps)
    return fmt::format("{} steps, the golden run has {}", now.steps, golden.steps);
  if (!(std::fabs(golden.time - now.time) <= tolerance * std::fabs(golden.time)))
    return fmt::format("ends at {:.17g}, the golden run at {:.17g}", now.time, golden.time);
  if (golden.tables.size() != now.tables.size())
    return fmt::format("{} tables, the golden file has {}", now.tables.size(),
                       golden.tables.size());
  for (std::size_t t = 0; t < golden.tables.size(); ++t) {
    std::string difference = table_difference(golden.tables[t], now.tables[t], tolerance);
    if (!difference.empty()) return difference;
  }
  return {};
}

}  // namespace sluice

// Rows from dense fields; coarse points under finer ones left out.
#include <fmt/format.h>

#include <array>

#include "framework/archive/extract/extract_parts.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {
namespace {

struct LoadedField {
  FieldInfo info;
  DenseField values;
};

IntVec3 times(IntVec3 a, IntVec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

// Whether a finer level holds a value at the point's first refined index.
bool covered(const Grid& grid, const std::vector<LoadedField>& fields, const FieldInfo& coarse,
             IntVec3 c) {
  for (const LoadedField& f : fields) {
    if (f.info.material != coarse.material || f.info.level <= coarse.level) continue;
    IntVec3 fine = c;
    for (int l = coarse.level + 1; l <= f.info.level; ++l) fine = times(fine, grid.levels[l].ratio);
    if (f.values.has(fine)) return true;
  }
  return false;
}

std::vector<std::string> columns_of(const Quantity& q, ValueType type) {
  std::vector<std::string> columns = {"time", "level", "material", "i", "j", "k", "x", "y", "z"};
  for (std::string& name : value_columns(q, type)) columns.push_back(std::move(name));
  return columns;
}

void add_row(const ArchiveStep& step, const LoadedField& f, IntVec3 c, Vec3 p, const Quantity& q,
             ValueRows& rows) {
  std::array<double, 9> components{};
  const int count = f.info.components();
  for (int m = 0; m < count; ++m) components[m] = f.values.at(c, m);
  rows.add(step.info().time);
  rows.add(f.info.level);
  rows.add(f.info.material);
  for (int d = 0; d < 3; ++d) rows.add(c[d]);
  for (int d = 0; d < 3; ++d) rows.add(p[d]);
  add_values(q, components.data(), count, rows);
  rows.end_row();
}

}  // namespace

std::string extract_box(const ArchiveStep& step, const ExtractOptions& options, const Quantity& q,
                        ValueRows& rows) {
  std::vector<LoadedField> fields;
  for (const FieldInfo& f : select_fields(step, q.label, options.material, options.level)) {
    const Level& level = step.grid().levels.at(f.level);
    fields.push_back(
        {f, step.read(f, intersection(step.range(f), index_range(level, f.centring)))});
  }
  rows.head(options.label, fields.front().info.unit, columns_of(q, fields.front().info.type));
  BoxOfPoints box(options);
  for (const LoadedField& f : fields) {
    const Level& level = step.grid().levels[f.info.level];
    for_each_cell(f.values.cells, [&](IntVec3 c) {
      const Vec3 p = position(level, f.info.centring, c);
      if (!f.values.has(c) || covered(step.grid(), fields, f.info, c)) return;
      const auto place = [&] {
        return fmt::format("[{}, {}, {}] of level {}", c.x, c.y, c.z, f.info.level);
      };
      if (box.contains(p, place)) add_row(step, f, c, p, q, rows);
    });
  }
  if (!box.nearest().empty())
    return fmt::format("no point of {} lies in the box: the nearest is {}", q.label, box.nearest());
  return fmt::format("{} holds no value of {} at t = {:g} (step {})", step.folder().string(),
                     q.label, step.info().time, step.info().step);
}

}  // namespace sluice

// Rows of CSV from dense fields; coarse points under finer ones left out.
#include "framework/archive/csv_extract.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/particle_table.hpp"
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

const char* value_columns(ValueType type) {
  if (type == ValueType::vector) return "value_x,value_y,value_z";
  if (type == ValueType::tensor)
    return "value_xx,value_xy,value_xz,value_yx,value_yy,value_yz,value_zx,value_zy,value_zz";
  return "value";
}

bool inside(Vec3 p, const ExtractOptions& o) {
  for (int d = 0; d < 3; ++d)
    if ((o.from && p[d] < (*o.from)[d]) || (o.to && p[d] > (*o.to)[d])) return false;
  return true;
}

// Particles by id; of all levels where none is chosen.
std::int64_t extract_particles(const ArchiveStep& step, const ExtractOptions& options,
                               const std::function<void(std::string_view)>& write) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  bool headed = false;
  std::int64_t rows = 0;
  for (const int material : particle_materials(step)) {
    if (options.material && *options.material != material) continue;
    const ParticleTable table = read_particles(step, material, {{options.label}, {}});
    const ParticleColumn* column = table.find(options.label);
    if (column == nullptr) continue;
    if (!headed)
      fmt::format_to(out, "time,level,material,id,x,y,z,{}\n", value_columns(column->info.type));
    headed = true;
    for (std::size_t n = 0; n < table.size(); ++n) {
      const Vec3 p = table.position(n);
      if ((options.level >= 0 && table.levels[n] != options.level) || !inside(p, options)) continue;
      fmt::format_to(out, "{:.17g},{},{},{},{:.17g},{:.17g},{:.17g}", step.info().time,
                     table.levels[n], material,
                     table.numbered ? std::to_string(table.ids[n]) : std::string(), p.x, p.y, p.z);
      for (const std::vector<double>& values : column->components)
        fmt::format_to(out, ",{:.17g}", values[n]);
      fmt::format_to(out, "\n");
      ++rows;
    }
  }
  write({text.data(), text.size()});
  return rows;
}

bool is_of_particles(const ArchiveStep& step, const std::string& label) {
  return std::any_of(step.particle_fields().begin(), step.particle_fields().end(),
                     [&](const FieldInfo& f) { return f.name == label; });
}

}  // namespace

std::int64_t extract_csv(const ArchiveStep& step, const ExtractOptions& options,
                         const std::function<void(std::string_view)>& write) {
  if (is_of_particles(step, options.label)) return extract_particles(step, options, write);
  std::vector<LoadedField> fields;
  for (const FieldInfo& f : select_fields(step, options.label, options.material, options.level)) {
    const Level& level = step.grid().levels.at(f.level);
    fields.push_back(
        {f, step.read(f, intersection(step.range(f), index_range(level, f.centring)))});
  }
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "time,level,material,i,j,k,x,y,z,{}\n",
                 value_columns(fields.front().info.type));
  std::int64_t rows = 0;
  for (const LoadedField& f : fields) {
    const Level& level = step.grid().levels[f.info.level];
    for_each_cell(f.values.cells, [&](IntVec3 c) {
      const Vec3 p = position(level, f.info.centring, c);
      if (!f.values.has(c) || !inside(p, options) || covered(step.grid(), fields, f.info, c))
        return;
      fmt::format_to(out, "{:.17g},{},{},{},{},{},{:.17g},{:.17g},{:.17g}", step.info().time,
                     f.info.level, f.info.material, c.x, c.y, c.z, p.x, p.y, p.z);
      for (int m = 0; m < f.info.components(); ++m)
        fmt::format_to(out, ",{:.17g}", f.values.at(c, m));
      fmt::format_to(out, "\n");
      ++rows;
      if (text.size() > 1 << 20) {
        write({text.data(), text.size()});
        text.clear();
      }
    });
  }
  write({text.data(), text.size()});
  return rows;
}

}  // namespace sluice

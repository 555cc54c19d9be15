// Values are read when their array is written: one label of one box at a time.
#include "framework/archive/vtk/vtk_step.hpp"

#include <limits>
#include <set>

#include "framework/archive/particle_table.hpp"

namespace sluice {
namespace {

bool is_integer(StoredType stored) {
  return stored != StoredType::float64 && stored != StoredType::float32;
}

// The indices of a label that the cells of a box show.
struct ShownIndices {
  IndexBox places;  // of the file
  IntVec3 shift;    // to the high face
  const VtkLevel* level;
  bool on_points;
  IndexBox stored;

  IntVec3 index(IntVec3 place) const {
    IntVec3 c = level->source(place) + shift;
    // A direction that is not of the run has one layer of nodes, drawn on both sides of its cell.
    for (int d = 0; on_points && d < 3; ++d)
      if (stored.size()[d] == 1) c[d] = stored.lower[d];
    return c;
  }
  IndexBox wanted() const {
    const IndexBox all{index(places.lower),
                       index(places.upper - IntVec3{1, 1, 1}) + IntVec3{1, 1, 1}};
    return intersection(all, stored);
  }
};

}  // namespace

VtkStep::VtkStep(const ArchiveStep& step, const LabelFilter& labels, const ArrayNames& names)
    : step_(step) {
  for (const FieldInfo& f : step.fields())
    if (labels.selects(f.name))
      by_name_[names.of(f.name, f.material)].emplace(f.level, OfLevel{f, step.range(f)});
}

std::vector<VtkArray> VtkStep::arrays(const VtkLevel& level, const IndexBox& cells) const {
  std::vector<VtkArray> made;
  for (const auto& [name, fields] : by_name_) {
    const int face = face_direction(fields.begin()->second.info.centring);
    if (face < 0) {
      made.push_back(array(fields, name, level, cells, {}));
      continue;
    }
    IntVec3 up;
    up[face] = 1;
    made.push_back(array(fields, name + "_low", level, cells, {}));
    made.push_back(array(fields, name + "_high", level, cells, up));
  }
  return made;
}

VtkArray VtkStep::array(const std::map<int, OfLevel>& fields, const std::string& name,
                        const VtkLevel& level, const IndexBox& cells, IntVec3 shift) const {
  const FieldInfo& any = fields.begin()->second.info;
  const auto found = fields.find(level.level.index);
  const OfLevel* here = found == fields.end() ? nullptr : &found->second;
  VtkArray a;
  a.name = name;
  a.stored = any.stored;
  a.on_points = any.centring == Centring::node;
  a.components = any.components();
  const IndexBox places{cells.lower, a.on_points ? cells.upper + IntVec3{1, 1, 1} : cells.upper};
  a.tuples = places.volume();
  const ShownIndices shown{places, shift, &level, a.on_points, here ? here->stored : IndexBox{}};
  a.put = [this, here, shown, components = a.components, stored = a.stored](VtkValues& out) {
    const double absent = is_integer(stored) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    DenseField values;
    const IndexBox wanted = here ? shown.wanted() : IndexBox{};
    if (!wanted.empty()) values = step_.read(here->info, wanted);
    for_each_cell(shown.places, [&](IntVec3 place) {
      const IntVec3 c = shown.index(place);
      const bool has = !wanted.empty() && values.has(c);
      for (int m = 0; m < components; ++m) out.add(has ? values.at(c, m) : absent);
    });
  };
  return a;
}

namespace {

// One column of the particles, read when it is written.
VtkArray particle_array(const ArchiveStep& step, int material, const std::string& label,
                        std::int64_t count) {
  VtkArray a;
  a.name = label == particle_position_name ? "Points" : label;
  a.on_points = true;
  a.tuples = count;
  for (const FieldInfo& f : step.particle_fields()) {
    if (f.name != label || f.material != material) continue;
    a.stored = f.stored;
    a.components = f.components();
  }
  a.put = [&step, material, label](VtkValues& out) {
    const ParticleTable table = read_particles(step, material, {{label}, {}});
    if (label == particle_id_name) {
      for (const std::int64_t id : table.ids) out.add(id);
      return;
    }
    const ParticleColumn& column = *table.find(label);
    for (std::size_t n = 0; n < table.size(); ++n)
      for (const std::vector<double>& component : column.components) out.add(component[n]);
  };
  return a;
}

}  // namespace

void write_particles(const ArchiveStep& step, int material, const LabelFilter& labels,
                     const std::filesystem::path& path) {
  std::set<std::string> selected;
  for (const FieldInfo& f : step.particle_fields())
    if (f.material == material && f.name != particle_position_name && labels.selects(f.name))
      selected.insert(f.name);
  const ParticleTable numbers = read_particles(step, material, {{particle_position_name}, {}});
  if (numbers.numbered) selected.insert(particle_id_name);
  const auto count = static_cast<std::int64_t>(numbers.size());
  std::vector<VtkArray> arrays;
  for (const std::string& label : selected)
    arrays.push_back(particle_array(step, material, label, count));
  write_vtp(path, particle_array(step, material, particle_position_name, count), arrays);
}

}  // namespace sluice

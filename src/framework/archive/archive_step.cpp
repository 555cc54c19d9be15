// Fields of one archived step, put together from the boxes of all ranks' files.
#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/archive.hpp"
#include "framework/archive/field_file_reader.hpp"
#include "framework/archive/raw_step_file.hpp"

namespace sluice {
namespace fs = std::filesystem;

ArchiveStep::ArchiveStep(const fs::path& timestep_xml, const ArchiveStorage& storage)
    : folder_(timestep_xml.parent_path()), storage_(storage) {
  if (storage.format == ArchiveFormat::raw)
    open_raw(timestep_xml);
  else
    open_own(timestep_xml);
  gather_fields();
}

void ArchiveStep::open_own(const fs::path& timestep_xml) {
  record_ = parse_step(read_sealed(timestep_xml), timestep_xml.string());
  for (const std::string& href : record_.data_files) {
    try {
      open_file(folder_ / fs::path(href).filename());
    } catch (const Error& e) {
      damage_.push_back(e.what());
    }
  }
}

void ArchiveStep::open_raw(const fs::path& timestep_xml) {
  RawStepRecord record = read_raw_step(timestep_xml, storage_);
  auto file = std::make_unique<RawStepFile>(record, storage_, damage_);
  record_ = std::move(record.step);
  try {
    record_.info.next_delt = file->global("delT", 0);
  } catch (const Error& e) {
    damage_.push_back(e.what());
  }
  files_.push_back(std::move(file));
}

ArchiveStep::ArchiveStep(ArchiveStep&&) noexcept = default;
ArchiveStep& ArchiveStep::operator=(ArchiveStep&&) noexcept = default;
ArchiveStep::~ArchiveStep() = default;

void ArchiveStep::open_file(const fs::path& path) {
  auto file = std::make_unique<FieldFileReader>(path);
  for (const StoredVariable& v : file->variables())
    if (v.level < 0 || static_cast<std::size_t>(v.level) >= grid().levels.size())
      throw DamageError(fmt::format("{}: {} is on level {}, which the grid does not have",
                                    path.string(), v.name, v.level));
  files_.push_back(std::move(file));
}

void ArchiveStep::gather_fields() {
  auto key = [](const FieldInfo& f) { return std::tie(f.name, f.material, f.level); };
  for (const auto& file : files_)
    for (const StoredVariable& v : file->variables())
      (v.centring == Centring::particle ? particle_fields_ : fields_)
          .push_back({v.name, v.type, v.centring, v.unit, v.level, v.material, v.stored});
  for (std::vector<FieldInfo>* fields : {&fields_, &particle_fields_}) {
    std::stable_sort(fields->begin(), fields->end(),
                     [&](const FieldInfo& a, const FieldInfo& b) { return key(a) < key(b); });
    fields->erase(
        std::unique(fields->begin(), fields->end(),
                    [&](const FieldInfo& a, const FieldInfo& b) { return key(a) == key(b); }),
        fields->end());
  }
}

namespace {

const FieldInfo* find_in(const std::vector<FieldInfo>& fields, std::string_view name, int material,
                         int level) {
  for (const FieldInfo& f : fields)
    if (f.name == name && f.material == material && f.level == level) return &f;
  return nullptr;
}

}  // namespace

const FieldInfo* ArchiveStep::find(std::string_view name, int material, int level) const {
  return find_in(fields_, name, material, level);
}

const FieldInfo* ArchiveStep::find_particles(std::string_view name, int material, int level) const {
  return find_in(particle_fields_, name, material, level);
}

std::vector<std::vector<double>> ArchiveStep::read_particles(const FieldInfo& field) const {
  if (!damage_.empty()) throw DamageError(damage_.front());
  const std::size_t n = field.components();
  std::vector<std::vector<double>> lists(n);
  for (const auto& file : files_) {
    const StoredVariable* v = file->find(field.name, field.level, field.material);
    if (v == nullptr) continue;
    for (std::size_t b = 0; b < file->boxes(*v).size(); ++b) {
      const std::vector<double> values = file->read_box(*v, b);
      const auto count = static_cast<std::ptrdiff_t>(values.size() / n);
      for (std::size_t c = 0; c < n; ++c) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(c) * count;
        lists[c].insert(lists[c].end(), first, first + count);
      }
    }
  }
  return lists;
}

std::vector<std::int64_t> ArchiveStep::read_particle_integers(const FieldInfo& field) const {
  if (!damage_.empty()) throw DamageError(damage_.front());
  std::vector<std::int64_t> list;
  for (const auto& file : files_) {
    const StoredVariable* v = file->find(field.name, field.level, field.material);
    if (v == nullptr) continue;
    for (std::size_t b = 0; b < file->boxes(*v).size(); ++b) {
      const std::vector<std::int64_t> values = file->read_integers(*v, b);
      list.insert(list.end(), values.begin(), values.end());
    }
  }
  return list;
}

std::vector<int> ArchiveStep::particle_patches(const FieldInfo& field) const {
  std::vector<int> patches;
  for (const auto& file : files_) {
    const StoredVariable* v = file->find(field.name, field.level, field.material);
    if (v == nullptr) continue;
    for (const StoredBox& b : file->boxes(*v))
      patches.insert(patches.end(), b.stored.volume(), b.patch);
  }
  return patches;
}

IndexBox ArchiveStep::range(const FieldInfo& field, Layers layers) const {
  IndexBox all;
  for (const auto& file : files_)
    if (const StoredVariable* v = file->find(field.name, field.level, field.material))
      for (const StoredBox& b : file->boxes(*v)) {
        const IndexBox& box = layers == Layers::extra ? b.stored : b.interior;
        all = all.empty() ? box : bounding(all, box);
      }
  return all;
}

// Calls f(box, values of all components) for every stored box that meets `cells`.
template <class F>
void ArchiveStep::visit_boxes(const FieldInfo& field, const IndexBox& cells, Layers layers,
                              F&& f) const {
  for (const auto& file : files_) {
    const StoredVariable* v = file->find(field.name, field.level, field.material);
    if (!v) continue;
    const std::vector<StoredBox>& boxes = file->boxes(*v);
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const IndexBox& wanted = layers == Layers::extra ? boxes[b].stored : boxes[b].interior;
      if (!intersection(wanted, cells).empty()) f(boxes[b], file->read_box(*v, b));
    }
  }
}

DenseField ArchiveStep::read(const FieldInfo& field, const IndexBox& cells, Layers layers) const {
  DenseField dense;
  dense.cells = cells;
  const std::size_t count = cells.volume();
  const std::size_t n = field.components();
  dense.components.assign(n, std::vector<double>(count));
  dense.present.assign(count, 0);
  visit_boxes(field, cells, layers, [&](const StoredBox& box, const std::vector<double>& values) {
    const std::size_t volume = box.stored.volume();
    DenseField source;
    source.cells = box.stored;
    for_each_cell(intersection(layers == Layers::extra ? box.stored : box.interior, cells),
                  [&](IntVec3 c) {
                    const std::size_t to = dense.offset(c), from = source.offset(c);
                    // An extra cell of one patch may be an inner one of another.
                    if (dense.present[to] && !box.interior.contains(c)) return;
                    for (std::size_t m = 0; m < n; ++m)
                      dense.components[m][to] = values[m * volume + from];
                    dense.present[to] = 1;
                  });
  });
  if (!damage_.empty())  // some boxes may be in the files that cannot be read
    for (const GridBox& b : grid().levels.at(field.level).boxes)
      for_each_cell(intersection(b.cells, cells), [&](IntVec3 c) {
        if (!dense.has(c)) throw DamageError(damage_.front());
      });
  return dense;
}

void ArchiveStep::read_into(const FieldInfo& field, int component, const IndexBox& cells,
                            const RealView& target) const {
  std::int64_t filled = 0;
  visit_boxes(
      field, cells, Layers::interior, [&](const StoredBox& box, const std::vector<double>& values) {
        const IndexBox part = intersection(box.interior, cells);
        DenseField source;
        source.cells = box.stored;
        const auto start = static_cast<std::size_t>(component) * box.stored.volume();
        for_each_cell(part, [&](IntVec3 c) { target(c) = values[start + source.offset(c)]; });
        filled += part.volume();
      });
  if (filled == cells.volume()) return;
  if (!damage_.empty()) throw DamageError(damage_.front());
  throw InputError(
      fmt::format("{}: {} of material {} on level {} holds {} of the {} values from {} to {}",
                  folder_.string(), field.name, field.material, field.level, filled, cells.volume(),
                  triple_text(cells.lower), triple_text(cells.upper)));
}

std::vector<std::string> ArchiveStep::verify(std::int64_t& good_values) const {
  std::vector<std::string> found = damage_;
  for (const auto& file : files_) {
    for (const StoredVariable& v : file->variables()) {
      try {
        const std::size_t boxes = file->boxes(v).size();
        for (std::size_t b = 0; b < boxes; ++b) {
          try {
            good_values += static_cast<std::int64_t>(file->read_box(v, b).size());
          } catch (const Error& e) {
            found.push_back(e.what());
          }
        }
      } catch (const Error& e) {  // the structure: the same for all variables of the file
        found.push_back(e.what());
        break;
      }
    }
  }
  return found;
}

}  // namespace sluice

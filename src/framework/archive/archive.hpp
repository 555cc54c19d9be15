// Reading an archive: its steps, grids and fields, in any layout of boxes and ranks, in Sluice's
// own format or in Uintah's raw one.
//
// What is damaged is named (DamageError) and never returned as data; the rest stays readable.
#pragma once
#include <memory>
#include <string_view>

#include "framework/archive/archive_record.hpp"
#include "framework/field/array_view.hpp"

namespace sluice {

class StepFile;

// A label of one material and level as one step holds it.
struct FieldInfo {
  std::string name;
  ValueType type = ValueType::real;
  Centring centring = Centring::cell;
  std::string unit;
  int level = 0;
  int material = 0;
  StoredType stored = StoredType::float64;
  int components() const { return component_count(type); }
};

// Values over a box of indices, by component, x fastest, in the unit of the field; `present` is 0
// where no value is stored (a finer level does not cover everything).
struct DenseField {
  IndexBox cells;
  std::vector<std::vector<double>> components;
  std::vector<char> present;

  std::size_t offset(IntVec3 c) const {
    const IntVec3 n = cells.size(), r = c - cells.lower;
    return r.x + n.x * (r.y + static_cast<std::size_t>(n.y) * r.z);
  }
  bool has(IntVec3 c) const { return cells.contains(c) && present[offset(c)]; }
  double at(IntVec3 c, int component = 0) const { return components[component][offset(c)]; }
};

// Which values of a grid a reader is given: `extra` adds the cells that a raw archive stores around
// a level. Archives of Sluice have none.
enum class Layers { interior, extra };

// One archived state. Files are opened when first read.
class ArchiveStep {
 public:
  explicit ArchiveStep(const std::filesystem::path& timestep_xml,
                       const ArchiveStorage& storage = {});
  ArchiveStep(ArchiveStep&&) noexcept;
  ArchiveStep& operator=(ArchiveStep&&) noexcept;
  ~ArchiveStep();

  const StepInfo& info() const { return record_.info; }
  const Grid& grid() const { return record_.grid; }
  const ArchiveStorage& storage() const { return storage_; }
  // By level, in the order of its boxes.
  const std::vector<std::vector<PatchRecord>>& patches() const { return record_.patches; }
  int level_id(int level) const { return record_.level_ids.at(level); }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FieldInfo>& fields() const { return fields_; }  // by name, material, level
  const FieldInfo* find(std::string_view name, int material, int level) const;
  // The same of particles: those of one material and level are in one order in all variables.
  const std::vector<FieldInfo>& particle_fields() const { return particle_fields_; }
  const FieldInfo* find_particles(std::string_view name, int material, int level) const;
  // By component and particle, in the unit of the field. Those of a raw archive are in the order of
  // its patches.
  std::vector<std::vector<double>> read_particles(const FieldInfo& field) const;
  // The same of integers, exact also beyond 2^53.
  std::vector<std::int64_t> read_particle_integers(const FieldInfo& field) const;
  // The patch of each of these particles, as a place in Level::boxes; -1: the file does not say.
  std::vector<int> particle_patches(const FieldInfo& field) const;

  // All indices that hold a value of the field (face labels reach one beyond the cells).
  IndexBox range(const FieldInfo& field, Layers layers = Layers::interior) const;
  DenseField read(const FieldInfo& field, const IndexBox& cells,
                  Layers layers = Layers::interior) const;
  DenseField read(const FieldInfo& field) const { return read(field, range(field)); }
  // Fills `cells` of `target` from one component; throws when a value is missing.
  void read_into(const FieldInfo& field, int component, const IndexBox& cells,
                 const RealView& target) const;

  // Files that could not be opened; fields are read from the others as far as they go.
  const std::vector<std::string>& damage() const { return damage_; }
  // Reads everything; one message for each thing damaged. Counts the values that were good.
  std::vector<std::string> verify(std::int64_t& good_values) const;

 private:
  void open_own(const std::filesystem::path& timestep_xml);
  void open_raw(const std::filesystem::path& timestep_xml);
  void open_file(const std::filesystem::path& path);
  void gather_fields();
  template <class F>
  void visit_boxes(const FieldInfo& field, const IndexBox& cells, Layers layers, F&& f) const;

  std::filesystem::path folder_;
  ArchiveStorage storage_;
  StepRecord record_;
  std::vector<FieldInfo> fields_, particle_fields_;
  std::vector<std::unique_ptr<StepFile>> files_;
  std::vector<std::string> damage_;
};

class Archive {
 public:
  // A folder NAME.uda.NNN or a link to it.
  static Archive open(const std::filesystem::path& path);

  const std::filesystem::path& folder() const { return folder_; }
  const ArchiveIndex& index() const { return index_; }
  ArchiveFormat format() const { return index_.storage.format; }
  const std::vector<StepEntry>& outputs() const { return index_.steps; }
  const std::vector<StepEntry>& checkpoints() const { return checkpoint_index_.steps; }
  ArchiveStep read_output(const StepEntry& entry) const {
    require_referenced_archive(entry, folder_);
    return ArchiveStep(folder_ / entry.href, index_.storage);
  }
  ArchiveStep read_checkpoint(const StepEntry& entry) const {
    return ArchiveStep(folder_ / "checkpoints" / entry.href, checkpoint_index_.storage);
  }

  // "last", "first", "#N" (the N-th output, from 0) or a time: the nearest output, InputError when
  // that is further away than half an interval.
  const StepEntry& select_output(std::string_view text) const;
  // The checkpoint of this step; the last one when step < 0.
  const StepEntry& select_checkpoint(int step = -1) const;

  // Problems with the index of the checkpoints, if any.
  const std::vector<std::string>& damage() const { return damage_; }

 private:
  std::filesystem::path folder_;
  ArchiveIndex index_, checkpoint_index_;
  std::vector<std::string> damage_;
};

// InputError where an archive is raw: only Sluice's own can be continued.
void require_own_format(const Archive& archive);

}  // namespace sluice

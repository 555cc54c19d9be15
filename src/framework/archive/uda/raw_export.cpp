// index.xml, timestep.xml, and blocks of 1024 bytes and more for each variable, patch and material.
#include "framework/archive/uda/raw_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <set>

#include "framework/archive/particle_patches.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/raw_grid.hpp"
#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_alignment = 1024;

void add_meta(XmlElement& parent) {
  XmlElement& meta = parent.add("Meta");
  meta.add("endianness", std::endian::native == std::endian::big ? "big_endian" : "little_endian");
  meta.add("nBits", "64");
  meta.add("numProcs", "1");
}

IntVec3 flags_of(const std::array<bool, 3>& flags) {
  return {flags[0], flags[1], flags[2]};
}

// Patches are numbered through all levels.
XmlElement grid_xml(const Grid& grid) {
  XmlElement root("Grid");
  root.add("numLevels", std::to_string(grid.levels.size()));
  int id = 0;
  for (const Level& level : grid.levels) {
    XmlElement& e = root.add("Level");
    const auto corner = [&](IntVec3 i) { return level.anchor + to_real(i) * level.spacing; };
    if (flags_of(level.periodic) != IntVec3{})
      e.add("periodic", triple_text(flags_of(level.periodic)));
    e.add("numPatches", std::to_string(level.boxes.size()));
    e.add("totalCells", std::to_string(level.cell_count()));
    e.add("extraCells", triple_text(IntVec3{}));
    e.add("anchor", triple_text(level.anchor));
    e.add("id", std::to_string(level.index));
    e.add("cellspacing", triple_text(level.spacing));
    for (const GridBox& b : level.boxes) {
      XmlElement& patch = e.add("Patch");
      patch.add("id", std::to_string(id++));
      patch.add("proc", "0");
      patch.add("lowIndex", triple_text(b.cells.lower));
      patch.add("highIndex", triple_text(b.cells.upper));
      patch.add("interiorLowIndex", triple_text(b.cells.lower));
      patch.add("interiorHighIndex", triple_text(b.cells.upper));
      patch.add("nnodes",
                std::to_string((b.cells.grown(0, 0, 1).grown(1, 0, 1).grown(2, 0, 1)).volume()));
      patch.add("lower", triple_text(corner(b.cells.lower)));
      patch.add("upper", triple_text(corner(b.cells.upper)));
      patch.add("totalCells", std::to_string(b.cells.volume()));
    }
  }
  return root;
}

// CCVariable<float>; positions are points.
std::string raw_type_name(const FieldInfo& f) {
  const std::string text = type_text(f.type, f.centring);
  const bool position = f.centring == Centring::particle && f.name == particle_position_name;
  const bool as_float = f.type == ValueType::real && f.stored == StoredType::float32;
  if (position) return "ParticleVariable<Point>";
  return as_float ? text.substr(0, text.find('<')) + "<float>" : text;
}

// p00000.xml and p00000.data of a level.
class BlockFile {
 public:
  explicit BlockFile(fs::path name)
      : name_(std::move(name)),
        data_(name_.string() + ".data", std::ios::binary),
        record_("Uintah_Output") {}

  XmlElement& add(const FieldInfo& f, int patch, const std::string& bytes,
                  std::optional<std::size_t> particles) {
    const std::size_t padding = (block_alignment - written_ % block_alignment) % block_alignment;
    data_ << std::string(padding, '\0') << bytes;
    const std::size_t start = written_ + padding;
    written_ = start + bytes.size();
    XmlElement& e = record_.add("Variable");
    e.set("type", raw_type_name(f));
    e.add("variable", f.name);
    e.add("index", std::to_string(f.material));
    e.add("patch", std::to_string(patch));
    e.add("start", std::to_string(start));
    if (particles) e.add("numParticles", std::to_string(*particles));
    e.add("end", std::to_string(written_));
    e.add("filename", name_.filename().string() + ".data");
    return e;
  }
  void close() {
    if (!data_.flush())
      throw SystemError("cannot write " + name_.string() + ".data: is the disk full?");
    write_text(name_.string() + ".xml", to_text(record_));
  }

 private:
  fs::path name_;
  std::ofstream data_;
  std::size_t written_ = 0;
  XmlElement record_;
};

void put_number(const FieldInfo& f, double value, std::string& bytes) {
  const auto put = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  if (f.type == ValueType::integer)
    put(static_cast<std::int32_t>(value));
  else if (f.type == ValueType::real && f.stored == StoredType::float32)
    put(static_cast<float>(value));
  else
    put(value);
}

// The field of a level, with those of coarser levels below it.
class LevelValues {
 public:
  LevelValues(const ArchiveStep& step, const FieldInfo& field) : grid_(step.grid()) {
    for (int l = field.level; l >= 0; --l)
      if (const FieldInfo* f = step.find(field.name, field.material, l)) fields_[l] = step.read(*f);
  }

  double at(int level, IntVec3 c, int component) const {
    for (int l = level; l >= 0; --l) {
      const auto found = fields_.find(l);
      if (found != fields_.end() && found->second.has(c)) return found->second.at(c, component);
      c = coarsen(c, grid_.levels[l].ratio);
    }
    return nearest(level, c, component);
  }

 private:
  // A direction of one cell has one layer of nodes.
  double nearest(int level, IntVec3 c, int component) const {
    const DenseField& f = fields_.at(level);
    c = min(max(c, f.cells.lower), f.cells.upper - IntVec3{1, 1, 1});
    return f.has(c) ? f.at(c, component) : 0.0;
  }

  const Grid& grid_;
  std::map<int, DenseField> fields_;
};

class RawStepExport {
 public:
  RawStepExport(const ArchiveStep& step, const LabelFilter& labels, fs::path folder)
      : step_(step),
        labels_(labels),
        folder_(std::move(folder)),
        grid_(grid_xml(step.grid())),
        levels_(parse_raw_grid(grid_, "the exported grid")) {}

  // The variables that were written, by name.
  void write(std::map<std::string, XmlElement>& variables) {
    make_folder(folder_);
    XmlElement root("Uintah_timestep");
    add_meta(root);
    XmlElement& time = root.add("Time");
    time.add("timestepNumber", std::to_string(step_.info().step));
    time.add("currentTime", real_text(step_.info().time));
    time.add("oldDelt", real_text(step_.info().old_delt));
    root.children.push_back(grid_);
    XmlElement& data = root.add("Data");
    const auto particles = particles_by_patch(step_, -1);
    for (const RawLevel& level : levels_) {
      const std::string name = fmt::format("l{}", level.level.index);
      make_folder(folder_ / name);
      BlockFile file(folder_ / name / "p00000");
      for (const FieldInfo& f : step_.fields())
        if (f.level == level.level.index && labels_.selects(f.name)) {
          write_cells(level, f, file);
          note(f, variables);
        }
      for (const FieldInfo& f : step_.particle_fields())
        if (f.level == level.level.index && wanted(f)) {
          write_particles(level, f, particles, file);
          note(f, variables);
        }
      file.close();
      data.add("Datafile").set("href", name + "/p00000.xml").set("proc", "0");
    }
    write_text(folder_ / "timestep.xml", to_text(root));
  }

 private:
  // Readers need positions with any other variable of particles.
  bool wanted(const FieldInfo& f) const {
    const bool any = std::any_of(step_.particle_fields().begin(), step_.particle_fields().end(),
                                 [&](const FieldInfo& g) { return labels_.selects(g.name); });
    return labels_.selects(f.name) || (f.name == particle_position_name && any);
  }

  static void note(const FieldInfo& f, std::map<std::string, XmlElement>& variables) {
    XmlElement e("variable");
    e.set("type", raw_type_name(f)).set("name", f.name).set("numMaterials", "1");
    const auto [known, is_new] = variables.try_emplace(f.name, std::move(e));
    auto& materials = known->second.attributes.back().second;
    materials = std::to_string(std::max(parse_int(materials, f.name), f.material + 1));
  }

  void write_cells(const RawLevel& level, const FieldInfo& f, BlockFile& file) const {
    const LevelValues values(step_, f);
    for (const RawPatch& patch : level.patches) {
      std::string bytes;
      for_each_cell(stored_indices(patch, f.centring, {}), [&](IntVec3 c) {
        for (int m = 0; m < f.components(); ++m) put_number(f, values.at(f.level, c, m), bytes);
      });
      file.add(f, patch.id, bytes, std::nullopt);
    }
  }

  void write_particles(const RawLevel& level, const FieldInfo& f,
                       const std::vector<PatchParticles>& particles, BlockFile& file) const {
    const bool integers = f.type == ValueType::long_integer;
    const auto numbers = integers ? step_.read_particle_integers(f) : std::vector<std::int64_t>();
    const auto lists = integers ? std::vector<std::vector<double>>() : step_.read_particles(f);
    for (std::size_t p = 0; p < level.patches.size(); ++p) {
      const auto here = std::find_if(particles.begin(), particles.end(), [&](const auto& q) {
        return q.level == f.level && q.material == f.material && q.patch == static_cast<int>(p);
      });
      std::string bytes;
      std::size_t count = 0;
      if (here != particles.end()) {
        count = here->places.size();
        for (const std::size_t n : here->places) {
          if (integers)
            bytes.append(reinterpret_cast<const char*>(&numbers[n]), sizeof(std::int64_t));
          for (const std::vector<double>& component : lists) put_number(f, component[n], bytes);
        }
      }
      file.add(f, level.patches[p].id, bytes, count);
    }
  }

  const ArchiveStep& step_;
  const LabelFilter& labels_;
  fs::path folder_;
  XmlElement grid_;
  std::vector<RawLevel> levels_;
};

void copy_if_there(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::exists(from) && !fs::copy_file(from, to, error))
    fail_system("copy " + from.string() + " to", to, error.value());
}

}  // namespace

fs::path export_raw(const Archive& archive, const fs::path& folder, const LabelFilter& labels,
                    const std::string& time) {
  std::vector<StepEntry> steps = archive.outputs();
  if (!time.empty() || steps.empty()) steps = {archive.select_output(time.empty() ? "last" : time)};
  if (!make_folder(folder))
    throw InputError(folder.string() + " exists already; name another folder with -o");
  XmlElement root("Uintah_DataArchive");
  root.add("numberOfProcessors", "1");
  root.add("ParticlePosition", particle_position_name);
  root.add("outputFormat", "UDA");
  add_meta(root);
  XmlElement& globals = root.add("globals");
  for (const HistoryEntry& h : archive.index().histories) {
    copy_if_there(archive.folder() / h.file, folder / h.file);
    globals.add("variable")
        .set("href", h.file)
        .set("type", h.type.find('<') == h.type.npos ? "ReductionVariable<" + h.type + ">" : h.type)
        .set("name", h.name);
  }
  for (const char* deck : {"input.xml", "input.xml.orig"})
    copy_if_there(archive.folder() / deck, folder / deck);
  std::map<std::string, XmlElement> variables;
  XmlElement list("timesteps");
  for (const StepEntry& s : steps) {
    const ArchiveStep step = archive.read_output(s);
    for (const std::string& damage : step.damage()) throw DamageError(damage);
    RawStepExport(step, labels, folder / step_folder_name(s.step)).write(variables);
    list.add("timestep", std::to_string(s.step))
        .set("href", step_folder_name(s.step) + "/timestep.xml")
        .set("time", real_text(s.time))
        .set("oldDelt", real_text(s.old_delt));
  }
  if (variables.empty())
    throw InputError(archive.folder().string() + " contains none of the requested labels");
  XmlElement& named = root.add("variables");
  for (auto& [name, e] : variables) named.children.push_back(std::move(e));
  root.children.push_back(std::move(list));
  write_text_atomically(folder / "index.xml", to_text(root));
  return folder;
}

}  // namespace sluice

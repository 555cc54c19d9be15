// Steps to images, hierarchies of images, and the .pvd file with their times.
#include "framework/archive/vtk/vtk_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "framework/archive/particle_table.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/vtk/vtk_image.hpp"
#include "framework/base/error.hpp"
#include "framework/grid/box_list.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

struct LoadedField {
  FieldInfo info;
  DenseField values;
};

// A level as VTK gets it. Its AMR format takes one refinement ratio for all directions, so that in
// a direction of one cell, which we do not refine, every cell becomes `copies` thin ones.
struct VtkLevel {
  Level level;
  IntVec3 copies{1, 1, 1};

  IndexBox spread(const IndexBox& b) const {
    IndexBox s;
    for (int d = 0; d < 3; ++d) {
      s.lower[d] = b.lower[d] * copies[d];
      s.upper[d] = b.upper[d] * copies[d];
    }
    return s;
  }
  IntVec3 source(IntVec3 c) const {
    auto divide = [](int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); };
    return {divide(c.x, copies.x), divide(c.y, copies.y), divide(c.z, copies.z)};
  }
};

// The ratio of the directions that are refined; 0 when they are refined unequally.
int common_ratio(const Level& level) {
  int ratio = 0;
  for (int d = 0; d < 3; ++d) {
    if (level.domain.size()[d] == 1) continue;
    if (ratio != 0 && level.ratio[d] != ratio) return 0;
    ratio = level.ratio[d];
  }
  return std::max(ratio, 1);
}

bool fits_vtk_amr(const Grid& grid) {
  return std::all_of(grid.levels.begin(), grid.levels.end(), [](const Level& level) {
    return level.index == 0 || common_ratio(level) > 0;
  });
}

std::vector<VtkLevel> vtk_levels(const Grid& grid) {
  std::vector<VtkLevel> levels;
  if (!fits_vtk_amr(grid)) {
    for (const Level& level : grid.levels) levels.push_back({level});
    return levels;
  }
  IntVec3 copies{1, 1, 1};
  for (const Level& level : grid.levels) {
    const int ratio = level.index > 0 ? common_ratio(level) : 1;
    for (int d = 0; d < 3; ++d) copies[d] *= ratio / level.ratio[d];
    levels.push_back({level, copies});
    for (int d = 0; d < 3; ++d) levels.back().level.spacing[d] /= copies[d];
  }
  return levels;
}

// The boxes of the next finer level, in cells of a level.
std::optional<BoxFinder> finer_boxes(const Grid& grid, std::size_t level) {
  if (level + 1 >= grid.levels.size()) return {};
  const Level& fine = grid.levels[level + 1];
  std::vector<IndexBox> coarse;
  for (const GridBox& b : fine.boxes) coarse.push_back(coarsen(b.cells, fine.ratio));
  return BoxFinder(std::move(coarse));
}

// Those that lie over some of the cells.
std::vector<IndexBox> boxes_over(const std::optional<BoxFinder>& finer, const IndexBox& cells) {
  std::vector<IndexBox> found;
  if (!finer) return found;
  for (const int n : finer->overlapping(cells)) found.push_back(finer->boxes()[n]);
  return found;
}

class StepExport {
 public:
  StepExport(const ArchiveStep& step, const ExportOptions& options) : step_(step) {
    std::map<std::string, std::set<int>> materials;
    for (const FieldInfo& f : step.fields()) materials[f.name].insert(f.material);
    for (const auto& [name, set] : materials) many_materials_[name] = set.size() > 1;
    for (const FieldInfo& f : step.fields())
      if (options.labels.selects(f.name)) fields_.push_back({f, step.read(f)});
  }

  bool empty() const { return fields_.empty(); }

  // Writes NAME.vti, or NAME.vtm (and NAME.vthb where VTK can), and returns the file's name.
  std::string write(const fs::path& folder, const std::string& name) const {
    const Grid& grid = step_.grid();
    const Level& coarse = grid.levels.at(0);
    if (grid.levels.size() > 1 || coarse.cell_count() != coarse.domain.volume())
      return write_levels(folder, name);
    write_vti(folder / (name + ".vti"), coarse, coarse.domain, false,
              arrays({coarse}, coarse.domain));
    return name + ".vti";
  }

 private:
  // The file of a box within the export.
  static std::string box_file(const std::string& name, int level, std::size_t box) {
    return fmt::format("{}/l{}_{:05}.vti", name, level, box);
  }

  // A box that lies partly below a finer level is written twice: with such cells marked, for the
  // blocks, and plain, for VTK's AMR, which marks cells itself as it loads levels.
  std::string write_levels(const fs::path& folder, const std::string& name) const {
    make_folder(folder / name);
    const std::vector<VtkLevel> levels = vtk_levels(step_.grid());
    const bool amr = fits_vtk_amr(step_.grid());
    std::vector<std::vector<std::string>> files(levels.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
      const Level& level = levels[l].level;
      const std::optional<BoxFinder> finer = finer_boxes(step_.grid(), l);
      for (std::size_t b = 0; b < level.boxes.size(); ++b) {
        const IndexBox& cells = level.boxes[b].cells;
        const std::vector<IndexBox> hidden = boxes_over(finer, cells);
        const IndexBox c = levels[l].spread(cells);
        std::string file = box_file(name, level.index, b);
        std::vector<VtkArray> all = arrays(levels[l], c);
        if (amr || hidden.empty()) write_vti(folder / file, level, c, true, all);
        if (!hidden.empty()) {
          file.insert(file.size() - 4, "_marked");
          all.push_back(ghosts(levels[l], c, hidden));
          write_vti(folder / file, level, c, true, all);
        }
        files[l].push_back(file);
      }
    }
    if (amr) write_amr(folder, name, levels);
    return write_blocks(folder, name, files);
  }

  static std::string write_blocks(const fs::path& folder, const std::string& name,
                                  const std::vector<std::vector<std::string>>& files) {
    XmlElement root("VTKFile");
    root.set("type", "vtkMultiBlockDataSet")
        .set("version", "1.0")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64");
    XmlElement& blocks = root.add("vtkMultiBlockDataSet");
    for (std::size_t l = 0; l < files.size(); ++l) {
      XmlElement& block = blocks.add("Block");
      block.set("index", std::to_string(l)).set("name", fmt::format("level {}", l));
      for (std::size_t b = 0; b < files[l].size(); ++b)
        block.add("DataSet")
            .set("index", std::to_string(b))
            .set("name", fmt::format("box {}", b))
            .set("file", files[l][b]);
    }
    write_text_atomically(folder / (name + ".vtm"), to_text(root));
    return name + ".vtm";
  }

  void write_amr(const fs::path& folder, const std::string& name,
                 const std::vector<VtkLevel>& levels) const {
    const Vec3 origin = step_.grid().levels[0].anchor;
    XmlElement root("VTKFile");
    root.set("type", "vtkOverlappingAMR")
        .set("version", "1.1")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64");
    XmlElement& amr = root.add("vtkOverlappingAMR");
    amr.set("origin", fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z))
        .set("grid_description", "XYZ");
    for (const VtkLevel& vtk : levels) {
      const Level& level = vtk.level;
      XmlElement& block = amr.add("Block");
      block.set("level", std::to_string(level.index))
          .set("spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                      level.spacing.z));
      for (std::size_t b = 0; b < level.boxes.size(); ++b) {
        const IndexBox c = vtk.spread(level.boxes[b].cells);
        block.add("DataSet")
            .set("index", std::to_string(b))
            .set("amr_box", fmt::format("{} {} {} {} {} {}", c.lower.x, c.upper.x - 1, c.lower.y,
                                        c.upper.y - 1, c.lower.z, c.upper.z - 1))
            .set("file", box_file(name, level.index, b));
      }
    }
    write_text_atomically(folder / (name + ".vthb"), to_text(root));
  }

  // Cells below a finer level: not drawn because they are refined, not integrated because they are
  // duplicates.
  static VtkArray ghosts(const VtkLevel& vtk, const IndexBox& cells,
                         const std::vector<IndexBox>& finer) {
    constexpr double duplicate = 1, refined = 8;
    VtkArray a;
    a.name = "vtkGhostType";
    a.type = VtkType::byte;
    a.values.reserve(cells.volume());
    for_each_cell(cells, [&](IntVec3 place) {
      const IntVec3 c = vtk.source(place);
      const bool hidden =
          std::any_of(finer.begin(), finer.end(), [&](const IndexBox& b) { return b.contains(c); });
      a.values.push_back(hidden ? duplicate + refined : 0.0);
    });
    return a;
  }

  // All arrays of a box. Every box of a hierarchy has the same arrays: NaN where nothing is stored.
  std::vector<VtkArray> arrays(const VtkLevel& vtk, const IndexBox& cells) const {
    std::vector<VtkArray> made;
    std::set<std::string> names;
    for (const LoadedField& any : fields_) {
      const std::string name = array_name(any.info);
      if (!names.insert(name).second) continue;
      const LoadedField* f = nullptr;
      for (const LoadedField& g : fields_)
        if (g.info.level == vtk.level.index && array_name(g.info) == name) f = &g;
      const int face = face_direction(any.info.centring);
      if (face < 0) {
        made.push_back(fill(any.info, f, name, vtk, cells, {}));
      } else {
        IntVec3 up;
        up[face] = 1;
        made.push_back(fill(any.info, f, name + "_low", vtk, cells, {}));
        made.push_back(fill(any.info, f, name + "_high", vtk, cells, up));
      }
    }
    return made;
  }

  std::string array_name(const FieldInfo& f) const {
    return many_materials_.at(f.name) ? fmt::format("{}_{}", f.name, f.material) : f.name;
  }

  // A direction that is not of the run has one layer of nodes, drawn on both sides of its cell.
  static IntVec3 on_one_layer(IntVec3 c, const IndexBox& stored) {
    for (int d = 0; d < 3; ++d)
      if (stored.size()[d] == 1) c[d] = stored.lower[d];
    return c;
  }

  static VtkArray fill(const FieldInfo& info, const LoadedField* f, const std::string& name,
                       const VtkLevel& vtk, const IndexBox& cells, IntVec3 shift) {
    VtkArray a;
    a.name = name;
    a.on_points = info.centring == Centring::node;
    a.type = info.type == ValueType::integer ? VtkType::integer : VtkType::real;
    a.components = info.components();
    const double absent =
        a.type == VtkType::integer ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    const IndexBox range{cells.lower, a.on_points ? cells.upper + IntVec3{1, 1, 1} : cells.upper};
    a.values.reserve(range.volume() * a.components);
    for_each_cell(range, [&](IntVec3 place) {
      IntVec3 c = vtk.source(place) + shift;
      if (a.on_points && f) c = on_one_layer(c, f->values.cells);
      const bool has = f && f->values.has(c);
      for (int m = 0; m < a.components; ++m) a.values.push_back(has ? f->values.at(c, m) : absent);
    });
    return a;
  }

  const ArchiveStep& step_;
  std::vector<LoadedField> fields_;
  std::map<std::string, bool> many_materials_;
};

// Particles of one material, all levels: positions as points, the rest as arrays.
void write_particles(const fs::path& path, const ParticleTable& table, const LabelFilter& labels) {
  const auto array = [&](const std::string& name, const std::vector<std::vector<double>>& values) {
    VtkArray a{name, VtkType::real, true, static_cast<int>(values.size()), {}};
    for (std::size_t n = 0; n < table.size(); ++n)
      for (const std::vector<double>& component : values) a.values.push_back(component[n]);
    return a;
  };
  std::vector<VtkArray> arrays;
  VtkArray ids{particle_id_name, VtkType::long_integer, true, 1, {}};
  for (const std::int64_t id : table.ids) ids.values.push_back(static_cast<double>(id));
  if (table.numbered) arrays.push_back(ids);
  for (const ParticleColumn& column : table.columns)
    if (column.info.name != particle_position_name && labels.selects(column.info.name))
      arrays.push_back(array(column.info.name, column.components));
  write_vtp(path, array("Points", table.find(particle_position_name)->components), arrays);
}

// Writes the particles of a step and names their files in the collection.
bool export_particles(const ArchiveStep& step, const fs::path& folder, const LabelFilter& labels,
                      XmlElement& collection) {
  bool any = false;
  const auto wanted = [&](const FieldInfo& f) { return labels.selects(f.name); };
  const auto& fields = step.particle_fields();
  if (std::none_of(fields.begin(), fields.end(), wanted)) return false;
  for (const int material : particle_materials(step)) {
    const std::string file =
        fmt::format("{}_particles_{}.vtp", step_folder_name(step.info().step), material);
    write_particles(folder / file, read_particles(step, material, labels), labels);
    collection.add("DataSet")
        .set("timestep", real_text(step.info().time))
        .set("group", "")
        .set("part", std::to_string(material))
        .set("file", file);
    any = true;
  }
  return any;
}

XmlElement collection_file() {
  XmlElement root("VTKFile");
  root.set("type", "Collection").set("version", "1.0").set("byte_order", "LittleEndian");
  root.add("Collection");
  return root;
}

}  // namespace

fs::path export_vtk(const Archive& archive, const fs::path& folder, const ExportOptions& options) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_system("create folder", folder, error.value());
  std::vector<StepEntry> steps = archive.outputs();
  if (!options.time.empty() || steps.empty())
    steps = {archive.select_output(options.time.empty() ? "last" : options.time)};
  const std::string name = archive.folder().filename().string();
  XmlElement root = collection_file(), points = collection_file();
  XmlElement& collection = root.children.front();
  bool any_particles = false;
  std::string series;
  for (const StepEntry& entry : steps) {
    const ArchiveStep step = archive.read_output(entry);
    const std::string base = step_folder_name(entry.step);
    const bool particles = export_particles(step, folder, options.labels, points.children.front());
    any_particles = any_particles || particles;
    const StepExport of_cells(step, options);
    if (of_cells.empty()) {
      if (particles) continue;
      throw InputError(step.folder().string() + " contains none of the requested labels");
    }
    const std::string file = of_cells.write(folder, base);
    if (step.grid().levels.size() > 1 && fits_vtk_amr(step.grid()))
      series += fmt::format("{}\n    {{\"name\": \"{}.vthb\", \"time\": {}}}",
                            series.empty() ? "" : ",", base, real_text(entry.time));
    collection.add("DataSet")
        .set("timestep", real_text(entry.time))
        .set("group", "")
        .set("part", "0")
        .set("file", file);
  }
  const fs::path of_points = folder / (name + "_particles.pvd");
  if (any_particles) write_text_atomically(of_points, to_text(points));
  if (collection.children.empty()) return of_points;
  const fs::path pvd = folder / (name + ".pvd");
  write_text_atomically(pvd, to_text(root));
  if (!series.empty())
    write_text_atomically(
        folder / (name + ".vthb.series"),
        "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [" + series + "\n  ]\n}\n");
  return pvd;
}

}  // namespace sluice

// Steps to images, hierarchies of images, and the .pvd file with their times.
#include "framework/archive/vtk_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/vtk_image.hpp"
#include "framework/base/error.hpp"

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

// The ratio of the directions that are refined; InputError when they are refined unequally.
int common_ratio(const Level& level) {
  int ratio = 0;
  for (int d = 0; d < 3; ++d) {
    if (level.domain.size()[d] == 1) continue;
    if (ratio != 0 && level.ratio[d] != ratio)
      throw InputError(fmt::format(
          "level {} is refined by {}: VTK's AMR format knows only one ratio for all directions; "
          "sluice extract gives the values of every level",
          level.index, triple_text(level.ratio)));
    ratio = level.ratio[d];
  }
  return std::max(ratio, 1);
}

std::vector<VtkLevel> vtk_levels(const Grid& grid) {
  std::vector<VtkLevel> levels;
  IntVec3 copies{1, 1, 1};
  for (const Level& level : grid.levels) {
    const int ratio = level.index > 0 ? common_ratio(level) : 1;
    for (int d = 0; d < 3; ++d) copies[d] *= ratio / level.ratio[d];
    levels.push_back({level, copies});
    for (int d = 0; d < 3; ++d) levels.back().level.spacing[d] /= copies[d];
  }
  return levels;
}

class StepExport {
 public:
  StepExport(const ArchiveStep& step, const ExportOptions& options) : step_(step) {
    std::map<std::string, std::set<int>> materials;
    for (const FieldInfo& f : step.fields()) materials[f.name].insert(f.material);
    for (const auto& [name, set] : materials) many_materials_[name] = set.size() > 1;
    for (const FieldInfo& f : step.fields())
      if (options.labels.selects(f.name)) fields_.push_back({f, step.read(f)});
    if (fields_.empty())
      throw InputError(step.folder().string() + " holds no label that was asked for");
  }

  // Writes NAME.vti or NAME.vthb and returns the file's name.
  std::string write(const fs::path& folder, const std::string& name) const {
    const Grid& grid = step_.grid();
    const Level& coarse = grid.levels.at(0);
    if (grid.levels.size() > 1 || coarse.cell_count() != coarse.domain.volume())
      return write_hierarchy(folder, name);
    write_vti(folder / (name + ".vti"), coarse, coarse.domain, false,
              arrays({coarse}, coarse.domain));
    return name + ".vti";
  }

 private:
  std::string write_hierarchy(const fs::path& folder, const std::string& name) const {
    make_folder(folder / name);
    const Grid& grid = step_.grid();
    const Vec3 origin = grid.levels[0].anchor;
    XmlElement root("VTKFile");
    root.set("type", "vtkOverlappingAMR")
        .set("version", "1.1")
        .set("byte_order", "LittleEndian")
        .set("header_type", "UInt64");
    XmlElement& amr = root.add("vtkOverlappingAMR");
    amr.set("origin", fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z))
        .set("grid_description", "XYZ");
    for (const VtkLevel& vtk : vtk_levels(grid)) {
      const Level& level = vtk.level;
      XmlElement& block = amr.add("Block");
      block.set("level", std::to_string(level.index))
          .set("spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                      level.spacing.z));
      for (std::size_t b = 0; b < level.boxes.size(); ++b) {
        const IndexBox c = vtk.spread(level.boxes[b].cells);
        const std::string file = fmt::format("{}/l{}_{:05}.vti", name, level.index, b);
        write_vti(folder / file, level, c, true, arrays(vtk, c));
        block.add("DataSet")
            .set("index", std::to_string(b))
            .set("amr_box", fmt::format("{} {} {} {} {} {}", c.lower.x, c.upper.x - 1, c.lower.y,
                                        c.upper.y - 1, c.lower.z, c.upper.z - 1))
            .set("file", file);
      }
    }
    write_text_atomically(folder / (name + ".vthb"), to_text(root));
    return name + ".vthb";
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
    a.values.reserve(static_cast<std::size_t>(range.volume() * a.components));
    for_each_cell(range, [&](IntVec3 place) {
      const IntVec3 c = vtk.source(place) + shift;
      const bool has = f && f->values.has(c);
      for (int m = 0; m < a.components; ++m) a.values.push_back(has ? f->values.at(c, m) : absent);
    });
    return a;
  }

  const ArchiveStep& step_;
  std::vector<LoadedField> fields_;
  std::map<std::string, bool> many_materials_;
};

}  // namespace

fs::path export_vtk(const Archive& archive, const fs::path& folder, const ExportOptions& options) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_system("create folder", folder, error.value());
  std::vector<StepEntry> steps = archive.outputs();
  if (!options.time.empty() || steps.empty())
    steps = {archive.select_output(options.time.empty() ? "last" : options.time)};
  const std::string name = archive.folder().filename().string();
  XmlElement root("VTKFile");
  root.set("type", "Collection").set("version", "1.0").set("byte_order", "LittleEndian");
  XmlElement& collection = root.add("Collection");
  for (const StepEntry& entry : steps) {
    const ArchiveStep step = archive.read_output(entry);
    const std::string file = StepExport(step, options).write(folder, step_folder_name(entry.step));
    collection.add("DataSet")
        .set("timestep", real_text(entry.time))
        .set("group", "")
        .set("part", "0")
        .set("file", file);
  }
  const fs::path pvd = folder / (name + ".pvd");
  write_text_atomically(pvd, to_text(root));
  return pvd;
}

}  // namespace sluice

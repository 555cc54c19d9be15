// Steps to images, hierarchies of images, and the .pvd file with their times.
#include "framework/archive/vtk_export.hpp"

#include <fmt/format.h>

#include <algorithm>
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
              arrays(coarse, coarse.domain));
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
    for (const Level& level : grid.levels) {
      XmlElement& block = amr.add("Block");
      block.set("level", std::to_string(level.index))
          .set("spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                      level.spacing.z));
      for (std::size_t b = 0; b < level.boxes.size(); ++b) {
        const IndexBox& c = level.boxes[b].cells;
        const std::string file = fmt::format("{}/l{}_{:05}.vti", name, level.index, b);
        write_vti(folder / file, level, c, true, arrays(level, c));
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
  std::vector<VtkArray> arrays(const Level& level, const IndexBox& cells) const {
    std::vector<VtkArray> made;
    std::set<std::string> names;
    for (const LoadedField& any : fields_) {
      const std::string name = array_name(any.info);
      if (!names.insert(name).second) continue;
      const LoadedField* f = nullptr;
      for (const LoadedField& g : fields_)
        if (g.info.level == level.index && array_name(g.info) == name) f = &g;
      const int face = face_direction(any.info.centring);
      if (face < 0) {
        made.push_back(fill(any.info, f, name, cells, {}));
      } else {
        IntVec3 up;
        up[face] = 1;
        made.push_back(fill(any.info, f, name + "_low", cells, {}));
        made.push_back(fill(any.info, f, name + "_high", cells, up));
      }
    }
    return made;
  }

  std::string array_name(const FieldInfo& f) const {
    return many_materials_.at(f.name) ? fmt::format("{}_{}", f.name, f.material) : f.name;
  }

  static VtkArray fill(const FieldInfo& info, const LoadedField* f, const std::string& name,
                       const IndexBox& cells, IntVec3 shift) {
    VtkArray a;
    a.name = name;
    a.on_points = info.centring == Centring::node;
    a.integers = info.type == ValueType::integer;
    a.components = info.components();
    const double absent = a.integers ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    const IndexBox range =
        a.on_points ? IndexBox{cells.lower, cells.upper + IntVec3{1, 1, 1}} : cells.shifted(shift);
    a.values.reserve(static_cast<std::size_t>(range.volume() * a.components));
    for_each_cell(range, [&](IntVec3 c) {
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

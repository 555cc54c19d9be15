// Outputs one after another, and the files with their times.
#include "framework/archive/vtk/vtk_export.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/particle_table.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/vtk/vtk_hierarchy.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

// The files of an archive over time.
class Collection {
 public:
  Collection() {
    root_.set("type", "Collection").set("version", "1.0").set("byte_order", "LittleEndian");
    root_.add("Collection");
  }
  void add(double time, int part, const std::string& name, const std::string& file) {
    XmlElement& entry = root_.children.front().add("DataSet");
    entry.set("timestep", real_text(time)).set("group", "").set("part", std::to_string(part));
    if (!name.empty()) entry.set("name", name);
    entry.set("file", file);
  }
  bool empty() const { return root_.children.front().children.empty(); }
  fs::path write(const fs::path& path) const {
    write_text_atomically(path, to_text(root_));
    return path;
  }

 private:
  XmlElement root_{"VTKFile"};
};

// The same of AMR data sets, which a .pvd cannot ask for finer levels.
class Series {
 public:
  void add(double time, const std::string& file) {
    entries_ += fmt::format("{}\n    {{\"name\": \"{}\", \"time\": {}}}",
                            entries_.empty() ? "" : ",", file, real_text(time));
  }
  bool empty() const { return entries_.empty(); }
  fs::path write(const fs::path& path) const {
    write_text_atomically(
        path, "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [" + entries_ + "\n  ]\n}\n");
    return path;
  }

 private:
  std::string entries_;
};

class Export {
 public:
  Export(const Archive& archive, const fs::path& folder, const ExportOptions& options)
      : archive_(archive), folder_(folder), options_(options), names_(archive) {}

  void add(const StepEntry& entry) {
    const ArchiveStep step = archive_.read_output(entry);
    const bool has_particles = add_particles(step);
    const VtkStep of_grid(step, options_.labels, names_);
    if (!of_grid.empty())
      add_grid(of_grid, step.grid(), entry);
    else if (!has_particles)
      throw InputError(step.folder().string() + " contains none of the requested labels");
  }

  fs::path finish() const {
    const std::string name = archive_.folder().filename().string();
    fs::path made;
    if (!points_.empty()) made = points_.write(folder_ / (name + "_particles.pvd"));
    if (!series_.empty()) made = series_.write(folder_ / (name + ".vthb.series"));
    if (!grids_.empty()) made = grids_.write(folder_ / (name + ".pvd"));
    return made;
  }

 private:
  bool add_particles(const ArchiveStep& step) {
    const auto wanted = [&](const FieldInfo& f) { return options_.labels.selects(f.name); };
    const auto& fields = step.particle_fields();
    if (std::none_of(fields.begin(), fields.end(), wanted)) return false;
    const std::vector<int> materials = particle_materials(step);
    for (const int material : materials) {
      const std::string file =
          fmt::format("{}_particles_{}.vtp", step_folder_name(step.info().step), material);
      write_particles(step, material, options_.labels, folder_ / file);
      points_.add(step.info().time, material, names_.described(material), file);
    }
    return !materials.empty();
  }

  void add_grid(const VtkStep& step, const Grid& grid, const StepEntry& entry) {
    const std::string name = step_folder_name(entry.step);
    const Level& coarse = grid.levels.at(0);
    if (grid.levels.size() > 1 && options_.amr) {
      if (!fits_vtk_amr(grid))
        throw InputError(archive_.folder().string() +
                         ": AMR data sets have one refinement ratio for all directions, this run "
                         "has several; export it without --amr");
      series_.add(entry.time, write_vtk_amr(step, grid, folder_, name));
    } else if (grid.levels.size() > 1 || coarse.cell_count() != coarse.domain.volume()) {
      grids_.add(entry.time, 0, "", write_vtk_blocks(step, grid, folder_, name));
    } else {
      const VtkLevel level{coarse};
      write_vti(folder_ / (name + ".vti"), coarse, coarse.domain, false,
                step.arrays(level, coarse.domain));
      grids_.add(entry.time, 0, "", name + ".vti");
    }
  }

  const Archive& archive_;
  const fs::path& folder_;
  const ExportOptions& options_;
  ArrayNames names_;
  Collection grids_, points_;
  Series series_;
};

}  // namespace

fs::path export_vtk(const Archive& archive, const fs::path& folder, const ExportOptions& options) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_system("create folder", folder, error.value());
  std::vector<StepEntry> steps = archive.outputs();
  if (!options.time.empty() || steps.empty())
    steps = {archive.select_output(options.time.empty() ? "last" : options.time)};
  Export files(archive, folder, options);
  for (const StepEntry& entry : steps) files.add(entry);
  return files.finish();
}

}  // namespace sluice

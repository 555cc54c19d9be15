// Images and the XML that names them: .vtm with marked cells, .vthb with boxes of indices.
#include "framework/archive/vtk/vtk_hierarchy.hpp"

#include <fmt/format.h>

#include "framework/archive/drawing/covered_cells.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

// The file of a box within the export.
std::string box_file(const std::string& name, int level, std::size_t box) {
  return fmt::format("{}/l{}_{:05}.vti", name, level, box);
}

XmlElement vtk_root(const char* type, const char* version) {
  XmlElement root("VTKFile");
  root.set("type", type)
      .set("version", version)
      .set("byte_order", "LittleEndian")
      .set("header_type", "UInt64");
  return root;
}

std::string reals(Vec3 v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z);
}

VtkArray ghosts(const CoveredCells& covered, const IndexBox& cells) {
  VtkArray a{"vtkGhostType", StoredType::uint8, false, 1, cells.volume(), {}};
  a.put = [&covered, cells](VtkValues& out) {
    for (const std::uint8_t type : covered.ghost_types(cells)) out.add(static_cast<double>(type));
  };
  return a;
}

}  // namespace

std::string write_vtk_blocks(const VtkStep& step, const Grid& grid, const fs::path& folder,
                             const std::string& name) {
  make_folder(folder / name);
  XmlElement root = vtk_root("vtkMultiBlockDataSet", "1.0");
  XmlElement& blocks = root.add("vtkMultiBlockDataSet");
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    const VtkLevel level{grid.levels[l]};
    const CoveredCells covered(grid, l);
    XmlElement& block = blocks.add("Block");
    block.set("index", std::to_string(l)).set("name", fmt::format("level {}", l));
    for (std::size_t b = 0; b < level.level.boxes.size(); ++b) {
      const IndexBox& cells = level.level.boxes[b].cells;
      const std::string file = box_file(name, level.level.index, b);
      std::vector<VtkArray> arrays = step.arrays(level, cells);
      if (covered.any(cells)) arrays.push_back(ghosts(covered, cells));
      write_vti(folder / file, level.level, cells, true, arrays);
      block.add("DataSet")
          .set("index", std::to_string(b))
          .set("name", fmt::format("box {}", b))
          .set("file", file);
    }
  }
  write_text_atomically(folder / (name + ".vtm"), to_text(root));
  return name + ".vtm";
}

std::string write_vtk_amr(const VtkStep& step, const Grid& grid, const fs::path& folder,
                          const std::string& name) {
  make_folder(folder / name);
  XmlElement root = vtk_root("vtkOverlappingAMR", "1.1");
  XmlElement& amr = root.add("vtkOverlappingAMR");
  amr.set("origin", reals(grid.levels[0].anchor)).set("grid_description", "XYZ");
  for (const VtkLevel& vtk : vtk_amr_levels(grid)) {
    const Level& level = vtk.level;
    XmlElement& block = amr.add("Block");
    block.set("level", std::to_string(level.index)).set("spacing", reals(level.spacing));
    for (std::size_t b = 0; b < level.boxes.size(); ++b) {
      const IndexBox c = vtk.spread(level.boxes[b].cells);
      const std::string file = box_file(name, level.index, b);
      write_vti(folder / file, level, c, true, step.arrays(vtk, c));
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

}  // namespace sluice

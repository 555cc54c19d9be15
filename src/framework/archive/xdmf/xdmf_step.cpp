// Boxes of all files of a step, and where the values of each label lie in them.
#include "framework/archive/xdmf/xdmf_step.hpp"

#include <fmt/format.h>

#include "framework/archive/field_file_reader.hpp"
#include "framework/archive/particle_table.hpp"

namespace sluice {
namespace fs = std::filesystem;
namespace {

// Values of one box in a data set of one dimension, component after component.
struct Range {
  std::string data_set;  // FILE:/GROUP/values
  std::int64_t total = 0, start = 0, count = 0;
  StoredType stored = StoredType::float64;
  int components = 1;
};

// Floating point is XDMF's default, and 4 bytes are.
void set_number_type(XmlElement& item, StoredType stored) {
  if (stored == StoredType::uint8) item.set("NumberType", "UChar");
  if (stored == StoredType::int32 || stored == StoredType::int64) item.set("NumberType", "Int");
  if (size_of(stored) != 4) item.set("Precision", std::to_string(size_of(stored)));
}

void add_component(XmlElement& parent, const Range& range, int component, const std::string& dims) {
  XmlElement& slab = parent.add("DataItem").set("ItemType", "HyperSlab").set("Dimensions", dims);
  // Integers of 8 bytes: as floats, the default, places beyond 2^24 would be others.
  slab.add("DataItem", fmt::format("{} 1 {}", range.start + component * range.count, range.count))
      .set("Dimensions", "3")
      .set("NumberType", "Int")
      .set("Precision", "8")
      .set("Format", "XML");
  XmlElement& whole =
      slab.add("DataItem", range.data_set).set("Dimensions", std::to_string(range.total));
  set_number_type(whole, range.stored);
  whole.set("Format", "HDF");
}

void add_values(XmlElement& parent, const Range& range, const std::string& dims) {
  if (range.components == 1) return add_component(parent, range, 0, dims);
  std::string arguments;
  for (int c = 0; c < range.components; ++c) arguments += fmt::format("{}${}", c ? "," : "", c);
  XmlElement& joined = parent.add("DataItem")
                           .set("ItemType", "Function")
                           .set("Function", "JOIN(" + arguments + ")")
                           .set("Dimensions", fmt::format("{} {}", dims, range.components));
  for (int c = 0; c < range.components; ++c) add_component(joined, range, c, dims);
}

XmlElement attribute(const std::string& name, const char* centre, const Range& range,
                     const std::string& dims) {
  XmlElement a("Attribute");
  a.set("Name", name).set("Center", centre);
  if (range.components == 3) a.set("AttributeType", "Vector");
  if (range.components == 9) a.set("AttributeType", "Tensor");
  add_values(a, range, dims);
  return a;
}

XmlElement collection(const std::string& name) {
  XmlElement c("Grid");
  c.set("Name", name).set("GridType", "Collection").set("CollectionType", "Spatial");
  return c;
}

// Slowest direction first, as XDMF counts.
std::string dims_of(IntVec3 n) {
  return fmt::format("{} {} {}", n.z, n.y, n.x);
}
std::string reals_of(Vec3 v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.z, v.y, v.x);
}

XmlElement image(const Level& level, const IndexBox& box, const std::string& name) {
  Vec3 origin = level.anchor;
  for (int d = 0; d < 3; ++d) origin[d] += box.lower[d] * level.spacing[d];
  XmlElement grid("Grid");
  grid.set("Name", name);
  grid.add("Topology")
      .set("TopologyType", "3DCoRectMesh")
      .set("Dimensions", dims_of(box.size() + IntVec3{1, 1, 1}));
  XmlElement& geometry = grid.add("Geometry").set("GeometryType", "ORIGIN_DXDYDZ");
  for (const Vec3& v : {origin, level.spacing})
    geometry.add("DataItem", reals_of(v))
        .set("Dimensions", "3")
        .set("Precision", "8")
        .set("Format", "XML");
  return grid;
}

class StepText {
 public:
  StepText(const XdmfContext& context, const StepRecord& record, const CoveredBoxes& covered)
      : context_(context), record_(record), covered_(covered) {}

  void add_file(FieldFileReader& file, const std::string& href) {
    for (const StoredVariable& v : file.variables()) {
      if (v.level < 0 || static_cast<std::size_t>(v.level) >= record_.grid.levels.size())
        throw DamageError(fmt::format("{}: {} is on level {}, which the grid does not have", href,
                                      v.name, v.level));
      if (v.centring == Centring::cell) add_cells(file, v, href);
      if (v.centring == Centring::particle) add_particles(file, v, href);
    }
    flush_particles();
  }

  XmlElement text() const {
    XmlElement step = collection(step_folder_name(record_.info.step));
    step.add("Time").set("Value", real_text(record_.info.time));
    std::vector<XmlElement> levels(record_.grid.levels.size());
    for (std::size_t l = 0; l < levels.size(); ++l)
      levels[l] = collection(fmt::format("level {}", l));
    for (const auto& [key, grid] : images_) levels[key[0]].children.push_back(grid);
    for (XmlElement& level : levels)
      if (!level.children.empty()) step.children.push_back(std::move(level));
    for (const auto& [material, points] : particles_) step.children.push_back(points);
    return step;
  }

 private:
  static Range range_of(const StoredVariable& v, const std::string& href) {
    Range r;
    r.data_set = href + ":" + v.group() + "/values";
    r.total = v.bytes / static_cast<std::int64_t>(size_of(v.stored));
    r.stored = v.stored;
    r.components = component_count(v.type);
    return r;
  }

  void add_cells(FieldFileReader& file, const StoredVariable& v, const std::string& href) {
    Range range = range_of(v, href);
    for (const StoredBox& b : file.boxes(v)) {
      range.count = b.stored.volume();
      image_of(v.level, b.stored)
          .children.push_back(attribute(context_.names->of(v.name, v.material), "Cell", range,
                                        dims_of(b.stored.size())));
      range.start += range.count * range.components;
    }
  }

  XmlElement& image_of(int level, const IndexBox& box) {
    const BoxKey key = key_of(level, box);
    const auto it = images_.find(key);
    if (it != images_.end()) return it->second;
    XmlElement grid = image(record_.grid.levels[level], box, fmt::format("box {}", images_.size()));
    if (const auto marks = covered_.find(key); marks != covered_.end()) {
      const Range range{context_.covered_file + ":/covered",
                        context_.covered_total,
                        marks->second,
                        box.volume(),
                        StoredType::uint8,
                        1};
      grid.children.push_back(attribute("vtkGhostType", "Cell", range, dims_of(box.size())));
    }
    return images_.emplace(key, std::move(grid)).first->second;
  }

  // All variables of a material and level have the same boxes in the same order.
  void add_particles(FieldFileReader& file, const StoredVariable& v, const std::string& href) {
    std::vector<XmlElement>& grids = points_[{v.material, v.level}];
    const std::vector<StoredBox>& boxes = file.boxes(v);
    if (grids.empty()) grids.assign(boxes.size(), XmlElement("Grid"));
    if (grids.size() != boxes.size())
      throw DamageError(fmt::format("{}: {} has {} boxes of particles, others have {}", href,
                                    v.group(), boxes.size(), grids.size()));
    Range range = range_of(v, href);
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      range.count = boxes[n].stored.volume();
      add_points(grids[n], v, range);
      range.start += range.count * range.components;
    }
  }

  void add_points(XmlElement& grid, const StoredVariable& v, const Range& range) const {
    const std::string count = std::to_string(range.count);
    if (v.name != particle_position_name) {
      grid.children.push_back(
          attribute(context_.names->of(v.name, v.material), "Node", range, count));
      return;
    }
    XmlElement geometry("Geometry"), topology("Topology");
    geometry.set("GeometryType", "X_Y_Z");
    for (int c = 0; c < 3; ++c) add_component(geometry, range, c, count);
    topology.set("TopologyType", "Polyvertex").set("NumberOfElements", count);
    grid.children.insert(grid.children.begin(), {topology, geometry});
  }

  void flush_particles() {
    for (auto& [key, grids] : points_) {
      const auto [it, is_new] = particles_.try_emplace(key.first);
      if (is_new) it->second = collection("particles of " + context_.names->described(key.first));
      for (XmlElement& grid : grids) {
        grid.set("Name", fmt::format("part {}", it->second.children.size()));
        it->second.children.push_back(std::move(grid));
      }
    }
    points_.clear();
  }

  const XdmfContext& context_;
  const StepRecord& record_;
  const CoveredBoxes& covered_;
  std::map<BoxKey, XmlElement> images_;
  std::map<int, XmlElement> particles_;                            // by material
  std::map<std::pair<int, int>, std::vector<XmlElement>> points_;  // of one file
};

}  // namespace

XmlElement xdmf_step(const XdmfContext& context, const StepRecord& record,
                     const CoveredBoxes& covered, const fs::path& href, const fs::path& folder) {
  StepText text(context, record, covered);
  for (const std::string& name : record.data_files) {
    FieldFileReader file(folder / fs::path(name).filename());
    text.add_file(file, (href / fs::path(name).filename().replace_extension(".h5")).string());
  }
  return text.text();
}

}  // namespace sluice

// Geometry pieces and the operators that join them.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

TagSpec piece(const std::string& name, const std::string& doc) {
  return tag(name, doc).multiple().attribute(
      attribute("label", "name; an empty tag with the label of another piece repeats it")
          .text()
          .alias("name"));
}

TagSpec place(const std::string& name, const std::string& doc) {
  return tag(name, doc).vector().unit("length");
}
TagSpec length(const std::string& name, const std::string& doc) {
  return tag(name, doc).real().above(0).unit("length");
}
TagSpec count(const std::string& name, const std::string& doc) {
  return tag(name, doc).real().above(0);
}

std::vector<TagSpec> flat_pieces() {
  return {
      piece("box", "axis-parallel box, faces included")
          .with_children({place("min", "low corner").once(), place("max", "high corner").once()}),
      piece("parallelepiped", "skewed box from one corner and its three neighbours")
          .with_children({place("p1", "corner").once(), place("p2", "neighbour of p1").once(),
                          place("p3", "neighbour of p1").once(),
                          place("p4", "neighbour of p1").once()}),
      piece("polyhedron", "convex body: intersection of half spaces")
          .with_children({place("center", "a point inside").once(),
                          tag("bounds", "the half spaces")
                              .once()
                              .child(tag("half_space", "one half space")
                                         .at_least_once()
                                         .attribute(attribute("type", "how the plane is given")
                                                        .once()
                                                        .words({"absolute", "relative"}))
                                         .with_children({place("planePoint", "point of the plane")
                                                             .once()
                                                             .only_for("type", {"absolute"}),
                                                         tag("normal", "normal, pointing inwards")
                                                             .once()
                                                             .vector()
                                                             .only_for("type", {"absolute"}),
                                                         place("offset", "plane point minus center")
                                                             .once()
                                                             .only_for("type", {"relative"})}))}),
      piece("corrugated", "plate with one corrugated edge")
          .with_children(
              {place("xymin", "low corner").once(), place("xymax", "high corner").once(),
               length("thickness", "extent in z").once(),
               tag("normal", "normal of the plate").once().vector(),
               tag("corr_edge", "the corrugated edge").once().words({"x+", "x-", "y+", "y-"}),
               tag("curve", "shape of the corrugation").once().words({"sin", "cos"}),
               length("wavelength", "length of one wave").once(),
               tag("amplitude", "height of a wave").once().real().unit("length")}),
  };
}

std::vector<TagSpec> round_pieces() {
  return {
      piece("sphere", "ball, surface included")
          .with_children({place("origin", "centre").once().alias("center"),
                          length("radius", "radius").once()}),
      piece("cylinder", "cylinder between two discs")
          .with_children({place("bottom", "centre of one end").once(),
                          place("top", "centre of the other end").once(),
                          length("radius", "radius").once(),
                          tag("cylinder_end", "for pressure on particles").boolean(),
                          tag("axisymmetric_end", "for pressure on particles").boolean(),
                          tag("axisymmetric_side", "for pressure on particles").boolean()}),
      piece("cone", "frustum between two discs")
          .with_children({place("bottom", "centre of one end").once(),
                          place("top", "centre of the other end").once(),
                          tag("bottom_radius", "radius at the bottom").once().real().at_least(0),
                          tag("top_radius", "radius at the top").once().real().at_least(0)}),
      piece("ellipsoid", "ellipsoid with half axes along x, y, z or along v1, v2, v3")
          .with_children({place("origin", "centre").once(), length("rx", "half axis along x"),
                          length("ry", "half axis along y"), length("rz", "half axis along z"),
                          place("v1", "first half axis"), place("v2", "second half axis"),
                          place("v3", "third half axis")}),
      piece("torus", "ring")
          .with_children(
              {place("center", "centre").once(),
               length("major_radius", "radius of the ring's middle line").once(),
               length("minor_radius", "radius of the ring's cross-section").once(),
               tag("axis", "axis of the ring")
                   .once()
                   .words({"x", "y", "z"})
                   .spelling("X", "x")
                   .spelling("Y", "y")
                   .spelling("Z", "z"),
               tag("theta", "rotation of the axis").real().by_default("0").unit("radian")}),
      piece("smoothcyl", "hollow cylinder whose particles follow the surface")
          .with_children(
              {tag("discretization_scheme", "arrangement of the particles")
                   .words({"pie_slices", "constant_particle_volumes"})
                   .by_default("pie_slices"),
               place("bottom", "centre of one end").once(),
               place("top", "centre of the other end").once(),
               tag("inner_radius", "inner radius")
                   .real()
                   .at_least(0)
                   .unit("length")
                   .by_default("0"),
               length("outer_radius", "radius"),
               count("num_radial", "particles along the radius").once(),
               count("num_axial", "particles along the axis").once(),
               count("num_angular", "particles around"),
               tag("arc_start_angle", "start of the arc").real().unit("degree"),
               tag("arc_angle", "length of the arc").real().unit("degree"),
               tag("endcap_thickness", "thickness of the end caps").real().unit("length")}),
  };
}

std::vector<TagSpec> thin_pieces() {
  const TagSpec radius = length("radius", "radius of the middle surface").once();
  const TagSpec thickness = length("thickness", "thickness").once();
  return {
      piece("sphere_membrane", "thin ball shell for membranes")
          .with_children({place("origin", "centre").once(), radius, thickness,
                          count("num_lat", "particles along a meridian").once(),
                          count("num_long", "particles along the equator").once()}),
      piece("sphere_shell", "ball shell")
          .with_children({place("origin", "centre").once(), radius, thickness,
                          count("num_lat", "particles along a meridian").once(),
                          count("num_long", "particles along the equator").once()}),
      piece("cylinder_shell", "tube")
          .with_children({place("bottom", "centre of one end").once(),
                          place("top", "centre of the other end").once(), radius, thickness,
                          count("num_axis", "particles along the axis").once(),
                          count("num_circum", "particles around").once()}),
      piece("plane_shell", "disc")
          .with_children({place("center", "centre").once(),
                          tag("normal", "normal of the disc").once().vector(), radius, thickness,
                          count("num_radius", "particles along the radius").once()}),
  };
}

std::vector<TagSpec> listed_pieces() {
  return {
      piece("tri", "body inside a closed surface of triangles")
          .child(tag("name", "files NAME.pts and NAME.tri").once().file({".tri", ".pts"})),
      piece("line_segment", "body over a closed polygon in the x-y plane")
          .child(tag("name", "file of the polygon's corners").once().file()),
      // The label of a file piece is not called name: that is its child.
      tag("file", "particles listed in a file")
          .multiple()
          .attribute(attribute("label", "name of the piece").text())
          .with_children({tag("name", "file").once().file(),
                          tag("var", "a variable in each row after x y z").multiple().text(),
                          tag("format", "format of the file")
                              .words({"text", "bin", "lsb", "msb"})
                              .by_default("text"),
                          tag("usePFS", "one file per patch").boolean().by_default("true")}),
      tag("image", "voxels of a file with grey values between two thresholds")
          .multiple()
          .attribute(attribute("label", "name of the piece").text())
          .with_children(
              {tag("name", "file of one byte per voxel, x fastest").once().file(),
               tag("res", "voxels per direction").once().int_vector().at_least(1),
               tag("threshold", "smallest and largest grey value, 0 to 255")
                   .once()
                   .integers()
                   .at_least(0)
                   .at_most(255),
               place("lower", "low corner of the image; absent: low corner of the domain"),
               place("upper", "high corner of the image; absent: high corner of the domain")}),
      piece("null", "all of space"),
  };
}

TagSpec joined(const std::string& name, const std::string& doc) {
  return piece(name, doc).group("geometry_piece");
}

void check_piece(const DeckNode& node, std::vector<Fault>& faults) {
  const auto pieces = node.children.size();
  if (node.name == "difference" && pieces != 2) {
    add_error(faults, node.where,
              fmt::format("<difference> has {} pieces; it takes exactly two, the second "
                          "cut out of the first",
                          pieces),
              "join several pieces with <union>");
  }
  if ((node.name == "union" || node.name == "intersection") && pieces == 0) {
    add_error(faults, node.where, fmt::format("<{}> has no pieces", node.name));
  }
  const auto low = vector_of(&node, "min");
  const auto high = vector_of(&node, "max");
  if (node.name != "box" || !low || !high) return;
  for (int d = 0; d < 3; ++d) {
    if ((*low)[d] <= (*high)[d]) continue;
    add_error(faults, node.child("max")->where,
              fmt::format("<box> is inverted in {}: min {} is above max {}", direction_names[d],
                          (*low)[d], (*high)[d]),
              "exchange the two");
  }
}

void check_pieces_below(const DeckNode& node, std::vector<Fault>& faults) {
  check_piece(node, faults);
  for (const auto& child : node.children) check_pieces_below(*child, faults);
}

void place_images_below(DeckNode& node, Vec3 lower, Vec3 upper) {
  for (const auto& child : node.children) place_images_below(*child, lower, upper);
  if (node.name != "image" || node.children.empty()) return;
  for (const auto& [name, place] : {std::pair("lower", lower), std::pair("upper", upper)}) {
    if (node.child(name) != nullptr) continue;
    auto corner = std::make_unique<DeckNode>();
    corner->name = name;
    corner->text = fmt::format("[{},{},{}]", place.x, place.y, place.z);
    corner->where = node.where;
    node.children.push_back(std::move(corner));
  }
}

std::vector<TagSpec> all_pieces() {
  std::vector<TagSpec> pieces;
  for (const auto& set : {flat_pieces(), round_pieces(), thin_pieces(), listed_pieces()}) {
    pieces.insert(pieces.end(), set.begin(), set.end());
  }
  pieces.push_back(joined("union", "points in any of the pieces"));
  pieces.push_back(joined("intersection", "points in all of the pieces"));
  pieces.push_back(joined("difference", "points in the first piece and not in the second"));
  return pieces;
}

// Images without corners fill the domain: the corners are written into the tree.
void place_images(DeckNode& root, std::vector<Fault>& /*faults*/) {
  const DeckNode* level = root.find("Grid/Level");
  std::optional<Vec3> lower, upper;
  if (level != nullptr)
    for (const DeckNode* box : level->all("Box")) {
      const auto low = vector_of(box, "lower"), high = vector_of(box, "upper");
      if (!low || !high) continue;
      if (!lower || !upper) {
        lower = low;
        upper = high;
      }
      for (int d = 0; d < 3; ++d) {
        (*lower)[d] = std::min((*lower)[d], (*low)[d]);
        (*upper)[d] = std::max((*upper)[d], (*high)[d]);
      }
    }
  if (lower && upper) place_images_below(root, *lower, *upper);
}

// Decks of a thickness mean the inner radius by it.
void read_thickness(DeckNode& node, std::vector<Fault>& faults) {
  for (const auto& child : node.children) read_thickness(*child, faults);
  DeckNode* thickness = node.name == "smoothcyl" ? node.child("thickness") : nullptr;
  if (thickness == nullptr || node.child("inner_radius") != nullptr) return;
  const auto outer = real_of(&node, "outer_radius"), part = real_of(&node, "thickness");
  if (!outer || !part) return;
  add_warning(faults, thickness->where,
              "<thickness> of <smoothcyl> is obsolete; read as <inner_radius>, the outer radius "
              "minus the thickness");
  thickness->name = "inner_radius";
  thickness->text = fmt::format("{}", *outer - *part);
}

void read_thicknesses(DeckNode& root, std::vector<Fault>& faults) {
  read_thickness(root, faults);
}

}  // namespace

bool is_geometry_piece(std::string_view name) {
  static const std::vector<TagSpec> pieces = all_pieces();
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](const TagSpec& known) { return known.name == name; });
}

void add_geometry_tags(Schema& schema) {
  schema.groups["geometry_piece"] = all_pieces();
  schema.rewrites.emplace_back(place_images);
  schema.rewrites.emplace_back(read_thicknesses);
  schema.completions.emplace_back(resolve_piece_labels);
  schema.rules.emplace_back(check_pieces);
}

void check_pieces(const DeckNode& root, std::vector<Fault>& faults) {
  for (const char* path : {"MaterialProperties/ICE", "MaterialProperties/MPM",
                           "MaterialProperties/Peridynamics", "PhysicalBC", "AMR"})
    if (const DeckNode* block = root.find(path)) check_pieces_below(*block, faults);
}

}  // namespace sluice

// One geometry piece (not a boolean operator) from its tag.
#include "framework/scene/make_piece.hpp"

#include <fmt/format.h>

#include "framework/deck/data_file.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/corrugated.hpp"
#include "framework/geometry/image.hpp"
#include "framework/geometry/point_file.hpp"
#include "framework/geometry/polygon.hpp"
#include "framework/geometry/round.hpp"
#include "framework/geometry/shell.hpp"
#include "framework/geometry/smooth_cylinder.hpp"
#include "framework/geometry/triangulation.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

// `ending`: what is added to the name before the file is looked for.
std::string find_file(const DeckNode& node, const std::string& ending) {
  const DeckNode& name = node.need("name");
  std::vector<Fault> told;  // when the deck was read
  const std::string path = find_data_file(name.text, ending, name.where, told);
  return path.empty() ? name.text : path;
}

PiecePtr make_sphere(const DeckNode& node) {
  const DeckNode* origin = node.child("origin");
  if (origin == nullptr) origin = node.child("center");
  if (origin == nullptr) throw InputError("sphere: no origin (or center)");
  return std::make_shared<SpherePiece>(origin->as_vector(), node.real("radius"));
}

PiecePtr make_ellipsoid(const DeckNode& node) {
  const Vec3 origin = node.vector("origin");
  if (node.child("v1") != nullptr && node.child("v2") != nullptr && node.child("v3") != nullptr)
    return std::make_shared<EllipsoidPiece>(origin, node.vector("v1"), node.vector("v2"),
                                            node.vector("v3"));
  if (node.child("rx") == nullptr || node.child("ry") == nullptr || node.child("rz") == nullptr)
    throw InputError("ellipsoid: give rx, ry, rz or v1, v2, v3");
  return std::make_shared<EllipsoidPiece>(origin, Vec3{node.real("rx"), 0, 0},
                                          Vec3{0, node.real("ry"), 0}, Vec3{0, 0, node.real("rz")});
}

PiecePtr make_torus(const DeckNode& node) {
  const std::string axis = text_or(node, "axis", "z");
  if (axis != "x" && axis != "y" && axis != "z")
    throw InputError(fmt::format("torus: axis is '{}'; it must be x, y or z", axis));
  return std::make_shared<TorusPiece>(node.vector("center"), node.real("major_radius"),
                                      node.real("minor_radius"), axis[0] - 'x',
                                      real_or(node, "theta", 0));
}

PiecePtr make_polyhedron(const DeckNode& node) {
  const Vec3 center = node.vector("center");
  std::vector<HalfSpace> faces;
  for (const DeckNode* f : node.need("bounds").all("half_space")) {
    if (f->attribute("type").value_or("absolute") == "relative") {
      const Vec3 offset = f->vector("offset");
      faces.push_back({center + offset, -1.0 * offset});
    } else {
      faces.push_back({f->vector("planePoint"), f->vector("normal")});
    }
  }
  return std::make_shared<PolyhedronPiece>(center, std::move(faces));
}

PiecePtr make_smooth_cylinder(const DeckNode& node) {
  SmoothCylinder c;
  c.discretization_scheme = text_or(node, "discretization_scheme", "");
  if (c.discretization_scheme != "pie_slices" &&
      c.discretization_scheme != "constant_particle_volumes")
    throw InputError(
        fmt::format("smoothcyl: discretization_scheme is '{}'; it must be pie_slices "
                    "or constant_particle_volumes",
                    c.discretization_scheme));
  c.bottom = node.vector("bottom");
  c.top = node.vector("top");
  c.inner_radius = real_or(node, "inner_radius", 0);
  if (node.child("outer_radius") == nullptr) throw InputError("smoothcyl: no outer_radius");
  c.outer_radius = node.real("outer_radius");
  c.num_radial = static_cast<int>(node.real("num_radial"));
  c.num_axial = static_cast<int>(node.real("num_axial"));
  c.num_angular = static_cast<int>(real_or(node, "num_angular", 1));
  c.arc_start_angle = real_or(node, "arc_start_angle", 0);
  c.arc_angle = real_or(node, "arc_angle", 360);
  c.endcap_thickness = real_or(node, "endcap_thickness", 0);
  return std::make_shared<SmoothCylinderPiece>(c);
}

PiecePtr make_corrugated(const DeckNode& node) {
  CorrugatedPlate p;
  p.xymin = node.vector("xymin");
  p.xymax = node.vector("xymax");
  p.thickness = node.real("thickness");
  const Vec3 normal = vector_or(node, "normal", {0, 0, 1});
  if (normal.x != 0 || normal.y != 0 || !(normal.z > 0))
    throw InputError("corrugated: the normal must point along +z");
  const std::string edge = text_or(node, "corr_edge", "x+");
  if (edge != "x+" && edge != "x-" && edge != "y+" && edge != "y-")
    throw InputError(
        fmt::format("corrugated: corr_edge is '{}'; it must be x+, x-, y+ or y-", edge));
  p.edge_direction = edge[0] - 'x';
  p.edge_plus = edge[1] == '+';
  const std::string curve = text_or(node, "curve", "sin");
  if (curve != "sin" && curve != "cos")
    throw InputError(fmt::format("corrugated: curve is '{}'; it must be sin or cos", curve));
  p.cosine = curve == "cos";
  p.wavelength = node.real("wavelength");
  p.amplitude = node.real("amplitude");
  return std::make_shared<CorrugatedPiece>(p);
}

PiecePtr make_point_file(const DeckNode& node) {
  const std::string format = text_or(node, "format", "text");
  PointFormat f = PointFormat::text;
  if (format == "bin")
    f = PointFormat::binary;
  else if (format == "lsb")
    f = PointFormat::binary_little_endian;
  else if (format == "msb")
    f = PointFormat::binary_big_endian;
  else if (format != "text" && format != "split")
    throw InputError(fmt::format("file: format is '{}'; it must be text, bin, lsb or msb", format));
  std::vector<std::string> variables;
  for (const DeckNode* v : node.all("var")) variables.push_back(v->text);
  return std::make_shared<PointFilePiece>(read_point_file(find_file(node, ""), f, variables));
}

PiecePtr make_image(const DeckNode& node) {
  const std::vector<double> range = node.need("threshold").as_reals();
  if (range.size() != 2)
    throw InputError(
        fmt::format("image: threshold has {} numbers; expected the smallest and the largest grey "
                    "value, as [0,255]",
                    range.size()));
  return read_image(find_file(node, ""), node.int_vector("res"), static_cast<int>(range[0]),
                    static_cast<int>(range[1]), {node.vector("lower"), node.vector("upper")});
}

}  // namespace

PiecePtr make_piece(const DeckNode& node) {
  const std::string& tag = node.name;
  if (tag == "box") return std::make_shared<BoxPiece>(node.vector("min"), node.vector("max"));
  if (tag == "sphere") return make_sphere(node);
  if (tag == "cylinder")
    return make_cylinder(node.vector("bottom"), node.vector("top"), node.real("radius"));
  if (tag == "cone")
    return std::make_shared<ConePiece>(node.vector("bottom"), node.vector("top"),
                                       node.real("bottom_radius"), node.real("top_radius"));
  if (tag == "ellipsoid") return make_ellipsoid(node);
  if (tag == "torus") return make_torus(node);
  if (tag == "parallelepiped")
    return std::make_shared<ParallelepipedPiece>(node.vector("p1"), node.vector("p2"),
                                                 node.vector("p3"), node.vector("p4"));
  if (tag == "polyhedron") return make_polyhedron(node);
  if (tag == "tri")
    return std::make_shared<TriangulationPiece>(read_triangulation(find_file(node, ".tri")));
  if (tag == "line_segment")
    return std::make_shared<PolygonPiece>(read_polygon(find_file(node, "")));
  if (tag == "smoothcyl") return make_smooth_cylinder(node);
  if (tag == "file") return make_point_file(node);
  if (tag == "image") return make_image(node);
  if (tag == "plane_shell")
    return make_plane_shell(node.vector("center"), node.vector("normal"), node.real("radius"),
                            node.real("thickness"));
  if (tag == "sphere_shell" || tag == "sphere_membrane")
    return make_sphere_shell(node.vector("origin"), node.real("radius"), node.real("thickness"));
  if (tag == "cylinder_shell")
    return make_cylinder_shell(node.vector("bottom"), node.vector("top"), node.real("radius"),
                               node.real("thickness"));
  if (tag == "corrugated") return make_corrugated(node);
  if (tag == "null") return std::make_shared<EverywherePiece>();
  throw InputError(fmt::format("the geometry piece <{}> cannot be built", tag));
}

}  // namespace sluice

// <PhysicalBC><MPM>: load curves and the surfaces on which they act.
#include <fmt/format.h>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/geometry/box.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

// An empty piece with a label stands for the piece that carries it: flags stand there.
void read_surface(const DeckNode& load, const GeometryReader& geometry, LoadCurve& curve,
                  std::vector<Fault>& faults) {
  const DeckNode& object = load.need("geom_object");
  const DeckNode* piece = nullptr;
  for (const auto& child : object.children) {
    if (!is_geometry_piece(child->name)) continue;
    if (piece != nullptr)
      add_error(faults, child->where, fmt::format("<{}> acts on one geometry piece", load.name),
                "write a block for each");
    piece = child.get();
  }
  if (piece == nullptr) {
    add_error(faults, object.where, "<geom_object> without a geometry piece");
    return;
  }
  curve.shape = piece->name;
  const bool torque = load.name == "torque";
  const bool known =
      curve.shape == "cylinder" || (!torque && (curve.shape == "box" || curve.shape == "sphere"));
  if (!known)
    add_error(faults, piece->where,
              fmt::format("<{}> acts on a surface of <{}>, not of <{}>", load.name,
                          torque ? "cylinder" : "box>, <cylinder> or <sphere", curve.shape));
  curve.ends = boolean_or(*piece, "cylinder_end", false);
  curve.axisymmetric_end = boolean_or(*piece, "axisymmetric_end", false);
  curve.axisymmetric_side = boolean_or(*piece, "axisymmetric_side", false);
  curve.piece = geometry.piece(*piece, faults);
}

void read_curve(const DeckNode& load, LoadCurve& curve) {
  const DeckNode& node = load.need("load_curve");
  curve.id = node.integer("id");
  const int material = integer_or(node, "material", -99);
  if (material >= 0) curve.material = material;
  for (const DeckNode* point : node.all("time_point"))
    curve.points.emplace_back(point->real("time"), point->real("load"));
}

LoadCurve read_force(const DeckNode& node, std::vector<Fault>& faults) {
  LoadCurve curve;
  curve.kind = LoadCurve::Kind::force;
  curve.shape = "box";
  curve.where = node.where;
  curve.force = node.vector("force_density");
  curve.points = {{0, 1}};
  const Vec3 lower = node.vector("lower"), upper = node.vector("upper");
  for (int d = 0; d < 3; ++d)
    if (lower[d] > upper[d]) {
      add_error(faults, node.need("upper").where,
                fmt::format("<force>: upper {:g} is below lower {:g} in {}", upper[d], lower[d],
                            "xyz"[d]));
      return curve;
    }
  curve.piece = std::make_shared<BoxPiece>(lower, upper);
  return curve;
}

}  // namespace

void read_loads(const DeckNode& root, const GeometryReader& geometry, MpmScene& s,
                std::vector<Fault>& faults) {
  const DeckNode* loads = root.find("PhysicalBC/MPM");
  if (loads == nullptr || !s.use_loads) return;
  for (const auto& node : loads->children) {
    if (node->name == "force") {
      s.loads.push_back(read_force(*node, faults));
      continue;
    }
    LoadCurve curve;
    curve.where = node->where;
    if (node->name == "torque") curve.kind = LoadCurve::Kind::torque;
    if (node->name == "heat_flux") curve.kind = LoadCurve::Kind::heat_flux;
    curve.on_points = node->name == "pressure_pts";
    curve.area = real_or(*node, "SurfaceArea", 0);
    curve.along_outward = boolean_or(*node, "outward_normal", false);
    if (const DeckNode* res = node->child("res")) curve.spacing = res->as_vector();
    read_curve(*node, curve);
    if (!curve.on_points) read_surface(*node, geometry, curve, faults);
    s.loads.push_back(std::move(curve));
  }
}

}  // namespace sluice::mpm

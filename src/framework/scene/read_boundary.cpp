// Reading and checking the deck's <BoundaryConditions>.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/scene/boundary.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

constexpr double in_plane = 1e-6;         // of a cell, for the plane of a shape
constexpr std::size_t max_regions = 255;  // a region number is one byte

std::string lower_case(std::string_view text) {
  std::string s(text);
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

ConditionKind kind_of(std::string_view name) {
  const std::string n = lower_case(name);
  if (n == "dirichlet") return ConditionKind::dirichlet;
  if (n == "neumann" || n == "zeroneumann") return ConditionKind::neumann;
  if (n == "symmetry" || n == "symmetric") return ConditionKind::symmetry;
  if (n == "freeslipwall") return ConditionKind::free_slip_wall;
  if (n == "computefromdensity") return ConditionKind::compute_from_density;
  if (n == "lodi") return ConditionKind::open_face;
  return ConditionKind::other;
}

Side side_named(const DeckNode& face, std::string_view attribute, const std::string& text) {
  for (Side s : all_sides)
    if (name_of(s) == text) return s;
  throw InputError(fmt::format("<{}>: {}=\"{}\"; sides are x-, x+, y-, y+, z- and z+", face.name,
                               attribute, text));
}

Vec3 need_vector(const DeckNode& face, std::string_view name) {
  const std::optional<Vec3> v = vector_attribute(face, name);
  if (!v) throw InputError(fmt::format("<Face>: this shape needs the attribute {}", name));
  return *v;
}

double need_length(const DeckNode& face, std::string_view name) {
  const std::optional<double> x = real_attribute(face, name);
  if (!x) throw InputError(fmt::format("<Face>: this shape needs the attribute {}", name));
  if (!(*x > 0)) throw InputError(fmt::format("<Face>: {} is {}; it must be positive", name, *x));
  return *x;
}

RegionShape read_shape(const DeckNode& face, std::string_view name) {
  RegionShape s;
  if (name == "circle") {
    s.kind = RegionShape::Kind::circle;
    s.origin = need_vector(face, "origin");
    s.radius = need_length(face, "radius");
  } else if (name == "annulus") {
    s.kind = RegionShape::Kind::annulus;
    s.origin = need_vector(face, "origin");
    s.inner_radius = need_length(face, "inner_radius");
    s.radius = need_length(face, "outer_radius");
    if (s.inner_radius >= s.radius)
      throw InputError(fmt::format("<Face>: inner_radius {} must be below outer_radius {}",
                                   s.inner_radius, s.radius));
  } else if (name == "ellipse") {
    s.kind = RegionShape::Kind::ellipse;
    s.origin = need_vector(face, "origin");
    s.major_radius = need_length(face, "major_radius");
    s.minor_radius = need_length(face, "minor_radius");
    s.angle = real_attribute(face, "angle").value_or(0);
  } else if (name == "rectangle") {
    s.kind = RegionShape::Kind::rectangle;
    s.lower = need_vector(face, "lower");
    s.upper = need_vector(face, "upper");
  } else if (name == "rectangulus") {
    s.kind = RegionShape::Kind::rectangulus;
    s.lower = need_vector(face, "outer_lower");
    s.upper = need_vector(face, "outer_upper");
    s.inner_lower = need_vector(face, "inner_lower");
    s.inner_upper = need_vector(face, "inner_upper");
  }
  return s;
}

bool same_shape(const RegionShape& a, const RegionShape& b) {
  return a.kind == b.kind && a.origin == b.origin && a.radius == b.radius &&
         a.inner_radius == b.inner_radius && a.major_radius == b.major_radius &&
         a.minor_radius == b.minor_radius && a.angle == b.angle && a.lower == b.lower &&
         a.upper == b.upper && a.inner_lower == b.inner_lower && a.inner_upper == b.inner_upper;
}

// Shapes are drawn in the plane of their side.
void check_plane(const RegionShape& s, Side side, const Level& level) {
  const int d = direction_of(side);
  const int node = is_plus(side) ? level.domain.upper[d] : level.domain.lower[d];
  const double plane = level.anchor[d] + node * level.spacing[d];
  std::vector<Vec3> points;
  if (s.kind == RegionShape::Kind::circle || s.kind == RegionShape::Kind::annulus ||
      s.kind == RegionShape::Kind::ellipse)
    points = {s.origin};
  if (s.kind == RegionShape::Kind::rectangle) points = {s.lower, s.upper};
  if (s.kind == RegionShape::Kind::rectangulus)
    points = {s.lower, s.upper, s.inner_lower, s.inner_upper};
  for (Vec3 p : points)
    if (std::abs(p[d] - plane) > in_plane * level.spacing[d])
      throw InputError(fmt::format(
          "<Face>: the shape lies at {} = {}, but side {} of the domain is the plane {} = {}",
          "xyz"[d], p[d], name_of(side), "xyz"[d], plane));
}

void read_value(const DeckNode& node, Condition& c) {
  const DeckNode* child = node.child("value");
  const std::optional<std::string> attribute = node.attribute("value");
  if (child != nullptr && attribute)
    throw InputError("<BCType>: a value both as attribute and as child; keep one of them");
  if (child == nullptr && !attribute) return;
  const std::string text = child != nullptr ? child->text : *attribute;
  if (text.empty()) return;
  c.has_value = true;
  if (text.front() == '[') {
    const ParsedValue<Vec3> v = parse_vector(text);
    if (!v) throw InputError("<BCType>: value " + v.problem);
    c.is_vector = true;
    c.vector = *v.value;
    return;
  }
  if (const ParsedValue<double> x = parse_real(text)) {
    c.value = *x.value;
    c.vector = Vec3::all(c.value);
    return;
  }
  c.text = text;
}

// A condition that cannot be carried out as written.
void check_condition(const Condition& c) {
  const bool valued = c.kind == ConditionKind::dirichlet || c.kind == ConditionKind::neumann;
  const bool velocity = c.variable == "Velocity";
  const bool scalar = c.variable == "Pressure" || c.variable == "Density" ||
                      c.variable == "Temperature" || c.variable == "SpecificVol";
  if (valued && lower_case(c.kind_name) != "zeroneumann" && (velocity || scalar)) {
    if (!c.has_value)
      throw InputError(fmt::format("<BCType>: {} {} needs a <value>", c.kind_name, c.variable));
    if (!c.text.empty())
      throw InputError(
          fmt::format("<BCType>: the value of {} is '{}', not a number", c.variable, c.text));
    if (velocity && !c.is_vector && c.value != 0)
      throw InputError("<BCType>: the value of Velocity must be a vector, as [0,0,0]");
    if (scalar && c.is_vector)
      throw InputError(fmt::format("<BCType>: the value of {} must be one number", c.variable));
  }
  if (c.kind == ConditionKind::dirichlet && !c.is_vector && c.value <= 0 &&
      (c.variable == "Density" || c.variable == "Temperature" || c.variable == "SpecificVol"))
    throw InputError(
        fmt::format("<BCType>: {} is {}; it must be greater than 0", c.variable, c.value));
}

// Material indices of an entry; -1 stands for all.
std::vector<int> read_materials(const DeckNode& node, int materials, std::vector<Fault>& faults) {
  const std::optional<std::string> id = node.attribute("id"), ids = node.attribute("ids");
  if (!id && !ids)
    throw InputError("<BCType>: neither id nor ids; write id=\"all\" or a material index");
  if (id && collapse_blanks(*id) == "all") return {-1};
  const ParsedValue<std::vector<int>> list = parse_integers(id ? *id : *ids);
  if (!list) throw InputError("<BCType>: material index: " + list.problem);
  std::vector<int> result;
  for (int m : *list.value) {
    if (m == -1 || (m >= 0 && m < materials))
      result.push_back(m);
    else
      add_warning(faults, node.where,
                  fmt::format("boundary condition for material {}, but the deck has {} material{} "
                              "(0 to {}); it is ignored",
                              m, materials, materials == 1 ? "" : "s", materials - 1));
  }
  return result;
}

// `strict`: the values must be complete (a fluid needs them).
void read_condition(const DeckNode& node, int materials, bool strict, BoundaryRegion& region,
                    std::vector<Fault>& faults) {
  Condition c;
  c.where = node.where;
  c.variable = node.attribute("label").value_or("");
  c.kind_name = node.attribute("var").value_or("");
  c.kind = kind_of(c.kind_name);
  if (c.variable.empty() && c.kind == ConditionKind::symmetry) c.variable = "Symmetric";
  if (c.variable.empty()) throw InputError("<BCType>: no label; name the variable");
  read_value(node, c);
  if (strict) check_condition(c);
  for (int m : read_materials(node, materials, faults)) {
    c.material = m;
    region.conditions.push_back(c);
  }
}

class BoundaryReader {
 public:
  BoundaryReader(const Level& level, int materials, bool strict, std::vector<Fault>& faults)
      : level_(level), materials_(materials), strict_(strict), faults_(faults) {
    for (Side s : all_sides) {
      BoundarySide& side = at(s);
      side.periodic = level.periodic[direction_of(s)];
      if (side.periodic) continue;
      side.regions.emplace_back();
      side.regions.front().name = fmt::format("side {}", name_of(s));
    }
  }

  void read_face(const DeckNode& face) {
    for (std::string_view name : face_shapes)
      if (const std::optional<std::string> text = face.attribute(name))
        return read_face(face, name, side_named(face, name, collapse_blanks(*text)));
    throw InputError(
        "<Face>: no side; write side=\"x-\" (or circle, annulus, ellipse, rectangle, "
        "rectangulus)");
  }

  BoundaryConditions take() { return std::move(result_); }

 private:
  BoundarySide& at(Side s) { return result_.sides[index_of(s)]; }

  void read_face(const DeckNode& face, std::string_view shape_name, Side side) {
    if (at(side).periodic)
      return add_warning(
          faults_, face.where,
          fmt::format("side {} is periodic; its boundary conditions are ignored", name_of(side)));
    RegionShape shape = read_shape(face, shape_name);
    check_plane(shape, side, level_);
    BoundaryRegion& region = region_for(side, shape, face, shape_name);
    for (const auto& child : face.children)
      if (child->name == "BCType")
        collect(faults_, child->where,
                [&] { read_condition(*child, materials_, strict_, region, faults_); });
  }

  // Faces that repeat a shape (for another material) share a region.
  BoundaryRegion& region_for(Side side, const RegionShape& shape, const DeckNode& face,
                             std::string_view shape_name) {
    std::vector<BoundaryRegion>& regions = at(side).regions;
    for (BoundaryRegion& r : regions)
      if (same_shape(r.shape, shape)) {
        if (r.where.line == 0) r.where = face.where;
        return r;
      }
    if (regions.size() >= max_regions)
      throw InputError(fmt::format("side {}: more than {} shapes", name_of(side), max_regions - 1));
    BoundaryRegion region;
    region.shape = shape;
    region.where = face.where;
    region.name = face.attribute("name").value_or(fmt::format("{} {}", shape_name, name_of(side)));
    regions.push_back(std::move(region));
    return regions.back();
  }

  const Level& level_;
  int materials_;
  bool strict_;
  std::vector<Fault>& faults_;
  BoundaryConditions result_;
};

void warn_unknown_variables(const BoundarySide& side, const std::vector<BoundaryNeed>& needs,
                            std::vector<Fault>& faults) {
  std::vector<std::string> known = {"SpecificVol", "Symmetric"};
  for (const BoundaryNeed& n : needs) known.push_back(n.variable);
  for (const BoundaryRegion& region : side.regions)
    for (const Condition& c : region.conditions) {
      if (std::find(known.begin(), known.end(), c.variable) != known.end()) continue;
      const std::optional<std::string> near = nearest_name(c.variable, known);
      if (near)
        add_error(faults, c.where, fmt::format("boundary condition for '{}'", c.variable),
                  fmt::format("did you mean '{}'?", *near));
    }
}

void check_coverage(const BoundarySide& side, Side s, const Level& level, const Location& where,
                    const std::vector<BoundaryNeed>& needs, std::vector<Fault>& faults) {
  const RegionMap map(side, s, level);
  for (std::size_t r = 0; r < side.regions.size(); ++r) {
    const BoundaryRegion& region = side.regions[r];
    if (map.counts()[r] == 0) {
      if (r > 0)
        add_warning(faults, region.where,
                    fmt::format("{}: no cell face has its centre in this shape", region.name));
      continue;
    }
    std::string missing;
    for (const BoundaryNeed& need : needs)
      for (int m : need.materials)
        if (region.find(need.variable, m) == nullptr)
          missing +=
              fmt::format("{}{} of material {}", missing.empty() ? "" : ", ", need.variable, m);
    if (!missing.empty())
      add_error(faults, region.where.line > 0 ? region.where : where,
                fmt::format("{}: no boundary condition for {}", region.name, missing),
                fmt::format("add <BCType> entries to <Face side=\"{}\"> or make the direction "
                            "periodic",
                            name_of(s)));
  }
}

}  // namespace

BoundaryConditions read_boundary_conditions(const DeckNode* node, const GridSettings& grid,
                                            int materials, const std::vector<BoundaryNeed>& needs,
                                            std::vector<Fault>& faults) {
  const Grid built = build_grid(grid, {});
  if (built.levels.empty()) return {};
  const Level& level = built.levels.front();
  BoundaryReader reader(level, materials, !needs.empty(), faults);
  if (node != nullptr)
    for (const DeckNode* face : node->all("Face"))
      collect(faults, face->where, [&] { reader.read_face(*face); });
  BoundaryConditions result = reader.take();
  if (needs.empty()) return result;
  const Location& where = node != nullptr ? node->where : grid.where;
  for (Side s : all_sides) {
    if (result.side(s).periodic) continue;
    warn_unknown_variables(result.side(s), needs, faults);
    check_coverage(result.side(s), s, level, where, needs, faults);
  }
  return result;
}

}  // namespace sluice

// Places, arrows and sides of a deck, by the names of their tags.
#include "properties/mirrored_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <regex>
#include <stdexcept>

#include "framework/deck/load_deck.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice::properties {
namespace {

const char* const names[] = {"x", "y", "z"};

// p -> p - middle, then mirrored; arrows are mirrored only.
struct Motion {
  Vec3 middle{};
  int axis = -1;  // none

  Vec3 arrow(Vec3 v) const {
    if (axis >= 0) v[axis] = 0.0 - v[axis];
    return v;
  }
  Vec3 place(Vec3 p) const { return arrow(p - middle); }
};

std::string text(Vec3 v) {
  return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

Vec3 vector_of(const std::string& written) {
  const auto v = parse_vector(written);
  if (!v) throw std::logic_error("no vector: " + written);
  return *v.value;
}

bool among(const std::string& name, std::initializer_list<const char*> list) {
  return std::any_of(list.begin(), list.end(), [&](const char* one) { return name == one; });
}

void set_attribute(DeckNode& node, const std::string& name, const std::string& value) {
  for (auto& [key, old] : node.attributes)
    if (key == name) old = value;
}

bool is_place(const std::string& name) {
  return among(name, {"origin", "center", "bottom", "top", "p1", "p2", "p3", "p4", "planePoint",
                      "reference_point", "starting_location"});
}
bool is_arrow(const std::string& name) {
  return among(
      name, {"velocity", "gravity", "vel_infinity", "reference_velocity", "velocity_src", "normal",
             "offset", "v1", "v2", "v3", "U_infinity", "value", "direction_if_plane"});
}
// Numbers of cells, sizes, and lists that are no vectors. Corners of grid boxes are placed on the
// nodes of their level, `min` and `max` as a pair.
bool keeps(const std::string& name) {
  return among(name, {"extraCells",
                      "patches",
                      "resolution",
                      "spacing",
                      "res",
                      "periodic",
                      "mu",
                      "tau",
                      "lower",
                      "upper",
                      "min",
                      "max",
                      "cell_refinement_ratio",
                      "min_patch_size",
                      "min_boundary_cells",
                      "cell_stability_dilation",
                      "cell_regrid_dilation",
                      "cell_deletion_dilation",
                      "momentum",
                      "heat",
                      "add_heat_matls",
                      "add_heat_coeff",
                      "coefficient"});
}

// A box between two corners, as tags.
void move_corners(DeckNode& box, const Motion& motion, const char* low, const char* high) {
  DeckNode* const a = box.child(low);
  DeckNode* const b = box.child(high);
  if (a == nullptr || b == nullptr) return;
  Vec3 lower = motion.place(a->as_vector()), upper = motion.place(b->as_vector());
  if (motion.axis >= 0) std::swap(lower[motion.axis], upper[motion.axis]);
  a->text = text(lower);
  b->text = text(upper);
}

// x- for x+ and the other way round; other sides stay.
std::string side_of(const std::string& side, const Motion& motion) {
  if (motion.axis < 0 || side.size() != 2 || side.substr(0, 1) != names[motion.axis]) return side;
  return side.substr(0, 1) + (side[1] == '-' ? "+" : "-");
}

// A side of the domain, or a shape on it.
void move_face(DeckNode& face, const Motion& motion) {
  std::vector<std::pair<std::string, std::string>> corners;
  for (auto& [key, value] : face.attributes) {
    if (among(key, {"side", "circle", "annulus", "ellipse", "rectangle", "rectangulus"}))
      value = side_of(value, motion);
    if (key == "origin") value = text(motion.place(vector_of(value)));
    // An ellipse turns the other way in the image of its plane.
    if (key == "angle" && motion.axis >= 0 && face.attribute("ellipse") &&
        face.attribute("ellipse")->substr(0, 1) != names[motion.axis])
      value = fmt::format("{}", 0.0 - std::stod(value));
  }
  for (const std::string part : {"", "inner_", "outer_"}) {
    const auto low = face.attribute(part + "lower"), high = face.attribute(part + "upper");
    if (!low || !high) continue;
    Vec3 lower = motion.place(vector_of(*low)), upper = motion.place(vector_of(*high));
    if (motion.axis >= 0) std::swap(lower[motion.axis], upper[motion.axis]);
    set_attribute(face, part + "lower", text(lower));
    set_attribute(face, part + "upper", text(upper));
  }
}

// Formulas of the new x, y, z.
void move_formulas(DeckNode& formulas, const Motion& motion) {
  for (const auto& one : formulas.children) {
    std::string& f = one->text;
    for (int d = 0; d < 3; ++d) {
      const std::regex coordinate(fmt::format("\\b{}\\b", names[d]));
      if (motion.middle[d] != 0)
        f = std::regex_replace(f, coordinate,
                               fmt::format("({} + ({}))", names[d], motion.middle[d]));
      if (motion.axis == d) f = std::regex_replace(f, coordinate, fmt::format("(-{})", names[d]));
    }
    if (motion.axis >= 0 && one->name == fmt::format("velocity_{}", names[motion.axis]))
      f = "-(" + f + ")";
  }
}

void negate(DeckNode& node) {
  node.text = fmt::format("{}", 0.0 - node.as_real());
}

// What a name alone does not tell.
void move_special(DeckNode& node, const Motion& motion) {
  if (node.name == "Face") move_face(node, motion);
  if (node.name == "box") move_corners(node, motion, "min", "max");
  if (node.name == "formula") move_formulas(node, motion);
  if (node.name == "domainFace") node.text = side_of(node.text, motion);
  if (motion.axis < 0) return;
  if (node.name == fmt::format("{}_dir", names[motion.axis])) negate(node);
  if (node.name == "vortex" && node.string("axis") != names[motion.axis])
    negate(*node.child("strength"));
}

void move(DeckNode& node, const Motion& motion) {
  if (node.name == "Meta" || node.name == "DataAnalysis") return;
  if (!node.text.empty() && node.text.front() == '[') {
    if (is_place(node.name)) {
      node.text = text(motion.place(node.as_vector()));
    } else if (is_arrow(node.name)) {
      node.text = text(motion.arrow(node.as_vector()));
    } else if (!keeps(node.name)) {
      throw std::logic_error(
          fmt::format("{}: no mirror image is known of <{}>", to_string(node.where), node.name));
    }
  }
  move_special(node, motion);
  for (const auto& child : node.children) move(*child, motion);
}

Vec3 spacing_of(const DeckNode& level, const DeckNode& box) {
  for (const DeckNode* node : {&box, &level})
    if (const DeckNode* given = node->child("spacing")) return given->as_vector();
  const Vec3 size = box.vector("upper") - box.vector("lower"), n = box.vector("resolution");
  return {size.x / n.x, size.y / n.y, size.z / n.z};
}

double of_few_digits(double h) {
  constexpr double one = 1ll << 36;
  int exponent = 0;
  const double share = std::frexp(h, &exponent);
  return std::ldexp(std::round(share * one) / one, exponent);
}

void for_each_box(DeckNode& grid, const std::function<void(DeckNode& level, DeckNode& box)>& f) {
  for (const auto& level : grid.children)
    for (const auto& box : level->children)
      if (level->name == "Level" && box->name == "Box") f(*level, *box);
}

// Puts the corners of all boxes on the nodes of levels about 0. Returns the old middle.
Vec3 centre_grid(DeckNode& grid) {
  const DeckNode& coarsest = grid.need("Level");
  const Vec3 h = spacing_of(coarsest, coarsest.need("Box"));
  Vec3 low = coarsest.need("Box").vector("lower"), high = coarsest.need("Box").vector("upper");
  for (const DeckNode* box : coarsest.all("Box"))
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], box->vector("lower")[d]);
      high[d] = std::max(high[d], box->vector("upper")[d]);
    }
  for_each_box(grid, [&](DeckNode& level, DeckNode& box) {
    const Vec3 fine = spacing_of(level, box);
    Vec3 corners[2] = {box.vector("lower"), box.vector("upper")}, spacing;
    for (int d = 0; d < 3; ++d) {
      const double ratio = std::round(h[d] / fine[d]);
      spacing[d] = of_few_digits(h[d]) / ratio;
      const double cells = std::round((high[d] - low[d]) / h[d]) * ratio;
      for (Vec3& c : corners)
        c[d] = (std::round((c[d] - low[d]) / fine[d]) - 0.5 * cells) * spacing[d];
    }
    box.child("lower")->text = text(corners[0]);
    box.child("upper")->text = text(corners[1]);
    if (DeckNode* given = box.child("spacing")) given->text = text(spacing);
  });
  for (const auto& level : grid.children)
    if (DeckNode* given = level->child("spacing")) {
      const Vec3 old = given->as_vector();
      Vec3 spacing;
      for (int d = 0; d < 3; ++d) spacing[d] = of_few_digits(h[d]) / std::round(h[d] / old[d]);
      given->text = text(spacing);
    }
  return 0.5 * (low + high);
}

void mirror_grid(DeckNode& grid, int axis) {
  for_each_box(grid, [&](DeckNode&, DeckNode& box) {
    move_corners(box, {.middle = {}, .axis = axis}, "lower", "upper");
  });
}

void drop_children(DeckNode& node, std::initializer_list<const char*> list) {
  std::erase_if(node.children, [&](const auto& child) { return among(child->name, list); });
}

// Points of a source follow a sequence within each cell, which has no image; those of the start lie
// on a lattice.
void drop_sources_of_tracers(DeckNode& node) {
  if (node.name == "tracer") drop_children(node, {"interiorSources"});
  for (const auto& child : node.children) drop_sources_of_tracers(*child);
}

void save_few(DeckNode& archiver) {
  drop_children(archiver, {"save"});
  for (const char* label : {"rho_CC", "temp_CC", "press_CC", "vel_CC"}) {
    auto save = std::make_unique<DeckNode>();
    save->name = "save";
    save->attributes = {{"label", label}};
    archiver.children.push_back(std::move(save));
  }
}

}  // namespace

std::string centred_deck(const Deck& deck) {
  const std::unique_ptr<DeckNode> root = copy_of(*deck.root);
  drop_children(*root, {"DataAnalysis"});
  if (DeckNode* meta = root->child("Meta")) drop_children(*meta, {"exact_solution"});
  save_few(*root->child("DataArchiver"));
  if (DeckNode* models = root->child("Models")) drop_sources_of_tracers(*models);
  if (DeckNode* ice = root->child("CFD")->child("ICE"))
    if (DeckNode* balanced = ice->child("applyHydrostaticPressure")) balanced->text = "false";
  const Vec3 middle = centre_grid(*root->child("Grid"));
  move(*root, {.middle = middle, .axis = -1});
  return to_xml(*root);
}

std::string mirrored_deck(const Deck& centred, int axis) {
  const std::unique_ptr<DeckNode> root = copy_of(*centred.root);
  mirror_grid(*root->child("Grid"), axis);
  move(*root, {.middle = {}, .axis = axis});
  return to_xml(*root);
}

}  // namespace sluice::properties

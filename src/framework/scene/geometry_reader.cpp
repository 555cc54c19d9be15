// Geometry pieces from the deck: labels, nesting, files, and the <geom_object> around them.
#include "framework/scene/geometry_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/geometry/boolean.hpp"
#include "framework/geometry/sampling.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/make_piece.hpp"

namespace sluice {

namespace {

constexpr int deepest_nesting = 64;

constexpr std::array<std::string_view, 22> piece_tags = {
    "box",          "sphere",          "cylinder",       "cone",
    "ellipsoid",    "torus",           "parallelepiped", "tri",
    "line_segment", "polyhedron",      "smoothcyl",      "file",
    "image",        "plane_shell",     "sphere_shell",   "cylinder_shell",
    "null",         "sphere_membrane", "corrugated",     "union",
    "intersection", "difference"};

std::string label_of(const DeckNode& node) {
  const std::optional<std::string> label = node.attribute("label");
  return label ? *label : node.attribute("name").value_or("");
}

bool empty(const DeckNode& node) {
  return node.text.empty() && std::all_of(node.children.begin(), node.children.end(),
                                          [](const auto& child) { return child->defaulted; });
}

bool same_content(const DeckNode& a, const DeckNode& b) {
  return a.name == b.name && a.text == b.text && a.children.size() == b.children.size() &&
         std::equal(a.children.begin(), a.children.end(), b.children.begin(),
                    [](const auto& x, const auto& y) { return same_content(*x, *y); });
}

}  // namespace

bool GeometryReader::is_piece(std::string_view tag) {
  return std::find(piece_tags.begin(), piece_tags.end(), tag) != piece_tags.end();
}

GeometryReader::GeometryReader(const DeckNode& root, std::vector<Fault>& faults) {
  std::map<std::string, const DeckNode*> rivals;  // second, different definition of a label
  std::vector<const DeckNode*> references, stack = {&root};
  while (!stack.empty()) {
    const DeckNode* node = stack.back();
    stack.pop_back();
    for (auto child = node->children.rbegin(); child != node->children.rend(); ++child)
      stack.push_back(child->get());
    const std::string label = label_of(*node);
    if (!is_piece(node->name) || label.empty()) continue;
    if (empty(*node)) {
      references.push_back(node);
      continue;
    }
    const auto [known, fresh] = labels_.emplace(label, node);
    if (!fresh && !same_content(*known->second, *node)) rivals.emplace(label, node);
  }
  for (const DeckNode* node : references) {
    const std::string label = label_of(*node);
    const auto rival = rivals.find(label);
    if (rival == rivals.end()) continue;
    add_error(faults, node->where,
              fmt::format("geometry label '{}' has two definitions, at {} and at {}", label,
                          to_string(labels_.at(label)->where), to_string(rival->second->where)),
              "give one of them another label");
  }
}

// The piece that a label stands for, or a fault and nullptr.
const DeckNode* GeometryReader::labelled(const DeckNode& node, const std::string& label,
                                         std::vector<Fault>& faults) const {
  const auto found = labels_.find(label);
  if (found == labels_.end()) {
    std::vector<std::string> known;
    for (const auto& [name, definition] : labels_) known.push_back(name);
    add_error(faults, node.where,
              fmt::format("no geometry piece has the label '{}', which this empty <{}> refers to",
                          label, node.name),
              suggest_name(label, known));
    return nullptr;
  }
  const DeckNode& meant = *found->second;
  if (meant.name != node.name) {
    add_error(faults, node.where,
              fmt::format("geometry '{}' is a <{}> (at {}), not a <{}>", label, meant.name,
                          to_string(meant.where), node.name));
    return nullptr;
  }
  return &meant;
}

PiecePtr GeometryReader::piece(const DeckNode& node, std::vector<Fault>& faults) const {
  return build(node, faults, 0);
}

PiecePtr GeometryReader::build(const DeckNode& node, std::vector<Fault>& faults, int depth) const {
  if (depth > deepest_nesting) {
    add_error(faults, node.where, fmt::format("geometry nested deeper than {}", deepest_nesting));
    return nullptr;
  }
  const std::string label = label_of(node);
  if (!label.empty() && empty(node) && node.name != "null") {
    const DeckNode* meant = labelled(node, label, faults);
    return meant != nullptr ? build(*meant, faults, depth + 1) : nullptr;
  }
  const bool boolean =
      node.name == "union" || node.name == "intersection" || node.name == "difference";
  PiecePtr result;
  if (!boolean) {
    collect(faults, node.where, [&] { result = make_piece(node); });
    return result;
  }
  std::vector<PiecePtr> members;
  bool good = true;
  for (const auto& child : node.children)
    if (is_piece(child->name)) {
      members.push_back(build(*child, faults, depth + 1));
      good = good && members.back() != nullptr;
    }
  if (!good) return nullptr;
  if (node.name == "difference" && members.size() != 2) {
    add_error(faults, node.where,
              fmt::format("a difference has {} pieces; it takes exactly two: the first without the "
                          "second",
                          members.size()));
    return nullptr;
  }
  collect(faults, node.where, [&] {
    if (node.name == "union") result = std::make_shared<UnionPiece>(members);
    if (node.name == "intersection") result = std::make_shared<IntersectionPiece>(members);
    if (node.name == "difference")
      result = std::make_shared<DifferencePiece>(members[0], members[1]);
  });
  return result;
}

GeomObject GeometryReader::object(const DeckNode& node, std::vector<Fault>& faults) const {
  GeomObject o;
  o.where = node.where;
  std::vector<PiecePtr> pieces;
  bool good = true;
  for (const auto& child : node.children) {
    if (is_piece(child->name)) {
      pieces.push_back(build(*child, faults, 0));
      good = good && pieces.back() != nullptr;
    } else if (child->name != "res" && child->name != "velocity") {
      // Initial values: every tag that holds one number.
      const ParsedValue<double> x = parse_real(child->text);
      if (!x) continue;
      o.values[child->name] = *x.value;
      o.value_where[child->name] = child->where;
    }
  }
  collect(faults, node.where, [&] {
    o.res = int_vector_or(node, "res", {1, 1, 1});
    o.velocity = vector_or(node, "velocity", {});
    if (o.res.x < 1 || o.res.y < 1 || o.res.z < 1 || o.res.x > 1000 || o.res.y > 1000 ||
        o.res.z > 1000)
      throw InputError(fmt::format("<geom_object>: res is [{}, {}, {}]; each must be 1 to 1000",
                                   o.res.x, o.res.y, o.res.z));
  });
  if (pieces.empty()) add_error(faults, node.where, "<geom_object> without a geometry piece");
  if (!good || pieces.empty()) return o;
  o.piece = pieces.size() == 1 ? pieces.front() : std::make_shared<UnionPiece>(std::move(pieces));
  return o;
}

std::vector<std::int32_t> count_inside(const GeomObject& object, const Level& level,
                                       const IndexBox& cells) {
  return count_inside(*object.piece, CellLattice{level.anchor, level.spacing}, cells.lower,
                      cells.upper, object.res);
}

}  // namespace sluice

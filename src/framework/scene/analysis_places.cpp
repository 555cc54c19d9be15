// Lines, planes, points and control volumes of the deck's <DataAnalysis>.
#include <fmt/format.h>

#include "framework/scene/analysis_settings.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {
namespace {

constexpr const char* side_names[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

// Files and folders are named after what is looked at.
std::string file_name(const DeckNode& node, const char* attribute) {
  const std::string name = node.attribute(attribute).value_or("");
  if (name.empty())
    throw InputError(
        fmt::format("<{}>: no {}; it gives its files their name", node.name, attribute));
  if (name.find('/') != std::string::npos || name.front() == '.')
    throw InputError(fmt::format("<{}>: '{}' cannot be a folder's name", node.name, name));
  return name;
}

AnalysedLine read_line(const DeckNode& node) {
  AnalysedLine line;
  line.where = node.where;
  line.name = file_name(node, "name");
  line.start = node.vector("startingPt");
  line.end = node.vector("endingPt");
  line.step = real_or(node, "stepSize", 0);
  if (line.step < 0) throw InputError("<line>: stepSize must be greater than 0");
  return line;
}

// Of a rectangle: the low one first; `flat`: the first direction in which they agree.
void order_corners(Vec3& low, Vec3& high, int& flat) {
  for (int d = 2; d >= 0; --d)
    if (low[d] == high[d])
      flat = d;
    else if (low[d] > high[d])
      std::swap(low[d], high[d]);
}

AnalysedPlane read_plane(const DeckNode& node) {
  AnalysedPlane plane;
  plane.where = node.where;
  plane.name = file_name(node, "name");
  plane.start = node.vector("startingPt");
  plane.end = node.vector("endingPt");
  order_corners(plane.start, plane.end, plane.normal);
  return plane;
}

AnalysedPoint read_point(const DeckNode& node) {
  AnalysedPoint point;
  point.where = node.where;
  point.name = file_name(node, "name");
  point.position = node.vector("position");
  return point;
}

void read_corners(const DeckNode& box, ControlVolume& v) {
  v.whole = false;
  v.low = box.vector("min");
  v.high = box.vector("max");
}

// A box of <controlVolumes>: all of its sides count.
ControlVolume read_box(const DeckNode& node) {
  ControlVolume v;
  v.where = node.where;
  v.name = file_name(node, "label");
  read_corners(node, v);
  for (VolumeSide& s : v.sides) s.counts = true;
  return v;
}

void read_side(const DeckNode& face, ControlVolume& v) {
  const std::string side = face.attribute("side").value_or("");
  for (std::size_t s = 0; s < 6; ++s) {
    if (side != side_names[s]) continue;
    v.sides[s].counts = true;
    v.sides[s].whole = face.attribute("extents").value_or("entireFace") == "entireFace";
    if (v.sides[s].whole) return;
    v.sides[s].start = face.vector("startPt");
    v.sides[s].end = face.vector("endPt");
    for (int d = 0; d < 3; ++d)
      if (v.sides[s].start[d] > v.sides[s].end[d])
        std::swap(v.sides[s].start[d], v.sides[s].end[d]);
    return;
  }
  throw InputError(
      fmt::format("<Face side=\"{}\">: a side is one of x-, x+, y-, y+, z-, z+", side));
}

// The one volume of a budget: the domain unless a box is given; without faces, all of them count.
ControlVolume read_volume(const DeckNode& node, const std::string& name) {
  ControlVolume v;
  v.where = node.where;
  v.name = name;
  if (const DeckNode* box = node.child("box")) read_corners(*box, v);
  const auto faces = node.all("Face");
  for (const DeckNode* face : faces) read_side(*face, v);
  if (faces.empty())
    for (VolumeSide& s : v.sides) s.counts = true;
  return v;
}

// Entries of a list of places.
template <class Place, class Read>
void read_list(const DeckNode& module, const char* list, const char* entry, Read read,
               std::vector<Place>& places, std::vector<Fault>& faults) {
  const DeckNode* node = module.child(list);
  if (node == nullptr) return;
  for (const DeckNode* e : node->all(entry))
    collect(faults, e->where, [&] { places.push_back(read(*e)); });
}

// A rectangle through which heat passes: a flat volume.
ControlVolume read_flat(const DeckNode& node, int number) {
  ControlVolume v;
  v.where = node.where;
  v.name = std::to_string(number);
  v.whole = false;
  v.low = node.vector("startingPt");
  v.high = node.vector("endingPt");
  order_corners(v.low, v.high, v.flat);
  return v;
}

}  // namespace

void read_analysis_places(const DeckNode& module, AnalysisModule& m, std::vector<Fault>& faults) {
  read_list(module, "lines", "line", read_line, m.lines, faults);
  read_list(module, "planes", "plane", read_plane, m.planes, faults);
  read_list(module, "points", "point", read_point, m.points, faults);
  read_list(module, "controlVolumes", "box", read_box, m.volumes, faults);
  for (const DeckNode* plane : module.all("plane"))
    collect(faults, plane->where, [&] {
      m.volumes.push_back(read_flat(*plane, static_cast<int>(m.volumes.size()) + 1));
    });
  if (const DeckNode* volume = module.child("controlVolume"))
    collect(faults, volume->where, [&] { m.volumes.push_back(read_volume(*volume, m.name)); });
}

}  // namespace sluice

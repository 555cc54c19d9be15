// Point files and smooth cylinders as lists of particles.
#include "mpm/start/point_list.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/geometry/point_file.hpp"
#include "framework/geometry/smooth_cylinder.hpp"

namespace sluice::mpm {
namespace {

template <class T>
std::vector<T> column(const std::map<std::string, std::vector<T>>& columns, const char* name) {
  const auto at = columns.find(name);
  return at == columns.end() ? std::vector<T>{} : at->second;
}

PointList from_file(const PointFile& file) {
  PointList list;
  list.place = file.points;
  list.volume = column(file.scalars, "p.volume");
  list.temperature = column(file.scalars, "p.temperature");
  list.colour = column(file.scalars, "p.color");
  list.velocity = column(file.vectors, "p.velocity");
  list.external_force = column(file.vectors, "p.externalforce");
  list.fibre = column(file.vectors, "p.fiberdir");
  list.normal = column(file.vectors, "p.normal");
  list.load_curve = column(file.vectors, "p.loadCurveID");
  const auto r1 = column(file.vectors, "p.rvec1"), r2 = column(file.vectors, "p.rvec2"),
             r3 = column(file.vectors, "p.rvec3");
  if (r1.empty() || r2.empty() || r3.empty()) return list;
  for (std::size_t n = 0; n < r1.size(); ++n) list.edges.push_back({r1[n], r2[n], r3[n]});
  return list;
}

// A ring between two radii, cut into equal parts.
struct Ring {
  double inner = 0, outer = 0;
  int parts = 1;
};

// pie_slices: equal widths, the same number of parts. constant_particle_volumes: num_angular parts
// in the outermost ring, fewer inside as the radius; widths that make all volumes equal.
std::vector<Ring> rings_of(const SmoothCylinder& c) {
  std::vector<Ring> rings(c.num_radial);
  const double width = (c.outer_radius - c.inner_radius) / c.num_radial;
  const double last = c.outer_radius - 0.5 * width;
  const bool equal = c.discretization_scheme == "constant_particle_volumes";
  int all = 0;
  for (int k = 0; k < c.num_radial; ++k) {
    Ring& ring = rings[k];
    ring.inner = c.inner_radius + k * width;
    ring.outer = c.inner_radius + (k + 1) * width;
    ring.parts = c.num_angular;
    if (equal)
      ring.parts = std::max(
          1, static_cast<int>(std::lround(c.num_angular * 0.5 * (ring.inner + ring.outer) / last)));
    all += ring.parts;
  }
  if (!equal) return rings;
  const double a = c.inner_radius * c.inner_radius, b = c.outer_radius * c.outer_radius;
  int until = 0;
  for (Ring& ring : rings) {
    ring.inner = std::sqrt(a + (b - a) * until / all);
    until += ring.parts;
    ring.outer = std::sqrt(a + (b - a) * until / all);
  }
  return rings;
}

class Axes {
 public:
  explicit Axes(const SmoothCylinder& c) : bottom(c.bottom) {
    const Vec3 along = c.top - c.bottom;
    length = std::sqrt(dot(along, along));
    n = (1 / length) * along;
    const Vec3 across = cross({0, 1, 0}, n);
    const double size = std::sqrt(dot(across, across));
    e1 = size > 1e-12 ? (1 / size) * across : Vec3{1, 0, 0};
    e2 = cross(n, e1);
  }
  Vec3 bottom, n, e1, e2;
  double length;
};

void add_ring(const Ring& ring, double angle_0, double arc, double height, double layer,
              const Axes& axes, PointList& list) {
  const double r = 0.5 * (ring.inner + ring.outer), part = arc / ring.parts;
  for (int j = 0; j < ring.parts; ++j) {
    const double angle = angle_0 + (j + 0.5) * part;
    const Vec3 radial = std::cos(angle) * axes.e1 + std::sin(angle) * axes.e2;
    const Vec3 round = std::cos(angle) * axes.e2 - std::sin(angle) * axes.e1;
    list.place.push_back(axes.bottom + height * axes.n + r * radial);
    // Their product is the volume of the part: (r_o^2 - r_i^2)/2 dtheta dz = r dr dtheta dz.
    list.edges.push_back({(ring.outer - ring.inner) * radial, (r * part) * round, layer * axes.n});
    list.volume.push_back(r * (ring.outer - ring.inner) * part * layer);
  }
}

PointList from_cylinder(const SmoothCylinder& c) {
  PointList list;
  const Axes axes(c);
  const double degree = std::numbers::pi / 180;
  const double layer = axes.length / c.num_axial;
  const int cap_layers =
      c.endcap_thickness > 0
          ? std::max(1, static_cast<int>(std::lround(c.endcap_thickness / layer)))
          : 0;
  const double cap_layer = cap_layers > 0 ? c.endcap_thickness / cap_layers : 0;
  const auto add_layer = [&](double height, double thickness) {
    for (const Ring& ring : rings_of(c))
      add_ring(ring, c.arc_start_angle * degree, c.arc_angle * degree, height, thickness, axes,
               list);
  };
  for (int k = 0; k < cap_layers; ++k)
    add_layer(-c.endcap_thickness + (k + 0.5) * cap_layer, cap_layer);
  for (int k = 0; k < c.num_axial; ++k) add_layer((k + 0.5) * layer, layer);
  for (int k = 0; k < cap_layers; ++k) add_layer(axes.length + (k + 0.5) * cap_layer, cap_layer);
  return list;
}

}  // namespace

std::optional<PointList> point_list(const SeedObject& object) {
  if (const auto* file = dynamic_cast<const PointFilePiece*>(object.piece.get()))
    return from_file(file->file());
  if (const auto* cylinder = dynamic_cast<const SmoothCylinderPiece*>(object.piece.get()))
    return from_cylinder(cylinder->cylinder());
  return std::nullopt;
}

}  // namespace sluice::mpm

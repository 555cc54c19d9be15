// Model "LightTime": a detonation that is prescribed, as programmed burn (Wilkins 1964).
//
// A front leaves <starting_location>, or the plane through it with the normal <direction_if_plane>,
// at time 0 with the speed D and passes over the grid whatever lies there. At a distance s from it
//   F = D (t - s/D)/(1.5 dx),  0 <= F <= 1, and 1 from 0.96 on:
// the share of explosive and products that has burned; dx: edge of a cell. Heat: E0 per mass.
#pragma once
#include <cmath>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "framework/field/label.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct LightTime {
  static constexpr double front = 1.5;  // its width, edges of cells
  static constexpr double all = 0.96;   // F from which everything has burned

  Vec3 start{}, normal{};  // normal 0: a point
  double D = 1;            // speed of the front
  double heat = 0;         // J/kg
  bool in_mixed_cells = true;
  // Else cells burn that explosive and products fill by more than this.
  static constexpr double full = 0.99;

  double distance(Vec3 x) const {
    const Vec3 way{x.x - start.x, x.y - start.y, x.z - start.z};
    const double size = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    if (size > 0) return std::fabs(way.x * normal.x + way.y * normal.y + way.z * normal.z) / size;
    return std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
  }
  // F at a place and time, in cells of this edge.
  double share(Vec3 x, double time, double edge) const {
    const double F = (D * time - distance(x)) / (front * edge);
    return F > all ? 1.0 : F > 0 ? F : 0.0;
  }
};

TagSpec light_time_tag();
// "mag_grad_Fr", with the products.
Label front_gradient_label();
LightTime read_light_time_law(const DeckNode& parameters);

}  // namespace sluice::models

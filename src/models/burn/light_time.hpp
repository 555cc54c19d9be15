// Model "LightTime": a detonation that is prescribed, as programmed burn (Wilkins 1964).
//
// A front leaves <starting_location>, or the plane through it with the normal <direction_if_plane>,
// at time 0 with the speed D and passes over the grid whatever lies there. At a distance s from it
//   F = D (t - s/D)/(1.5 dx),  0 <= F <= 1, and 1 from 0.96 on:
// the share of explosive and products that has burned; dx: edge of a cell. Heat: E0 per mass.
#pragma once
#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "framework/field/label.hpp"
#include "models/burn/detonation_front.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct LightTime {
  DetonationFront front;
  double D = 1;     // speed of the front, m/s
  double heat = 0;  // J/kg
  bool in_mixed_cells = true;
  // Else cells burn that explosive and products fill by more than this.
  static constexpr double full = 0.99;

  // F at a place (m) and time (s), in cells of this edge (m).
  double share(Vec3 x, double time, double edge) const {
    const double F = (D * time - front.distance(x)) / (DetonationFront::width * edge);
    return F > DetonationFront::all ? 1.0 : F > 0 ? F : 0.0;
  }
};

TagSpec light_time_tag();
// "mag_grad_Fr", with the products.
Label front_gradient_label();
LightTime read_light_time_law(const DeckNode& parameters);

}  // namespace sluice::models

// Conditions of kind LODI: waves leave through the face and do not come back (boundary/waves.hpp).
#pragma once
#include <optional>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"

namespace sluice::ice {

struct FaceCondition;

struct LodiSettings {
  double press_infinity = 0;              // far away, Pa
  double sigma = 0.27;                    // how fast the pressure goes back to it, without unit
  double scale = 1;                       // factor of all that comes in
  std::optional<Vec3> velocity_infinity;  // m/s
  std::optional<double> rho_infinity;     // kg/m^3
  Location where;
};

FaceCondition open_face_condition();

}  // namespace sluice::ice

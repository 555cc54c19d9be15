// A flow that is given at a boundary as a function of place and time: what its ghosts hold.
#pragma once
#include "framework/base/vec3.hpp"

namespace sluice::ice {

// A ghost cell, as such a flow sees it.
struct GhostPlace {
  Vec3 centre{};         // m
  Vec3 height{};         // of the centre above the low side of the domain, in each direction, m
  Vec3 domain_size{};    // m
  double time = 0;       // s
  double arrival = 0;    // time that sound takes from the centre to the face, s; waves alone
  double viscosity = 0;  // of the gas, Pa s
};

class PrescribedFlow {
 public:
  // What the face makes of it: the velocity through it is as given, whatever lies inside; or a wave
  // runs in, whose values hold on the face; or the flow is an exact one on both sides.
  enum class Nature { velocity, wave, exact };

  virtual ~PrescribedFlow() = default;
  virtual Nature nature() const = 0;
  // Velocity of a ghost of density rho (kg/m^3), m/s. `value`: that of the deck, <BCType><value>.
  virtual Vec3 velocity(const GhostPlace& at, Vec3 value, double rho) const = 0;
  // Pa; asked only where the condition is one of the pressure.
  virtual double pressure(const GhostPlace& at, double rho) const = 0;
  // The component along `direction` of the velocity (m/s) on the face at a time (s); `in_ghost`:
  // that of the ghost next to it.
  virtual double on_face(int direction, Vec3 value, double in_ghost, double time) const = 0;
};

}  // namespace sluice::ice

// Conditions of kind Sine: pressure and velocity swing about a mean,
//   q = reference + A sin(omega t) on the face;
// components of the velocity whose reference is zero stay zero. A ghost has what will have come to
// the face when sound has run in from there.
#pragma once
#include "framework/deck/deck.hpp"
#include "ice/conditions/prescribed_flow.hpp"

namespace sluice::ice {

struct FaceCondition;

struct SineSettings {
  double omega = 0;               // 1/s
  double amplitude = 0;           // of the pressure (Pa) and of the velocity (m/s)
  double reference_pressure = 0;  // Pa
  Vec3 reference_velocity{};      // m/s
};

class SineFlow final : public PrescribedFlow {
 public:
  explicit SineFlow(const SineSettings& settings) : s_(settings) {}
  Nature nature() const override { return Nature::wave; }
  Vec3 velocity(const GhostPlace& at, Vec3 value, double rho) const override;
  double pressure(const GhostPlace& at, double rho) const override;
  double on_face(int direction, Vec3 value, double in_ghost, double time) const override;

 private:
  double swing(double time) const;
  SineSettings s_;
};

FaceCondition sine_condition();

}  // namespace sluice::ice

// Conditions of kind MMS_1: the travelling vortices of <manufacturedSolution type="mms_1"> go on at
// the boundary. They are an exact flow without compression:
//   u = 1 - A cos(x - t) sin(y - t) d,  v = 1 + A sin(x - t) cos(y - t) d,  d = exp(-2 nu t)
//   p = p_ref - rho A^2/4 d^2 (cos 2(x - t) + cos 2(y - t)),  nu = mu/rho
#pragma once
#include "framework/deck/deck.hpp"
#include "ice/conditions/prescribed_flow.hpp"

namespace sluice::ice {

struct FaceCondition;

struct TravellingVortices {
  double amplitude = 1;           // A, m/s
  double reference_pressure = 0;  // p_ref, Pa

  struct Flow {
    double u = 0, v = 0, p = 0;  // m/s, Pa
  };
  // At x (m) and a time (s), of a gas of density rho (kg/m^3) and viscosity mu (Pa s).
  Flow at(Vec3 x, double time, double rho, double viscosity) const;
};

class VortexFlow final : public PrescribedFlow {
 public:
  explicit VortexFlow(const TravellingVortices& vortices) : vortices_(vortices) {}
  Nature nature() const override { return Nature::exact; }
  Vec3 velocity(const GhostPlace& at, Vec3 /*value*/, double rho) const override {
    const TravellingVortices::Flow flow = vortices_.at(at.centre, at.time, rho, at.viscosity);
    return {flow.u, flow.v, 0};
  }
  double pressure(const GhostPlace& at, double rho) const override {
    return vortices_.at(at.centre, at.time, rho, at.viscosity).p;
  }
  double on_face(int /*direction*/, Vec3 /*value*/, double in_ghost,
                 double /*time*/) const override {
    return in_ghost;
  }

 private:
  TravellingVortices vortices_;
};

FaceCondition travelling_vortices_condition();

}  // namespace sluice::ice

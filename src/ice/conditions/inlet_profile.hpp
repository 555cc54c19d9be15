// Conditions of kinds powerLawProfile and logLawProfile: a velocity that depends on the height h
// above the low side of the domain along `vertical`,
//   power law: the velocity given times min(h/H, 1)^exponent
//   log law: the velocity given (friction velocity) times ln(h/z0)/kappa, 0 below z0
#pragma once
#include <optional>

#include "framework/deck/deck.hpp"
#include "ice/conditions/prescribed_flow.hpp"

namespace sluice::ice {

struct FaceCondition;

struct InletProfile {
  int vertical = 1;
  double exponent = 0;           // of the power law, without unit
  std::optional<double> height;  // H, m; the domain's without it
  double roughness = 0;          // z0, m
  double von_karman = 0.4;       // kappa, without unit
};

class ProfileFlow : public PrescribedFlow {
 public:
  explicit ProfileFlow(const InletProfile& profile) : profile_(profile) {}
  Nature nature() const final { return Nature::velocity; }
  Vec3 velocity(const GhostPlace& at, Vec3 value, double /*rho*/) const final {
    return share(at) * value;
  }
  double pressure(const GhostPlace& /*at*/, double /*rho*/) const final { return 0; }  // not asked
  double on_face(int /*direction*/, Vec3 /*value*/, double in_ghost, double /*time*/) const final {
    return in_ghost;
  }

 protected:
  // Factor of the velocity given, without unit.
  virtual double share(const GhostPlace& at) const = 0;
  InletProfile profile_;
};

class PowerLawFlow final : public ProfileFlow {
 public:
  using ProfileFlow::ProfileFlow;

 private:
  double share(const GhostPlace& at) const override;
};

class LogLawFlow final : public ProfileFlow {
 public:
  using ProfileFlow::ProfileFlow;

 private:
  double share(const GhostPlace& at) const override;
};

FaceCondition power_law_condition();
FaceCondition log_law_condition();

}  // namespace sluice::ice

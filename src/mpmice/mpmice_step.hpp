// The step of fluid and solids: the sweep of the fluid between stages of the solids and of what
// joins both.
#pragma once
#include "ice/fluid_step.hpp"

namespace sluice::mpmice {

class MpmIce;

class MpmIceStep final : public ice::FluidStep {
 public:
  explicit MpmIceStep(const MpmIce& both);

  void declare_stages(StepShape& shape) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;
  double array_bytes(const Level& finest) const override;

 private:
  const MpmIce* both_;
};

}  // namespace sluice::mpmice

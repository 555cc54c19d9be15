// Histories of solids; what is saved of particles is the particle method's (solid_particles.hpp).
#pragma once
#include "framework/run/component/output_facet.hpp"

namespace sluice::mpm {

class Mpm;

class MpmOutputs final : public OutputFacet {
 public:
  explicit MpmOutputs(const Mpm& mpm) : mpm_(&mpm) {}

  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;

 private:
  const Mpm* mpm_;
};

}  // namespace sluice::mpm

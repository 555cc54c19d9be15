// Solids alone in implicit steps: the component impm.
#pragma once
#include "mpm/mpm.hpp"

namespace sluice::mpm {

class ImplicitMpm final : public Mpm {
 public:
  using Mpm::Mpm;

  std::string name() const override { return "impm"; }
  void shape_step(StepShape& shape) const override;
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  // Particles alone are followed: what nodes gain and lose on the way is the rule's of the step.
  std::vector<std::string> tally_names() const override { return {}; }
  std::vector<double> tallies(const std::vector<double>& /*sums*/) const override { return {}; }
  std::vector<ConservedTotal> tallied_totals(const Totals& /*totals*/) const override { return {}; }
  std::vector<std::pair<std::string, double>> account(
      const Conservation& /*tallies*/) const override {
    return {};
  }
};

// Explicit or implicit, as the scene says.
std::unique_ptr<Mpm> make_solids(const Scene& scene, MpmScene solids);

}  // namespace sluice::mpm

// Solids alone in implicit steps: the component impm.
#pragma once
#include "mpm/mpm.hpp"

namespace sluice::mpm {

class ImplicitMpm final : public Mpm {
 public:
  using Mpm::Mpm;

  std::string name() const override { return "impm"; }
  void shape_step(StepShape& shape) const override;
  // Implicit steps have books of their own; their scheme takes energy, it gives none.
  std::vector<BodyEnergy> body_energies(const std::vector<double>& /*sums*/) const override {
    return {};
  }
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  std::vector<std::pair<std::string, double>> budget(
      const Conservation& tracked_totals) const override;
};

// Explicit or implicit, as the scene says.
std::unique_ptr<Mpm> make_solids(const Scene& scene, MpmScene solids);

}  // namespace sluice::mpm

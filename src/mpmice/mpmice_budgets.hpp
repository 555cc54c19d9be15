// The budgets of fluid and solids together: totals, what passes, the account of energy.
#pragma once
#include "framework/run/component/budget_facet.hpp"

namespace sluice::mpmice {

class MpmIce;

class MpmIceBudgets final : public BudgetFacet {
 public:
  explicit MpmIceBudgets(const MpmIce& both) : both_(&both) {}

  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  void add_particle_totals(const ParticleCloud& particles, Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::optional<VolumeSums> volume_sums() const override;
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  std::vector<ConservedTotal> tallied_totals(const Totals& totals) const override;
  std::vector<std::pair<std::string, double>> budget(const Conservation& tallies) const override;
  std::vector<BodyEnergy> body_energies(const std::vector<double>& sums) const override;
  std::string place_of_gain(const ParticleCloud& cloud, int material,
                            Communicator& ranks) const override;

 private:
  void add_reference_work(const ParticleCloud& particles, Totals& totals) const;

  const MpmIce* both_;
};

}  // namespace sluice::mpmice

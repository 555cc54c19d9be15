// The budgets of solids: what particles hold, what passes, the account of their energy.
#pragma once
#include "framework/run/component/budget_facet.hpp"

namespace sluice::mpm {

class Mpm;

class MpmBudgets : public BudgetFacet {
 public:
  explicit MpmBudgets(const Mpm& mpm) : mpm_(&mpm) {}

  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  void add_particle_totals(const ParticleCloud& particles, Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  std::vector<ConservedTotal> tallied_totals(const Totals& totals) const override;
  std::vector<std::pair<std::string, double>> budget(const Conservation& tallies) const override;
  // The same of tallies that begin with a number, among those of another part too.
  static std::vector<std::pair<std::string, double>> budget_from(const Conservation& tallies,
                                                                 int first);
  std::vector<BodyEnergy> body_energies(const std::vector<double>& sums) const override;
  std::string place_of_gain(const ParticleCloud& cloud, int material,
                            Communicator& ranks) const override;
  std::string better_for_energy() const override;

 private:
  const Mpm* mpm_;
};

// Implicit steps have an account of their own; their scheme takes energy, it gives none.
class ImplicitMpmBudgets final : public MpmBudgets {
 public:
  using MpmBudgets::MpmBudgets;
  std::vector<std::pair<std::string, double>> budget(const Conservation& tallies) const override;
  std::vector<BodyEnergy> body_energies(const std::vector<double>& /*sums*/) const override {
    return {};
  }
};

}  // namespace sluice::mpm

// Solids alone: the material point method as a component.
#pragma once
#include <memory>

#include "framework/run/component/component.hpp"
#include "framework/run/component/no_transfer.hpp"
#include "framework/run/simulation/energy_guard.hpp"
#include "mpm/budgets/history_sums.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/solid_particles.hpp"
#include "mpm/step/stable_step.hpp"

namespace sluice::mpm {

class SolidLevels;

class Mpm : public Component {
 public:
  Mpm(const Scene& scene, MpmScene solids);

  // A warning for each label that the deck saves and none of its particles has.
  void warn_of_absent_labels(std::vector<Fault>& faults) const;

  std::string name() const override { return "mpm"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return static_cast<int>(solids_.materials.size()); }

  const ParticleMethod* particles() const override { return &particles_; }
  const MpmScene& scene() const { return solids_; }
  const std::vector<Carried>& carried() const { return particles_.carried(); }
  // The stages of a step, for components that join them with others.
  std::shared_ptr<SolidLevels> make_step() const;
  bool has_history(Label label) const;
  void shape_step(StepShape& shape) const override;
  int reduction_maxima() const override;
  int reduction_sums() const override;
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  double courant_number() const override { return 1; }

  // Of Totals::amounts, how many are the solids'.
  std::size_t amount_count() const { return history_sums_.count(); }
  void add_particle_totals(const ParticleCloud& particles, Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<BodyEnergy> body_energies(const std::vector<double>& sums) const override;
  std::string place_of_gain(const ParticleCloud& cloud, int material,
                            Communicator& ranks) const override;
  std::string better_for_energy() const override;
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  std::vector<ConservedTotal> tallied_totals(const Totals& totals) const override;
  // The same of tallies that begin with a number, among those of another part too.
  static std::vector<std::pair<std::string, double>> budget_from(const Conservation& tracked_totals,
                                                                 int first);
  std::vector<std::pair<std::string, double>> budget(
      const Conservation& tracked_totals) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;

  // No field lives in cells: particles carry everything from step to step.
  std::vector<SlotInfo> state_slots() const override { return {}; }
  std::vector<std::vector<Label>> checkpoint_labels() const override { return {}; }
  void initialise(Warehouse& /*state*/) const override {}
  void fill_boundary(Warehouse& /*state*/, double /*time*/, std::span<const double> /*sums*/,
                     const ThreadTeam& /*team*/) const override {}
  void declare_step(TaskList& /*list*/, const StepVariant& /*variant*/) const override {}
  void declare_diagnostics(TaskList& list, int level) const override;
  const TransferOperators& transfer() const override { return no_transfer_; }
  Label refine_flag() const override;
  Label mask_label() const override;
  bool skipping_allowed() const override { return false; }
  void measure_rates(const Warehouse& /*state*/, Reductions& /*rates*/) const override {}
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  std::string describe_fault(int kind) const override;

 protected:
  const Scene& run_scene() const { return scene_; }

 private:
  const Scene& scene_;
  MpmScene solids_;
  SolidParticles particles_;
  EffectList effects_;
  HistorySums history_sums_;
  StepLimit stable_;  // share of h/(c + |v|), by the deck's multiplier
  NoTransfer no_transfer_;
};

}  // namespace sluice::mpm

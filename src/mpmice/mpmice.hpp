// Fluid and solids on one grid as a component of a run: both parts, and what joins them.
//
// Numbers of effects, maxima, sums and materials: those of the solids come first.
#pragma once
#include <memory>

#include "framework/run/component/joined_particles.hpp"
#include "ice/ice.hpp"
#include "mpm/mpm.hpp"
#include "mpmice/burn/burning_cells.hpp"

namespace sluice::mpmice {

// Solids between which the exchange of momentum is as good as infinite move with one velocity where
// they meet: a rule of contact, before those of the deck.
void bind_solids(const ice::IceScene& fluid, mpm::MpmScene& solids);

class MpmIce final : public Component {
 public:
  // `burns`: solids that become fluids.
  MpmIce(const Scene& scene, ice::IceScene fluid, mpm::MpmScene solids,
         std::vector<models::SolidBurn> burns = {});

  const mpm::Mpm& solids() const { return solids_; }
  const ice::Ice& fluid() const { return fluid_; }

  std::string name() const override { return "mpmice"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return solids_.material_count() + fluid_.material_count(); }

  std::vector<SlotInfo> state_slots() const override { return fluid_.state_slots(); }
  std::vector<std::vector<Label>> checkpoint_labels() const override {
    return fluid_.checkpoint_labels();
  }
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override {
    fluid_.fill_boundary(state, time, sums, team);
  }
  int boundary_sums() const override { return fluid_.boundary_sums(); }
  void add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const override {
    fluid_.add_boundary_sums(state, sums);
  }

  void declare_step(TaskList& list, const StepVariant& variant) const override {
    fluid_.declare_step(list, variant);
  }
  int step_kinds() const override { return fluid_.step_kinds(); }
  int step_kind(const Warehouse& old_state, int local_box,
                const IndexBox& cells_with_halo) const override {
    return fluid_.step_kind(old_state, local_box, cells_with_halo);
  }
  std::optional<double> absent_value(Label label, int material, int kind) const override {
    return fluid_.absent_value(label, material, kind);
  }
  void shape_step(StepShape& shape) const override;
  std::vector<SlotInfo> work_slots() const override;
  void fill_work_boundary(Warehouse& state, Label label, const ThreadTeam& team) const override {
    fluid_.fill_work_boundary(state, label, team);
  }
  void declare_diagnostics(TaskList& list, int level) const override;

  const TransferOperators& transfer() const override { return fluid_.transfer(); }
  IntVec3 interface_depth(const Level& level) const override {
    return fluid_.interface_depth(level);
  }
  Label refine_flag() const override { return fluid_.refine_flag(); }
  std::vector<ErrorEstimate> error_estimates() const override { return fluid_.error_estimates(); }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const override {
    return fluid_.flag_seeds(state);
  }
  Label mask_label() const override { return fluid_.mask_label(); }
  const ParticleMethod* particles() const override {
    return joined_ ? joined_.get() : solids_.particles();
  }

  int reduction_maxima() const override;
  int reduction_sums() const override;
  std::vector<OutputSwitch> output_switches() const override;
  bool passes_switch(std::size_t n, const std::vector<double>& sums) const override;
  int first_volume_sum() const override { return fluid_.first_volume_sum(); }
  bool skipping_allowed() const override { return fluid_.skipping_allowed(); }
  bool may_be_skipped(int kind) const override { return fluid_.may_be_skipped(kind); }
  double courant_number() const override { return fluid_.courant_number(); }
  bool diffusive() const override { return fluid_.diffusive(); }
  void measure_rates(const Warehouse& state, Reductions& rates) const override {
    fluid_.measure_rates(state, rates);
  }
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  void add_particle_totals(const ParticleCloud& particles, Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<BodyEnergy> body_energies(const std::vector<double>& sums) const override {
    return solids_.body_energies(sums);
  }
  std::string place_of_gain(const ParticleCloud& cloud, int material,
                            Communicator& ranks) const override {
    return solids_.place_of_gain(cloud, material, ranks);
  }
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  std::vector<ConservedTotal> tallied_totals(const Totals& totals) const override;
  std::vector<std::pair<std::string, double>> budget(
      const Conservation& tracked_totals) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;
  std::string describe_fault(int kind) const override { return fluid_.describe_fault(kind); }

 private:
  std::size_t first_burned_sum() const;
  void add_reference_work(const ParticleCloud& particles, Totals& totals) const;
  bool has_budget() const;  // of energy: nothing burns, no solid is rigid
  Totals fluid_totals(const Totals& all) const;
  const Scene& scene_;
  mpm::Mpm solids_;
  ice::Ice fluid_;
  std::vector<models::SolidBurn> burns_;
  BurningCells burning_;
  EffectList effects_;
  std::unique_ptr<JoinedParticles> joined_;  // of solids and tracers, where there are any
};

}  // namespace sluice::mpmice

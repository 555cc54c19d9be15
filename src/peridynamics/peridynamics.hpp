// Peridynamic solids as a component: points with bonds, velocity Verlet.
#pragma once
#include <memory>

#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"
#include "peridynamics/deck/peri_scene.hpp"
#include "peridynamics/start/point_particles.hpp"
#include "peridynamics/step/step_sums.hpp"

namespace sluice::peridynamics {

class Peridynamics final : public Component,
                           public StepFacet,
                           public BudgetFacet,
                           public OutputFacet {
 public:
  Peridynamics(const Scene& scene, PeriScene solids);
  // Its particles refer to it.
  Peridynamics(const Peridynamics&) = delete;
  Peridynamics& operator=(const Peridynamics&) = delete;

  std::string name() const override { return "peridynamics"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return static_cast<int>(solids_.materials.size()); }
  const StateFacet& state() const override { return state_; }
  const StepFacet& step() const override { return *this; }
  const BudgetFacet& budgets() const override { return *this; }
  const OutputFacet& outputs() const override { return *this; }
  const ParticleMethod* particles() const override { return &particles_; }

  // The step.
  void declare(TaskList& /*list*/, const StepVariant& /*variant*/) const override {}
  void declare_stages(StepShape& shape) const override;
  const ReductionLayout& reductions() const override { return reductions_; }
  StepLimit limit(const std::vector<double>& maxima) const override;
  double array_bytes(const Level& finest) const override;

  // The books.
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  void add_particle_totals(const ParticleCloud& cloud, Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  std::vector<std::pair<std::string, double>> budget(const Conservation& tallies) const override;

  // Histories.
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;

 private:
  const Scene& scene_;
  PeriScene solids_;
  PointParticles particles_;
  EffectList effects_;
  StateFacet state_;
  ReductionLayout reductions_;
};

void declare_labels();
std::vector<std::string> histories(const DeckNode& root);
std::unique_ptr<Component> make(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::peridynamics

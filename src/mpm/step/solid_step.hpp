// One step of all solids of a level, stage by stage: mpm_scheme, section 2.
//
// ParticlesToNodes gives mass, momentum and force to nodes; NodeStage moves these; NodesToParticles
// moves particles by them and finds their stress. SolidEffects has an entry for each further
// phenomenon that the scene asks for. An attempt writes beside what there is: new columns of the
// particles, nodes. Only the journal makes them the present state.
#pragma once
#include <memory>
#include <vector>

#include "mpm/step/node_stage.hpp"
#include "mpm/step/nodes_to_particles.hpp"
#include "mpm/step/solid_effects.hpp"
#include "mpm/step/step_outcome.hpp"
#include "mpm/step/xpic_filter.hpp"

namespace sluice::mpm {

class SolidStep;
// A group of lanes of the bodies of a step: sums that particles give to nodes, then velocities.
using NodeGroup = NodeLanes& (*)(SolidStep&, int body);
NodeLanes& nodes_of(SolidStep& step, int body);     // of the step
NodeLanes& mapped_of(SolidStep& step, int body);    // that particles give back
NodeLanes& passed_of(SolidStep& step, int body);    // of a pass of XPIC: its sums,
NodeLanes& filtered_of(SolidStep& step, int body);  // and its velocities
NodeLanes& friction_of(SolidStep& step, int body);  // rise of temperature by friction

class SolidStep {
 public:
  // The kinds of particles are the materials, in their order, and then the cohesive zones.
  SolidStep(const Scene& scene, const MpmScene& solids, const std::vector<Carried>& carried,
            const std::vector<ParticleKind>& kinds);
  SolidStep(const SolidStep&) = delete;  // its parts refer to each other
  SolidStep& operator=(const SolidStep&) = delete;

  // The stages of a step, in order.
  Verdict begin(const StageScope& scope);
  Verdict to_grid(const StageScope& scope);
  Verdict share_sums(const StageScope& scope, NodeGroup group = nodes_of);
  Verdict move_nodes(const StageScope& scope);
  Verdict from_grid(const StageScope& scope);

  // Bounds of sums are the same on all levels: spacings, and the bound of forces from outside.
  LevelSpacings& spacings() { return spacings_; }
  void set_most_force(int body, double force);
  // Images across sides join their nodes, and get the velocities of these.
  void fold(NodeGroup group = nodes_of);
  void unfold(NodeGroup group = nodes_of);

  // Parts of the step that SolidLevels joins over levels, once it has begun. mapped(), filter():
  // where the transfer has them.
  MappedBack& mapped() { return *mapped_; }
  XpicFilter& filter() { return *filter_; }
  NodesToParticles& particles() { return *particles_; }
  SolidEffects& effects() { return *effects_; }
  std::vector<BlockWork>& work() { return work_; }
  const LevelNodes& nodes() const { return nodes_; }
  // Null: no rule acts.
  const ContactStage* contact() const { return contact_.get(); }
  // Of a master in this step; null: no rule prescribes any.
  const MasterMotion* motion_of(int body) const;

  // After share_sums(): the materials on the nodes.
  Body& body(int m) { return bodies_[static_cast<std::size_t>(m)]; }
  const std::vector<Body>& bodies() const { return bodies_; }
  // After from_grid().
  const StepOutcome& outcome() const { return outcome_; }
  // Velocities were changed further; bounds of those of a body (all ranks').
  void include_velocities(int m, Vec3 up, Vec3 down) { outcome_.include_velocities(m, up, down); }

 private:
  void make();
  void list_work(ParticleCloud& cloud, double time);
  void find_bounds(const StageScope& scope);

  SolidParts parts_;
  LevelSpacings spacings_;
  LevelNodes nodes_;
  std::vector<Body> bodies_;
  std::vector<BlockWork> work_;
  std::unique_ptr<ContactStage> contact_;  // null: no rule acts
  std::unique_ptr<MappedBack> mapped_;     // null: no velocities are mapped back
  std::unique_ptr<XpicFilter> filter_;     // null: another transfer
  std::unique_ptr<SolidEffects> effects_;
  std::unique_ptr<NodeStage> node_stage_;
  std::unique_ptr<NodesToParticles> particles_;
  StepOutcome outcome_;
};

}  // namespace sluice::mpm

// A step of solids on all levels: each stage on every level, and what joins the levels between.
//
// All levels take the same step. Particles live on the finest level over them; the nodes of all
// levels have one basis (composite_nodes.hpp).
#pragma once
#include <memory>
#include <vector>

#include "mpm/grains/regroup.hpp"
#include "mpm/levels/composite_nodes.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

class SolidLevels {
 public:
  SolidLevels(const Scene& scene, const MpmScene& solids, const std::vector<Carried>& carried,
              const std::vector<ParticleKind>& kinds);

  // The stages of a step, in order.
  Verdict begin(const StageScope& scope);
  // Between begin() and to_grid(), if at all: forces from outside on corners of this rank's
  // particles, forces[level][material]. Their places may be any that corners of its particles have.
  // Collective: the sums must have room for the largest.
  void add_corner_forces(const StageScope& scope,
                         const std::vector<std::vector<solids::CornerForces>>& forces);
  // The midpoint transfer, in the first step alone.
  Verdict start_spins(const StageScope& scope);
  Verdict to_grid(const StageScope& scope);
  Verdict share_sums(const StageScope& scope);
  Verdict move_nodes(const StageScope& scope);
  Verdict filter_velocities(const StageScope& scope);
  Verdict map_back(const StageScope& scope);
  Verdict from_grid(const StageScope& scope);
  Verdict commit(const StageScope& scope);
  // Particles to their boxes, corners with them: after some have been taken away. Collective.
  void relocate(ParticleCloud& cloud);

  // After from_grid(), of a kind in a local box of a level: particles as they were, and as they are
  // at the end of the step. The latter has places and the columns that a step advances alone.
  struct BeforeAndAfter {
    const ParticleSet &before, &after;
  };
  static BeforeAndAfter moved(ParticleCloud& cloud, int kind, int level, int box);

  SolidStep& level(int l) { return *steps_[l]; }
  int count() const { return static_cast<int>(steps_.size()); }

 private:
  using Stage = Verdict (SolidStep::*)(const StageScope&);
  Verdict on_levels(const StageScope& scope, Stage stage);
  StageScope scope_of(const StageScope& scope, int level);
  void look_at_levels(const StageScope& scope);
  // Sums of a group of lanes joined over images, levels and ranks; velocities spread the other way.
  void join_sums(const StageScope& scope, NodeGroup group);
  void spread_velocities(NodeGroup group);
  void spread(NodeGroup group);
  static Verdict agree_on(const StageScope& scope, std::vector<KindRates>& bounds,
                          const std::string& fault);
  void heat_by_losses(const StageScope& scope);
  void map_all_back(const StageScope& scope, std::span<const KindRates> bounds);
  // Clusters of grains into materials of their own; whether any particle has changed.
  bool regroup(ParticleCloud& cloud, Communicator& ranks, const StepEnd& end);
  // Rigid bodies that transmit forces move by what all levels gave them.
  void push_transmitting(const StageScope& scope);

  const Scene* scene_;
  const MpmScene* solids_;
  const std::vector<Carried>* carried_;
  const std::vector<ParticleKind>* kinds_;
  std::vector<std::unique_ptr<SolidStep>> steps_;
  std::vector<Level> present_;                               // as they were when last looked at
  std::vector<std::unique_ptr<CompositeNodes>> interfaces_;  // by coarser level
  std::vector<std::vector<std::vector<double>>> maxima_;     // by level: what its step is handed
  double strayed_ = 0;  // since the particles were sorted, cells
};

}  // namespace sluice::mpm

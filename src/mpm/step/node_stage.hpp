// The step on the nodes of all bodies of a level: forces, contact where bodies meet, boundary; or a
// motion that the deck prescribes.
#pragma once
#include <memory>
#include <vector>

#include "mpm/loads/prescribed_motion.hpp"
#include "mpm/step/contact_stage.hpp"

namespace sluice::mpm {

class NodeStage {
 public:
  // Keeps references. `contact`, `friction`: null, the scene has none.
  NodeStage(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
            ContactStage* contact, FrictionHeat* friction, const SolidEffectList& effects);

  // `several`: levels, which pass heat of friction on to each other.
  void move(const StepScope& at, const NodeStep& step, bool several);

  // The sums of this rank, of the step.
  NodeBooks& books() { return books_; }

 private:
  void prescribe(const StepScope& step) const;
  void list_groups(bool several);
  void move_groups(const NodeStep& step, std::vector<NodeBooks>& books);

  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  ContactStage* contact_;
  FrictionHeat* friction_;
  std::vector<SolidEffect*> effects_;
  NodeUpdate update_;
  std::unique_ptr<PrescribedMotion> prescribed_;  // null: the particles are free
  BlockGroups groups_;
  NodeBooks books_;
};

// What a step is to nodes, of the run's constants.
NodeStep node_step(const Scene& scene, const MpmScene& solids, const Level& level,
                   const StageScope& scope);

}  // namespace sluice::mpm

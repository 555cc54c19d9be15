#include "mpm/step/node_stage.hpp"

#include "mpm/step/mirror_books.hpp"

namespace sluice::mpm {

NodeStep node_step(const Scene& scene, const MpmScene& solids, const Level& level,
                   const StageScope& scope) {
  NodeStep step;
  step.dt = scope.step.dt;
  const bool whole = solids.whole_kicks || (solids.full_first_kick && scope.dt_before == 0);
  step.kick = whole ? step.dt : 0.5 * (scope.dt_before + step.dt);
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) step.gravity[d] = scene.constants.gravity[d];
  step.damping = solids.damping;
  return step;
}

NodeStage::NodeStage(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
                     ContactStage* contact, FrictionHeat* friction, const SolidEffectList& effects)
    : nodes_(&nodes),
      bodies_(&bodies),
      contact_(contact),
      friction_(friction),
      effects_(effects),
      update_(nodes, bodies, effects) {
  if (!solids.prescribed_file.empty())
    prescribed_ =
        std::make_unique<PrescribedMotion>(PrescribedMotion::read(solids.prescribed_file));
}

// v* = G x on all nodes of bodies that deform.
void NodeStage::prescribe(const StepScope& step) const {
  const Matrix3 rate = prescribed_->rate(step.time, step.dt);
  BlockGroups blocks;
  list_single_blocks(*bodies_, blocks);
  for (std::size_t g = 0; g < blocks.count(); ++g) update_.prescribe(rate, blocks[g].front());
}

void NodeStage::list_groups(bool several) {
  const bool meets = contact_ != nullptr && contact_->blocks().any();
  if (friction_ != nullptr) friction_->make_room(several || meets);
  if (contact_ == nullptr) {
    list_single_blocks(*bodies_, groups_);
    return;
  }
  contact_->begin_held();
  contact_->blocks().list_groups(*bodies_, groups_);
}

void NodeStage::move_groups(const NodeStep& step, std::vector<NodeBooks>& books) {
  const ThreadTeam& team = *nodes_->team;
  std::vector<MeetingScratch> scratch(static_cast<std::size_t>(team.size()));
  for (MeetingScratch& of : scratch) of.impulses.resize(1);
  if (contact_ == nullptr)
    team.for_each(groups_.count(), [&](std::size_t g, int thread) {
      const auto t = static_cast<std::size_t>(thread);
      update_.move(step, groups_[g].front(), scratch[t].impulses.front(), books[t]);
    });
  else
    team.for_each(groups_.count(), [&](std::size_t g, int thread) {
      const auto t = static_cast<std::size_t>(thread);
      contact_->move(step, groups_[g], update_, friction_, scratch[t], books[t]);
    });
}

void NodeStage::move(const StepScope& at, const NodeStep& step, bool several) {
  std::vector<NodeBooks> books(static_cast<std::size_t>(nodes_->team->size()));
  for (NodeBooks& of : books) of.make_room(bodies_->size());
  if (prescribed_ != nullptr) {
    prescribe(at);
  } else {
    for (SolidEffect* effect : effects_) effect->before_nodes();
    list_groups(several);
    move_groups(step, books);
    for (std::size_t k = 0; k < bodies_->size(); ++k) {
      const Body& body = (*bodies_)[k];
      const int m = static_cast<int>(k);
      book_mirrored_changes(*nodes_, body, m, body.nodes, books[0]);
      nodes_->boundary->unfold(m, body.table, (*bodies_)[k].nodes);
    }
  }
  for (std::size_t n = 1; n < books.size(); ++n) books[0].merge(books[n]);
  books_ = std::move(books[0]);
  for (SolidEffect* effect : effects_) effect->after_nodes(step, books_);
}

}  // namespace sluice::mpm

// What a deck gives for all faces with a condition of a kind: the blocks of <BoundaryConditions>
// that kinds of conditions need.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "ice/conditions/open_face.hpp"
#include "ice/conditions/prescribed_flow.hpp"
#include "ice/conditions/wall_slip.hpp"

namespace sluice::ice {

struct FlowConditions {
  struct Flow {
    std::string kind;  // the word of the condition
    std::shared_ptr<const PrescribedFlow> flow;
  };

  std::optional<LodiSettings> lodi;
  std::optional<SlipSettings> slip;
  std::vector<Flow> flows;

  // Null: the deck has none of this kind.
  std::shared_ptr<const PrescribedFlow> flow(const std::string& kind) const;
};

// Of a deck that has been checked.
FlowConditions read_flow_conditions(const DeckNode& root);

}  // namespace sluice::ice

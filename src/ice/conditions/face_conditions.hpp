// The table of kinds of boundary conditions of a fluid: <BCType var=>.
//
// A new kind is a file of this folder and a row in face_conditions.cpp; one that gives the flow as
// a function of place and time derives from PrescribedFlow. Schema, checks, help and ghosts read
// the columns of the row, never its word.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/scene/boundary.hpp"
#include "ice/conditions/flow_conditions.hpp"
#include "ice/conditions/ghost_rule.hpp"

namespace sluice::ice {

struct FaceCondition {
  std::string_view word = {};                    // <BCType var=>
  std::vector<std::string_view> variables = {};  // that it is for: <BCType label=>; empty: any
  // Element of <BoundaryConditions> with its parameters, if it needs one; its own rules.
  std::optional<TagSpec> block = std::nullopt;
  void (*check_block)(const DeckNode& block, std::vector<Fault>& faults) = nullptr;
  // What must hold of a condition beyond its variable and its block.
  void (*check)(const DeckNode& root, const DeckNode& condition,
                std::vector<Fault>& faults) = nullptr;
  // Of the velocity: nothing passes the face, or what passes is given, with a <value>.
  bool wall = false, gives_velocity = false;
  // The mean free path of one gas counts.
  bool rarefied = false;
  // The flow that it gives; null: none, or the deck lacks what it needs.
  std::shared_ptr<const PrescribedFlow> (*read_flow)(const DeckNode& root) = nullptr;
  // What its block says for all faces; null: nothing beyond that flow.
  void (*read_settings)(const DeckNode& block, FlowConditions& conditions) = nullptr;
  // Writes the condition into a rule of ghosts; null: the framework's kinds (boundary/make_rule).
  // Throws InputError, with the deck's line, where what it needs is missing.
  void (*apply)(const Condition& condition, int normal, const FlowConditions& settings,
                GhostRule& rule) = nullptr;

  bool is_for(std::string_view variable) const;
};

const std::vector<FaceCondition>& face_conditions();
// Null: there is none of this word.
const FaceCondition* face_condition(std::string_view word);
// "Dirichlet, Neumann, ... and MMS_1".
std::string known_face_conditions();

// The `apply` of conditions that give a flow.
void apply_flow(const Condition& condition, int normal, const FlowConditions& settings,
                GhostRule& rule);
[[noreturn]] void throw_missing_block(const Condition& condition, std::string_view block);

}  // namespace sluice::ice

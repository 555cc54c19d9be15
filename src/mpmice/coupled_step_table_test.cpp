// The table of the coupled step: short, and without a row for what the deck does not ask for.
#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::coupled_step_table {
namespace {

// The rows, those of passes once.
void list(const std::vector<StepShape::Stage>& stages, std::vector<std::string>& rows) {
  for (const StepShape::Stage& stage : stages) {
    if (const auto* solve = std::get_if<StepShape::Solve>(&stage)) rows.push_back(solve->name);
    if (const auto* sweep = std::get_if<StepShape::Sweep>(&stage)) rows.push_back(sweep->name);
    if (const auto* prepare = std::get_if<StepShape::Prepare>(&stage))
      rows.push_back(prepare->name);
    if (const auto* iterate = std::get_if<StepShape::Iterate>(&stage)) list(iterate->body, rows);
  }
}

std::vector<std::string> rows_of(const CoupledDeck& deck) {
  const GivenFluid both(deck);
  StepShape shape;
  both.component().step().declare_stages(shape);
  std::vector<std::string> rows;
  list(shape.stages(), rows);
  return rows;
}

bool has(const std::vector<std::string>& rows, const std::string& name) {
  return std::find(rows.begin(), rows.end(), name) != rows.end();
}

TEST(CoupledStepTable, HasAtMostTwentyRows) {
  CoupledDeck deck;
  deck.heat = deck.drag = "1";
  const std::vector<std::string> rows = rows_of(deck);
  EXPECT_LE(rows.size(), 20u);
  EXPECT_TRUE(has(rows, "exchange of momentum and heat"));
}

TEST(CoupledStepTable, LeavesOutWhatTheDeckDoesNotAskFor) {
  const std::vector<std::string> rows = rows_of({});
  EXPECT_FALSE(has(rows, "exchange of momentum and heat"));
  EXPECT_FALSE(has(rows, "burning of solids"));
}

// Rows that a pass repeats count once.
TEST(CoupledStepTable, OfASemiImplicitStepHasAtMostTwentySix) {
  CoupledDeck deck;
  deck.heat = deck.drag = "1";
  deck.fluid =
      "<ImplicitSolver><max_outer_iterations>9</max_outer_iterations><outer_iteration_tolerance>"
      "1e-9</outer_iteration_tolerance><iters_before_timestep_restart>9"
      "</iters_before_timestep_restart><Parameters variable='implicitPressure'><tolerance>1e-9"
      "</tolerance></Parameters></ImplicitSolver>";
  std::vector<std::string> rows = rows_of(deck);
  EXPECT_TRUE(has(rows, "work pressure beside solids"));
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  EXPECT_LE(rows.size(), 26u);
}

}  // namespace
}  // namespace sluice::mpmice::coupled_step_table

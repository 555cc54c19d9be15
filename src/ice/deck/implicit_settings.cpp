#include "ice/deck/implicit_settings.hpp"

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/solve/solver_tags.hpp"
#include "ice/deck/schema.hpp"
#include "ice/deck/scheme.hpp"

namespace sluice::ice {

TagSpec implicit_solver_tag() {
  return tag("ImplicitSolver",
             "semi-implicit pressure: the time step is limited by the flow, not by sound")
      .with_children(
          {tag("max_outer_iterations",
               "maximum number of solves in a step; 1: the remaining volume error of "
               "cells is corrected in the next step")
               .once()
               .integer()
               .at_least(1),
           tag("outer_iteration_tolerance",
               "largest relative error of the volume of a cell after the last solve")
               .once()
               .real()
               .at_least(0),
           tag("iters_before_timestep_restart",
               "after this number of pressure solves a step is repeated with a smaller time step, "
               "if a solve has reduced the error by less than a factor of three")
               .integer()
               .at_least(1)})
      .child(solve::solver_parameters_tag());
}

ImplicitSettings read_implicit(const DeckNode& root, const DeckNode& block,
                               std::vector<Fault>& faults) {
  ImplicitSettings s;
  s.where = block.where;
  s.max_passes = integer_or(block, "max_outer_iterations", s.max_passes);
  s.tolerance = real_or(block, "outer_iteration_tolerance", s.tolerance);
  s.max_passes_before_redo = integer_or(block, "iters_before_timestep_restart", s.max_passes);
  s.linear = solve::read_solver_settings(root, block, "implicitPressure", faults);
  return s;
}

void check_implicit(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* ice = root.find("CFD/ICE");
  const DeckNode* block = ice == nullptr ? nullptr : ice->child("ImplicitSolver");
  if (block == nullptr || !runs_ice(root)) return;
  if (!scheme_of(root).implicit)
    add_error(faults, block->where, "<ImplicitSolver> needs <scheme>conservative</scheme>",
              "remove <scheme>, or <ImplicitSolver>");
  if (const DeckNode* amr = root.child("AMR"); amr != nullptr && !is_true(amr, "useLockStep"))
    if (const DeckNode* grid = root.find("Grid");
        grid != nullptr && amr->child("Regridder") != nullptr)
      add_error(faults, block->where,
                "<ImplicitSolver> solves for the pressure of all levels at once, which must take "
                "the same step",
                "<useLockStep> true in <AMR>");
}

}  // namespace sluice::ice

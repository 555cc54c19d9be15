// What a run will take, in seconds and in bytes of its archive, from recorded costs of a cell and
// of a particle (recorded_costs.hpp).
//
//   seconds = start + steps (cells C + particles P + what a step costs by itself) + outputs
//
// The time step is that of the start throughout, of fluids shortened by what waves from rest gain.
#pragma once
#include <string>
#include <vector>

#include "app/plan/planned_hierarchy.hpp"
#include "app/plan/planned_particles.hpp"
#include "app/plan/planned_steps.hpp"
#include "app/plan/recorded_costs.hpp"

namespace sluice {

struct PlannedCost {
  bool known = false;  // false: the first step is not
  PlannedSteps steps;
  double cell_updates = 0;  // of a step of the coarsest level
  double particles = 0;
  double cell_ns = 0, particle_ns = 0;  // of a step, on this machine
  double start_s = 0, stepping_s = 0, output_s = 0;
  double outputs_bytes = 0, checkpoints_bytes = 0;  // of all that are there at the end
  double machine = 1;      // time of this machine over that of the recorded one
  bool from_rest = false;  // the first steps are shorter than those that follow: an upper bound
  double seconds() const { return start_s + stepping_s + output_s; }
  double bytes() const { return outputs_bytes + checkpoints_bytes; }
};

// What decides the costs, of a plan.
struct CostedRun {
  std::string component;  // ice, mpm, mpmice, ...
  int dimensions = 1;
  double cells = 0;         // at the start, of all levels
  double cell_updates = 0;  // of a step of the coarsest level
  double particles = 0;
  double output_bytes = 0, checkpoint_bytes = 0;  // of one
  std::vector<std::string> effects;               // that are on
  std::string interpolator;                       // of particles
  bool skipping = false;                          // uniform blocks are skipped
  bool from_rest = false;                         // a pressure solve starts from rest
  bool levels = false;                            // several
  int ranks = 1, threads = 1;
};

PlannedCost planned_cost(const CostedRun& run, const PlannedSteps& steps);
std::string cost_text(const PlannedCost& cost);

}  // namespace sluice

// Which cells of each level ask for a finer one: criteria of the component, estimated errors
// against the range of a variable, regions.
#pragma once
#include <vector>

#include "framework/refine/flag_field.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/run/levels/region_flags.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice {

class RefinementFlags {
 public:
  // `levels`: every level that may exist.
  RefinementFlags(const RefinementSettings& settings, const Component& component,
                  const std::vector<Level>& levels);
  // How many levels must be read, of those that exist, to flag the coarsest `flagging`.
  int levels_read(int existing, int flagging) const;
  // Flags of the coarsest `flagging` levels; `levels`: those that must be read, ghost cells filled.
  // Collective: all ranks get the flags of all boxes.
  std::vector<FlagField> of(const std::vector<LevelSolver*>& levels, int flagging, double time,
                            Communicator& communicator, const ParticleCloud* particles = nullptr);

 private:
  void compute(const std::vector<LevelSolver*>& levels, int flagging, double time) const;
  std::vector<double> largest_errors(const std::vector<LevelSolver*>& levels,
                                     Communicator& communicator) const;
  void add_seeds(const LevelSolver& solver, Communicator& communicator,
                 const ParticleCloud* particles, FlagField& flags) const;

  const Component* component_;
  Label flag_;
  std::vector<ErrorEstimate> estimates_;
  std::vector<Label> values_, all_;   // diagnostics: what errors are estimated of; with the flags
  std::vector<RegionFlags> regions_;  // by level
};

}  // namespace sluice

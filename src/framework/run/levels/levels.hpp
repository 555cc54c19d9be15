// All levels of a run: their solvers, where they meet, and how they are laid out.
#pragma once
#include <memory>
#include <vector>

#include "framework/refine/interface_distance.hpp"
#include "framework/refine/level_transfer.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

// Where a level meets the next finer one.
struct LevelInterface {
  Interpolation ghosts;
  FluxRegister fluxes;
  Restriction restriction;
};

class Levels {
 public:
  // Levels that take stages together (StepShape) take the same step; others have substeps by their
  // ratio.
  Levels(const Scene& scene, const Component& component, Communicator& communicator,
         SolverOptions options);

  // Levels that exist now, coarse to fine, and all that may.
  int count() const;
  int possible() const { return static_cast<int>(solvers_.size()); }
  LevelSolver& operator[](int l) { return *solvers_[l]; }
  const LevelSolver& operator[](int l) const { return *solvers_[l]; }
  std::vector<LevelSolver*> existing();
  Grid grid() const;  // of the levels that exist now
  std::int64_t cell_count() const;
  // Of a level in one step of the next coarser one, and in a coarse step.
  int substeps(int l) const { return substeps_[l]; }
  int substeps_in_coarse_step(int l) const { return in_coarse_step_[l]; }

  // Null: there is no finer level.
  LevelInterface* interface(int coarser) { return interfaces_[coarser].get(); }
  // Of the deck's analyses, in its order; none when the component keeps no account of them.
  const std::vector<VolumeCells>& volumes() const { return volumes_; }
  int layouts() const { return layouts_; }  // grows whenever boxes change

  // A level gets other boxes: its state is that of the deck at the start, or goes on, new cells
  // from the coarser level, whose ghosts must be filled. Interfaces are made by the caller.
  void lay_out(int l, std::vector<GridBox> boxes, bool from_deck);
  void make_interface(int coarser);
  // What the levels know of each other, once every interface is made. Levels below `first` lie
  // where they lay, and all but the one next to it meet what they met.
  void connect(int first = 0);
  // The averages of each finer level into the cells below, finest first.
  void restrict_all();

 private:
  void watch_volumes(int first);
  const Level* finer_than(int l) const;

  const Scene* scene_;
  const Component* component_;
  Communicator* communicator_;
  std::vector<std::unique_ptr<LevelSolver>> solvers_;
  std::vector<std::unique_ptr<LevelInterface>> interfaces_;  // by coarser level
  std::vector<int> substeps_, in_coarse_step_;
  std::vector<InterfaceDistance> ends_of_levels_;
  std::vector<VolumeCells> volumes_;
  int layouts_ = 0;
};

}  // namespace sluice

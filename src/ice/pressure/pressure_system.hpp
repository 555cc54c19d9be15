// The linear system of a step, from the fields that a sweep has stored, and its solution into the
// work slot d of each level.
#pragma once
#include <memory>
#include <span>

#include "framework/run/levels/level_solver.hpp"
#include "framework/solve/linear_solver.hpp"

namespace sluice::ice::pressure {

class PressureSystem {
 public:
  virtual ~PressureSystem() = default;
  // Both collective, of levels whose boxes are those at the construction.
  virtual void set_up(std::span<LevelSolver* const> levels) = 0;
  // Ghosts of X- where levels meet, by the same parabola as those of d: with another the two would
  // disagree in every step, and the interface grow waves of its own.
  virtual void join_work_pressure(std::span<LevelSolver* const> /*levels*/) {}
  // d += the solution for the right-hand side under this label of what is stored.
  virtual solve::SolveReport correct(std::span<LevelSolver* const> levels, Label right_side) = 0;
};

// One level: by any solver. Several: by conjugate gradients over all of them.
std::unique_ptr<PressureSystem> make_pressure_system(std::span<LevelSolver* const> levels, int rank,
                                                     const solve::SolverSettings& settings);
std::unique_ptr<PressureSystem> make_composite_system(std::span<LevelSolver* const> levels,
                                                      int rank,
                                                      const solve::SolverSettings& settings);

// The slot of a label that one material alone has, whatever its number; -1 when absent.
inline int slot_of(const Warehouse& fields, Label label) {
  for (int s = 0; s < fields.slot_count(); ++s)
    if (fields.info(s).label == label) return s;
  return -1;
}

template <class F>
void for_each_box(LevelSolver& level, F&& f) {
  for (int b = 0; b < static_cast<int>(level.state().local_boxes().size()); ++b)
    f(b, level.state().local_boxes()[b].cells);
}

}  // namespace sluice::ice::pressure

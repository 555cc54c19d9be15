// solvertest: one solve of a linear system a step, in cells.
//
//   sum over the deck's directions d of  2 x(i) - x(i - e_d) - x(i + e_d)  =  1 in cell (0, 0, 0),
//                                                                           0 elsewhere
// with x = 0 in the cells around the domain. x, without unit, becomes `pressure`.
//
// The step has two stages: a solve fills a work field, a sweep makes the new state from it. Each
// solve begins with the pressure of the step before. The deck's <Solver> and <Parameters> choose
// the solver: framework/solve/solver_tags.hpp.
//
// Limits: one level; the system is the same in every step.
#pragma once
#include <array>
#include <memory>

#include "framework/run/component/plain_component.hpp"
#include "framework/solve/solver_settings.hpp"

namespace sluice::examples {

struct SolverTestScene {
  double dt = 0;                     // <delt>, s
  std::array<bool, 3> directions{};  // <X_Laplacian>, <Y_Laplacian>, <Z_Laplacian>
  solve::SolverSettings solver;
};

struct SolverTestLabels {
  Label pressure, right_side, matrix;
};
SolverTestLabels claim_solver_test_labels();

class SolverTest : public PlainComponent {
 public:
  SolverTest(const Scene& scene, const SolverTestScene& settings);

  std::vector<SlotInfo> slots() const override;
  std::vector<SlotInfo> work_slots() const override;
  void initialise(Warehouse& state) const override { fill_state(state, 0.0); }
  void fill_boundary(Warehouse& /*state*/, double /*time*/, std::span<const double> /*sums*/,
                     const ThreadTeam& /*team*/) const override {}  // nobody reads ghosts
  void declare_stages(StepShape& shape) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  void declare_diagnostics(TaskList& list, int level) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;

 private:
  SolverTestScene settings_;
  SolverTestLabels labels_ = claim_solver_test_labels();
  Label solution_;  // a work field
};

void add_solver_test_tags(Schema& schema);
std::unique_ptr<Component> make_solver_test(const Deck& deck, const Scene& scene,
                                            std::vector<Fault>& faults);

}  // namespace sluice::examples

// The system of one level.
#include "ice/pressure/pressure_system.hpp"

#include "ice/fluid/labels.hpp"

namespace sluice::ice::pressure {
namespace {

// Coefficients of the faces of one direction: between cells, and on sides of the domain, where d of
// the ghost is 0.
void add_faces(const Level& level, int d, const IndexBox& cells, const ConstRealView& face,
               const RealView& diagonal, const RealView& low) {
  const bool wraps = level.periodic[d];
  for_each_cell(cells, [&](IntVec3 c) {
    IntVec3 above = c;
    ++above[d];
    diagonal(c) += face(c) + face(above);
    low(c) = wraps || c[d] > level.domain.lower[d] ? -face(c) : 0.0;
  });
}

class OneLevel final : public PressureSystem {
 public:
  OneLevel(const Level& level, int rank, const solve::SolverSettings& settings)
      : matrix_(level),
        right_side_(solve::boxes_of(level, rank)),
        change_(solve::boxes_of(level, rank)),
        solver_(solve::make_linear_solver(settings)) {}

  void set_up(std::span<LevelSolver* const> levels) override {
    LevelSolver& level = *levels.front();
    const Warehouse& stored = level.outputs();
    const Labels& l = labels();
    const Level& cells_of = level.level();
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const RealView& diagonal = matrix_.diagonal()[b];
      const auto own = stored.view(slot_of(stored, l.matrix_cell), 0, b);
      for_each_cell(cells, [&](IntVec3 c) { diagonal(c) = own(c); });
      for (int d = 0; d < 3; ++d)
        if (cells_of.active[d])
          add_faces(cells_of, d, cells, stored.view(slot_of(stored, l.matrix_face[d]), 0, b),
                    diagonal, matrix_.low(d)[b]);
    });
    solver_->follow(matrix_);
  }

  solve::SolveReport correct(std::span<LevelSolver* const> levels, Label right_side) override {
    LevelSolver& level = *levels.front();
    const Warehouse& stored = level.outputs();
    const int from = slot_of(stored, right_side);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const auto R = stored.view(from, 0, b);
      for_each_cell(cells, [&](IntVec3 c) {
        right_side_.views()[b](c) = R(c);
        change_.views()[b](c) = 0.0;
      });
    });
    const solve::SolveReport report = solver_->solve(right_side_.values(), change_.views());
    const int slot = slot_of(level.state(), labels().pressure_increment);
    const int last_slot = slot_of(level.state(), labels().pressure_correction);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const RealView d = level.state().view(slot, 0, b);
      const RealView& e = change_.views()[b];
      const RealView last = level.state().view(last_slot, 0, b);
      for_each_cell(cells, [&](IntVec3 c) {
        d(c) += e(c);
        last(c) = e(c);
      });
    });
    level.fill_work_ghosts(labels().pressure_increment);
    return report;
  }

 private:
  solve::CellMatrix matrix_;
  solve::BoxArrays right_side_, change_;
  std::unique_ptr<solve::LinearSolver> solver_;
};

}  // namespace

std::unique_ptr<PressureSystem> make_pressure_system(std::span<LevelSolver* const> levels, int rank,
                                                     const solve::SolverSettings& settings) {
  if (levels.size() > 1) return make_composite_system(levels, rank, settings);
  return std::make_unique<OneLevel>(levels.front()->level(), rank, settings);
}

}  // namespace sluice::ice::pressure

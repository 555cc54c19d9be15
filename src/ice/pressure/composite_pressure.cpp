// The system of several levels, and d in the ghost cells where they meet.
//
// Rows are summed over the volume of their cell. The matrix couples two points where levels meet;
// what it lacks beside the parabola of the ghost cells there (interface_ghosts.hpp) is found by the
// sweep that follows, and corrected in the next pass.
#include "framework/solve/composite_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/interface_ghosts.hpp"
#include "ice/pressure/pressure_system.hpp"

namespace sluice::ice::pressure {
namespace {

using solve::CompositeVector;

class SeveralLevels final : public PressureSystem {
 public:
  SeveralLevels(std::span<LevelSolver* const> levels, int rank,
                const solve::SolverSettings& settings)
      : solver_(settings) {
    for (const LevelSolver* level : levels) {
      coefficients_.emplace_back(level->level(), rank);
      numbers_.emplace_back(solve::boxes_of(level->level(), rank));
    }
  }

  void set_up(std::span<LevelSolver* const> levels) override {
    for (std::size_t l = 0; l < levels.size(); ++l) take_coefficients(*levels[l], coefficients_[l]);
    solver_.set_up(coefficients_);
    right_side_ = solver_.system().vector();
    change_ = right_side_;
    total_ = right_side_;
  }

  void join_work_pressure(std::span<LevelSolver* const> levels) override {
    for (std::size_t l = 0; l < levels.size(); ++l) {
      take(*levels[l], labels().work_pressure, numbers_[l], 1.0);
      if (l > 0) fill_interface(levels, labels().interface_pressure, l);
    }
  }

  solve::SolveReport correct(std::span<LevelSolver* const> levels, Label right_side) override {
    const solve::CompositeSystem& system = solver_.system();
    for (std::size_t l = 0; l < levels.size(); ++l) {
      take(*levels[l], right_side, numbers_[l], levels[l]->level().cell_volume());
      system.load(l, numbers_[l].values(), right_side_);
    }
    const solve::SolveReport report = solver_.solve(right_side_, change_);
    for (std::size_t l = 0; l < levels.size(); ++l)
      for (std::size_t c = 0; c < total_[l].size(); ++c) total_[l][c] += change_[l][c];
    system.cover(total_);
    CompositeVector& last = change_;
    system.cover(last);
    for (std::size_t l = 0; l < levels.size(); ++l) {
      put(levels, last, labels().pressure_correction, l);
      put(levels, total_, labels().pressure_increment, l);
      levels[l]->fill_work_ghosts(labels().pressure_increment);
      if (l > 0) fill_interface(levels, labels().pressure_increment, l);
    }
    return report;
  }

 private:
  static void take(LevelSolver& level, Label label, const solve::BoxArrays& to, double volume) {
    const Warehouse& stored = level.outputs();
    const int slot = slot_of(stored, label);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const auto from = stored.view(slot, 0, b);
      const RealView& v = to.views()[b];
      for_each_cell(cells, [&](IntVec3 c) { v(c) = volume * from(c); });
    });
  }
  static void take_coefficients(LevelSolver& level, solve::LevelCoefficients& to) {
    const Labels& l = labels();
    const double volume = level.level().cell_volume();
    take(level, l.matrix_cell, to.own, volume);
    const Warehouse& stored = level.outputs();
    for (int d = 0; d < 3; ++d) {
      if (!level.level().active[d]) continue;
      const int slot = slot_of(stored, l.matrix_face[d]);
      for_each_box(level, [&](int b, const IndexBox& cells) {
        const auto face = stored.view(slot, 0, b);
        for_each_cell(cells, [&](IntVec3 c) {
          IntVec3 above = c;
          ++above[d];
          to.low[d].views()[b](c) = volume * face(c);
          to.high[d].views()[b](c) = volume * face(above);
        });
      });
    }
  }
  void put(std::span<LevelSolver* const> levels, const CompositeVector& v, Label label,
           std::size_t l) {
    LevelSolver& level = *levels[l];
    solver_.system().store(v, l, numbers_[l].views());
    const int slot = slot_of(level.state(), label);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const RealView d = level.state().view(slot, 0, b);
      const RealView& from = numbers_[l].views()[b];
      for_each_cell(cells, [&](IntVec3 c) { d(c) = from(c); });
    });
  }
  // Ghosts of a slot where the level meets the coarser one; numbers_ holds the cells of both.
  void fill_interface(std::span<LevelSolver* const> levels, Label label, std::size_t l) {
    LevelSolver& level = *levels[l];
    const int slot = slot_of(level.state(), label);
    const InterfaceGhosts ghosts(levels[l - 1]->level(), level.level(), numbers_[l - 1].values(),
                                 numbers_[l].values());
    for_each_box(level, [&](int b, const IndexBox& cells) {
      ghosts.fill(level.state().view(slot, 0, b), cells);
    });
  }

  solve::CompositeSolver solver_;
  std::vector<solve::LevelCoefficients> coefficients_;
  std::vector<solve::BoxArrays> numbers_;
  CompositeVector right_side_, change_, total_;
};

}  // namespace

std::unique_ptr<PressureSystem> make_composite_system(std::span<LevelSolver* const> levels,
                                                      int rank,
                                                      const solve::SolverSettings& settings) {
  return std::make_unique<SeveralLevels>(levels, rank, settings);
}

}  // namespace sluice::ice::pressure

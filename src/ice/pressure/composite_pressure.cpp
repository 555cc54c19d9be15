// The system of several levels, and d in the ghost cells where they meet.
//
// Rows are summed over the volume of their cell. A ghost cell beside a face of a coarser level gets
// the parabola through the first and the second fine cell, f1 and f2, and a value c* of the coarser
// level, at distances 1/2, 3/2 and r/2 of fine cells from the face:
//   g = 8/((r + 1)(r + 3)) c* + 2 (r - 1)/(r + 1) f1 - (r - 1)/(r + 3) f2
//   c* = c + sum over tangents of  o (c+ - c-)/2 + o^2/2 (c+ - 2 c + c-)
// o: how far, in coarse cells, the ghost's centre lies aside of c's. The matrix couples two points;
// what it lacks is found by the sweep that follows, and corrected in the next pass.
#include "framework/grid/cell_map.hpp"
#include "framework/solve/all_boxes.hpp"
#include "framework/solve/composite_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/pressure_system.hpp"

namespace sluice::ice::pressure {
namespace {

using solve::CompositeVector;

IntVec3 parent_of(IntVec3 c, IntVec3 ratio) {
  const auto floor_of = [](int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); };
  return {floor_of(c.x, ratio.x), floor_of(c.y, ratio.y), floor_of(c.z, ratio.z)};
}

// A number of a level and the next coarser one, for ghost cells between them.
class InterfaceGhosts {
 public:
  // The numbers of the cells of both levels, of the boxes of this rank. Collective.
  InterfaceGhosts(const Level& coarse, const Level& fine, const solve::ConstBoxViews& of_coarse,
                  const solve::ConstBoxViews& of_fine)
      : fine_(fine),
        coarse_map_(coarse),
        fine_map_(fine),
        coarse_numbers_(coarse, of_coarse),
        fine_numbers_(fine, of_fine) {}

  void fill(const RealView& d, const IndexBox& cells) const {
    for_each_cell(d.box, [&](IntVec3 ghost) {
      if (cells.contains(ghost) || fine_map_.has(ghost) || !fine_map_.in_domain(ghost)) return;
      d(ghost) = value(ghost);
    });
  }

 private:
  double value(IntVec3 ghost) const {
    for (int away = 1; away <= most_layers; ++away)
      for (int d = 0; d < 3; ++d) {
        if (!fine_.active[static_cast<std::size_t>(d)]) continue;
        for (const int inward : {1, -1}) {
          IntVec3 f1 = ghost;
          f1[d] += inward * away;
          if (fine_map_.has(f1)) return beside(f1, d, inward, away);
        }
      }
    return coarse(parent_of(fine_map_.image(ghost), fine_.ratio));
  }
  // The ghost `away` cells outward of f1 along d.
  double beside(IntVec3 f1, int d, int inward, int away) const {
    IntVec3 f2 = f1, g = f1;
    f2[d] += inward;
    g[d] -= inward;
    const double r = fine_.ratio[d], c = around(g, d);
    const double first = fine(f1), second = fine_map_.has(f2) ? fine(f2) : first;
    const double ghost = 8.0 / ((r + 1) * (r + 3)) * c + 2.0 * (r - 1) / (r + 1) * first -
                         (r - 1) / (r + 3) * second;
    if (away == 1) return ghost;
    // Further out: the line through the first ghost and c*.
    const double per_cell = r > 1 ? (c - ghost) / (0.5 * r - 0.5) : 0.0;
    return ghost + per_cell * (away - 1);
  }
  // c* beside a fine cell.
  double around(IntVec3 g, int d) const {
    const IntVec3 image = fine_map_.image(g), parent = parent_of(image, fine_.ratio);
    const double c = coarse(parent);
    double sum = c;
    for (int t = 0; t < 3; ++t) {
      if (t == d || !fine_.active[static_cast<std::size_t>(t)]) continue;
      const double o = (image[t] - parent[t] * fine_.ratio[t] + 0.5) / fine_.ratio[t] - 0.5;
      IntVec3 low = parent, high = parent;
      --low[t];
      ++high[t];
      const double below = coarse_or(low, c), above = coarse_or(high, c);
      sum += o * (above - below) / 2 + o * o / 2 * (above - 2 * c + below);
    }
    return sum;
  }
  double coarse_or(IntVec3 cell, double other) const {
    return coarse_map_.has(cell) ? coarse(cell) : other;
  }
  double coarse(IntVec3 cell) const {
    return coarse_map_.has(cell) ? number(coarse_map_, coarse_numbers_, cell) : 0.0;
  }
  double fine(IntVec3 cell) const { return number(fine_map_, fine_numbers_, cell); }
  static double number(const CellMap& map, const solve::AllBoxes& numbers, IntVec3 cell) {
    return numbers.views()[static_cast<std::size_t>(map.box_of(cell))](map.image(cell));
  }

  static constexpr int most_layers = 4;
  const Level& fine_;
  CellMap coarse_map_, fine_map_;
  solve::AllBoxes coarse_numbers_, fine_numbers_;
};

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
    const int slot = stored.find(label, 0);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const auto from = stored.view(slot, 0, b);
      const RealView& v = to.views()[static_cast<std::size_t>(b)];
      for_each_cell(cells, [&](IntVec3 c) { v(c) = volume * from(c); });
    });
  }
  static void take_coefficients(LevelSolver& level, solve::LevelCoefficients& to) {
    const Labels& l = labels();
    const double volume = level.level().cell_volume();
    take(level, l.matrix_cell, to.own, volume);
    const Warehouse& stored = level.outputs();
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<std::size_t>(d);
      if (!level.level().active[n]) continue;
      const int slot = stored.find(l.matrix_face[d], 0);
      for_each_box(level, [&](int b, const IndexBox& cells) {
        const auto face = stored.view(slot, 0, b);
        const auto box = static_cast<std::size_t>(b);
        for_each_cell(cells, [&](IntVec3 c) {
          IntVec3 above = c;
          ++above[d];
          to.low[n].views()[box](c) = volume * face(c);
          to.high[n].views()[box](c) = volume * face(above);
        });
      });
    }
  }
  void put(std::span<LevelSolver* const> levels, const CompositeVector& v, Label label,
           std::size_t l) {
    LevelSolver& level = *levels[l];
    solver_.system().store(v, l, numbers_[l].views());
    const int slot = level.state().find(label, 0);
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const RealView d = level.state().view(slot, 0, b);
      const RealView& from = numbers_[l].views()[static_cast<std::size_t>(b)];
      for_each_cell(cells, [&](IntVec3 c) { d(c) = from(c); });
    });
  }
  // Ghosts of a slot where the level meets the coarser one; numbers_ holds the cells of both.
  void fill_interface(std::span<LevelSolver* const> levels, Label label, std::size_t l) {
    LevelSolver& level = *levels[l];
    const int slot = level.state().find(label, 0);
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

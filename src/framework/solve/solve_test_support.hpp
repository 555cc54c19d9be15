// Systems for tests of solvers: diffusion on a cube of cells, with densities and sides as asked.
// Numbers have no unit.
#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "framework/base/communicator.hpp"
#include "framework/solve/linear_solver.hpp"

namespace sluice::solve {

enum class Sides { dirichlet, neumann, mixed, periodic };

// A level of the unit cube, cut into boxes that are dealt out to all ranks.
inline std::unique_ptr<Level> level_of(IntVec3 cells, IntVec3 pieces = {1, 1, 1},
                                       Sides sides = Sides::neumann) {
  auto level = std::make_unique<Level>();
  level->domain = {{0, 0, 0}, cells};
  for (int d = 0; d < 3; ++d) {
    level->active[d] = cells[d] > 1;
    level->periodic[d] = sides == Sides::periodic && cells[d] > 1;
    level->spacing[d] = 1.0 / cells[d];
  }
  for (const IndexBox& b : split(level->domain, pieces))
    level->boxes.push_back({b, 0, static_cast<int>(level->boxes.size())});
  assign_owners(level->boxes, world().size());
  return level;
}

using CellFunction = std::function<double(IntVec3)>;

inline void fill_views(const BoxViews& views, const CellFunction& value) {
  for (const RealView& v : views) for_each_cell(v.box, [&](IntVec3 c) { v(c) = value(c); });
}

struct DiffusionSystem {
  double diagonal = 0;     // beside the faces
  Vec3 coupling{1, 1, 1};  // of a face between cells of density 1
  CellFunction density = [](IntVec3) { return 1.0; };
  Sides sides = Sides::neumann;
};

inline bool is_dirichlet(Sides sides, int direction, bool high) {
  return sides == Sides::dirichlet || (sides == Sides::mixed && (direction != 1) != high);
}

// Two-point faces; a Dirichlet side is half a cell away.
inline CellMatrix matrix_of(const Level& level, const DiffusionSystem& system) {
  CellMatrix matrix(level);
  const auto face = [&](IntVec3 c, int d, int side) {  // the coupling across it, and with a cell
    IntVec3 other = c;
    other[d] += side;
    const int n = level.domain.size()[d];
    if (n == 1) return std::pair{0.0, false};
    const bool out = other[d] < 0 || other[d] >= n;
    if (out && system.sides == Sides::periodic) other[d] = (other[d] + n) % n;
    if (out && system.sides != Sides::periodic) {
      const bool given = is_dirichlet(system.sides, d, side > 0);
      return std::pair{given ? 2 * system.coupling[d] / system.density(c) : 0.0, false};
    }
    return std::pair{2 * system.coupling[d] / (system.density(c) + system.density(other)), true};
  };
  for (int d = 0; d < 3; ++d) {
    fill_views(matrix.low(d), [&](IntVec3 c) {
      const auto [size, coupled] = face(c, d, -1);
      return coupled ? -size : 0.0;
    });
  }
  fill_views(matrix.diagonal(), [&](IntVec3 c) {
    double sum = system.diagonal;
    for (int d = 0; d < 3; ++d) sum += face(c, d, -1).first + face(c, d, 1).first;
    return sum;
  });
  return matrix;
}

// Smooth parts and noise, the same for a cell whatever the boxes are.
inline double noisy(IntVec3 c) {
  const double n = 12.9898 * c.x + 78.233 * c.y + 37.719 * c.z;
  const double wave = std::sin(n) * 43758.5453;
  return 1 + std::sin(0.05 * (c.x + 2 * c.y + 3 * c.z)) + (wave - std::floor(wave));
}

// Numbers by cell of a domain that begins at (0, 0, 0), found once.
inline CellFunction table_of(IntVec3 cells, const CellFunction& value) {
  auto table = std::make_shared<std::vector<double>>();
  for_each_cell({{0, 0, 0}, cells}, [&](IntVec3 c) { table->push_back(value(c)); });
  return [cells, table](IntVec3 c) { return (*table)[c.x + cells.x * (c.y + cells.y * c.z)]; };
}

// The same without its mean: what is left of it can be brought to 1e-10 where rows nearly sum to 0.
inline CellFunction noisy_without_mean(IntVec3 cells) {
  double mean = 0;
  for_each_cell({{0, 0, 0}, cells}, [&](IntVec3 c) { mean += noisy(c); });
  mean /= static_cast<double>(IndexBox{{0, 0, 0}, cells}.volume());
  return [mean](IntVec3 c) { return noisy(c) - mean; };
}

// Balls of density 1e4, at places that look random; some overlap.
inline CellFunction balls(IntVec3 cells, int count) {
  return table_of(cells, [cells, count](IntVec3 c) {
    const double radius = count == 1 ? 0.25 : cells.z > 1 ? 0.08 : 0.05;
    for (int b = 0; b < count; ++b) {
      double distance = 0;
      for (int d = 0; d < 3; ++d) {
        if (cells[d] == 1) continue;
        const double turn = 0.5 + b * (0.7548776662 - 0.185 * d);
        const double off = (c[d] + 0.5) / cells[d] - (turn - std::floor(turn));
        distance += off * off;
      }
      if (distance < radius * radius) return 1e4;
    }
    return 1.0;
  });
}

// A solve from 0; the solution stays in `x`.
struct Solved {
  SolveReport report;
  BoxArrays x;
};
inline Solved solve_from_zero(LinearSolver& solver, const Level& level, const CellFunction& b) {
  const BoxArrays right_side(boxes_of(level, world().rank()));
  Solved solved{{}, BoxArrays(boxes_of(level, world().rank()))};
  fill_views(right_side.views(), b);
  solved.report = solver.solve(right_side.values(), solved.x.views());
  return solved;
}

}  // namespace sluice::solve

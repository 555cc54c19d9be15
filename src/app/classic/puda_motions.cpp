// puda -AA_MMS_1, -AA_MMS_2, -GV_MMS, -ER_MMS: errors of displacements against manufactured motions
// of solids, on the terminal and in the files L_norms and L_normsPerLevel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "app/classic/puda.hpp"

namespace sluice {
namespace {

constexpr double pi = std::numbers::pi;

// A bar along one direction; E = 9 K mu / (3 K + mu) and density 1 give the speed of its waves.
double bar_speed() {
  constexpr double mu = 3846, bulk = 8333;
  return std::sqrt(9 * bulk * mu / (3 * bulk + mu));
}

Vec3 bar_displacement(Vec3 X, double t, int direction) {
  Vec3 u;
  u[direction] = 0.05 * std::sin(2 * pi * X[direction]) * std::cos(pi * bar_speed() * t);
  return u;
}

Vec3 block_displacement(Vec3 X, double t, int) {
  const double phase = bar_speed() * pi * t;
  Vec3 u;
  for (int d = 0; d < 3; ++d)
    u[d] = 0.05 * std::sin(pi * X[d]) * std::sin(2.0 / 3 * d * pi + phase);
  return u;
}

Vec3 vortex_displacement(Vec3 X, double t, int) {
  const double r = std::hypot(X.x, X.y) - 1;
  const double angle = std::sin(pi * t) * (1 - 32 * r * r + 256 * r * r * r * r);
  return {std::cos(angle) * X.x - std::sin(angle) * X.y - X.x,
          std::sin(angle) * X.x + std::cos(angle) * X.y - X.y, 0};
}

// A ring of radii 0.4 and 0.6, E 1e7, density 1000.
Vec3 ring_displacement(Vec3 X, double t, int) {
  constexpr double inner = 0.4, outer = 0.6, denominator = outer - 3 * inner;
  constexpr double c1 = -6 * inner / (outer * denominator),
                   c2 = 3 * (outer + inner) / (outer * outer * denominator),
                   c3 = -2 / (outer * outer * denominator);
  const double r = std::hypot(X.x, X.y);
  const double factor = 0.1 * std::sin(std::sqrt(1e7 / 1000) * pi * t) * (c3 * r * r + c2 * r + c1);
  return {factor * X.x, factor * X.y, 0};
}

struct ManufacturedMotion {
  const char* option;
  int directions;  // that the grid must have; 0: any number
  Vec3 (*displacement)(Vec3 X, double t, int direction);
};
constexpr ManufacturedMotion motions[] = {{"-AA_MMS_1", 1, bar_displacement},
                                          {"-AA_MMS_2", 3, block_displacement},
                                          {"-GV_MMS", 0, vortex_displacement},
                                          {"-ER_MMS", 0, ring_displacement}};

struct MotionError {
  double largest = 0, squares = 0;
  std::int64_t particles = 0;
  Vec3 worst{-9, -9, -9};
  IntVec3 worst_cell{-9, -9, -9};
  double l2() const {
    return particles == 0 ? 0 : std::sqrt(squares / static_cast<double>(particles));
  }
};

// The direction of a 1-D grid.
int checked_direction(const ArchiveStep& step, const ManufacturedMotion& motion) {
  const IntVec3 cells = step.grid().levels.front().domain.size();
  int active = 0, last = 0;
  for (int d = 0; d < 3; ++d)
    if (cells[d] > 1) {
      ++active;
      last = d;
    }
  if (motion.directions != 0 && active != motion.directions)
    throw InputError(fmt::format(
        "{} is of a grid with {} direction{} of more than one cell; this one "
        "has {} cells",
        motion.option, motion.directions, motion.directions == 1 ? "" : "s", index_text(cells)));
  return last;
}

MotionError error_on(const ArchiveStep& step, const ManufacturedMotion& motion, int level,
                     int material, double time) {
  MotionError error;
  const int direction = checked_direction(step, motion);
  ParticleLists lists(step);
  for (const PatchParticles& p : particles_by_patch(step, material)) {
    if (p.level != level) continue;
    const auto& u = lists.values("p.displacement", p);
    for (const std::size_t n : p.places) {
      const Vec3 moved{u[0][n], u[1][n], u[2][n]}, place = lists.position(p, n);
      const Vec3 d = motion.displacement(place - moved, time, direction) - moved;
      const double size = std::sqrt(dot(d, d));
      error.squares += size * size;
      ++error.particles;
      if (size <= error.largest) continue;
      error.largest = size;
      error.worst = place;
      error.worst_cell = cell_of(step.grid().levels[level], place);
    }
  }
  return error;
}

void print_motion(const Archive& archive, const PudaRequest& request,
                  const ManufacturedMotion& motion) {
  constexpr int digits = 8;
  std::ofstream all("L_norms"), by_level("L_normsPerLevel");
  all << "#Time,    L_inf,    L2norm\n";
  by_level << "#Time,  Level,   L_inf,    L2norm,    NumParticles\n";
  const OutputRange& range = request.outputs;
  for (std::size_t t = range.first; t <= range.last; t += range.step) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    MotionError total;
    for (const Level& level : step.grid().levels) {
      const MotionError e =
          error_on(step, motion, level.index, std::max(request.material, 0), entry.time);
      fmt::print(
          "     Level: {} L_inf Error: {}, L2norm: {} numParticles: {} , Worst particle: {}, "
          "{}\n",
          level.index, number_text(e.largest, digits), number_text(e.l2(), digits), e.particles,
          point_text(e.worst, digits), index_text(e.worst_cell));
      by_level << fmt::format("{:.16e}, {},  {:.16e},  {:.16e}  {}\n", entry.time, level.index,
                              e.largest, e.l2(), e.particles);
      total.squares += e.squares;
      total.particles += e.particles;
      if (e.largest <= total.largest) continue;
      total.largest = e.largest;
      total.worst = e.worst;
      total.worst_cell = e.worst_cell;
    }
    fmt::print("time: {} , L_inf Error: {} , L2norm Error: {} , Worst particle: {} {}\n",
               number_text(entry.time, digits), number_text(total.largest, digits),
               number_text(total.l2(), digits), point_text(total.worst, digits),
               index_text(total.worst_cell));
    all << fmt::format("{:.16e}, {:.16e}, {:.16e}\n", entry.time, total.largest, total.l2());
  }
  if (!all.flush() || !by_level.flush())
    throw SystemError("cannot write L_norms and L_normsPerLevel: is the disk full?");
}

}  // namespace

std::vector<ClassicOption> puda_motion_options() {
  std::vector<ClassicOption> options;
  for (const ManufacturedMotion& m : motions)
    options.push_back({m.option, "", "errors of displacements against a manufactured motion"});
  return options;
}

void puda_motions(const Archive& archive, const ClassicArguments& arguments,
                  const PudaRequest& request) {
  for (const ManufacturedMotion& m : motions)
    if (arguments.has(m.option)) print_motion(archive, request, m);
}

}  // namespace sluice

// What rows remember of materials that are alone (RowMarks): it is so in every cell of the state,
// and said of most.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::marks_test {
namespace {

constexpr IntVec3 cells{96, 64, 1};

// A disk of a second gas and a drop of a third that fly through the first, past each other.
MixtureBox disks(IntVec3 block, double drag, bool force_all = false) {
  GasBox box;
  box.cells = cells;
  box.scheme = "conservative";
  SolverOptions options;
  options.block = block;
  options.threads = 2;
  options.force_all = force_all;
  const Vec3 middle[] = {{0.3, 0.45, 0}, {0.72, 0.6, 0}};
  return {box,
          {ideal_gas(1.4, 717), ideal_gas(1.667, 3116), ideal_gas(1.2, 1000)},
          [=](Vec3 x) {
            MixtureCell c;
            c.volume = {1, 0, 0};
            for (std::size_t m = 0; m < 2; ++m)
              if (std::hypot(x.x - middle[m].x, x.y - middle[m].y) < 0.17) {
                c.volume = {0, 0, 0};
                c.volume[m + 1] = 1;
              }
            c.density = {1, 0.2, 4};
            c.pressure = {1e5, 1e5, 1e5};
            c.velocity[0] = 150;
            c.velocity[1] = x.y > 0.5 ? -80 : 80;
            return c;
          },
          options,
          {},
          {},
          drag};
}

// The cells of which something is known, which all are as it says.
int known_cells(MixtureBox& run) {
  const RowMarks* marks = run.solver().state().marks(0);
  if (marks == nullptr) return 0;
  int known = 0;
  for (int j = 0; j < cells.y; ++j)
    marks->for_each({0, j, 0}, cells.x, [&](int first, int count, int mark) {
      if (mark == 0) return;
      known += count;
      for (int i = first; i < first + count; ++i)
        for (int m = 0; m < run.count(); ++m) {
          const IntVec3 c{i, j, 0};
          const bool alone = m == mark - 1;
          EXPECT_EQ(run.volume(m, c), alone ? 1.0 : 0.0) << i << ' ' << j;
          EXPECT_EQ(run.mass(m, c) > 0, alone) << i << ' ' << j;
          EXPECT_EQ(run.energy(m, c) > 0, alone) << i << ' ' << j;
          if (!run.is_multi_velocity()) continue;
          const RealView slip = run.view(labels().slip, m, 0, c);
          EXPECT_EQ(slip(c), 0.0) << i << ' ' << j;
        }
    });
  return known;
}

TEST(MarksOfRows, SayWhereAMaterialIsAlone) {
  for (const double drag : {one_velocity_coefficient, 1e3}) {
    MixtureBox all = disks({}, drag, true);
    all.steps(40);
    EXPECT_EQ(known_cells(all), 0);
    // Rows of one block, and of two that share the part in the middle, which is never known.
    for (const auto& [block, share] : {std::pair{IntVec3{96, 32, 1}, 0.4}, {{48, 32, 1}, 0.2}}) {
      MixtureBox run = disks(block, drag);
      EXPECT_EQ(known_cells(run), 0);
      for (int n = 0; n < 40; ++n) {
        run.steps(1);
        const int known = known_cells(run);
        if (n > 0) {
          EXPECT_GT(known, share * cells.x * cells.y) << n;
        }
      }
      EXPECT_EQ(bits_of(run, false), bits_of(all, false));
      run.solver().mark_modified();
      EXPECT_EQ(known_cells(run), 0);
    }
  }
}

}  // namespace
}  // namespace sluice::ice::marks_test

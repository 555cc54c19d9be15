// Ghost states around boxes of one to three dimensions, along any axes, on any number of threads.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "ice/boundary/boundary_fill.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice::boundary_fill_space_test {
namespace {

BoundaryRegion region_of(const char* variable, ConditionKind kind, double value) {
  Condition c;
  c.variable = variable;
  c.kind = kind;
  c.has_value = true;
  c.value = value;
  BoundaryRegion region;
  region.conditions = {c};
  return region;
}

// Large enough in three dimensions that each side is filled in several pieces. Symmetry on the
// minus sides; the plus sides copy, or are given.
class Space {
 public:
  Space(std::array<bool, 3> active, const BoundaryRegion& plus, Vec3 gravity) {
    Level level;
    level.active = active;
    for (int d = 0; d < 3; ++d) level.domain.upper[d] = active[d] ? 40 + 7 * d : 1;
    level.boxes = {{level.domain, 0, 0}};
    scene_.grid.levels = {level};
    scene_.constants.gravity = gravity;
    for (const Side side : all_sides)
      scene_.boundary.sides[index_of(side)].regions = {
          is_plus(side) ? plus : region_of("Symmetric", ConditionKind::symmetry, 0)};
  }

  const IndexBox& domain() const { return scene_.grid.levels.front().domain; }
  // A filled state; 3 momentum components.
  std::unique_ptr<Warehouse> filled(int threads) const {
    const Labels& l = labels();
    auto state = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    state->add({l.mass, 0, 1, 3});
    state->add({l.momentum, 0, 3, 3});
    state->add({l.energy, 0, 1, 3});
    for_each_cell(domain(), [&](IntVec3 c) {
      const double number = 1 + c.x + 50 * (c.y + 60 * c.z);
      state->view(0, 0, 0)(c) = 1 + 1e-5 * number;
      for (int d = 0; d < 3; ++d) state->view(1, d, 0)(c) = 1e-6 * (d + 1) * number - 0.01;
      state->view(2, 0, 0)(c) = 2 + 1e-5 * number;
    });
    BoundaryFill(scene_, material_, {l.mass, l.momentum, l.energy, 0, {0, 1, 2}})
        .fill(*state, ThreadTeam(threads));
    return state;
  }

 private:
  Scene scene_;
  IceMaterial material_;
};

// How many ghosts are not what they look at: mirrored below the domain, copied above.
int wrong_ghosts(const Warehouse& state, const IndexBox& domain) {
  int wrong = 0;
  for (int slot = 0; slot < 3; ++slot)
    for (int c = 0; c < state.info(slot).components; ++c) {
      const RealView v = state.view(slot, c, 0);
      for_each_cell(v.box, [&](IntVec3 cell) {
        IntVec3 source = cell;
        double sign = 1;
        for (int d = 0; d < 3; ++d) {
          source[d] = std::min(source[d], domain.upper[d] - 1);
          if (cell[d] >= domain.lower[d]) continue;
          source[d] = 2 * domain.lower[d] - 1 - cell[d];
          if (slot == 1 && c == d) sign = -sign;
        }
        wrong += v(cell) != sign * v(source);
      });
    }
  return wrong;
}

TEST(BoundaryFillInSpace, EveryGhostLooksAtItsCell) {
  for (const bool x : {false, true})
    for (const bool y : {false, true})
      for (const bool z : {false, true}) {
        if (!x && !y && !z) continue;
        const Space space({x, y, z}, region_of("Density", ConditionKind::neumann, 0), {});
        for (const int threads : {1, 2})
          EXPECT_EQ(wrong_ghosts(*space.filled(threads), space.domain()), 0)
              << x << y << z << " on " << threads << " threads";
      }
}

TEST(BoundaryFillInSpace, ThreadsChangeNoBit) {
  const Space space({true, true, true}, region_of("Pressure", ConditionKind::dirichlet, 0.7),
                    {0.5, -2, 1});
  const auto one = space.filled(1), three = space.filled(3);
  EXPECT_NE(wrong_ghosts(*one, space.domain()), 0);  // these are no copies
  for (int slot = 0; slot < 3; ++slot)
    for (int c = 0; c < one->info(slot).components; ++c) {
      const RealView a = one->view(slot, c, 0), b = three->view(slot, c, 0);
      EXPECT_EQ(std::memcmp(a.data, b.data, sizeof(double) * a.box.volume()), 0);
    }
}

}  // namespace
}  // namespace sluice::ice::boundary_fill_space_test

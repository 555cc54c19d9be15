// Open faces of a cube: no direction and no border between regions shows in the bits.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "ice/boundary/boundary_fill.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice::wave_rows_test {
namespace {

constexpr int cells = 11, width = 4;
constexpr double dx = 0.1, far_pressure = 10;

struct Gas {
  double rho, p;
  Vec3 u;
};
using Flow = std::function<Gas(Vec3)>;

std::vector<Condition> open_face() {
  std::vector<Condition> all;
  for (const char* variable : {"Pressure", "Velocity", "Temperature", "Density"}) {
    Condition c;
    c.variable = variable;
    c.kind_name = "LODI";
    c.kind = ConditionKind::other;
    c.has_value = true;
    c.is_vector = c.variable == "Velocity";
    all.push_back(c);
  }
  return all;
}

std::vector<Condition> with_pressure() {
  std::vector<Condition> all = open_face();
  all.front().kind_name = "Dirichlet";
  all.front().kind = ConditionKind::dirichlet;
  all.front().value = 9.5;
  return all;
}

FlowConditions blocks(std::optional<Vec3> velocity = {}) {
  FlowConditions c;
  c.lodi = LodiSettings{};
  c.lodi->press_infinity = far_pressure;
  c.lodi->velocity_infinity = velocity;
  if (velocity) c.lodi->rho_infinity = 1.1;
  return c;
}

bool in_circle(IntVec3 cell, int normal) {
  RegionShape circle;
  circle.kind = RegionShape::Kind::circle;
  circle.origin = {0.5, 0.45, 0.6};
  circle.radius = 0.32;
  return circle.contains(normal, {dx * (cell.x + 0.5), dx * (cell.y + 0.5), dx * (cell.z + 0.5)});
}

// Every side has one region, or a circle and the rest of it.
class Cube {
 public:
  Cube(const FlowConditions& conditions, const Flow& flow, std::vector<Condition> rest,
       std::optional<std::vector<Condition>> circle = {}, IntVec3 size = IntVec3::all(cells),
       Vec3 gravity = {}) {
    scene_.constants.gravity = gravity;
    Level level;
    level.domain = {{0, 0, 0}, size};
    level.boxes = {{level.domain, 0, 0}};
    level.spacing = {dx, dx, dx};
    scene_.grid.levels = {level};
    BoundaryRegion whole, part;
    whole.conditions = std::move(rest);
    if (circle) part.conditions = *circle;
    part.shape.kind = RegionShape::Kind::circle;
    part.shape.origin = {0.5, 0.45, 0.6};
    part.shape.radius = 0.32;
    for (BoundarySide& side : scene_.boundary.sides) {
      side.regions = {whole};
      if (circle) side.regions.push_back(part);
    }
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    state_->add({l.mass, 0, 1, width});
    state_->add({l.momentum, 0, 3, width});
    state_->add({l.energy, 0, 1, width});
    for_each_cell(level.domain, [&](IntVec3 c) {
      const Gas gas = flow(level.centre(c));
      state_->view(0, 0, 0)(c) = gas.rho;
      for (int e = 0; e < 3; ++e) state_->view(1, e, 0)(c) = gas.rho * gas.u[e];
      state_->view(2, 0, 0)(c) = gas.p / 0.4;
    });
    const IceMaterial material;
    const BoundaryFill boundary(scene_, material, {l.mass, l.momentum, l.energy, 0, {0, 1, 2}}, 0,
                                conditions);
    std::vector<ExactSum> exact(boundary.sum_count());
    boundary.add_sums(*state_, exact);
    std::vector<double> sums;
    for (const ExactSum& sum : exact) sums.push_back(sum.value());
    boundary.fill(*state_, ThreadTeam(), 0, sums);
  }
  // Density, momentum, energy.
  std::array<double, 5> at(IntVec3 c) const {
    return {state_->view(0, 0, 0)(c), state_->view(1, 0, 0)(c), state_->view(1, 1, 0)(c),
            state_->view(1, 2, 0)(c), state_->view(2, 0, 0)(c)};
  }
  Vec3 velocity(IntVec3 c) const {
    const std::array<double, 5> s = at(c);
    return {s[1] / s[0], s[2] / s[0], s[3] / s[0]};
  }

 private:
  Scene scene_;
  std::unique_ptr<Warehouse> state_;
};

IndexBox with_ghosts() {
  return IndexBox{{0, 0, 0}, IntVec3::all(cells)}.grown(IntVec3::all(width));
}

// f(ghost, direction) for ghosts beyond one side only.
template <class F>
void for_each_face_ghost(F&& f) {
  for_each_cell(with_ghosts(), [&](IntVec3 c) {
    int beyond = 0, direction = 0;
    for (int e = 0; e < 3; ++e)
      if (c[e] < 0 || c[e] >= cells) {
        ++beyond;
        direction = e;
      }
    if (beyond == 1) f(c, direction);
  });
}

// Of all speeds, in and out, some of them faster than sound.
Gas rough(Vec3 x) {
  const double a = std::sin(5 * x.x + 2 * x.y * x.z), b = std::cos(4 * x.y - 3 * x.x * x.z);
  const double c = std::sin(7 * x.z + x.x - x.y);
  return {1 + 0.4 * a, far_pressure * (1 + 0.3 * b), {4 * c + a, 5 * b, 3 * a - 2 * b}};
}

// Rows along x have unit stride, those along y and z have not.
TEST(WaveRows, AreTheSameOnFacesAcrossAllDirections) {
  const auto turned = [](auto v) { return decltype(v){v[1], v[2], v[0]}; };  // what was y is x
  const auto back = [](Vec3 v) { return Vec3{v.z, v.x, v.y}; };
  for (const auto& far : {std::optional<Vec3>(), std::optional(Vec3{0.7, 0.7, 0.7})}) {
    const Cube cube(blocks(far), rough, open_face());
    const Cube image(
        blocks(far),
        [&](Vec3 x) {
          Gas gas = rough(back(x));
          gas.u = turned(gas.u);
          return gas;
        },
        open_face());
    for_each_face_ghost([&](IntVec3 c, int) {
      const std::array<double, 5> s = cube.at(c), t = image.at(turned(c));
      EXPECT_EQ(t, (std::array{s[0], s[2], s[3], s[1], s[4]})) << c.x << ' ' << c.y << ' ' << c.z;
    });
  }
}

TEST(WaveRows, RegionsWithTheSameSettingsAreOne) {
  // Means over regions are the same to the bit where the flow is uniform.
  const Flow even = [](Vec3 x) {
    Gas gas = rough(x);
    gas.rho = 1 + 0.125 * std::floor(8 * std::sin(9 * x.x * x.y + x.z));
    gas.rho = std::max(gas.rho, 0.25);
    gas.u = {0.5, -0.25, 0.125};
    return gas;
  };
  const std::pair<FlowConditions, Flow> cases[] = {{blocks(Vec3{0.5, 1, -1}), rough},
                                                   {blocks(), even}};
  for (const auto& [conditions, flow] : cases) {
    const Cube one(conditions, flow, open_face());
    const Cube two(conditions, flow, open_face(), open_face());
    for_each_cell(with_ghosts(), [&](IntVec3 c) {
      EXPECT_EQ(one.at(c), two.at(c)) << c.x << ' ' << c.y << ' ' << c.z;
    });
  }
}

TEST(WaveRows, ARegionWithATargetKnowsNothingOfTheOneWithout) {
  const FlowConditions conditions = blocks(Vec3{0.5, 1, -1});
  const Cube free(conditions, rough, open_face()), held(conditions, rough, with_pressure());
  const Cube both(conditions, rough, open_face(), with_pressure());
  const Cube other(conditions, rough, with_pressure(), open_face());
  int differ = 0;
  for_each_face_ghost([&](IntVec3 c, int direction) {
    const bool inside = in_circle(c, direction);
    EXPECT_EQ(both.at(c), (inside ? held : free).at(c)) << c.x << ' ' << c.y << ' ' << c.z;
    EXPECT_EQ(other.at(c), (inside ? free : held).at(c)) << c.x << ' ' << c.y << ' ' << c.z;
    differ += free.at(c) != held.at(c);
  });
  EXPECT_GT(differ, 6 * width * cells * cells / 2);
}

// A stream that leaves everywhere, faster in the middle: each region has its own mean.
TEST(WaveRows, EachRegionHasTheMeanOverItself) {
  const Flow jet = [](Vec3 x) {
    const double r = std::hypot(x.y - 0.45, x.z - 0.6);
    return Gas{1 + 0.1 * x.x,
               far_pressure + std::sin(3 * x.y + x.z),
               {0.5 + 0.25 * std::exp(-9 * r * r), 0.5 * x.y - 0.2, 0.25 * x.z + 0.1}};
  };
  const Cube both(blocks(), jet, open_face(), open_face());
  Vec3 across;  // means over both sides of each direction
  double mean[2] = {0, 0};
  int count[2] = {0, 0};
  for (int d = 0; d < 3; ++d)
    for_each_cell({{0, 0, 0}, IntVec3::all(cells)}, [&](IntVec3 c) {
      if (c[d] == 0 || c[d] == cells - 1) across[d] += both.velocity(c)[d] / (2 * cells * cells);
      if (d != 0 || c.x != cells - 1) return;
      mean[in_circle(c, 0)] += both.velocity(c).x;
      ++count[in_circle(c, 0)];
    });
  ASSERT_GT(std::min(count[0], count[1]), 10);
  for (const bool inside : {false, true}) {
    const Cube far(blocks(Vec3{mean[inside] / count[inside], across.y, across.z}), jet,
                   open_face());
    for_each_face_ghost([&](IntVec3 c, int) {
      if (c.x < cells || in_circle(c, 0) != inside) return;
      for (std::size_t q = 0; q < 5; ++q)
        EXPECT_NEAR(both.at(c)[q], far.at(c)[q], 1e-12 * far_pressure) << q;
    });
  }
}

// Nothing is known of how the flow changes across a layer of one cell: it goes on as it is.
TEST(WaveRows, OfOneLayerOfCellsKnowNoSlope) {
  for (int d = 0; d < 3; ++d)
    for (const double gravity : {0.0, -0.5}) {
      IntVec3 size = IntVec3::all(cells);
      size[d] = 1;
      Vec3 pull;
      pull[d] = gravity;
      FlowConditions conditions = blocks();
      conditions.lodi->sigma = 0;
      const Vec3 u{0.25, -0.5, 0.125};
      const Cube layer(
          conditions,
          [&](Vec3) {
            return Gas{2, far_pressure, u};
          },
          open_face(), {}, size, pull);
      for (const int outward : {-1, 1})
        for (int n = 1; n <= width; ++n) {
          IntVec3 ghost{3, 4, 5};
          ghost[d] = outward < 0 ? -n : n;
          const std::array<double, 5> s = layer.at(ghost);
          EXPECT_EQ(s[0], 2) << d;
          EXPECT_EQ(layer.velocity(ghost), u) << d;
          EXPECT_NEAR(0.4 * s[4], far_pressure + 2 * gravity * dx * outward * n, 1e-13) << d;
        }
    }
}

}  // namespace
}  // namespace sluice::ice::wave_rows_test

// Tracers: where the flow takes them, who appears and who leaves.
#include <cmath>
#include <numbers>

#include "framework/run/levels/load_balance.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/test_support/tracers.hpp"

namespace sluice::ice::tracers_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double min_order = 1.9;
const std::string everywhere = tracer_box("[-99,-99,-99]", "[99,99,99]");

GasBox uniform(IntVec3 cells) {
  GasBox box;
  box.cells = cells;
  box.velocity[0] = "0.5";
  box.velocity[1] = "-0.25";
  return box;
}

double wrapped(double x) {
  return x - std::floor(x);
}
// Distance on a circle of length 1.
double apart(double a, double b) {
  const double d = std::fabs(wrapped(a) - wrapped(b));
  return std::min(d, 1 - d);
}

TEST(Tracers, GoWithUniformFlowAndWrapAround) {
  GasBox box = uniform({16, 12, 1});
  box.models = tracer_model(tracer_start(everywhere, 4));
  TracerRun run(box);
  const TracerRun::Particles before = run.particles();
  ASSERT_EQ(before.size(), 16U * 12U * 4U);
  const int steps = run.run(3.0);
  EXPECT_GT(steps, 20);
  const TracerRun::Particles after = run.particles();
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [id, p] : after) {
    const Vec3 start = before.at(id).place;
    EXPECT_LT(apart(p.place.x, start.x + 0.5 * 3.0), 1e-13) << id;
    EXPECT_LT(apart(p.place.y, start.y - 0.25 * 3.0), 1e-13) << id;
    EXPECT_EQ(p.place.z, start.z);
  }
}

// What particles cost counts when boxes are dealt out, box by box: here the first has them all.
TEST(Tracers, CountInTheCostOfTheirBoxes) {
  GasBox box = uniform({16, 12, 1});
  box.velocity[0] = box.velocity[1] = "0";
  box.models = tracer_model(tracer_start(tracer_box("[-99,-99,-99]", "[0.5,99,99]"), 400));
  TracerRun run(box, {2, 1, 1});
  run.run(1.0);
  const Hierarchy& hierarchy = run.hierarchy();
  const ParticleCloud* particles = hierarchy.particles();
  const std::vector<double> all = box_seconds(run.hierarchy().level(0), particles, world());
  const std::vector<double> cells = box_seconds(run.hierarchy().level(0), nullptr, world());
  ASSERT_EQ(all.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_EQ(all[b], cells[b] + particles->box_seconds(0)[b]) << b;
  EXPECT_GT(all[0] - cells[0], 4 * (all[1] - cells[1]));
}

// Isentropic vortex of strength 3 at rest (C.-W. Shu, ICASE Report 97-65, section 5.1).
GasBox vortex(int cells) {
  GasBox box;
  box.cells = {cells, cells, 1};
  box.low = {-5, -5, 0};
  box.high = {5, 5, 1};
  const std::string T = "(1 - 9/(28*pi^2)*exp(1 - x^2 - y^2))";
  box.density = T + "^2.5";
  box.pressure = T + "^3.5";
  box.velocity[0] = "-3/(2*pi)*exp((1 - x^2 - y^2)/2)*y";
  box.velocity[1] = "3/(2*pi)*exp((1 - x^2 - y^2)/2)*x";
  return box;
}

double turning_speed(double radius) {
  return 3 / (2 * pi) * std::exp((1 - radius * radius) / 2);
}

const std::string static_levels =
    "<AMR type='StaticGridML'><ICE><orderOfInterpolation>2</orderOfInterpolation></ICE></AMR>";

std::string finer_level(Vec3 low, Vec3 high, IntVec3 cells) {
  return fmt::format(
      "<Level><Box><lower>[{},{},{}]</lower><upper>[{},{},{}]</upper>"
      "<resolution>[{},{},{}]</resolution></Box><periodic>[1,1,1]</periodic></Level>",
      low.x, low.y, low.z, high.x, high.y, high.z, cells.x, cells.y, cells.z);
}

// Mean distance from where the exact flow leads; `levels`: one half of the vortex is refined.
double vortex_error(int cells, double time, bool levels = false) {
  GasBox box = vortex(cells);
  // The same places on each grid: one a cell of the coarsest.
  box.models = tracer_model(tracer_start(tracer_box("[-1.5,-1.5,-1]", "[1.5,1.5,2]"), 1));
  TracerRun run(box, {},
                levels ? finer_level({-2.5, -2.5, 0}, {0, 2.5, 1}, {cells / 2, cells, 1}) : "",
                levels ? static_levels : "");
  const TracerRun::Particles before = run.particles();
  run.run(time);
  double sum = 0;
  for (const auto& [id, p] : run.particles()) {
    const Vec3 x = before.at(id).place;
    const double angle = time * turning_speed(std::hypot(x.x, x.y));
    sum += std::hypot(p.place.x - (x.x * std::cos(angle) - x.y * std::sin(angle)),
                      p.place.y - (x.x * std::sin(angle) + x.y * std::cos(angle)));
  }
  return sum / static_cast<double>(before.size());
}

void expect_second_order(bool levels) {
  double before = 0;
  for (const int cells : {32, 64, 128}) {
    const double error = vortex_error(cells, 4.0, levels);
    if (before > 0) {
      const double order = std::log2(before / error);
      testing::Test::RecordProperty(fmt::format("order_at_{}", cells), fmt::format("{}", order));
      EXPECT_GE(order, min_order) << error;
    }
    before = error;
  }
}

TEST(Tracers, TurnWithAVortexToSecondOrder) {
  expect_second_order(false);
}

TEST(FullTracers, TurnAcrossLevelsToSecondOrder) {
  expect_second_order(true);
}

// The mover alone in a steady velocity: whole turns, spacing and step halved together.
TEST(Tracers, CloseTheirCirclesToSecondOrder) {
  double before = 0;
  for (const int cells : {64, 128, 256}) {
    GasBox box = vortex(cells);
    box.models = tracer_model(tracer_start(tracer_box("[-2,-2,-1]", "[2,2,2]"), 1));
    TracerRun run(box);
    LevelSolver& level = run.hierarchy().level(0);
    run.hierarchy().fill_ghosts(0);
    const double radius = 1.1, turn = 2 * pi / turning_speed(radius);
    ParticleSet particle;
    particle.add({radius, 0, 0.5}, 0);
    const int steps = 4 * cells;
    ParticleStep step;
    step.old_state = step.new_state = &level.state();
    for (int n = 0; n < steps; ++n) {
      step.begin = step.old_time = turn * n / steps;
      step.end = step.new_time = turn * (n + 1) / steps;
      run.ice().particles()->advance(0, step, particle);
    }
    const double error = std::hypot(particle.position(0).x - radius, particle.position(0).y);
    if (before > 0) {
      EXPECT_GE(std::log2(before / error), min_order) << error;
    }
    before = error;
  }
}

TEST(Tracers, StayInAClosedBox) {
  GasBox box;
  box.cells = {20, 16, 1};
  box.periodic = false;
  box.walls = true;
  box.pressure = "1 + 4*exp(-40*((x-0.3)^2 + (y-0.4)^2))";
  box.models = tracer_model(tracer_start(everywhere, 9));
  TracerRun run(box);
  const ParticleCount before = run.count();
  EXPECT_EQ(before.made, 20 * 16 * 9);
  run.run(1.0);
  const ParticleCount after = run.count();
  EXPECT_EQ(after.made, before.made);
  EXPECT_EQ(after.left, 0);
  EXPECT_EQ(after.here, before.here);
  for (const auto& [id, p] : run.particles())
    EXPECT_TRUE(run.level().domain.contains(cell_at(run.level(), p.place))) << id;
}

TEST(Tracers, LeaveWhereTheFlowLeaves) {
  GasBox box = uniform({16, 12, 1});
  box.periodic = false;
  box.models = tracer_model(tracer_start(everywhere, 4));
  TracerRun run(box);
  const TracerRun::Particles before = run.particles();
  run.run(0.6);
  std::int64_t gone = 0;
  const TracerRun::Particles after = run.particles();
  for (const auto& [id, p] : before) {
    const bool inside = p.place.x + 0.3 < 1 && p.place.y - 0.15 >= 0;
    gone += !inside;
    EXPECT_EQ(after.count(id), inside ? 1U : 0U) << id;
  }
  EXPECT_GT(gone, 100);
  EXPECT_EQ(run.count().left, gone);
  EXPECT_EQ(run.count().here, run.count().made - gone);
}

TEST(Tracers, LiveOnTheFinestLevelAndCrossItsEdge) {
  GasBox box = uniform({16, 16, 1});
  box.models = tracer_model(tracer_start(everywhere, 4));
  const std::string fine = finer_level({0.25, 0.25, 0}, {0.75, 0.75, 1}, {16, 16, 1});
  TracerRun run(box, {}, fine, static_levels), split(box, {4, 2, 1}, fine, static_levels);
  const TracerRun::Particles before = run.particles();
  EXPECT_EQ(before.size(), 4U * (16 * 16 - 8 * 8 + 16 * 16));  // so many a cell of the level there
  run.run(1.5);
  const TracerRun::Particles after = run.particles();
  ASSERT_EQ(after.size(), before.size());
  int crossed = 0;
  for (const auto& [id, p] : after) {
    const SeenParticle& start = before.at(id);
    EXPECT_LT(apart(p.place.x, start.place.x + 0.75), 1e-13) << id;
    EXPECT_LT(apart(p.place.y, start.place.y - 0.375), 1e-13) << id;
    const auto inside = [](double x) { return x >= 0.25 && x < 0.75; };
    EXPECT_EQ(p.level, inside(p.place.x) && inside(p.place.y) ? 1 : 0) << id;
    crossed += p.level != start.level;
  }
  EXPECT_GT(crossed, 200);
  split.run(1.5);
  EXPECT_EQ(after, split.particles());
}

// A finer level wherever they go, and nowhere else.
TEST(Tracers, AreFollowedByAFinerLevel) {
  GasBox box = uniform({32, 32, 1});
  box.models = tracer_model(tracer_start(tracer_box("[0.2,0.2,-1]", "[0.3,0.3,2]"), 4), "",
                            "<refine_distance>0.02</refine_distance>");
  TracerRun run(box, {}, "",
                "<AMR><ICE><orderOfInterpolation>2</orderOfInterpolation></ICE>"
                "<Regridder type='Tiled'><max_levels>2</max_levels>"
                "<cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>"
                "<min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>");
  const std::size_t count = run.particles().size();
  EXPECT_GT(count, 100U);
  for (const double time : {0.0, 0.5, 1.3}) {
    run.run(time);
    const TracerRun::Particles all = run.particles();
    EXPECT_EQ(all.size(), count);
    for (const auto& [id, p] : all) EXPECT_EQ(p.level, 1) << id << " at " << time;
    ASSERT_EQ(run.hierarchy().level_count(), 2);
    const Level& fine = run.hierarchy().level(1).level();
    EXPECT_LT(fine.cell_count(), fine.domain.volume() / 3) << time;
  }
}

// Whatever the steps: number n of a cell appears at start + (n + 1/2)/rate and moves from then on.
TEST(Tracers, AppearInSourcesAtTheirTimes) {
  GasBox box = uniform({16, 12, 1});
  const std::string window = "<timeStart>0.1</timeStart><timeStop>0.9</timeStop>";
  const std::string scalar =
      "<scalar name='p.age'><initialValue>2</initialValue><exponentialDecay><c1>3</c1>"
      "<c2 type='constant'><value>0.5</value></c2><c3>0.25</c3></exponentialDecay></scalar>";
  // 3 x 3 cells.
  box.models = tracer_model(tracer_start(tracer_box("[5,5,5]", "[6,6,6]"), 1),
                            tracer_source(tracer_box("[0.25,0.25,-1]", "[0.4375,0.5,2]"), 10),
                            window + scalar);
  TracerRun run(box), slow(box);
  EXPECT_EQ(run.particles().size(), 0U);
  const int steps = run.run(1.2);
  EXPECT_GT(slow.run(1.2, 0.3), 2 * steps);
  const TracerRun::Particles all = run.particles(), same = slow.particles();
  EXPECT_EQ(all.size(), 9U * 8U);
  ASSERT_EQ(all.size(), same.size());
  for (const auto& [id, p] : all) {
    const SeenParticle& q = same.at(id);
    EXPECT_LT(apart(p.place.x, q.place.x) + apart(p.place.y, q.place.y), 1e-13) << id;
    const auto number = id / (16 * 12) - 1;  // the first ids are of those at the start
    const double age = 1.2 - (0.1 + (static_cast<double>(number) + 0.5) / 10);
    const double born = wrapped(p.place.x - 0.5 * age);
    EXPECT_GE(born, 0.25 - 1e-12);
    EXPECT_LE(born, 0.4375 + 1e-12);
    EXPECT_NEAR(p.carried, 2 * std::exp(-1.75 * age), 1e-13);
  }
}

TEST(Tracers, DoNotDependOnBoxesOrThreads) {
  GasBox box = vortex(24);
  box.models = tracer_model(tracer_start(tracer_box("[-3,-4,-1]", "[3,4,2]"), 3),
                            tracer_source(tracer_box("[1,1,-1]", "[3,3,2]"), 2.5));
  TracerRun one(box), many(box, {3, 2, 1}, "", "", 2);
  one.run(1.5);
  many.run(1.5);
  EXPECT_GT(one.particles().size(), 500U);
  EXPECT_EQ(one.particles(), many.particles());
}

TEST(Tracers, AreRefusedWhereNumbersWouldRunOut) {
  GasBox box = uniform({16, 16, 1});
  box.models = tracer_model(tracer_start(everywhere, 1), tracer_source(everywhere, 1e14));
  try {
    TracerRun run(box);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("ask for fewer particles"), std::string::npos) << e.what();
  }
}

std::string graph_of(Stepper& of) {
  SweepExecutor& step = of.solver().graphs().step(false, {});
  return to_dot(step.list(), of.ice().effects(), step.plan());
}

TEST(Tracers, AreNotThereWithoutTheModel) {
  GasBox box = vortex(8);
  Stepper without(box);
  EXPECT_EQ(without.ice().particles(), nullptr);
  EXPECT_FALSE(without.ice().effects().on(effect_tracers));
  box.models = tracer_model(tracer_start(everywhere, 1));
  Stepper with(box);
  EXPECT_NE(with.ice().particles(), nullptr);
  EXPECT_EQ(graph_of(without), graph_of(with));
  EXPECT_EQ(without.solver().graphs().effect_tasks(), with.solver().graphs().effect_tasks());
  EXPECT_EQ(without.solver().memory_bytes(), with.solver().memory_bytes());
}

}  // namespace
}  // namespace sluice::ice::tracers_test

// A gas that flows and a solid that particles move, seen alike through CellMaterial: particle halo,
// projection, closure once a row, and the pressure found by an iterated sub-graph.
//
//   sum_m  mass_m / rho_m(p, T) = 1        (each cell; Newton's method, one sweep a pass)
#include "framework/task/cell_material.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>

#include "framework/task/schedule.hpp"
#include "framework/task/sweep_test_support.hpp"

namespace sluice::cell_material_mock_test {
namespace {

using namespace sweep_test;

constexpr double temperature = 300, gas_constant = 287;
constexpr double solid_density = 1000, stiffness = 1e7;  // rho = rho_0 (1 + p/K)
constexpr double converged_volume = 1e-12;
constexpr int most_passes = 50;

Label mass_of(int material) {
  return test_label(10 + material);
}

// One row of cells for a closure: density, d density/dp and sound speed at (p, T).
struct ClosureRow {
  int count = 0;
  const double* pressure = nullptr;
  const double* temperature = nullptr;
  double* density = nullptr;
  double* compressibility = nullptr;
  double* sound_speed = nullptr;
};

// A material and its law.
struct Closed {
  explicit Closed(CellMaterial m) : cells(std::move(m)) {}
  virtual ~Closed() = default;
  virtual void closure(const ClosureRow& row) const = 0;
  CellMaterial cells;
};

class Gas final : public Closed {
 public:
  Gas() : Closed({"gas", 0, Movement::advection, {mass_of(0), {}, {}, {}}}) {}
  void closure(const ClosureRow& r) const override {
    ++calls;
    for (int i = 0; i < r.count; ++i) {
      r.compressibility[i] = 1 / (gas_constant * r.temperature[i]);
      r.density[i] = r.pressure[i] * r.compressibility[i];
      r.sound_speed[i] = std::sqrt(1.4 * gas_constant * r.temperature[i]);
    }
  }
  mutable std::atomic<int> calls = 0;
};

class Solid final : public Closed {
 public:
  Solid()
      : Closed({"solid", 1, Movement::particles, {mass_of(1), {}, {}, {}}, {test_label(20), {}}}) {}
  void closure(const ClosureRow& r) const override {
    ++calls;
    for (int i = 0; i < r.count; ++i) {
      r.density[i] = solid_density * (1 + r.pressure[i] / stiffness);
      r.compressibility[i] = solid_density / stiffness;
      r.sound_speed[i] = std::sqrt(stiffness / solid_density);
    }
  }
  mutable std::atomic<int> calls = 0;
};

struct Particle {
  std::uint64_t id = 0;
  Vec3 place{};  // in cells
  double mass = 0;
  IntVec3 cell() const {
    return {static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)), 0};
  }
};
bool cell_then_id(const Particle& a, const Particle& b) {
  const IntVec3 p = a.cell(), q = b.cell();
  return std::tie(p.y, p.x, a.id) < std::tie(q.y, q.x, b.id);
}

// The particles of each box, and those of neighbours within the width of the shape function.
class Particles {
 public:
  static constexpr int shape_width = 1;  // a hat of one cell on either side

  explicit Particles(const Level& level) : level_(&level), own_(level.boxes.size()) {
    for (std::uint64_t id = 0; id < 60; ++id) {
      const double t = static_cast<double>(id);
      const Particle p{id,
                       {8 + 6.3 * std::sin(1.7 * t), 6 + 4.1 * std::cos(2.3 * t), 0.5},
                       40 + 3 * std::sin(t)};
      for (const GridBox& b : level.boxes)
        if (b.cells.contains(p.cell())) own_[static_cast<std::size_t>(b.id)].push_back(p);
    }
  }

  // The particle halo: the same regions as for cells, what lies in them instead of their values.
  void exchange() {
    seen_ = own_;
    for (const HaloCopy& c : halo_copies(*level_, shape_width))
      for (const Particle& p : own_[static_cast<std::size_t>(c.from)])
        if (c.region.contains(p.cell())) seen_[static_cast<std::size_t>(c.to)].push_back(p);
    for (auto& box : seen_) std::sort(box.begin(), box.end(), cell_then_id);
  }

  // Each box scatters own and halo particles, in (cell, id) order, into its own cells.
  void scatter(Warehouse& state) const {
    const int slot = state.find(mass_of(1), 1);
    for (const GridBox& box : state.local_boxes()) {
      const RealView v = state.view(slot, 0, box.id);
      for_each_cell(box.cells, [&](IntVec3 c) { v(c) = 0; });
      for (const Particle& p : seen_[static_cast<std::size_t>(box.id)])
        for_each_cell(
            intersection(box.cells, IndexBox{p.cell(), p.cell() + IntVec3{1, 1, 1}}.grown(
                                        {shape_width, shape_width, 0})),
            [&](IntVec3 c) { v(c) += p.mass * hat(c.x, p.place.x) * hat(c.y, p.place.y); });
    }
  }

 private:
  static double hat(int i, double x) { return std::max(0.0, 1 - std::fabs(i + 0.5 - x)); }
  const Level* level_;
  std::vector<std::vector<Particle>> own_, seen_;
};

// One Newton pass for the pressure that all materials share.
struct PressurePass {
  TaskList list;
  VariableId pressure, pressure_new;

  explicit PressurePass(const std::vector<const Closed*>& materials) {
    pressure = list.old_state(test_label(2), 0, 1);
    pressure_new = list.new_state(test_label(2), 0, 1);
    const VariableId heat = list.old_state(test_label(3), 0, 1);
    std::vector<VariableId> density, slope;
    for (const Closed* m : materials) {
      TaskBuilder task = list.task("closure of " + m->cells.name, 0);
      const In p = task.read(pressure), T = task.read(heat);
      density.push_back(list.temporary("rho of " + m->cells.name));
      slope.push_back(list.temporary("drho/dp of " + m->cells.name));
      const Out rho = task.write(density.back()), drho = task.write(slope.back());
      const Out c = task.write(list.temporary("c of " + m->cells.name));
      task.kernel([=](const Row& row) {
        m->closure({row.count(), row(p), row(T), row(rho), row(drho), row(c)});
      });
    }
    TaskBuilder newton = list.task("pressure", 0);
    const In p = newton.read(pressure);
    std::vector<In> mass, rho, drho;
    for (std::size_t m = 0; m < materials.size(); ++m) {
      mass.push_back(newton.read(
          list.old_state(materials[m]->cells.fields.mass, materials[m]->cells.number, 1)));
      rho.push_back(newton.read(density[m]));
      drho.push_back(newton.read(slope[m]));
    }
    const Out next = newton.write(pressure_new);
    newton.kernel([=](const Row& row) {
      for (int i = 0; i < row.count(); ++i) {
        double excess = -1, change = 0;
        for (std::size_t m = 0; m < mass.size(); ++m) {
          const double volume = row(mass[m])[i] / row(rho[m])[i];
          excess += volume;
          change += volume * row(drho[m])[i] / row(rho[m])[i];
        }
        row(next)[i] = row(p)[i] * std::exp(excess / (change * row(p)[i]));  // stays positive
        row.reductions().maximum(0, ordered_bits(std::fabs(excess)));
      }
    });
  }
};

struct Mixture {
  Gas gas;
  Solid solid;
  Level level;
  Particles particles;
  PressurePass pass;
  Warehouse state, next;
  std::unique_ptr<SweepExecutor> sweep;
  double worst = 0;
  int passes = 0;

  explicit Mixture(IntVec3 boxes, IntVec3 block = {})
      : level(level_of({16, 12, 1}, boxes)),
        particles(level),
        pass({&gas, &solid}),
        state(level, 0),
        next(level, 0) {
    for (const SlotInfo& s : {SlotInfo{test_label(2), 0, 1, 0}, SlotInfo{test_label(3), 0, 1, 0},
                              SlotInfo{mass_of(0), 0, 1, 0}, SlotInfo{mass_of(1), 1, 1, 0}})
      state.add(s);
    next.add({test_label(2), 0, 1, 0});
    SweepOptions o;
    o.maxima = 1;
    o.block = block;
    EffectList effects;
    effects.add({"flow", true, "", {}});
    sweep = std::make_unique<SweepExecutor>(
        pass.list, compile(pass.list, effects, {pass.pressure_new}, axes_of(level)), level, o);
    sweep->bind(state, next, nullptr);
    each_box([&](int b, const IndexBox& cells) {
      for_each_cell(cells, [&](IntVec3 c) {
        state.view(0, 0, b)(c) = 1e5;
        state.view(1, 0, b)(c) = temperature;
        state.view(2, 0, b)(c) = 1.2;
      });
    });
  }

  void each_box(const std::function<void(int, const IndexBox&)>& f) const {
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      f(b, state.local_boxes()[static_cast<std::size_t>(b)].cells);
  }

  Schedule schedule(int most) {
    const Action project = [this](const StepScope&, StepJournal&) {
      for (const CellMaterial* m : {&gas.cells, &solid.cells})
        if (m->movement == Movement::particles) particles.scatter(state);
      return Verdict::good;
    };
    const Action newton = [this](const StepScope& s, StepJournal&) {
      worst = sweep->run({s.time, s.dt, level.spacing, s.level}).maximum(0);
      each_box([&](int b, const IndexBox& cells) {
        for_each_cell(cells, [&](IntVec3 c) { state.view(0, 0, b)(c) = next.view(0, 0, b)(c); });
      });
      return Verdict::good;
    };
    return {{HaloPoint{"particles", 0, Particles::shape_width,
                       [this](const StepScope&, StepJournal&) {
                         particles.exchange();
                         return Verdict::good;
                       }}},
            {Sweep{"projection", 0, project}},
            {Loop{"pressure",
                  {{Sweep{"Newton pass", 0, newton}}},
                  [this](const StepScope&, int n) {
                    passes = n;
                    return worst < converged_volume;
                  },
                  most}}};
  }

  std::vector<double> values(int slot) const {
    std::vector<double> v;
    for_each_cell(level.domain, [&](IntVec3 c) {
      each_box([&](int b, const IndexBox& cells) {
        if (cells.contains(c)) v.push_back(state.view(slot, 0, b)(c));
      });
    });
    return v;
  }
};

TEST(CellMaterialMock, TheLoopFindsTheSharedPressure) {
  Mixture mix({1, 1, 1});
  const Schedule schedule = mix.schedule(most_passes);
  check(schedule);
  StepJournal journal;
  ASSERT_EQ(run(schedule, {}, journal), Verdict::good);
  EXPECT_GT(mix.passes, 2);
  const std::vector<double> p = mix.values(0), gas = mix.values(2), solid = mix.values(3);
  double most_solid = 0;
  for (std::size_t n = 0; n < p.size(); ++n) {
    const double volume = gas[n] * gas_constant * temperature / p[n] +
                          solid[n] / (solid_density * (1 + p[n] / stiffness));
    EXPECT_NEAR(volume, 1, 1e-11);
    most_solid = std::max(most_solid, solid[n]);
    if (solid[n] == 0) {
      EXPECT_NEAR(p[n], 1.2 * gas_constant * temperature, 1e-6);
    }
  }
  EXPECT_GT(most_solid, 50);  // measured 90: particles are where they should
}

TEST(CellMaterialMock, ClosuresAreCalledOnceARow) {
  Mixture mix({1, 1, 1});
  StepJournal journal;
  ASSERT_EQ(run(mix.schedule(most_passes), {}, journal), Verdict::good);
  EXPECT_EQ(mix.gas.calls, 12 * mix.passes);  // 12 rows of 16 cells
  EXPECT_EQ(mix.solid.calls, mix.gas.calls);
}

TEST(CellMaterialMock, BoxesAndBlocksChangeNoBitOfProjectionAndPressure) {
  Mixture one({1, 1, 1}), many({4, 3, 1}, {3, 2, 1}), narrow({16, 1, 1});
  for (Mixture* mix : {&one, &many, &narrow}) {
    StepJournal journal;
    ASSERT_EQ(run(mix->schedule(most_passes), {}, journal), Verdict::good);
  }
  for (const Mixture* mix : {&many, &narrow}) {
    EXPECT_EQ(mix->values(3), one.values(3));
    EXPECT_EQ(mix->values(0), one.values(0));
    EXPECT_EQ(mix->passes, one.passes);
  }
}

TEST(CellMaterialMock, ALoopThatDoesNotConvergeRejectsTheStep) {
  Mixture mix({1, 1, 1});
  StepJournal journal;
  EXPECT_EQ(run(mix.schedule(2), {}, journal), Verdict::reject);
}

}  // namespace
}  // namespace sluice::cell_material_mock_test

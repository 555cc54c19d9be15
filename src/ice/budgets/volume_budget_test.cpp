// Control volumes of two materials: what passes their sides is the change of what they hold.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::volume_account_test {
namespace {

// 24 x 16 cells between walls under gravity, water on the left; the volume is cut by the interface.
class TwoFluids : public testing::Test {
 protected:
  TwoFluids() {
    GasBox box;
    box.cells = {24, 16, 1};
    box.periodic = false;
    box.walls = true;
    box.scheme = "conservative";
    box.gravity = "[0,-1e4,0]";
    std::string text = deck_text(box);
    const std::string end = "</Uintah_specification>";
    text.replace(text.find(end), end.size(),
                 "<DataAnalysis><Module name='firstLawThermo'><samplingFrequency>1"
                 "</samplingFrequency><timeStart>0</timeStart><timeStop>1</timeStop><controlVolume>"
                 "<box><min>[0.25,0.25,0]</min><max>[0.75,0.75,1]</max></box></controlVolume>"
                 "</Module></DataAnalysis>" +
                     end);
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    Deck deck = load_deck_text(text, "box.ups", {}, schema);
    std::vector<Fault> faults = deck.faults;
    scene_ = read_scene(deck, SceneOptions{}, faults);
    IceScene ice = read_ice_scene(deck, scene_, faults);
    const IceMaterial first = ice.materials.front();
    ice.materials.assign(2, first);
    for (std::size_t m = 0; m < 2; ++m) {
      ice.materials[m].fluid = fluids_[m];
      ice.materials[m].index = static_cast<int>(m);
    }
    ice.exchange.momentum = PairCoefficients(2);
    ice.exchange.momentum.set(0, 1, one_velocity_coefficient);
    ice_ = std::make_unique<Ice>(scene_, std::move(ice));
    const Level& level = scene_.grid.levels.front();
    SolverOptions options;
    options.block = {6, 4, 1};  // some hold one of the materials alone
    solver_ = std::make_unique<LevelSolver>(*ice_, level, world(), options);
    volume_ = cells_of(control_volumes(scene_.analysis).front(), level);
    solver_->graphs().watch(VolumeFaces({volume_}, level, level, nullptr, 0));
    for_each_cell(level.domain, [&](IntVec3 c) { fill(c, level.centre(c)); });
    solver_->mark_modified();
  }

  double& at(Label label, int material, int component, IntVec3 c) {
    Warehouse& state = solver_->state();
    return state.view(state.find(label, material), component, 0)(c);
  }
  void fill(IntVec3 c, Vec3 x) {
    const bool left = x.x + 0.2 * std::sin(6 * x.y) < 0.6;
    const double volume[] = {left ? 1.0 : 0.0, left ? 0.0 : 1.0};
    const double density[] = {1000, 1.2}, pressure[] = {x.x < 0.3 ? 1e9 : 1e5, 1e5};
    for (int m = 0; m < 2; ++m) {
      at(labels().mass, m, 0, c) = volume[m] * density[m];
      at(labels().volume, m, 0, c) = volume[m];
      at(labels().energy, m, 0, c) =
          volume[m] > 0 ? fluids_[m].energy_from_pressure(density[m], pressure[m], 300.0) : 0.0;
    }
  }
  struct Held {
    double mass[2] = {0, 0}, momentum[2] = {0, 0}, energy = 0;
  };
  Held held() {
    Held sum;
    const double V = scene_.grid.levels.front().cell_volume();
    for_each_cell(volume_.cells, [&](IntVec3 c) {
      double rho = 0, m2 = 0;
      for (int m = 0; m < 2; ++m) {
        sum.mass[m] += V * at(labels().mass, m, 0, c);
        sum.energy += V * at(labels().energy, m, 0, c);
        rho += at(labels().mass, m, 0, c);
      }
      for (int d = 0; d < 2; ++d) {
        const double p = at(labels().momentum, 0, d, c);
        sum.momentum[d] += V * p;
        m2 += p * p;
      }
      sum.energy += V * 0.5 * m2 / rho;
    });
    return sum;
  }

  std::vector<Fluid> fluids_ = {stiffened_gas(4.4, 6e8), ideal_gas(1.4, 717)};
  Scene scene_;
  std::unique_ptr<Ice> ice_;
  std::unique_ptr<LevelSolver> solver_;
  VolumeCells volume_;
};

// Measured, as shares of what was held or moved: below 1e-15.
TEST_F(TwoFluids, KeepTheirBudgets) {
  constexpr double limit = 4e-15;
  const std::shared_ptr<RunControl> control = shared_control();
  const VolumeSums slots = *ice_->budgets().volume_sums();
  ASSERT_EQ(ice_->step().reductions().sums(), slots.mass(0, 0, 0) + slots.count(1));
  std::vector<double> rates = solver_->initial_rates();
  const Held before = held();
  Held passed, moved;
  double time = 0;
  for (int step = 0; step < 60; ++step) {
    const double dt = 0.5 * ice_->step().limit(rates).dt;
    solver_->fill_ghosts(time);
    const StepAttempt& a = solver_->attempt(time, dt, {}, control.get());
    ASSERT_EQ(a.faults, 0);
    rates = a.maxima;
    const auto sum = [&](int slot) { return a.sums[slot]; };
    const auto add = [](double& into, double& size, double x) {
      into += x;
      size += std::fabs(x);
    };
    for (int side = 0; side < 4; ++side) {
      const double in = side % 2 == 0 ? 1 : -1;
      for (int m = 0; m < 2; ++m)
        add(passed.mass[m], moved.mass[m], in * sum(slots.mass(0, side, m)));
      for (int d = 0; d < 2; ++d)
        for (const int part : {slots.momentum(0, side), slots.viscous(0, side)})
          add(passed.momentum[d], moved.momentum[d], in * sum(part + d));
      add(passed.momentum[side / 2], moved.momentum[side / 2], in * sum(slots.pressure(0, side)));
      add(passed.energy, moved.energy, in * sum(slots.energy(0, side)));
    }
    for (int d = 0; d < 2; ++d) add(passed.momentum[d], moved.momentum[d], sum(slots.force(0) + d));
    add(passed.energy, moved.energy, sum(slots.work(0)));
    solver_->advance();
    solver_->accept();
    time += dt;
  }
  const Held after = held();
  for (int m = 0; m < 2; ++m) {
    EXPECT_NE(passed.mass[m], 0.0);
    EXPECT_NEAR(after.mass[m] - before.mass[m], passed.mass[m],
                limit * (before.mass[m] + moved.mass[m]));
  }
  for (int d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d] - before.momentum[d], passed.momentum[d],
                limit * moved.momentum[d]);
  EXPECT_NEAR(after.energy - before.energy, passed.energy, limit * (before.energy + moved.energy));
}

}  // namespace
}  // namespace sluice::ice::volume_account_test

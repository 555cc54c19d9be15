// Open faces (LODI) of two materials: what mixtures, interfaces and single materials leave outside.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "framework/base/error.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice::mixture_waves_test {
namespace {

constexpr double far_pressure = 10, dx = 0.1;

Condition open_for(const char* variable, int material = -1) {
  Condition c;
  c.variable = variable;
  c.kind_name = "LODI";
  c.kind = ConditionKind::other;
  c.material = material;
  c.has_value = true;
  c.is_vector = c.variable == "Velocity";
  return c;
}

std::vector<Condition> open_face() {
  return {open_for("Pressure"), open_for("Velocity"), open_for("Temperature"), open_for("Density")};
}

// Share of the first material, true densities, velocity, pressure.
struct State {
  double share = 1, rho[2] = {1, 1}, u = 0, p = far_pressure;
};

// Eight cells along x, open at both ends, of two gases or of the first alone.
class Tube {
 public:
  explicit Tube(int materials = 2, std::vector<Condition> conditions = open_face())
      : count_(materials) {
    Level level;
    level.domain = {{0, 0, 0}, {8, 1, 1}};
    level.active = {true, false, false};
    level.boxes = {{level.domain, 0, 0}};
    level.spacing = {dx, 1, 1};
    scene_.grid.levels = {level};
    BoundaryRegion region;
    region.conditions = std::move(conditions);
    region.name = "side x-";
    for (Side side : {Side::x_minus, Side::x_plus})
      scene_.boundary.sides[index_of(side)].regions = {region};
    for (int m = 0; m < materials; ++m) {
      materials_.emplace_back();
      materials_.back().index = m;
      materials_.back().fluid = m == 0 ? ideal_gas(1.4, 1) : ideal_gas(1.667, 2);
    }
    conditions_.lodi = LodiSettings{};
    conditions_.lodi->press_infinity = far_pressure;
    conditions_.lodi->sigma = 0;
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    for (int m = 0; m < materials; ++m) state_->add({l.mass, m, 1, 4});
    state_->add({l.momentum, 0, 1, 4});
    for (int m = 0; m < materials; ++m) state_->add({l.energy, m, 1, 4});
    for (int m = 0; materials > 1 && m < 2; ++m) state_->add({l.volume, m, 1, 4});
  }
  Tube& fill(const std::function<State(int)>& f) {
    const Labels& l = labels();
    for (int i = 0; i < 8; ++i) {
      const State s = f(i);
      double rho = 0;
      for (int m = 0; m < count_; ++m) {
        const double V = m == 0 ? s.share : 1 - s.share;
        at(l.mass, m, i) = V * s.rho[m];
        at(l.energy, m, i) = V * fluid(m).energy_from_pressure(s.rho[m], s.p, 0);
        if (count_ > 1) at(l.volume, m, i) = V;
        rho += V * s.rho[m];
      }
      at(l.momentum, 0, i) = rho * s.u;
    }
    StateSlots slots{l.mass, l.momentum, l.energy, 0, {0}};
    if (count_ > 1) slots.volume = l.volume;
    BoundaryFill(scene_, materials_, slots, 0, conditions_).fill(*state_, ThreadTeam());
    return *this;
  }
  double& at(Label label, int m, int i) const {
    return state_->view(state_->find(label, m), 0, 0)(i, 0, 0);
  }
  double mass(int m, int i) const { return at(labels().mass, m, i); }
  double energy(int m, int i) const { return at(labels().energy, m, i); }
  double volume(int m, int i) const { return at(labels().volume, m, i); }
  double u(int i) const {
    return at(labels().momentum, 0, i) / (mass(0, i) + (count_ > 1 ? mass(1, i) : 0.0));
  }
  double p(int m, int i) const {
    return fluid(m).pressure(mass(m, i) / volume(m, i), energy(m, i) / volume(m, i));
  }
  const Fluid& fluid(int m) const { return materials_[m].fluid; }

 private:
  int count_;
  Scene scene_;
  std::vector<IceMaterial> materials_;
  FlowConditions conditions_;
  std::unique_ptr<Warehouse> state_;
};

// An interface in the last cells does not show in pressure and velocity.
TEST(MixtureWaves, UniformFlowStaysUniformWhateverFillsTheCells) {
  const double shares[8] = {0.25, 1, 1, 1, 0, 0, 1e-9, 0.5};
  Tube tube;
  tube.fill([&](int i) { return State{shares[i], {4, 0.5}, 0.7, far_pressure}; });
  for (const int ghost : {-1, -3, 8, 10}) {
    const int cell = ghost < 0 ? 0 : 7;
    for (int m = 0; m < 2; ++m) {
      EXPECT_NEAR(tube.p(m, ghost), far_pressure, 1e-12) << ghost;
      EXPECT_EQ(tube.mass(m, ghost), tube.mass(m, cell)) << ghost;
      EXPECT_EQ(tube.volume(m, ghost), tube.volume(m, cell)) << ghost;
    }
    EXPECT_NEAR(tube.u(ghost), 0.7, 1e-14) << ghost;
  }
}

// 1/K = sum V/K_m is what a small wave knows of the materials.
TEST(MixtureWaves, LeaveWithDensityAndSoundSpeedOfTheMixture) {
  constexpr double height = 1e-6;
  const double rho0[2] = {4, 0.5}, gamma[2] = {1.4, 1.667}, share = 0.3;
  const double K = far_pressure / (share / gamma[0] + (1 - share) / gamma[1]);
  const double rho = share * rho0[0] + (1 - share) * rho0[1], c = std::sqrt(K / rho);
  // Along +x on a mean flow: each material along its isentrope, shares with it.
  const auto wave = [&](int i) {
    const double dp = height * std::sin(0.4 * i);
    State s{share, {rho0[0], rho0[1]}, 0.5 + dp / (rho * c), far_pressure + dp};
    for (int m = 0; m < 2; ++m) s.rho[m] *= 1 + dp / (gamma[m] * far_pressure);
    const double mass[2] = {share * rho0[0], (1 - share) * rho0[1]};
    s.share = mass[0] / s.rho[0] / (mass[0] / s.rho[0] + mass[1] / s.rho[1]);
    return s;
  };
  Tube tube;
  tube.fill(wave);
  for (int layer = 0; layer < 3; ++layer) {
    const double step = (1 + layer) * (tube.p(0, 7) - tube.p(0, 6));
    for (int m = 0; m < 2; ++m) {
      EXPECT_NEAR(tube.p(m, 8 + layer), tube.p(m, 7) + step, 1e-3 * std::fabs(step));
      EXPECT_NEAR(
          tube.mass(m, 8 + layer) / tube.volume(m, 8 + layer) - tube.mass(m, 7) / tube.volume(m, 7),
          rho0[m] / (gamma[m] * far_pressure) * step, 1e-3 * std::fabs(step));
      EXPECT_NEAR(tube.p(m, -1 - layer), tube.p(m, 0), 1e-3 * height);  // nothing comes in
    }
    EXPECT_NEAR(tube.u(8 + layer) - tube.u(7), step / (rho * c),
                1e-3 * std::fabs(step) / (rho * c));
    EXPECT_NEAR(tube.volume(0, 8 + layer) + tube.volume(1, 8 + layer), 1.0, 1e-15);
  }
}

TEST(MixtureWaves, OneMaterialAloneHasTheBitsOfOneMaterial) {
  const auto flow = [](int i) {
    return State{1, {1 + 0.2 * std::sin(2.0 * i), 1}, 0.4 * std::cos(i), 10 + std::sin(3.0 * i)};
  };
  Tube two(2), one(1);
  two.fill(flow);
  one.fill(flow);
  for (const int ghost : {-3, -2, -1, 8, 9, 10}) {
    EXPECT_EQ(two.mass(0, ghost), one.mass(0, ghost));
    EXPECT_EQ(two.energy(0, ghost), one.energy(0, ghost));
    EXPECT_EQ(two.at(labels().momentum, 0, ghost), one.at(labels().momentum, 0, ghost));
    EXPECT_EQ(two.volume(0, ghost), 1.0);
    EXPECT_EQ(two.mass(1, ghost), 0.0);
    EXPECT_EQ(two.energy(1, ghost), 0.0);
  }
}

TEST(MixtureWaves, MirroredTubesGiveMirroredBits) {
  const auto flow = [](int i) {
    return State{
        0.5 + 0.4 * std::sin(i), {2 + std::sin(2.0 * i), 0.5}, std::cos(3.0 * i), 10.0 + i};
  };
  Tube tube, image;
  tube.fill(flow);
  image.fill([&](int i) {
    State s = flow(7 - i);
    s.u = -s.u;
    return s;
  });
  for (int layer = 0; layer < 3; ++layer) {
    for (int m = 0; m < 2; ++m) {
      EXPECT_EQ(tube.mass(m, 8 + layer), image.mass(m, -1 - layer));
      EXPECT_EQ(tube.volume(m, 8 + layer), image.volume(m, -1 - layer));
      EXPECT_EQ(tube.energy(m, 8 + layer), image.energy(m, -1 - layer));
    }
    EXPECT_EQ(tube.u(8 + layer), -image.u(-1 - layer));
  }
}

TEST(MixtureWaves, AreForAllMaterialsOrForNone) {
  Condition copy = open_for("Density", 1);
  copy.kind = ConditionKind::dirichlet;
  copy.kind_name = "Dirichlet";
  copy.value = 2;
  std::vector<Condition> mixed = open_face();
  mixed.push_back(copy);
  const std::vector<Condition> one = {open_for("Density", 0)};
  for (const auto& [conditions, says] :
       {std::pair{mixed, "LODI together with a given density of material 1"},
        std::pair{one, "LODI for some materials, but not for material 1"}}) {
    try {
      Tube tube(2, conditions);
      tube.fill([](int) { return State{}; });
      FAIL() << "accepted: " << says;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace sluice::ice::mixture_waves_test

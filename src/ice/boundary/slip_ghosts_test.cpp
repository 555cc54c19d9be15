// Ghosts of walls along which a rarefied gas slips.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "framework/base/error.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/conditions/wall_slip.hpp"
#include "ice/fluid/labels.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice::slip_ghosts_test {
namespace {

using Model = SlipSettings::Model;
constexpr double viscosity = 0.05, dx = 0.1, dy = 0.2;

Condition wall(const char* kind, Vec3 velocity) {
  Condition c;
  c.variable = "Velocity";
  c.kind_name = kind;
  c.kind = ConditionKind::other;
  c.has_value = c.is_vector = true;
  c.vector = velocity;
  return c;
}

struct State {
  double rho = 1, u = 0, p = 10;
  double f = 0;  // of a mixed gas
};

// Eight by six cells between slipping walls at both ends of y.
class Channel {
 public:
  explicit Channel(const SlipSettings& settings, const char* kind = "slip", Vec3 velocity = {},
                   double gravity = 0, double mu = viscosity,
                   std::optional<Sutherland> sutherland = {},
                   const models::MixedGas* mixed = nullptr)
      : mixed_(mixed) {
    Level level;
    level.domain = {{0, 0, 0}, {8, 6, 1}};
    level.active = {true, true, false};
    level.boxes = {{level.domain, 0, 0}};
    level.spacing = {dx, dy, 1};
    scene_.grid.levels = {level};
    scene_.constants.gravity = {gravity, 0, 0};
    BoundaryRegion region;
    region.conditions = {wall(kind, velocity)};
    for (Side side : {Side::y_minus, Side::y_plus})
      scene_.boundary.sides[index_of(side)].regions = {region};
    Condition copy = wall("Neumann", {});
    copy.kind = ConditionKind::neumann;
    region.conditions = {copy};
    for (Side side : {Side::x_minus, Side::x_plus})
      scene_.boundary.sides[index_of(side)].regions = {region};
    material_.viscosity = mu;
    material_.viscosity_models.sutherland = sutherland;
    conditions_.slip = settings;
    const Labels& l = labels();
    state_ = std::make_unique<Warehouse>(scene_.grid.levels.front(), 0);
    state_->add({l.mass, 0, 1, 4});
    state_->add({l.momentum, 0, 2, 4});
    state_->add({l.energy, 0, 1, 4});
    if (mixed == nullptr) return;
    scalars_.resize(1);
    scalars_[0].name = mixed->fractions.front();
    state_->add({scalars_[0].state(), 0, 1, 4});
  }
  void fill(const std::function<State(double, double)>& f) {
    for_each_cell(scene_.grid.levels.front().domain, [&](IntVec3 c) {
      const State s = f(dx * (c.x + 0.5), dy * (c.y + 0.5));
      state_->view(0, 0, 0)(c) = s.rho;
      state_->view(1, 0, 0)(c) = s.rho * s.u;
      state_->view(1, 1, 0)(c) = s.rho * 0.25;
      state_->view(2, 0, 0)(c) = s.p / (mixed_ == nullptr ? 0.4 : mixed_->at(s.f).ratio());
      if (mixed_ != nullptr) state_->view(3, 0, 0)(c) = s.f;
    });
    const Labels& l = labels();
    BoundaryFill(scene_, std::span(&material_, 1), {l.mass, l.momentum, l.energy, 0, {0, 1}}, 0,
                 conditions_, scalars_, mixed_)
        .fill(*state_, ThreadTeam());
  }
  double u(int i, int j, int c = 0) const {
    return state_->view(1, c, 0)(i, j, 0) / state_->view(0, 0, 0)(i, j, 0);
  }
  // On the wall of y-.
  double on_wall(int i) const { return 0.5 * (u(i, -1) + u(i, 0)); }

 private:
  Scene scene_;
  IceMaterial material_;
  FlowConditions conditions_;
  const models::MixedGas* mixed_;
  std::vector<models::TransportedScalar> scalars_;
  std::unique_ptr<Warehouse> state_;
};

SlipSettings settings(Model model = Model::first_order, double accommodation = 0.8) {
  SlipSettings s;
  s.model = model;
  s.momentum_accommodation = accommodation;
  return s;
}

constexpr double reflection = (2 - 0.8) / 0.8;
double free_path(double rho, double p) {
  return viscosity / (rho * std::sqrt(2 * (p / rho) / std::numbers::pi));
}

TEST(SlipGhosts, AStraightProfileMeetsTheWallWhereItShould) {
  // u' = 3: the gas on the wall has u_w + L u'.
  Channel channel(settings(), "slip", {2, 0, 0});
  const double L = reflection * free_path(1.2, 10);
  channel.fill([&](double, double y) { return State{1.2, 2 + 3 * (y + L), 10}; });
  EXPECT_NEAR(channel.on_wall(3), 2 + 3 * L, 1e-13);
  EXPECT_NEAR(channel.u(3, -1), 2 + 3 * (L - 0.1), 1e-13);
  EXPECT_NEAR(channel.u(3, -2), 2 + 3 * (L - 0.3), 1e-13);  // mirrored about the wall
  EXPECT_DOUBLE_EQ(channel.u(3, -1, 1), -0.25);
}

TEST(SlipGhosts, LieBetweenWallAndGasWhateverTheMeanFreePath) {
  for (const double mu : {1e-9, 1e-3, 1.0, 1e9}) {
    Channel channel(settings(), "slip", {2, 0, 0}, 0, mu);
    channel.fill([](double, double) { return State{1, 5, 10}; });
    EXPECT_GE(channel.on_wall(3), 2 - 1e-14) << mu;
    EXPECT_LE(channel.on_wall(3), 5 + 1e-14) << mu;
  }
  Channel sticking(settings(), "slip", {2, 0, 0}, 0, 1e-9), free(settings(), "slip", {}, 0, 1e9);
  sticking.fill([](double, double) { return State{1, 5, 10}; });
  free.fill([](double, double) { return State{1, 5, 10}; });
  EXPECT_NEAR(sticking.on_wall(3), 2, 1e-6);
  EXPECT_NEAR(free.on_wall(3), 5, 1e-6);
}

// mu u'' = dp/ds - rho g: the curvature counts with -C lambda^2, the slope with L.
void expect_curvature_counts(Model model, double C) {
  constexpr double gravity = 1.5, slope = 4;
  Channel channel(settings(model), "slip", {}, gravity);
  channel.fill([](double x, double) { return State{1, 0, 10 + slope * x}; });
  const double p = 10 + slope * 0.35, lambda = free_path(1, p);
  const double weight = 2 * reflection * lambda / dy;
  EXPECT_NEAR(channel.on_wall(3),
              -C * lambda * lambda * (slope - gravity) / viscosity / (1 + weight), 1e-13);
}

TEST(SlipGhosts, SecondOrderKnowsWhatPullsAtTheGas) {
  expect_curvature_counts(Model::first_order, 0);
  expect_curvature_counts(Model::deissler, 9.0 / 8);
  expect_curvature_counts(Model::karniadakis_beskok, -0.5 * reflection);
}

TEST(SlipGhosts, SecondOrderKnowsTheDrivingForce) {
  // As the gradient of pressure would, with the other sign.
  SlipSettings driven = settings(Model::deissler);
  driven.force = {-4, 0, 0};
  Channel channel(driven, "slip"), pressed(settings(Model::deissler), "slip");
  channel.fill([](double, double) { return State{1, 0, 10}; });
  pressed.fill([](double x, double) { return State{1, 0, 10 + 4 * (x - 0.35)}; });
  EXPECT_LT(channel.on_wall(3), 0);
  EXPECT_NEAR(channel.on_wall(3), pressed.on_wall(3), 1e-13);
}

TEST(SlipGhosts, GasAtRestUnderItsWeightDoesNotSlip) {
  constexpr double gravity = -2;
  Channel channel(settings(Model::deissler), "slip", {}, gravity);
  // p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2 with a density that rises.
  double rho[8], p[8] = {10};
  for (int i = 0; i < 8; ++i) rho[i] = 1 + 0.2 * i;
  for (int i = 1; i < 8; ++i) p[i] = p[i - 1] + gravity * dx * 0.5 * (rho[i - 1] + rho[i]);
  channel.fill([&](double x, double) {
    const int i = static_cast<int>(x / dx);
    return State{rho[i], 0, p[i]};
  });
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(channel.u(i, -1), 0, 1e-14) << i;
}

TEST(SlipGhosts, GasCreepsTowardsWhereItIsWarmer) {
  // T = p/(0.4 rho) rises by 2 a metre at uniform pressure; 3/4 mu/(rho T) dT/ds.
  const auto warmer = [](double x, double) { return State{10 / (0.4 * (20 + 2 * x)), 0, 10}; };
  SlipSettings creeping = settings();
  creeping.creep = true;
  Channel by_block(creeping), by_kind(settings(), "creep"), without(settings());
  for (Channel* channel : {&by_block, &by_kind, &without}) channel->fill(warmer);
  const double T = 20 + 2 * 0.35, rho = 10 / (0.4 * T);
  const double weight = 2 * reflection * free_path(rho, 10) / dy;
  const double speed = 0.75 * viscosity / (rho * T) * 2 / (1 + weight);
  EXPECT_NEAR(by_block.on_wall(3), speed, 1e-14);
  EXPECT_NEAR(by_kind.on_wall(3), speed, 1e-14);
  EXPECT_GT(speed, 1e-5);
  EXPECT_EQ(without.on_wall(3), 0.0);
}

// Gas that is a mixture has the pressure, the temperature and the viscosity of its fraction in each
// cell: in a channel where f rises along the wall it slips, is pulled and creeps by them.
TEST(SlipGhosts, OfAMixtureKnowWhatTheCellHolds) {
  models::MixedGas gas;
  gas.fractions = {"f"};
  gas.set_nodes({{0, 1, .4, viscosity, 0, 0}, {1, 3, 1.5, .02, 0, 0}});
  SlipSettings slip = settings(Model::deissler);
  slip.creep = true;
  Channel channel(slip, "slip", {2, 0, 0}, 0, viscosity, {}, &gas);
  constexpr double rho = 1.2, slope = 4;
  const auto f = [](double x) { return x; };
  channel.fill([&](double x, double) { return State{rho, 5, 10 + slope * x, f(x)}; });
  const double x = 0.35, p = 10 + slope * x, mu = .05 + f(x) * (.02 - .05);
  const auto T = [&](double at) { return (10 + slope * at) / (rho * (.4 + f(at) * (1.5 - .4))); };
  const double lambda = mu / (rho * std::sqrt(2 * (p / rho) / std::numbers::pi));
  const double weight = 2 * reflection * lambda / dy, warming = (T(x + dx) - T(x - dx)) / (2 * dx);
  const double known =
      2 - 9.0 / 8 * lambda * lambda * slope / mu + .75 * mu / (rho * T(x)) * warming;
  EXPECT_NEAR(channel.on_wall(3), (known + weight * 5) / (1 + weight), 1e-12);
}

TEST(SlipGhosts, TakeTheViscosityOfSutherlandsLaw) {
  const double T = 10 / (0.4 * 1.2);
  const Sutherland law{viscosity * (T + 3) / (T * std::sqrt(T)), 3};
  Channel by_law(settings(), "slip", {2, 0, 0}, 0, 0.01, law);
  Channel by_number(settings(), "slip", {2, 0, 0});
  for (Channel* channel : {&by_law, &by_number})
    channel->fill([](double, double) { return State{1.2, 5, 10}; });
  EXPECT_NEAR(by_law.on_wall(3), by_number.on_wall(3), 1e-14);
}

TEST(SlipGhosts, AWallThatMovesAcrossItselfIsRefused) {
  try {
    Channel channel(settings(), "slip", {0, 1, 0});
    channel.fill([](double, double) { return State{}; });
    FAIL() << "a wall with an inflow was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("has the normal component"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace sluice::ice::slip_ghosts_test

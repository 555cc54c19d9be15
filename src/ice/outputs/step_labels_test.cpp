// Labels of a step against what they must sum to, and against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ice/step/effect_ids.hpp"
#include "ice/test_support/transport.hpp"

namespace sluice::ice::step_labels_test {
namespace {

constexpr double round_off = 1e-13;

std::vector<Label> all_labels_of_a_step() {
  const Labels& l = labels();
  std::vector<Label> all = {l.lagrangian_mass,        l.momentum_before_exchange,
                            l.lagrangian_momentum,    l.momentum_source,
                            l.lagrangian_velocity,    l.stress_velocity,
                            l.energy_before_exchange, l.lagrangian_energy,
                            l.energy_source,          l.lagrangian_volume,
                            l.volume_source,          l.dilation,
                            l.lagrangian_heating,     l.temperature_rate,
                            l.velocity_rate};
  for (int d = 0; d < 3; ++d)
    for (const Label label : {l.face_temperature[d], l.face_volume_fraction[d],
                              l.face_pressure_gradient[d], l.face_pressure[d], l.face_velocity[d]})
      all.push_back(label);
  return all;
}

// Gas and liquid that share all cells of a periodic square but for a disc of gas alone.
MixtureCell stirred(Vec3 x) {
  constexpr double k = 2 * std::numbers::pi;
  const bool disc = std::hypot(x.x - .5, x.y - .4) < .2;
  const double share = .5 + .3 * std::sin(k * x.x);
  MixtureCell c;
  c.volume = {disc ? 0.0 : share, disc ? 1.0 : 1.0 - share};
  c.density = {1000 + 5 * std::cos(k * x.y), 2 + std::sin(k * x.y)};
  const double p = 1e5 * (2 + std::sin(k * (x.x + x.y)));
  c.pressure = {p, p};
  c.velocity[0] = 20 * std::sin(k * x.y);
  c.velocity[1] = 15 * std::cos(k * x.x);
  return c;
}

struct Case {
  double drag, viscosity;
};
void PrintTo(const Case& c, std::ostream* to) {
  *to << "K " << c.drag << ", mu " << c.viscosity;
}

class LabelsOfAStep : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& c = GetParam();
    Transport transport;
    transport.viscosity = {c.viscosity, 2 * c.viscosity};
    run_.emplace(box_of({24, 20, 1}, true, &GasBox::walls), std::vector<Fluid>{water, air}, stirred,
                 SolverOptions{}, IntVec3{}, transport, c.drag);
    run_->steps(3);
    for_each_cell(run_->domain(), [&](IntVec3 at) {
      for (int m = 0; m < 2; ++m) share_.push_back(run_->volume(m, at));
    });
    const Totals before = run_->totals();
    energy_ = before.internal_energy.sum.value() + before.kinetic_energy.sum.value();
    kinetic_ = before.kinetic_energy.sum.value();
    start_ = run_->time();
    run_->save(all_labels_of_a_step());
    run_->steps(1);
  }
  double dt() const { return run_->time() - start_; }
  // Of the start of the step.
  double share(IntVec3 cell, int m) const { return share_[2 * (cell.x + 24 * cell.y) + m]; }
  template <class F>
  double sum(F f) const {
    double all = 0;
    for_each_cell(run_->domain(), [&](IntVec3 c) {
      for (int m = 0; m < 2; ++m) all += f(c, m);
    });
    return all;
  }
  double saved(Label label, IntVec3 c, int m, int d = 0) const {
    return run_->saved(label, m, c, d);
  }

  std::optional<MixtureBox> run_;
  std::vector<double> share_;
  double energy_ = 0, kinetic_ = 0, start_ = 0;
  static constexpr double volume = 1. / (24 * 20), momentum = 500 * 20 * volume;
};

// What the phase leaves of all materials is all the energy there was, and no momentum comes from
// within; so is the mass.
TEST_P(LabelsOfAStep, SumToWhatIsConserved) {
  const Labels& l = labels();
  double kinetic = 0, before = 0;
  for (int d = 0; d < 2; ++d) {
    kinetic += sum([&](IntVec3 c, int m) {
      const double M = saved(l.lagrangian_mass, c, m), P = saved(l.lagrangian_momentum, c, m, d);
      return M > 0 ? .5 * P * P / M : 0.0;
    });
    const double given = sum([&](IntVec3 c, int m) { return saved(l.momentum_source, c, m, d); });
    EXPECT_LE(std::fabs(given), round_off * momentum * 480);
    before += sum([&](IntVec3 c, int m) {
      const double M = saved(l.lagrangian_mass, c, m), u = saved(l.stress_velocity, c, m, d);
      return .5 * M * u * u;
    });
  }
  EXPECT_NEAR(before, kinetic_, round_off * kinetic_);
  const double inner = sum([&](IntVec3 c, int m) { return saved(l.energy_before_exchange, c, m); });
  EXPECT_NEAR((inner + kinetic) / energy_, 1, round_off);
  const double gained = sum([&](IntVec3 c, int m) { return saved(l.energy_source, c, m); });
  EXPECT_NEAR(gained, kinetic_ - kinetic, round_off * energy_);
  EXPECT_GT(std::fabs(gained), 1e-4 * kinetic_);
  const double mass = sum([&](IntVec3 c, int m) { return saved(l.lagrangian_mass, c, m); });
  EXPECT_NEAR(mass / run_->totals().mass[0].sum.value(),
              1 + run_->totals().mass[1].sum.value() / run_->totals().mass[0].sum.value(),
              round_off);
}

TEST_P(LabelsOfAStep, ExchangeTakesFromOneWhatItGivesAnother) {
  const Labels& l = labels();
  double most = 0;
  for_each_cell(run_->domain(), [&](IntVec3 c) {
    for (int d = 0; d < 2; ++d) {
      double before = 0, after = 0;
      for (int m = 0; m < 2; ++m) {
        const double free = saved(l.momentum_before_exchange, c, m, d);
        const double bound = saved(l.lagrangian_momentum, c, m, d);
        const double M = saved(l.lagrangian_mass, c, m);
        const double u = saved(l.stress_velocity, c, m, d);
        EXPECT_NEAR(free - M * u, saved(l.momentum_source, c, m, d), round_off * momentum);
        EXPECT_NEAR(saved(l.lagrangian_velocity, c, m, d) * M, bound, round_off * momentum);
        before += free;
        after += bound;
        most = std::fmax(most, std::fabs(free - bound));
      }
      EXPECT_NEAR(before, after, round_off * momentum);
    }
  });
  EXPECT_GT(most, 1e-6 * momentum);
}

// Pressure acts on each by its volume.
TEST_P(LabelsOfAStep, PressurePushesEachByItsVolume) {
  if (GetParam().viscosity > 0) return;
  const Labels& l = labels();
  const double area[] = {1. / 20, 1. / 24};
  for_each_cell(run_->domain(), [&](IntVec3 c) {
    for (int d = 0; d < 2; ++d) {
      IntVec3 above = c;
      ++above[d];
      const double dp = saved(l.face_pressure[d], above, 0) - saved(l.face_pressure[d], c, 0);
      for (int m = 0; m < 2; ++m)
        EXPECT_NEAR(saved(l.momentum_source, c, m, d), -dt() * share(c, m) * dp * area[d],
                    round_off * momentum);
    }
  });
}

TEST_P(LabelsOfAStep, VolumesFillTheCellsAsTheyMove) {
  const Labels& l = labels();
  double all = 0, size = 0;
  for_each_cell(run_->domain(), [&](IntVec3 c) {
    const double swells = saved(l.dilation, c, 0);
    const double flows =
        (saved(l.face_velocity[0], {c.x + 1, c.y, 0}, 0) - saved(l.face_velocity[0], c, 0)) * 24 +
        (saved(l.face_velocity[1], {c.x, c.y + 1, 0}, 0) - saved(l.face_velocity[1], c, 0)) * 20;
    EXPECT_NEAR(swells, dt() * flows, 1e-14);
    double filled = 0;
    for (int m = 0; m < 2; ++m) {
      const double V = saved(l.lagrangian_volume, c, m), M = saved(l.lagrangian_mass, c, m);
      EXPECT_NEAR(saved(l.volume_source, c, m) * M, V - share(c, m) * volume, 1e-15 * volume);
      filled += V;
    }
    EXPECT_NEAR(filled / volume, 1 + swells, 1e-14);
    all += swells;
    size = std::fmax(size, std::fabs(swells));
  });
  EXPECT_GT(size, 1e-5);
  EXPECT_LE(std::fabs(all), round_off * size * 480);
}

TEST_P(LabelsOfAStep, SharesOfAFaceAreAll) {
  const Labels& l = labels();
  if (GetParam().drag < one_velocity_coefficient) return;  // each passes with its own velocity
  for_each_cell(run_->domain(), [&](IntVec3 c) {
    for (int d = 0; d < 2; ++d) {
      const double a = saved(l.face_volume_fraction[d], c, 0);
      const double b = saved(l.face_volume_fraction[d], c, 1);
      EXPECT_NEAR(a + b, 1, 1e-12);
      EXPECT_GE(std::fmin(a, b), -1e-12);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Drag, LabelsOfAStep,
                         ::testing::Values(Case{one_velocity_coefficient, 0}, Case{1e4, 0},
                                           Case{0, 0}, Case{one_velocity_coefficient, 5},
                                           Case{1e4, 5}));

// u = a x: each volume grows by 1 + a dt, exactly; the gas cools along its isentrope.
TEST(StepLabels, UniformExpansion) {
  const double a = .3;
  const Labels& l = labels();
  for (const char* scheme : {"conservative", "classic"})
    for (const bool liquid : {false, true}) {
      if (liquid && scheme == std::string("classic")) continue;
      const auto cools = [&](double dt) {
        GasBox box = box_of({16, 1, 1}, false, &GasBox::walls);
        box.walls = false;
        box.scheme = scheme;
        const auto start = [&](Vec3 x) {
          MixtureCell c;
          c.volume = liquid ? std::vector{.4, .6} : std::vector{1.0};
          c.density = liquid ? std::vector{2.0, 1000.0} : std::vector{2.0};
          c.pressure = liquid ? std::vector{1e5, 1e5} : std::vector{1e5};
          c.velocity[0] = a * x.x;
          return c;
        };
        MixtureBox run(box, liquid ? std::vector{air, water} : std::vector{air}, start);
        run.save(all_labels_of_a_step());
        run.step(dt);
        const IntVec3 c{8, 0, 0};
        for (int m = 0; m < run.count(); ++m) {
          const double v = m == 0 ? 1 / 2. : 1e-3, limit = 1e-13 * v;
          EXPECT_NEAR(run.saved(l.lagrangian_volume, m, c) / run.saved(l.lagrangian_mass, m, c),
                      v * (1 + a * dt), limit);
          EXPECT_NEAR(run.saved(l.volume_source, m, c), v * a * dt, limit);
        }
        EXPECT_NEAR(run.saved(l.dilation, 0, c), a * dt, 1e-13);
        const double T = 1e5 / .4 / 2 / 717;
        return run.saved(l.lagrangian_heating, 0, c) / (T * (std::pow(1 + a * dt, -.4) - 1) / dt);
      };
      const double first = cools(1e-3) - 1, second = cools(5e-4) - 1;
      EXPECT_LT(std::fabs(first), 1e-3) << scheme << liquid;
      EXPECT_GT(std::fabs(first), 1.9 * std::fabs(second)) << scheme << liquid;
    }
}

// Two gases of one gamma at rest in a common pressure: each takes heat at that pressure, and the
// difference falls as exp(-k t), k of the specific heats at constant pressure; in one step of dt to
// first order in k dt.
TEST(StepLabels, TemperatureRateIsThatOfTheExchange) {
  const Fluid other = ideal_gas(1.4, 300);
  const double H = 1e4, V[] = {.3, .7}, rho[] = {2, 1}, cv[] = {717, 300}, p = 1e5;
  const auto error = [&](double dt) {
    Transport transport;
    transport.heat_exchange = H;
    MixtureBox run(
        box_of({4, 1, 1}, true, &GasBox::walls), {air, other},
        [&](Vec3) { return pair_at_rest(V[0], rho[0], rho[1], p); }, {}, {}, transport);
    run.save(all_labels_of_a_step());
    run.step(dt);
    double T[2], C[2], k = 0;
    for (int m = 0; m < 2; ++m) {
      T[m] = p / .4 / rho[m] / cv[m];
      C[m] = V[m] * rho[m] * 1.4 * cv[m];
      k += H * V[0] * V[1] / C[m];
    }
    const double passed = (T[1] - T[0]) * (1 - std::exp(-k * dt)) / (1 / C[0] + 1 / C[1]);
    double worst = 0;
    for (int m = 0; m < 2; ++m) {
      const double exact = (m == 0 ? passed : -passed) / C[m] / dt;
      worst = std::fmax(worst,
                        std::fabs(run.saved(labels().temperature_rate, m, {1, 0, 0}) / exact - 1));
      EXPECT_EQ(run.saved(labels().lagrangian_heating, m, {1, 0, 0}), 0);  // nothing moves
    }
    EXPECT_LT(worst, k * dt);
    return worst;
  };
  EXPECT_NEAR(error(1e-2) / error(5e-3), 2, .1);
}

TEST(StepLabels, VelocityRateIsThatOfTheDrag) {
  const double K = 1e3, M[] = {300, .7}, slip = 1e-3;
  MixtureBox run(
      box_of({8, 1, 1}, true, &GasBox::walls), {water, air},
      [&](Vec3) {
        MixtureCell c = pair_at_rest(.3, 1000, 1, 1e5);
        c.slip = {slip, 0};
        return c;
      },
      {}, {}, {}, K);
  run.save(all_labels_of_a_step());
  run.steps(1);
  const double decay = std::expm1(-K * .21 * (1 / M[0] + 1 / M[1]) * run.time());
  for (int m = 0; m < 2; ++m) {
    const double w = slip * (m == 0 ? M[1] : -M[0]) / (M[0] + M[1]);
    EXPECT_NEAR(run.saved(labels().velocity_rate, m, {3, 0, 0}) / (w * decay / run.time()), 1,
                1e-9);
  }
}

// A linear pressure; temperatures by mass.
TEST(StepLabels, OnFaces) {
  const Labels& l = labels();
  GasBox box = box_of({8, 1, 1}, false, &GasBox::walls);
  const auto density = [](double x) { return 1 + x; };
  MixtureBox run(box, {air}, [&](Vec3 x) {
    MixtureCell c;
    c.volume = {1};
    c.density = {density(x.x)};
    c.pressure = {1e5 + 1e4 * x.x};
    return c;
  });
  run.save(all_labels_of_a_step());
  run.step(1e-6);
  for (int i = 1; i < 8; ++i) {
    EXPECT_NEAR(run.saved(l.face_pressure_gradient[0], 0, {i, 0, 0}), 1e4, 1e-6);
    // rho T of both cells is p/R; of the sum by the sum of the masses.
    const double x = i / 8., mean = (1e5 + 1e4 * x) / (.4 * 717) / density(x);
    EXPECT_NEAR(run.saved(l.face_temperature[0], 0, {i, 0, 0}), mean, 1e-12 * mean);
    EXPECT_EQ(run.saved(l.face_volume_fraction[0], 0, {i, 0, 0}), 1);
  }
  // Beyond a wall lies its mirror image.
  EXPECT_EQ(run.saved(l.face_pressure_gradient[0], 0, {0, 0, 0}), 0);
  EXPECT_EQ(run.saved(l.face_pressure_gradient[1], 0, {3, 0, 0}), 0);
}

// Functions of a state: amounts add up to those of the whole, shares of the compressibility to one,
// and that of the cell is the sum of V/(gamma (p + pi)).
TEST(StepLabels, AmountsAndCompressibilityOfAState) {
  const Labels& l = labels();
  MixtureBox run(box_of({24, 20, 1}, true, &GasBox::walls), {water, air}, stirred);
  run.steps(2);
  run.solver().fill_ghosts(run.time());
  run.solver().compute_diagnostics(run.time(),
                                   {l.energy_of_cell, l.volume_of_cell, l.compressibility_of_cell,
                                    l.compressibility_share, l.pressure});
  const double volume = 1. / (24 * 20);
  double energy = 0;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    const double p = run.saved(l.pressure, 0, c);
    const double wet = run.volume(0, c), dry = run.volume(1, c);
    const double sum = wet / (4.4 * (p + 6e8)) + dry / (1.4 * p);
    EXPECT_NEAR(run.saved(l.compressibility_of_cell, 0, c) / sum, 1, 1e-12);
    EXPECT_NEAR(run.saved(l.compressibility_share, 1, c), dry / (1.4 * p) / sum, 1e-12);
    EXPECT_NEAR(run.saved(l.compressibility_share, 0, c) + run.saved(l.compressibility_share, 1, c),
                1, 1e-14);
    EXPECT_NEAR((run.saved(l.volume_of_cell, 0, c) + run.saved(l.volume_of_cell, 1, c)) / volume, 1,
                1e-14);
    energy += run.saved(l.energy_of_cell, 0, c) + run.saved(l.energy_of_cell, 1, c);
  });
  EXPECT_NEAR(energy / run.totals().internal_energy.sum.value(), 1, round_off);
}

// What nobody saves is not computed.
TEST(StepLabels, CostNothingUnsaved) {
  for (const double drag : {one_velocity_coefficient, 1e4}) {
    const auto tasks = [&](std::vector<Label> saved) {
      MixtureBox run(box_of({24, 20, 1}, true, &GasBox::walls), {water, air}, stirred, {}, {}, {},
                     drag);
      run.save(std::move(saved));
      run.steps(1);
      return std::pair{run.solver().graphs().effect_tasks()[effect_saved_intermediates],
                       run.solver().graphs().effect_doubles()[effect_saved_intermediates]};
    };
    EXPECT_EQ(tasks({}), (std::pair{0, 0.0}));
  }
}

}  // namespace
}  // namespace sluice::ice::step_labels_test

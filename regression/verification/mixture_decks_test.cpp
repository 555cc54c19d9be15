// Own decks of several materials: everything at once in a closed box, exchange alone, fragments,
// a cavity, and two equations of state that move together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/exchange.hpp"
#include "verification/amr_case.hpp"

namespace sluice::verification::mixture_decks_test {
namespace {

using ice::mixture::exchanged;
using ice::mixture::farthest;
using ice::mixture::Matrix;
using ice::mixture::Numbers;

constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps

std::string momentum(const std::string& coefficients) {
  return "MaterialProperties/exchange_properties/exchange_coefficients/momentum=[" + coefficients +
         "]";
}

void expect_conserved(const CaseRun& run, double allowed) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  EXPECT_LE(drift, allowed);
  EXPECT_EQ(run.events(), 0) << run.record().at("events").dump();
}

// Shocks, friction, conduction, exchange of heat and momentum together: mass of each material,
// momentum with the walls' impulse counted, total energy.
class ClosedBox : public testing::TestWithParam<const char*> {};

TEST_P(ClosedBox, KeepsMassesMomentumAndEnergy) {
  const CaseRun run("closed_box", {momentum(GetParam())});
  EXPECT_GE(run.steps(), 1000);
  EXPECT_EQ(run.record().at("conservation").size(), 7u);
  expect_conserved(run, allowed_drift);
}

INSTANTIATE_TEST_SUITE_P(Drag, ClosedBox, testing::Values("1e6,1e3,100"));
INSTANTIATE_TEST_SUITE_P(Full, ClosedBox, testing::Values("0,0,0", "1e15,1e15,1e15"));

// The materials that a deck of exchange alone spreads over all cells.
struct Exchange {
  Numbers masses, volumes, velocities;  // per volume of the cell; as the deck starts
};

Exchange start_of(const CaseRun& run, int materials) {
  Exchange e;
  for (int m = 0; m < materials; ++m) {
    e.masses.push_back(run.field("rho_CC", 0, "first", m).at(0));
    e.volumes.push_back(run.field("vol_frac_CC", 0, "first", m).at(0));
    e.velocities.push_back(run.field("vel_CC", 0, "first", m).at(0));
  }
  return e;
}

// `K`: of each pair, as the deck orders them.
Numbers exact_velocities(const Exchange& e, const Numbers& K, double time) {
  const std::size_t n = e.masses.size();
  Matrix rates(n, Numbers(n, 0.0));
  std::size_t pair = 0;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b, ++pair)
      rates[a][b] = rates[b][a] = time * K[pair] * e.volumes[a] * e.volumes[b];
  return exchanged(e.masses, rates, e.velocities);
}

Numbers velocities(const CaseRun& run, int materials) {
  Numbers u;
  for (int m = 0; m < materials; ++m) {
    const CellValues field = run.field("vel_CC", 0, "last", m);
    u.push_back(field.at(0));
    EXPECT_EQ(lowest(field), highest(field)) << "of material " << m;
  }
  return u;
}

std::string text_of(const Numbers& K) {
  std::string text;
  for (const double k : K) text += (text.empty() ? "" : ",") + std::to_string(k);
  return text;
}

constexpr double fastest = .03;  // of the decks, m/s

TEST(ExchangeAlone, OfTwoIsTheExponential) {
  for (const double K : {0., 1e-3, 10., 1e3}) {
    const CaseRun run("exchange_of_two", {momentum(text_of({K}))});
    const Exchange start = start_of(run, 2);
    const double error = farthest(velocities(run, 2), exact_velocities(start, {K}, .5)) / fastest;
    record("error_" + std::to_string(K), error);
    EXPECT_LE(error, 1e-9) << K;  // drag heats: shares of the cell change by that
    expect_conserved(run, 1e-15);
  }
}

const Numbers of_five = {1, 20, 3, 40, 5, 10, 30, 2, 8, 15};

TEST(ExchangeAlone, OfFiveIsOfSecondOrder) {
  const auto error = [&](const char* step) {
    const CaseRun run("exchange_of_five", {std::string("Time/delt_max=") + step});
    expect_conserved(run, 1e-15);
    return farthest(velocities(run, 5), exact_velocities(start_of(run, 5), of_five, .5)) / fastest;
  };
  const double coarse = error("0.0125"), fine = error("0.00625");
  const double order = std::log2(coarse / fine);
  record("error", coarse);
  record("order", order);
  EXPECT_LE(coarse, 1e-3);
  EXPECT_GE(order, 1.9);
}

TEST(ExchangeAlone, OfFiveIsExactInBothLimits) {
  for (const char* K : {"0", "1e20"}) {
    std::string all = K;
    for (int pair = 1; pair < 10; ++pair) all += std::string(",") + K;
    const CaseRun run("exchange_of_five", {momentum(all), "Time/max_Timesteps=1"});
    const Exchange start = start_of(run, 5);
    double mean = 0, mass = 0;
    for (std::size_t m = 0; m < 5; ++m) {
      mean += start.masses[m] * start.velocities[m];
      mass += start.masses[m];
    }
    const Numbers bound(5, mean / mass);
    const bool free = std::string(K) == "0";
    EXPECT_LE(farthest(velocities(run, 5), free ? start.velocities : bound), 1e-13 * fastest) << K;
    expect_conserved(run, 1e-15);
  }
}

TEST(Fragments, AreKeptAndStayTogether) {
  const CaseRun run("fragments");
  for (const char* material : {"mass of material 0", "mass of material 1"}) {
    const double drift = run.record().at("conservation").at(material).at("drift").get<double>();
    record(material, drift);
    EXPECT_LE(std::fabs(drift), 1e-15);
  }
  expect_conserved(run, allowed_drift);
  // They filled 20 cells; the support may be wider by 6 on each side.
  const CellValues mass = run.field("rho_CC");
  const auto filled =
      std::count_if(mass.values.begin(), mass.values.end(), [](double v) { return v != 0; });
  record("cells", static_cast<double>(filled));
  EXPECT_LE(filled, 20 + 2 * 6);
}

// By one shock, from 1e5 Pa and 300 K.
double temperature_of_shocked_air(double pressure) {
  const double r = pressure / 1e5, jump = 2.4 / .4;
  return 300 * r * (jump + r) / (1 + jump * r);
}

// The air that the water has in it, as a share of the volume.
class Cavity : public testing::TestWithParam<double> {};

TEST_P(Cavity, OpensAndCollapses) {
  constexpr int outputs = 50;
  std::vector<std::string> overrides = {"DataArchiver/outputInterval=1e-4"};
  for (const int m : {1, 2})
    for (const int object : {1, 2})
      overrides.push_back(
          fmt::format("MaterialProperties/ICE/material[{}]/geom_object[{}]/volumeFraction={:.17g}",
                      m, object, m == 1 ? 1 - GetParam() : GetParam()));
  const CaseRun run("cavitation", overrides);
  const double drift =
      std::fabs(run.record().at("conservation").at("total energy").at("drift").get<double>());
  record("energy", drift);
  EXPECT_LE(drift, 1e-14);
  double widest = 0, narrowest = 1;   // the widest of the air's cells in each output
  double hottest = 0, coldest = 1e9;  // where there is any of a material
  for (int n = 0; n <= outputs; ++n) {
    const std::string which = "#" + std::to_string(n);
    const double share = highest(run.field("vol_frac_CC", 0, which, 1));
    if (share > widest) narrowest = share;
    widest = std::fmax(widest, share);
    narrowest = std::fmin(narrowest, share);
    for (const int m : {0, 1}) {
      const CellValues T = run.field("temp_CC", 0, which, m);
      const CellValues mass = run.field("rho_CC", 0, which, m);
      for (std::size_t i = 0; i < T.values.size(); ++i) {
        if (mass.values[i] == 0) continue;
        ASSERT_TRUE(std::isfinite(T.values[i])) << which;
        hottest = std::fmax(hottest, T.values[i]);
        coldest = std::fmin(coldest, T.values[i]);
      }
    }
  }
  record("widest", widest);
  record("narrowest_after", narrowest);
  record("hottest", hottest);
  record("coldest", coldest);
  EXPECT_GT(widest, .01);
  EXPECT_LT(narrowest, 1e-3);
  // Where both halves stop, the pressure is that of a water hammer, rho c u.
  const double hammer = 1e5 + 1000 * std::sqrt(4.4 * 6.001e8 / 1000) * 20;
  EXPECT_LE(hottest, temperature_of_shocked_air(hammer));
  EXPECT_GT(coldest, 1);
  EXPECT_EQ(run.events(), 0);
}

INSTANTIATE_TEST_SUITE_P(AirOf, Cavity, testing::Values(1e-6, 1e-30));
INSTANTIATE_TEST_SUITE_P(Full, Cavity, testing::Values(1e-4, 1e-9, 1e-12, 1e-20));

TEST(MovingTogether, CopperAndSeaWaterStayInEquilibrium) {
  constexpr double allowed = 1e-10;  // relative
  const CaseRun run("copper_in_sea_water");
  const double p = farthest_from(run.field("press_CC"), 1e7) / 1e7;
  record("pressure", p);
  EXPECT_LE(p, allowed);
  for (int m = 0; m < 2; ++m) {
    const CellValues mass = run.field("rho_CC", 0, "last", m);
    const CellValues u = run.field("vel_CC", 0, "last", m), T = run.field("temp_CC", 0, "last", m);
    double worst = 0;
    for (std::size_t i = 0; i < mass.values.size(); ++i)
      if (mass.values[i] > 0)
        worst = std::fmax(
            worst, std::fmax(std::fabs(u.values[i] / 100 - 1), std::fabs(T.values[i] / 300 - 1)));
    record("velocity_and_temperature_" + std::to_string(m), worst);
    EXPECT_LE(worst, allowed) << m;
  }
  expect_conserved(run, allowed_drift);
}

}  // namespace
}  // namespace sluice::verification::mixture_decks_test

// Rarefied gas between plates: slip at both, against profiles of Couette and channel flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/case_run.hpp"

namespace sluice::verification::slip_flow_test {
namespace {

constexpr double couette_error = 3e-6;     // of the plate; measured 1.4e-6: friction heats the gas
constexpr double lowest_order = 1.9;       // measured 2.0 for every model
constexpr double channel_error = 0.01;     // of the largest velocity, 16 cells
constexpr double conduction_limit = 1e-8;  // K of 1 K; measured 5e-10
constexpr double allowed_drift = 1e-12;    // of the energy; measured 1e-13

constexpr double viscosity = 0.1, accommodation = 0.8;
constexpr double reflection = (2 - accommodation) / accommodation;

// Where the run ended: friction has warmed the gas a little.
double free_path(const CaseRun& run) {
  const double rho = run.field("rho_CC").at(0), p = run.field("press_CC").at(0);
  return viscosity / (rho * std::sqrt(2 * (p / rho) / std::numbers::pi));
}

TEST(SlipFlow, CouetteProfileMeetsNeitherPlate) {
  const CaseRun run("slip_couette");
  const CellValues u = run.field("vel_CC", 0);
  const double L = reflection * free_path(run), plate = 0.01;
  EXPECT_NEAR(L, 0.188, 0.001);
  double worst = 0;
  for (int j = 0; j < u.size.y; ++j)
    worst = std::max(worst, std::fabs(u.at(0, j) / plate - (u.centre(0, j).y + L) / (1 + 2 * L)));
  record("Couette flow with slip: largest error", worst);
  EXPECT_LE(worst, couette_error);
  const auto energy = run.record().at("conservation").at("total energy");
  EXPECT_LE(std::fabs(energy.at("drift").get<double>()), allowed_drift);
}

// Largest error of the final profile, as a share of its largest velocity. C: of lambda^2 u''.
double channel_profile_error(const std::string& model, double C, int n) {
  const CaseRun run("slip_channel", {resolution(4, n),
                                     "Grid/BoundaryConditions/microSlip/SlipModel/@type=" + model});
  const CellValues u = run.field("vel_CC", 0);
  const double lambda = free_path(run), scale = 1e-4 / (2 * viscosity);
  const double slip = reflection * lambda + 2 * C * lambda * lambda;
  double worst = 0;
  for (int j = 0; j < n; ++j) {
    const double y = u.centre(0, j).y;
    worst = std::max(worst, std::fabs(u.at(0, j) / scale - (y * (1 - y) + slip)));
  }
  return worst / (0.25 + slip);
}

void expect_second_order(const std::string& model, double C) {
  const double coarse = channel_profile_error(model, C, 8);
  const double fine = channel_profile_error(model, C, 16);
  record(model + ": order", std::log2(coarse / fine));
  EXPECT_GE(std::log2(coarse / fine), lowest_order) << coarse << " " << fine;
  EXPECT_LE(fine, channel_error);
}

TEST(SlipFlow, ChannelProfileOfMaxwell) {
  expect_second_order("FirstOrder", 0);
}

TEST(SlipFlow, ChannelProfileOfDeissler) {
  expect_second_order("SecondOrder_Deissler", 9.0 / 8);
}

TEST(SlipFlow, ChannelProfileOfKarniadakisAndBeskok) {
  expect_second_order("SecondOrder_Karniadakis-Beskok", -0.5 * reflection);
}

// Gas of slip_heat.ups: c_v = 1, gamma = 1.4.
constexpr double conductivity = 0.14, thermal_reflection = (2 - 0.9) / 0.9;
constexpr double jump_per_path = thermal_reflection * 2 * conductivity / (2.4 * viscosity);

// At the temperature of the gas there and the pressure at which the run ended.
double free_path_at(double T, const CaseRun& run) {
  return viscosity * std::sqrt(0.5 * std::numbers::pi * 0.4 * T) / run.field("press_CC").at(0);
}

// Largest error of the final temperatures, as a share of their rise by friction. D: of
// lambda^2 T''.
double friction_error(const std::string& model, double D, int n) {
  const CaseRun run("slip_heat", {resolution(1, n),
                                  "Grid/BoundaryConditions/microSlip/SlipModel/@type=" + model});
  const CellValues T = run.field("temp_CC");
  double T_s = 2.5, shear = 0;
  for (int pass = 0; pass < 30; ++pass) {
    const double lambda = free_path_at(T_s, run);
    shear = 0.3 / (1 + 2 * reflection * lambda);
    T_s = 2.5 + (0.5 * jump_per_path * lambda + D * lambda * lambda) * viscosity * shear * shear /
                    conductivity;
  }
  const double rise = viscosity * shear * shear / (2 * conductivity);
  double worst = 0;
  for (int j = 0; j < n; ++j) {
    const double y = T.centre(0, j).y;
    worst = std::max(worst, std::fabs(T.at(0, j) - (T_s + rise * y * (1 - y))));
  }
  return worst / (T_s + 0.25 * rise - 2.5);
}

void expect_heat_of_second_order(const std::string& model, double D) {
  const double coarse = friction_error(model, D, 8), fine = friction_error(model, D, 16);
  record(model + ": order of heat", std::log2(coarse / fine));
  EXPECT_GE(std::log2(coarse / fine), lowest_order) << coarse << " " << fine;
  EXPECT_LE(fine, channel_error);
}

TEST(SlipFlow, HeatOfFrictionLeavesThroughAJump) {
  expect_heat_of_second_order("FirstOrder", 0);
  expect_heat_of_second_order("SecondOrder_Deissler", 9.0 / 128 * (177 * 1.4 - 145) / 2.4);
  expect_heat_of_second_order("SecondOrder_Karniadakis-Beskok", -0.5 * jump_per_path);
}

// Plates at 2 and 3 K: straight, with a jump at each as long as its own mean free path.
double conduction_error(int n) {
  const CaseRun run("slip_heat",
                    {resolution(1, n), "Grid/BoundaryConditions/Face[1]/BCType[3]/value=2",
                     "Grid/BoundaryConditions/Face[2]/BCType[3]/value=3",
                     "Grid/BoundaryConditions/Face[2]/BCType[4]/value=[0,0,0]"});
  const CellValues T = run.field("temp_CC");
  double slope = 1, low = 2, high = 3;
  for (int pass = 0; pass < 60; ++pass) {
    const double B0 = jump_per_path * free_path_at(low, run);
    const double B1 = jump_per_path * free_path_at(high, run);
    slope = 1 / (1 + B0 + B1);
    low = 2 + B0 * slope;
    high = 3 - B1 * slope;
  }
  double worst = 0;
  for (int j = 0; j < n; ++j)
    worst = std::max(worst, std::fabs(T.at(0, j) - (low + slope * T.centre(0, j).y)));
  return worst;
}

TEST(SlipFlow, ConductionBetweenPlatesJumpsAtBoth) {
  const double error = conduction_error(8);  // a straight line is exact on any grid
  record("conduction with jumps: largest error", error);
  EXPECT_LE(error, conduction_limit);
}

}  // namespace
}  // namespace sluice::verification::slip_flow_test

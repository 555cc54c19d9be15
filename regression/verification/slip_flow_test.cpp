// Rarefied gas between plates: slip at both, against profiles of Couette and channel flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/case_run.hpp"

namespace sluice::verification {
namespace {

constexpr double couette_error = 3e-6;   // of the plate; measured 1.4e-6: friction heats the gas
constexpr double lowest_order = 1.9;     // measured 2.0 for every model
constexpr double channel_error = 0.01;   // of the largest velocity, 16 cells
constexpr double allowed_drift = 1e-12;  // of the energy; measured 1e-13

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

}  // namespace
}  // namespace sluice::verification

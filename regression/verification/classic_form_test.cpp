// The classic ICE form against the errors that Uintah's own run of the same tube shows: 250 cells,
// 820 equal steps, mean errors against the exact solution at the centres of cells.
#include <gtest/gtest.h>

#include "verification/case_run.hpp"

namespace sluice::verification::classic_form_test {
namespace {

constexpr double allowed_share = .05;
// Measured here: 5.444e-3, 3.262, 455.9.
constexpr double density_error = 5.445e-3, velocity_error = 3.267, pressure_error = 454.7;

TEST(ClassicForm, HasTheErrorsOfTheOriginal) {
  const CaseRun run("shock_tube_classic");
  EXPECT_EQ(run.steps(), 820);
  EXPECT_NEAR(run.error_at_centres("rho_CC").l1, density_error, allowed_share * density_error);
  EXPECT_NEAR(run.error_at_centres("vel_CC").l1, velocity_error, allowed_share * velocity_error);
  EXPECT_NEAR(run.error_at_centres("press_CC").l1, pressure_error, allowed_share * pressure_error);
}

}  // namespace
}  // namespace sluice::verification::classic_form_test

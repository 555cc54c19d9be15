// Momentum that passes the surfaces of solids by a coefficient, against lumps.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::drag_through_surfaces_test {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A plate between two walls with one cell of gas on either side, along which it slides.
struct Plate {
  double place = 0;  // of its faces beyond planes of the grid, cells
  double speed = 0, K = 1e4;
  std::vector<std::string> further;

  static constexpr double dx = 0.01, rho_s = 10;
  static constexpr double rho = 1e5 / (287 * 300);

  CoupledRun run(double time) const {
    CoupledDeck deck;
    deck.cells = "[3,4,1]";
    deck.upper = "[0.03,0.04,0.01]";
    deck.periodic = "[0,1,0]";
    deck.time = fmt::format("{}", time);
    deck.density = fmt::format("{}", rho_s);
    deck.solid =
        solid_object(fmt::format("<box><min>[{:.17g},-1,-1]</min><max>[{:.17g},2,2]</max></box>",
                                 (1 + place) * dx, (2 + place) * dx),
                     fmt::format("[0,{},0]", speed));
    deck.drag = fmt::format("{}", K);
    return CoupledRun(deck, further);
  }
};

// u - u_s = e^(-eta t (1/(rho dx) + 2/(rho_s dx))), eta = K dx/4 on both faces.
TEST(DragThroughSurfaces, OfACoefficientIsThatOfACellCutInHalves) {
  Plate plate;
  plate.speed = 5;
  // A plate in planes of the grid flutters in the end (docs/theory/mpmice_coupling.md).
  const double time = 2e-4, eta = plate.K * Plate::dx / 4;
  const CoupledRun run = plate.run(time);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  const double rate = eta / Plate::dx * (1 / Plate::rho + 2 / Plate::rho_s);
  const double w = mean(run.particles("p.velocity")[1]) - run.field("vel_CC", 1).components[1][0];
  EXPECT_NEAR(w / (5 * std::exp(-rate * time)), 1, 0.02);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

// Gas that is driven by f per volume runs ahead of the plate by
//   w = f/rho/(eta (1/(rho dx) + 2/(rho_s dx)))
// where its faces lie on the grid; alike (within what the gas of either side holds) elsewhere.
TEST(DragThroughSurfaces, APlateFallsBehindByTheTerminalVelocity) {
  constexpr double f = 50;
  for (const double place : {0.0, 1e-7, 0.3}) {
    Plate plate;
    plate.place = place;
    plate.K = 5e4;
    plate.further = {"CFD/ICE/fixedPressureGradient/x_dir=0",
                     fmt::format("CFD/ICE/fixedPressureGradient/y_dir={}", f),
                     "CFD/ICE/fixedPressureGradient/z_dir=0"};
    const CoupledRun run = plate.run(7e-4);  // nine times the time in which it is reached
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    // Of either side of thickness L_k: u_k' = f/rho - eta (u_k - u_s)/(rho L_k), all of one
    // acceleration f (L_1 + L_2)/(rho (L_1 + L_2) + rho_s L) in the end.
    const double eta = plate.K * Plate::dx / 4, L = Plate::dx;
    const double a = f * 2 * L / (Plate::rho * 2 * L + Plate::rho_s * L);
    const double us = mean(run.particles("p.velocity")[1]);
    const auto u = run.field("vel_CC", 1).components[1];
    const double left = (1 + place) * L * (f - Plate::rho * a) / eta,
                 right = (1 - place) * L * (f - Plate::rho * a) / eta;
    EXPECT_NEAR((u[0] - us) / left, 1, 0.02) << place;
    EXPECT_NEAR((u[2] - us) / right, 1, 0.02) << place;
  }
}

// Without end: one motion.
TEST(DragThroughSurfaces, OfAnyCoefficientPassesNoVelocity) {
  for (const double K : {1e8, 1e15, 1e20})
    for (const double place : {0.0, 0.3, 1 - 1e-7}) {
      Plate plate;
      plate.place = place;
      plate.speed = 5;
      plate.K = K;
      const CoupledRun run = plate.run(2e-4);
      ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
      EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
      for (const double u : run.field("vel_CC", 1).components[1]) {
        EXPECT_GE(u, -1e-9) << K << " " << place;
        EXPECT_LE(u, 5 * (1 + 1e-12)) << K << " " << place;
      }
    }
}

}  // namespace
}  // namespace sluice::mpmice::drag_through_surfaces_test

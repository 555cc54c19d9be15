// Contact of solids in whole runs: friction, rolling, rebound, rigid masters, momentum, images.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::solids_contact {
namespace {

namespace fs = std::filesystem;

std::string deck(const std::string& name) {
  return std::string(SLUICE_SOURCE_DIR) + "/inputs/mpm/" + name + ".ups";
}

// Rows of a history of vectors: time and three components, as numbers or as written.
std::vector<std::array<double, 4>> history(const CaseRun& run, const std::string& label) {
  std::ifstream in(run.archive() / (label + ".dat"));
  std::vector<std::array<double, 4>> rows;
  for (std::array<double, 4> r{}; in >> r[0] >> r[1] >> r[2] >> r[3];) rows.push_back(r);
  if (rows.empty()) throw std::runtime_error("no history of " + label);
  return rows;
}

double velocity_at(const std::vector<std::array<double, 4>>& momentum, double mass, double time) {
  for (std::size_t n = 1; n < momentum.size(); ++n)
    if (momentum[n][0] >= time) {
      const auto &a = momentum[n - 1], &b = momentum[n];
      return (a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0])) / mass;
    }
  return momentum.back()[1] / mass;
}

double mass_of(const CaseRun& run, int material) {
  return run.record()
      .at("conservation")
      .at("mass of material " + std::to_string(material))
      .at("now")
      .get<double>();
}

double momentum_drift(const CaseRun& run) {
  double worst = 0;
  for (const char* d : {"x", "y", "z"})
    worst = std::max(worst, std::fabs(run.record()
                                          .at("conservation")
                                          .at(std::string("momentum ") + d)
                                          .at("drift")
                                          .get<double>()));
  return worst;
}

TEST(SolidsContact, BlockOnAFloorDeceleratesByMuG) {
  const CaseRun run(deck("sliding_block"));
  const auto p = history(run, "TotalMomentum");
  const double mass = mass_of(run, 0);
  const double deceleration = (1 - velocity_at(p, mass, 0.25)) / 0.25;
  record("deceleration", deceleration);
  EXPECT_NEAR(deceleration, 3, 0.03 * 3);
  EXPECT_NEAR(velocity_at(p, mass, 0.4), 0, 0.05);  // at rest from 1/3 s on
  EXPECT_LE(momentum_drift(run), 1e-13);
}

TEST(SolidsContact, DiskSlipsDownAnIncline) {
  const CaseRun run(deck("disk_slips"));
  const double a = velocity_at(history(run, "TotalMomentum"), mass_of(run, 0), 0.4) / 0.4;
  const double wanted = 5 - 0.1 * 8.660254;
  record("acceleration", a);
  EXPECT_NEAR(a, wanted, 0.03 * wanted);
}

TEST(SolidsContact, DiskRollsDownAnIncline) {
  const CaseRun run(deck("disk_rolls"));
  const double a = velocity_at(history(run, "TotalMomentum"), mass_of(run, 0), 0.4) / 0.4;
  const double wanted = 2.0 / 3 * 5;
  record("acceleration", a);
  EXPECT_NEAR(a, wanted, 0.03 * wanted);
}

TEST(SolidsContact, BarComesBackFromARigidWall) {
  const CaseRun run(deck("bouncing_bar"));
  const auto p = history(run, "TotalMomentum");
  const double back = -p.back()[1] / 24;
  record("speed after over before", back);
  EXPECT_GE(back, 0.8);
  EXPECT_LE(back, 1);
  EXPECT_LE(momentum_drift(run), 1e-13);
}

TEST(SolidsContact, RigidPistonMovesABarWithTheForceThatItFeels) {
  const CaseRun run(deck("rigid_piston"));
  const auto p = history(run, "TotalMomentum");
  const auto force = history(run, "RigidReactionForce");
  // Momentum of the bar: all but that of the piston, which moves at 1 m/s. Forces are impulses
  // over the time from the middle of the step before.
  double impulse = 0, before = 0, dt_before = 0;
  for (const auto& f : force) {
    const double dt = f[0] - before;
    impulse += 0.5 * (dt + dt_before) * f[1];
    before = f[0];
    dt_before = dt;
  }
  const double bar = p.back()[1] - mass_of(run, 0);
  EXPECT_NEAR(bar, -impulse, 1e-9 * bar);
  EXPECT_NEAR(bar / mass_of(run, 1), 1, 0.05);
  EXPECT_LE(momentum_drift(run), 1e-12);
}

TEST(SolidsContact, ThreeDisksKeepTheirMomentumAndFollowTheirMirrorImage) {
  const CaseRun run(deck("three_disks"));
  record("momentum drift", momentum_drift(run));
  EXPECT_LE(momentum_drift(run), 1e-13);
  std::ifstream in(deck("three_disks"));
  std::stringstream text;
  text << in.rdbuf();
  std::string mirrored = text.str();
  const auto swap = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = mirrored.find(from, at)) != std::string::npos; at += to.size())
      mirrored.replace(at, from.size(), to);
  };
  swap("[-0.45,", "[#,");
  swap("[0.45,", "[-0.45,");
  swap("[#,", "[0.45,");
  swap("[1,0.3,0]", "[#1,0.3,0]");
  swap("[-1,0.1,0]", "[1,0.1,0]");
  swap("[#1,0.3,0]", "[-1,0.3,0]");
  swap("[0.2,-1.5,0]", "[-0.2,-1.5,0]");
  const TemporaryFolder folder;
  const fs::path image = folder.path() / "image.ups";
  std::ofstream(image) << mirrored;
  const CaseRun other(image.string());
  const auto p = history(run, "TotalMomentum"), q = history(other, "TotalMomentum");
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t n = 0; n < p.size(); ++n) {
    // To round-off alone: contact still sums in an order that a mirror image changes.
    ASSERT_NEAR(p[n][0], q[n][0], 1e-13);
    ASSERT_NEAR(p[n][1], -q[n][1], 1e-11);
    ASSERT_NEAR(p[n][2], q[n][2], 1e-11);
  }
}

TEST(SolidsContact, BitsDoNotDependOnRanksAndBoxes) {
  const CaseRun one(deck("three_disks"));
  const CaseRun two(deck("three_disks"), {"Grid/Level/Box/patches=[2,2,1]"}, {}, 2);
  EXPECT_EQ(history(one, "TotalMomentum"), history(two, "TotalMomentum"));
}

}  // namespace
}  // namespace sluice::verification::solids_contact

// Mirrored decks give mirrored bits; permuted axes equal bits in 1-D and 2-D, 1e-12 in 3-D.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"
#include "properties/skew_deck.hpp"

namespace sluice::properties {
namespace {

constexpr double allowed_in_3d = 1e-12;  // of the largest value of the field
constexpr int run_steps = 24;

// Density, temperature and velocity of every cell, in the axes of the case.
struct Flow {
  std::vector<double> density, temperature;
  std::vector<Vec3> velocity;
};

Flow flow_of(const SkewCase& c, const Orientation& o) {
  ScratchFolder scratch;
  const Deck deck = load_deck_text(skew_deck(c, o, run_steps), c.name, {}, sluice_schema());
  const RunReport report = carry_out(deck, scratch / "run");
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, run_steps);
  EXPECT_EQ(report.events_json, "{}");
  const Archive archive = Archive::open(report.archive.value());
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  const DenseField rho = step.read(*step.find("rho_CC", 0, 0));
  const DenseField T = step.read(*step.find("temp_CC", 0, 0));
  const DenseField u = step.read(*step.find("vel_CC", 0, 0));
  Flow flow;
  for_each_cell({{0, 0, 0}, c.cells}, [&](IntVec3 cell) {
    const IntVec3 there = o.turn_cell(cell, c.cells);
    flow.density.push_back(rho.at(there));
    flow.temperature.push_back(T.at(there));
    Vec3 v;
    for (int d = 0; d < 3; ++d) {
      const auto n = static_cast<std::size_t>(d);
      v[o.shows[n]] = o.mirrored[n] ? -u.at(there, d) : u.at(there, d);
    }
    flow.velocity.push_back(v);
  });
  return flow;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::fabs(v));
  return most;
}

// Where they differ by more than `allowed` of the largest value; "" when nowhere.
std::string difference(const Flow& a, const Flow& b, double allowed) {
  std::vector<std::pair<std::vector<double>, std::vector<double>>> fields = {
      {a.density, b.density}, {a.temperature, b.temperature}};
  for (int d = 0; d < 3; ++d) {
    auto& [u, v] = fields.emplace_back();
    for (std::size_t n = 0; n < a.velocity.size(); ++n) {
      u.push_back(a.velocity[n][d]);
      v.push_back(b.velocity[n][d]);
    }
  }
  const char* names[] = {"density", "temperature", "velocity 0", "velocity 1", "velocity 2"};
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const auto& [p, q] = fields[f];
    const double bound = allowed * largest(p);
    std::size_t count = 0;
    double worst = 0;
    for (std::size_t n = 0; n < p.size(); ++n) {
      if (std::fabs(p[n] - q[n]) <= bound) continue;
      ++count;
      worst = std::max(worst, std::fabs(p[n] - q[n]));
    }
    if (count > 0)
      return std::string(names[f]) + " differs in " + std::to_string(count) + " cells, by up to " +
             std::to_string(worst / std::max(largest(p), 1e-300) * 1e15) + " 1e-15 of the largest";
  }
  return {};
}

class Symmetry : public testing::TestWithParam<SkewCase> {
 protected:
  // Gravity keeps a direction of one cell active.
  // Gravity makes a dimension of a direction with one cell.
  static int dimensions(const SkewCase& c) {
    int count = 0;
    for (int d = 0; d < 3; ++d) count += c.cells[d] > 1 || c.gravity[d] != 0;
    return count;
  }
  // The flow is not trivial: everything moves.
  static void expect_flow(const Flow& flow) {
    const auto [low, high] = std::minmax_element(flow.density.begin(), flow.density.end());
    EXPECT_GT(*low, 0);
    EXPECT_GT(*high, 1.5 * *low);
  }
};

TEST_P(Symmetry, MirroredDecksGiveMirroredBits) {
  const SkewCase& c = GetParam();
  const Flow plain = flow_of(c, {});
  expect_flow(plain);
  for (int d = 0; d < 3; ++d) {
    if (c.cells[d] == 1 && !c.cross_flow) continue;
    Orientation o;
    o.mirrored[static_cast<std::size_t>(d)] = true;
    EXPECT_EQ(difference(plain, flow_of(c, o), 0), "") << "mirrored along axis " << d;
  }
  EXPECT_EQ(difference(plain, flow_of(c, {{0, 1, 2}, {true, true, true}}), 0), "") << "all three";
}

TEST_P(Symmetry, PermutedAxesGiveTheSameFlow) {
  const SkewCase& c = GetParam();
  const double allowed = dimensions(c) == 3 ? allowed_in_3d : 0;
  const Flow plain = flow_of(c, {});
  for (const std::array<int, 3> shows :
       {std::array{1, 0, 2}, std::array{0, 2, 1}, std::array{2, 1, 0}, std::array{1, 2, 0},
        std::array{2, 0, 1}})
    EXPECT_EQ(difference(plain, flow_of(c, {shows, {}}), allowed), "")
        << "axes " << shows[0] << shows[1] << shows[2];
}

// Gravity acts along directions of one cell only: a hydrostatic start has its pressure in cell
// (0,0,0), which a mirror moves to the other end.
using enum SideKind;
const SkewCase cases[] = {
    {"tube", {64, 1, 1}, {wall, open, symmetry, symmetry, symmetry, symmetry}},
    {"tube_first_order",
     {64, 1, 1},
     {inflow, wall, symmetry, symmetry, symmetry, symmetry},
     {},
     0,
     false},
    {"tube_cross_flow",
     {64, 1, 1},
     {open, wall, periodic, periodic, periodic, periodic},
     {0, 0.01, -0.02},
     0.01,
     true,
     true},
    {"square", {32, 32, 1}, {wall, open, inflow, symmetry, symmetry, symmetry}},
    {"square_first_order",
     {32, 32, 1},
     {wall, open, periodic, periodic, symmetry, symmetry},
     {},
     0,
     false},
    {"square_viscous",
     {32, 32, 1},
     {moving_wall, wall, open, inflow, symmetry, symmetry},
     {},
     0.02},
    {"square_all",
     {32, 32, 1},
     {wall, moving_wall, symmetry, open, periodic, periodic},
     {0, 0, 0.01},
     0.02,
     true,
     true},
    {"tube_classic",
     {64, 1, 1},
     {wall, inflow, symmetry, symmetry, symmetry, symmetry},
     {},
     0,
     true,
     false,
     true},
    {"square_classic",
     {32, 32, 1},
     {wall, open, inflow, symmetry, symmetry, symmetry},
     {},
     0,
     true,
     false,
     true},
    {"square_classic_viscous",
     {32, 32, 1},
     {moving_wall, wall, open, inflow, periodic, periodic},
     {0, 0, 0.01},
     0.02,
     true,
     true,
     true},
    {"cube", {16, 16, 16}, {wall, open, inflow, symmetry, periodic, periodic}},
    {"cube_all", {16, 16, 16}, {moving_wall, wall, symmetry, open, inflow, wall}, {}, 0.02},
    {"cube_classic",
     {16, 16, 16},
     {wall, open, inflow, symmetry, periodic, periodic},
     {},
     0,
     true,
     false,
     true},
};

INSTANTIATE_TEST_SUITE_P(Cases, Symmetry, testing::ValuesIn(cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sluice::properties

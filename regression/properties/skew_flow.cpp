// Running and turning back.
#include "properties/skew_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/loading/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"

namespace sluice::properties {
namespace {

constexpr int run_steps = 24;

void add_level(const SkewCase& c, const Orientation& o, const ArchiveStep& step, int level,
               int material, Flow& flow) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const DenseField rho = step.read(*step.find("rho_CC", material, level));
  const DenseField T = step.read(*step.find("temp_CC", material, level));
  const DenseField u = step.read(*step.find("vel_CC", material, level));
  const FieldInfo* volume = step.find("vol_frac_CC", material, level);
  const DenseField share = volume != nullptr ? step.read(*volume) : DenseField{};
  const IntVec3 cells = c.cells_of(level);
  flow.cells.push_back(0);
  for_each_cell({{0, 0, 0}, cells}, [&](IntVec3 cell) {
    const IntVec3 there = o.turn_cell(cell, cells);
    const bool has = rho.has(there);
    flow.cells.back() += has;
    flow.density.push_back(has ? rho.at(there) : none);
    flow.temperature.push_back(has ? T.at(there) : none);
    if (volume != nullptr) flow.share.push_back(has ? share.at(there) : none);
    Vec3 v{};
    for (int d = 0; d < 3 && has; ++d) {
      const auto n = static_cast<std::size_t>(d);
      v[o.shows[n]] = o.mirrored[n] ? -u.at(there, d) : u.at(there, d);
    }
    flow.velocity.push_back(v);
  });
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double v : values)
    if (std::isfinite(v)) most = std::max(most, std::fabs(v));
  return most;
}

}  // namespace

Flow flow_of(const SkewCase& c, const Orientation& o) {
  ScratchFolder scratch;
  const Deck deck = load_deck_text(skew_deck(c, o, run_steps), c.name, {}, sluice_schema());
  const RunReport report = carry_out(deck, scratch / "run");
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, run_steps);
  EXPECT_EQ(report.events_json, "{}");
  const Archive archive = Archive::open(report.archive.value());
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  EXPECT_EQ(step.info().step, run_steps);
  Flow flow;
  for (int level = 0; level < static_cast<int>(step.grid().levels.size()); ++level)
    for (int m = 0; m < c.materials(); ++m) add_level(c, o, step, level, m, flow);
  EXPECT_EQ(static_cast<int>(flow.cells.size()), c.levels.most * c.materials());
  return flow;
}

std::string difference(const Flow& a, const Flow& b, double allowed) {
  if (a.cells != b.cells) return "the levels have other cells";
  std::vector<std::pair<std::vector<double>, std::vector<double>>> fields = {
      {a.density, b.density}, {a.share, b.share}, {a.temperature, b.temperature}};
  for (int d = 0; d < 3; ++d) {
    auto& [u, v] = fields.emplace_back();
    for (std::size_t n = 0; n < a.velocity.size(); ++n) {
      u.push_back(a.velocity[n][d]);
      v.push_back(b.velocity[n][d]);
    }
  }
  const char* names[] = {"density",    "share",      "temperature",
                         "velocity 0", "velocity 1", "velocity 2"};
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const auto& [p, q] = fields[f];
    const double bound = allowed * largest(p);
    std::size_t count = 0;
    double worst = 0;
    for (std::size_t n = 0; n < p.size(); ++n) {
      if (p[n] == q[n]) continue;
      // Round-off of heat and momentum shows as large where little of a material is.
      const double weight = f > 1 && !a.share.empty() ? a.share[n] : 1.0;
      if (weight * std::fabs(p[n] - q[n]) <= bound) continue;
      ++count;
      worst = std::max(worst, std::fabs(p[n] - q[n]));
    }
    if (count > 0)
      return std::string(names[f]) + " differs in " + std::to_string(count) + " cells, by up to " +
             std::to_string(worst / std::max(largest(p), 1e-300) * 1e15) + " 1e-15 of the largest";
  }
  return {};
}

}  // namespace sluice::properties

#include "app/loading/exact_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/loading/archive_error.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/json.hpp"
#include "framework/base/reduction.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {
namespace {

constexpr double start_tolerance = 0.02;  // of the largest magnitude
constexpr double allowed_share = 0.01;    // of the cells
constexpr double allowed_cells = 2;

// Density, velocity, pressure.
constexpr int quantities = 5;
using Values = std::array<double, quantities>;
constexpr std::array<const char*, quantities> quantity_names = {"rho_CC", "vel_CC.x", "vel_CC.y",
                                                                "vel_CC.z", "press_CC"};

struct Worst {
  double excess = 0;  // over the range, as a share of the scale
  std::string text;
};

class StartComparison {
 public:
  StartComparison(const exact::ExactSolution& solution, Hierarchy& hierarchy, double time)
      : solution_(solution), hierarchy_(hierarchy), time_(time) {}

  // Labels that the component computes from a state alone; false where some are not.
  bool compute() {
    for (const char* name : {"rho_CC", "vel_CC", "press_CC"}) {
      const std::optional<Label> label = find_label(name);
      if (!label || !hierarchy_.level(0).graphs().is_diagnostic_label(*label)) return false;
      labels_.push_back(*label);
    }
    hierarchy_.compute_diagnostics(time_, labels_);
    return true;
  }

  // The largest magnitudes, of both, on this rank; velocities count at least as a thousandth of
  // sqrt(p/rho), so that a flow at rest is not compared with its round-off.
  Values scale() {
    Values largest{};
    for_cells([&](const Level& level, IntVec3 c, const Values& now) {
      const Values there = exact(level.centre(c));
      for (std::size_t q = 0; q < quantities; ++q)
        if (std::isfinite(there[q]))
          largest[q] = std::max({largest[q], std::fabs(now[q]), std::fabs(there[q])});
      const double sound = 1e-3 * std::sqrt(std::fabs(there[4] / there[0]));
      for (std::size_t q = 1; q < 4; ++q)
        if (std::isfinite(sound)) largest[q] = std::max(largest[q], sound);
    });
    return largest;
  }

  void compare(const Values& scale) {
    for_cells([&](const Level& level, IntVec3 c, const Values& now) {
      Values low, high;
      low.fill(HUGE_VAL);
      high.fill(-HUGE_VAL);
      around(level, c, [&](const Values& there) {
        for (std::size_t q = 0; q < quantities; ++q) {
          low[q] = std::min(low[q], there[q]);
          high[q] = std::max(high[q], there[q]);
        }
      });
      ++cells;
      bool good = true;
      for (std::size_t q = 0; q < quantities; ++q) {
        const double excess = std::max(low[q] - now[q], now[q] - high[q]) / scale[q];
        if (!(excess > start_tolerance) || !std::isfinite(low[q] + high[q])) continue;
        good = false;
        if (excess > worst.excess) worst = {excess, text(level, c, q, now[q])};
      }
      if (!good) ++differing;
    });
  }

  std::uint64_t cells = 0, differing = 0;
  Worst worst;

 private:
  Values exact(Vec3 x) const {
    const exact::State s = solution_.at(x, time_);
    return {s.density, s.velocity.x, s.velocity.y, s.velocity.z, s.pressure};
  }

  std::string text(const Level& level, IntVec3 c, std::size_t q, double now) const {
    const Vec3 x = level.centre(c);
    return fmt::format(
        "{} of the deck is {:g} in cell [{}, {}, {}] of level {} at ({:g}, {:g}, "
        "{:g}), that of the exact solution {:g}",
        quantity_names[q], now, c.x, c.y, c.z, level.index, x.x, x.y, x.z, exact(x)[q]);
  }

  // visit(exact values) at the centre and a cell's width around it.
  template <class F>
  void around(const Level& level, IntVec3 c, F&& visit) const {
    IntVec3 reach;
    for (int d = 0; d < 3; ++d) reach[d] = level.active[d] && solution_.varies_along(d) ? 1 : 0;
    for_each_cell({{-reach.x, -reach.y, -reach.z}, {reach.x + 1, reach.y + 1, reach.z + 1}},
                  [&](IntVec3 shift) {
                    Vec3 x = level.centre(c);
                    for (int d = 0; d < 3; ++d) x[d] += shift[d] * level.spacing[d];
                    visit(exact(x));
                  });
  }

  // visit(level, cell, values) of the cells of this rank. Of a solution of several materials
  // density and velocity are those of all together.
  template <class F>
  void for_cells(F&& visit) {
    for (int l = 0; l < hierarchy_.level_count(); ++l) {
      LevelSolver& solver = hierarchy_.level(l);
      Warehouse& outputs = solver.outputs();
      const int materials = solution_.materials() > 1 ? hierarchy_.component().material_count() : 1;
      const auto& boxes = outputs.local_boxes();
      for (int b = 0; b < static_cast<int>(boxes.size()); ++b)
        for_each_cell(boxes[b].cells, [&](IntVec3 c) {
          Values now{};
          for (int m = 0; m < materials; ++m) add_material(outputs, b, m, c, now);
          for (std::size_t q = 1; q < 4; ++q) now[q] /= now[0];
          visit(solver.level(), c, now);
        });
    }
  }

  // Velocities are summed as momenta.
  void add_material(const Warehouse& outputs, int box, int material, IntVec3 c, Values& sum) const {
    const int rho = outputs.find(labels_[0], material), vel = outputs.find(labels_[1], material),
              press = outputs.find(labels_[2], material);
    if (rho < 0 || vel < 0) return;
    if (press >= 0 && material == 0) sum[4] = outputs.view(press, 0, box)(c);
    const double density = outputs.view(rho, 0, box)(c);
    if (density == 0) return;
    sum[0] += density;
    for (int d = 0; d < 3; ++d)
      sum[static_cast<std::size_t>(1 + d)] += density * outputs.view(vel, d, box)(c);
  }

  const exact::ExactSolution& solution_;
  Hierarchy& hierarchy_;
  double time_;
  std::vector<Label> labels_;
};

Values largest_of_all(const Values& own, Communicator& ranks) {
  Reduction all;
  std::vector<Reduction::Maximum> slots;
  for (const double x : own) slots.push_back(all.add_maximum(x));
  ranks.reduce(all);
  Values largest{};
  for (std::size_t q = 0; q < quantities; ++q) largest[q] = all.maximum(slots[q]);
  return largest;
}

Worst worst_of_all(const Worst& own, Communicator& ranks) {
  Worst worst;
  for (const std::string& one : ranks.gather(Json{own.excess, own.text}.dump())) {
    const Json read = Json::parse(one);
    if (read.at(0).get<double>() > worst.excess)
      worst = {read.at(0).get<double>(), read.at(1).get<std::string>()};
  }
  return worst;
}

}  // namespace

std::optional<Fault> exact_start_fault(const DeckNode& root, Hierarchy& hierarchy,
                                       Communicator& ranks, double time) {
  const auto reference = reference_of_deck(root);
  if (!reference || reference->solution->has_places()) return std::nullopt;
  StartComparison comparison(*reference->solution, hierarchy, time);
  if (!comparison.compute()) return std::nullopt;
  comparison.compare(largest_of_all(comparison.scale(), ranks));
  std::array<std::uint64_t, 2> counts = {comparison.cells, comparison.differing};
  ranks.sum(counts.data(), counts.size());
  const Worst worst = worst_of_all(comparison.worst, ranks);
  const auto cells = static_cast<double>(counts[0]), differing = static_cast<double>(counts[1]);
  if (differing <= std::max(allowed_cells, allowed_share * cells)) return std::nullopt;
  return Fault{Severity::warning, root.find("Meta/exact_solution")->where,
               fmt::format("<exact_solution> disagrees with the start of the deck in {} of {} "
                           "cells: at t = {:g} {}",
                           counts[1], counts[0], time, worst.text),
               "make both the same problem: errors against another one mean nothing"};
}

}  // namespace sluice

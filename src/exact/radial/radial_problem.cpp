#include "exact/radial/radial_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Density of the deposited energy. Its integral over the whole space is `energy`.
double deposited(const RadialProblem& problem, double r) {
  const auto& [energy, radius] = problem.deposit;
  const double s = r / radius;
  return energy * std::pow(std::sqrt(std::numbers::pi) * radius, -problem.dimension) *
         std::exp(-s * s);
}

}  // namespace

void check(const RadialProblem& problem) {
  if (problem.dimension > 1 && problem.low != 0) {
    throw InputError(
        fmt::format("radial reference: the low end is {}, must be 0 with an axis or "
                    "a point of symmetry",
                    problem.low));
  }
  if (!(problem.high > problem.low) || problem.cells < 4 || problem.pieces.empty()) {
    throw InputError(fmt::format(
        "radial reference: range {} to {} with {} cells and {} pieces; needs a rising range, 4 "
        "cells, one piece",
        problem.low, problem.high, problem.cells, problem.pieces.size()));
  }
  for (const auto& piece : problem.pieces) {
    if (piece.density > 0 && piece.pressure > 0) continue;
    throw InputError(
        fmt::format("radial reference: density {} and pressure {} of a state must be above zero",
                    piece.density, piece.pressure));
  }
  if (!(problem.deposit.energy >= 0) || !(problem.deposit.radius > 0)) {
    throw InputError(
        fmt::format("radial reference: an energy of {} is deposited within radius {}; the energy "
                    "must be at least 0 and the radius above 0",
                    problem.deposit.energy, problem.deposit.radius));
  }
}

double radial_volume(double low, double high, int dimension) {
  if (dimension == 1) return high - low;
  if (dimension == 2) return 0.5 * (high - low) * (high + low);
  return (high - low) * (low * low + low * high + high * high) / 3;
}

RadialMeans start_means(const RadialProblem& problem, double low, double high) {
  const int d = problem.dimension;
  const double volume = radial_volume(low, high, d);
  RadialMeans mean;
  double from = low;
  for (std::size_t k = 0; k < problem.pieces.size(); ++k) {
    const auto& piece = problem.pieces[k];
    const bool last = k + 1 == problem.pieces.size();
    const double to = last ? high : std::min(high, piece.end);
    if (to <= from) continue;
    const double share = radial_volume(from, to, d) / volume;
    mean.density += share * piece.density;
    mean.momentum += share * piece.density * piece.velocity;
    mean.energy += share * (piece.pressure / (problem.gamma - 1) +
                            0.5 * piece.density * piece.velocity * piece.velocity);
    from = to;
  }
  if (problem.deposit.energy > 0) {  // Simpson's rule
    const auto part = [&](double r) { return deposited(problem, r) * std::pow(r, d - 1); };
    const double sum = part(low) + 4 * part(0.5 * (low + high)) + part(high);
    mean.energy += (high - low) / 6 * sum / volume;
  }
  return mean;
}

}  // namespace sluice::exact

#include "exact/base/cell_mean.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "exact/base/adaptive_mean.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

enum Amount { mass, momentum, energy = 4, room, pressure, heat, share };

// m^2 of the means.
double squared_momentum(const std::array<double, 9>& mean) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += mean[momentum + d] * mean[momentum + d];
  return sum;
}

double internal_energy(const std::array<double, 9>& mean) {
  if (!(mean[mass] > 0)) return mean[energy];
  return mean[energy] - 0.5 * squared_momentum(mean) / mean[mass];
}

}  // namespace

CellMean::Kind CellMean::kind_of(const std::string& name) {
  if (name == "rho_CC") return Kind::density;
  if (name == "press_CC") return Kind::pressure;
  if (name == "temp_CC") return Kind::temperature;
  if (name == "vel_CC") return Kind::velocity;
  if (name == "sp_vol_CC") return Kind::specific_volume;
  if (name == "vol_frac_CC") return Kind::fraction;
  throw InputError(
      fmt::format("variable '{}' has no exact value; known are rho_CC, press_CC, temp_CC, vel_CC, "
                  "sp_vol_CC, vol_frac_CC",
                  name));
}

CellMean::CellMean(const ExactSolution& solution, double time, const CellVariable& variable)
    : solution_(solution),
      time_(time),
      variable_(variable),
      kind_(kind_of(variable.name)),
      several_(solution.materials() > 1) {}

CellMean::Amounts CellMean::amounts(Vec3 x) const {
  const State s = solution_.at(x, time_);
  Amounts out{};
  out[mass] = s.density;
  for (int d = 0; d < 3; ++d) out[momentum + d] = s.density * s.velocity[d];
  if (several_) {
    out[pressure] = s.pressure;
    if (kind_ == Kind::temperature) out[heat] = s.density * s.temperature(variable_.specific_heat);
    out[share] = s.material == variable_.material ? 1.0 : 0.0;
  } else {
    out[room] = 1 / (s.gamma - 1);
    out[energy] = s.pressure * out[room] + 0.5 * s.density * dot(s.velocity, s.velocity);
    out[share] = 1;
  }
  return out;
}

double CellMean::value(const Amounts& mean) const {
  const double rho = mean[mass];
  switch (kind_) {
    case Kind::density:
      return rho;
    case Kind::specific_volume:
      return 1 / rho;
    case Kind::velocity:
      return rho > 0 ? mean[momentum + variable_.component] / rho : 0.0;
    case Kind::pressure:
      return several_ ? mean[pressure] : internal_energy(mean) / mean[room];
    case Kind::temperature:
      return (several_ ? mean[heat] : internal_energy(mean) / variable_.specific_heat) / rho;
    case Kind::fraction:
      return mean[share];
  }
  return 0;
}

// How much the value changes with each of the amounts, at most.
CellMean::Amounts CellMean::slopes(const Amounts& mean) const {
  Amounts out{};
  const double rho = mean[mass];
  const auto of_internal_energy = [&](double per_energy) {
    const double m2 = squared_momentum(mean);
    out[energy] = per_energy;
    if (!(rho > 0)) return;
    for (int d = 0; d < 3; ++d) out[momentum + d] = per_energy * std::sqrt(m2) / rho;
    out[mass] += per_energy * 0.5 * m2 / (rho * rho);
  };
  switch (kind_) {
    case Kind::density:
      out[mass] = 1;
      break;
    case Kind::specific_volume:
      out[mass] = 1 / (rho * rho);
      break;
    case Kind::velocity:
      if (!(rho > 0)) break;
      out[momentum + variable_.component] = 1 / rho;
      out[mass] = std::abs(mean[momentum + variable_.component]) / (rho * rho);
      break;
    case Kind::pressure:
      if (several_) {
        out[pressure] = 1;
        break;
      }
      of_internal_energy(1 / mean[room]);
      out[room] = std::abs(value(mean)) / mean[room];
      break;
    case Kind::temperature:
      out[mass] = std::abs(value(mean)) / rho;
      if (several_)
        out[heat] = 1 / rho;
      else
        of_internal_energy(1 / (rho * variable_.specific_heat));
      break;
    case Kind::fraction:
      out[share] = 1;
      break;
  }
  return out;
}

// The box, the directions of the mean, and what its amounts count.
struct CellMean::Cell {
  Vec3 low, high;
  std::vector<int> directions;
  Amounts slopes;
};

// The means along the directions from `number` on, at the other coordinates of x.
CellMean::Amounts CellMean::along(const Cell& cell, std::size_t number, Vec3 x,
                                  double tolerance) const {
  if (number == cell.directions.size()) return amounts(x);
  const int d = cell.directions[number];
  const auto differ = [&](const Amounts& difference) {
    double sum = 0;
    for (std::size_t k = 0; k < difference.size(); ++k)
      sum += cell.slopes[k] * std::abs(difference[k]);
    return sum > tolerance;
  };
  const auto line = [&](double place) {
    Vec3 there = x;
    there[d] = place;
    // What an inner mean is off counts like a difference along d.
    return along(cell, number + 1, there, 0.5 * tolerance);
  };
  return adaptive_mean<std::tuple_size_v<Amounts>>(line, cell.low[d], cell.high[d], differ);
}

double CellMean::over(Vec3 low, Vec3 high, std::array<bool, 3> directions, double tolerance) const {
  const Vec3 middle = 0.5 * (low + high);
  Cell cell{low, high, {}, {}};
  for (int d = 0; d < 3; ++d)
    if (directions[d] && solution_.varies_along(d)) cell.directions.push_back(d);
  const Amounts first = amounts(middle);
  if (cell.directions.empty()) return value(first);
  // What the amounts count follows from the ends and the middle.
  const Amounts a = amounts(low), b = amounts(high);
  Amounts mean;
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = (a[k] + b[k] + 2 * first[k]) / 4;
  cell.slopes = slopes(mean);
  return value(along(cell, 0, middle, tolerance));
}

double CellMean::at(Vec3 x) const {
  return value(amounts(x));
}

}  // namespace sluice::exact

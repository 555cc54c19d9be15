#include "app/accuracy/error_bar.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

// Orders that schemes have: at jumps, least and largest; in smooth flow.
constexpr double least_order = 0.5, order_at_jumps = 1, largest_order = 3;
constexpr double safety = 1.25;
constexpr double alike = 0.4;  // two observed orders that confirm each other

std::optional<double> order_between(double coarse, double fine, double ratio) {
  if (!(coarse > 0 && fine > 0)) return std::nullopt;
  return std::log(coarse / fine) / std::log(ratio);
}

}  // namespace

double ErrorBar::at_spacing(double factor) const {
  return bar * std::pow(factor, used_order);
}

ErrorBar error_bar(const std::vector<double>& differences, double ratio) {
  ErrorBar found;
  const std::size_t n = differences.size();
  const double fine = differences.back();
  if (!(fine > 0)) return found;
  found.order = order_between(differences[n - 2], fine, ratio);
  found.diverges = found.order && *found.order < 0;
  const double p = found.order.value_or(least_order);
  const auto before =
      n > 2 ? order_between(differences[n - 3], differences[n - 2], ratio) : std::nullopt;
  const bool confirmed = before && std::fabs(*before - p) <= alike;
  found.used_order = std::clamp(p, least_order, confirmed ? largest_order : order_at_jumps);
  found.bar = safety * fine / (std::pow(ratio, found.used_order) - 1);
  return found;
}

}  // namespace sluice

#include "app/accuracy/error_bar.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

// Orders that schemes have at jumps (least) and in smooth flow (largest).
constexpr double least_order = 0.5, largest_order = 2;
constexpr double safety = 1.25;          // of an observed order within them
constexpr double safety_of_unknown = 2;  // of one outside

}  // namespace

double ErrorBar::at_spacing(double factor) const {
  return bar * std::pow(factor, used_order_);
}

ErrorBar error_bar(double coarse, double fine, double ratio) {
  ErrorBar found;
  if (!(fine > 0)) return found;
  double p = least_order;
  if (coarse > 0) {
    p = std::log(coarse / fine) / std::log(ratio);
    found.order = p;
    found.diverges = p < 0;
  }
  found.used_order_ = std::clamp(p, least_order, largest_order);
  const bool usual = found.used_order_ == p;
  found.bar =
      (usual ? safety : safety_of_unknown) * fine / (std::pow(ratio, found.used_order_) - 1);
  return found;
}

}  // namespace sluice

#include "exact/smooth/vortices.hpp"

#include <cmath>
#include <numbers>

namespace sluice::exact {

State IsentropicVortex::at(Vec3 x, double t) const {
  constexpr double pi = std::numbers::pi;
  Vec3 d = x - stream_.centre - stream_.velocity * t;
  if (stream_.period > 0) {
    d.x = std::remainder(d.x, stream_.period);
    d.y = std::remainder(d.y, stream_.period);
  }
  const double g = stream_.gamma, b = stream_.strength;
  const double swirl = b / (2 * pi) * std::exp(0.5 * (1 - d.x * d.x - d.y * d.y));
  const double temperature = 1 - (g - 1) / (2 * g) * swirl * swirl;
  State out;
  out.gamma = g;
  out.density = std::pow(temperature, 1 / (g - 1));
  out.velocity = stream_.velocity + Vec3{-swirl * d.y, swirl * d.x, 0};
  out.pressure = std::pow(temperature, g / (g - 1));
  return out;
}

State GreshoVortex::at(Vec3 x, double) const {
  const Vec3 d = x - centre_;
  const double r = std::sqrt(d.x * d.x + d.y * d.y);
  const double mean = 1 / (gamma_ * mach_ * mach_);
  State out;
  out.gamma = gamma_;
  out.density = 1;
  double swirl_over_r = 0;
  if (r < 0.2) {
    swirl_over_r = 5;
    out.pressure = mean + 12.5 * r * r;
  } else if (r < 0.4) {
    swirl_over_r = 2 / r - 5;
    out.pressure = mean + 12.5 * r * r + 4 * (1 - 5 * r + std::log(5 * r));
  } else {
    out.pressure = mean + 4 * std::numbers::ln2 - 2;
  }
  out.velocity = {-swirl_over_r * d.y, swirl_over_r * d.x, 0};
  return out;
}

}  // namespace sluice::exact

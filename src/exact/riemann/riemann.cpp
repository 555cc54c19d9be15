#include "exact/riemann/riemann.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Velocity jump across a side's wave as a function of the pressure behind it, and its slope.
struct Jump {
  double value, slope;
};
Jump velocity_jump(const GasState& side, double p) {
  const double g = side.gamma;
  if (p > side.pressure) {  // shock: Toro eq. 4.6, 4.37
    const double a = 2 / ((g + 1) * side.density);
    const double b = (g - 1) / (g + 1) * side.pressure;
    const double root = std::sqrt(a / (p + b));
    return {(p - side.pressure) * root, root * (1 - 0.5 * (p - side.pressure) / (p + b))};
  }
  // rarefaction; expm1 keeps weak waves accurate
  const double c = side.sound_speed();
  const double logarithm = std::log(p / side.pressure);
  return {2 * c / (g - 1) * std::expm1((g - 1) / (2 * g) * logarithm),
          std::exp(-(g + 1) / (2 * g) * logarithm) / (side.density * c)};
}

double star_density(const GasState& side, double p) {
  const double g = side.gamma, k = (g - 1) / (g + 1);
  if (p > side.pressure) return side.density * (p + k * side.pressure) / (k * p + side.pressure);
  return side.density * std::pow(p / side.pressure, 1 / g);
}

// State inside the fan of a right-going rarefaction (Toro eq. 4.63).
GasState inside_right_fan(const GasState& side, double speed) {
  const double g = side.gamma, c0 = side.sound_speed();
  const double c = std::max(0.0, 2 / (g + 1) * c0 - (g - 1) / (g + 1) * (side.velocity - speed));
  GasState out = side;
  out.velocity = 2 / (g + 1) * (-c0 + (g - 1) / 2 * side.velocity + speed);
  out.density = side.density * std::pow(c / c0, 2 / (g - 1));
  out.pressure = side.pressure * std::pow(c / c0, 2 * g / (g - 1));
  return out;
}

GasState mirrored(GasState state) {
  state.velocity = -state.velocity;
  return state;
}

void check(const GasState& side, const char* name) {
  if (side.density >= 0 && side.pressure >= 0 && side.gamma > 1 && std::isfinite(side.velocity)) {
    return;
  }
  throw InputError(fmt::format(
      "Riemann problem: {} state has density {}, pressure {}, gamma {}; allowed are density >= 0, "
      "pressure >= 0, gamma > 1",
      name, side.density, side.pressure, side.gamma));
}

}  // namespace

double GasState::sound_speed() const {
  return density > 0 ? std::sqrt(gamma * pressure / density) : 0.0;
}

RiemannSolution::RiemannSolution(GasState left, GasState right) : left_(left), right_(right) {
  check(left, "left");
  check(right, "right");
  const double reach_left = 2 * left.sound_speed() / (left.gamma - 1);
  const double reach_right = 2 * right.sound_speed() / (right.gamma - 1);
  vacuum_ = left.density == 0 || right.density == 0 ||
            reach_left + reach_right <= right.velocity - left.velocity;
  if (!vacuum_) solve();
  set_waves();
}

// Newton's iteration kept inside a bracket; the function rises monotonically and is concave.
void RiemannSolution::solve() {
  const double gap = right_.velocity - left_.velocity;
  const auto residual = [&](double p) {
    // A cold side (pressure 0) can only be shocked.
    const Jump l = velocity_jump(left_, p), r = velocity_jump(right_, p);
    return Jump{l.value + r.value + gap, l.slope + r.slope};
  };
  double low = 0;
  double high = std::max({left_.pressure, right_.pressure, 1e-300});
  while (residual(high).value < 0) {
    low = high;
    high *= 4;
  }
  double p = 0.5 * (low + high);
  for (int iteration = 0; iteration < 2000; ++iteration) {
    const Jump f = residual(p);
    (f.value < 0 ? low : high) = p;
    double next = p - f.value / f.slope;
    if (!(next > low && next < high)) {
      next = low > 0 ? std::sqrt(low) * std::sqrt(high) : 0.01 * high;
    }
    const bool done = std::abs(next - p) <= 1e-15 * p || next == low || next == high;
    p = next;
    if (done) break;
  }
  p_star_ = p;
  u_star_ = 0.5 * (left_.velocity + right_.velocity) +
            0.5 * (velocity_jump(right_, p).value - velocity_jump(left_, p).value);
  rho_star_left_ = star_density(left_, p);
  rho_star_right_ = star_density(right_, p);
}

void RiemannSolution::set_waves() {
  const auto right_going = [&](const GasState& side, double u_star, double rho_star) -> WaveSpeeds {
    const double c = side.sound_speed(), g = side.gamma;
    if (vacuum_) return {side.velocity + c, side.velocity - 2 * c / (g - 1)};
    if (p_star_ > side.pressure) {  // mass flux through the shock, Toro eq. 4.16; cold gas allowed
      const double flux =
          std::sqrt(0.5 * side.density * ((g + 1) * p_star_ + (g - 1) * side.pressure));
      const double speed = side.velocity + flux / side.density;
      return {speed, speed};
    }
    return {side.velocity + c, u_star + std::sqrt(g * p_star_ / rho_star)};
  };
  right_wave_ = right_going(right_, u_star_, rho_star_right_);
  left_wave_ = right_going(mirrored(left_), -u_star_, rho_star_left_);
  left_wave_ = {-left_wave_.head, -left_wave_.tail};
}

GasState RiemannSolution::sample(double speed) const {
  const bool of_left =
      vacuum_ ? (right_.density == 0 || (left_.density != 0 && speed <= left_wave_.tail))
              : speed < u_star_;
  if (!of_left) return sample_right(speed);
  RiemannSolution mirror = *this;
  std::swap(mirror.left_, mirror.right_);
  mirror.left_ = mirrored(mirror.left_);
  mirror.right_ = mirrored(mirror.right_);
  mirror.right_wave_ = {-left_wave_.head, -left_wave_.tail};
  mirror.u_star_ = -u_star_;
  mirror.rho_star_right_ = rho_star_left_;
  return mirrored(mirror.sample_right(-speed));
}

// Right of the contact (or of the void).
GasState RiemannSolution::sample_right(double speed) const {
  if (speed >= right_wave_.head) return right_;
  GasState out = right_;
  if (vacuum_) {
    if (speed > right_wave_.tail) return inside_right_fan(right_, speed);
    out.density = out.pressure = out.velocity = 0;
    return out;
  }
  if (p_star_ > right_.pressure || speed <= right_wave_.tail) {
    out.density = rho_star_right_;
    out.velocity = u_star_;
    out.pressure = p_star_;
    return out;
  }
  return inside_right_fan(right_, speed);
}

}  // namespace sluice::exact

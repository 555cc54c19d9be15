#include "exact/smooth/waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double length(Vec3 v) {
  return std::sqrt(dot(v, v));
}

double sound_speed(const State& s) {
  return std::sqrt(s.gamma * s.pressure / s.density);
}

}  // namespace

State AdvectedWave::at(Vec3 x, double t) const {
  State out = mean_;
  const double phase = dot(wave_vector_, x - origin_ - mean_.velocity * t);
  out.density = mean_.density * (1 + amplitude_ * std::cos(two_pi * phase));
  return out;
}

State SoundWave::at(Vec3 x, double t) const {
  const double c = sound_speed(mean_), k = length(wave_vector_);
  const double phase = dot(wave_vector_, x - origin_ - mean_.velocity * t) - sense_ * k * c * t;
  const double wave = amplitude_ * std::cos(two_pi * phase);
  State out = mean_;
  out.density = mean_.density * (1 + wave);
  out.velocity = mean_.velocity + wave_vector_ * (sense_ * c * wave / k);
  out.pressure = mean_.pressure * (1 + mean_.gamma * wave);
  return out;
}

SimpleWave::SimpleWave(State mean, double amplitude, Vec3 wave_vector, int sense, Vec3 origin)
    : mean_(mean),
      amplitude_(amplitude),
      wave_number_(length(wave_vector)),
      direction_(wave_vector * (1 / length(wave_vector))),
      sense_(sense),
      origin_(origin) {
  // Characteristics cross first where the signal speed u + c falls fastest along the wave.
  double steepest = 0;
  const int samples = 10000;
  for (int i = 0; i < samples; ++i) {
    const double phase = static_cast<double>(i) / samples;
    const double ratio = 1 + amplitude_ * std::cos(two_pi * phase);
    const double slope = -amplitude_ * two_pi * wave_number_ * std::sin(two_pi * phase);
    const double c = sound_speed(mean_) * std::pow(ratio, 0.5 * (mean_.gamma - 1));
    steepest = std::max(steepest, std::abs(0.5 * (mean_.gamma + 1) * c / ratio * slope));
  }
  breaking_time_ = 1 / steepest;
}

SimpleWave::Foot SimpleWave::foot(double phase) const {
  const double ratio = 1 + amplitude_ * std::cos(two_pi * phase);
  return {mean_.density * ratio, sound_speed(mean_) * std::pow(ratio, 0.5 * (mean_.gamma - 1))};
}

State SimpleWave::at(Vec3 x, double t) const {
  if (t >= breaking_time_) {
    throw InputError(fmt::format("simple wave: requested at t = {}, but it breaks at t = {}", t,
                                 breaking_time_));
  }
  const double g = mean_.gamma, c0 = sound_speed(mean_);
  const double s = dot(direction_, x - origin_ - mean_.velocity * t);
  // Foot xi of the characteristic through x: xi + sense ((g+1) c - 2 c0)/(g-1) t = s.
  const auto shift = [&](double xi) {
    return sense_ * ((g + 1) * foot(xi * wave_number_).sound_speed - 2 * c0) / (g - 1) * t;
  };
  const double c_low = c0 * std::pow(1 - std::abs(amplitude_), 0.5 * (g - 1));
  const double c_high = c0 * std::pow(1 + std::abs(amplitude_), 0.5 * (g - 1));
  const double a = sense_ * ((g + 1) * c_low - 2 * c0) / (g - 1) * t;
  const double b = sense_ * ((g + 1) * c_high - 2 * c0) / (g - 1) * t;
  double low = s - std::max(a, b) - 1e-12, high = s - std::min(a, b) + 1e-12;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (middle + shift(middle) < s ? low : high) = middle;
  }
  const Foot at_foot = foot(0.5 * (low + high) * wave_number_);
  State out = mean_;
  out.density = at_foot.density;
  out.velocity = mean_.velocity + direction_ * (sense_ * 2 / (g - 1) * (at_foot.sound_speed - c0));
  out.pressure = mean_.pressure * std::pow(at_foot.density / mean_.density, g);
  return out;
}

State HydrostaticColumn::at(Vec3 x, double) const {
  const double rise = base_.density * dot(gravity_, x - origin_);
  State out = base_;
  if (isothermal_) {
    const double ratio = std::exp(rise / base_.pressure);
    out.density *= ratio;
    out.pressure *= ratio;
  } else {
    out.pressure += rise;
  }
  return out;
}

}  // namespace sluice::exact

#include "exact/riemann/material_riemann.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eos/bracketed_root.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Right of the contact, with the wave's curve; speeds relative to the fluid ahead.
FluidState behind_right(const WaveCurve& curve, const FluidState& star,
                        const WaveCurve::Speeds& wave, double speed) {
  const FluidState& ahead = curve.ahead();
  if (speed >= wave.head) return ahead;
  if (speed <= wave.tail) return star;
  FluidState out = curve.in_fan(speed - ahead.velocity);
  out.velocity += ahead.velocity;
  return out;
}

WaveCurve::Speeds mirrored(WaveCurve::Speeds wave) {
  return {-wave.head, -wave.tail};
}

}  // namespace

MaterialRiemann::MaterialRiemann(const MaterialSide& left, const MaterialSide& right,
                                 WaveFormulas formulas)
    : left_(left), right_(right) {
  std::shared_ptr<WaveCurve> l = make_wave_curve(left.law, exact::mirrored(left.state), formulas);
  std::shared_ptr<WaveCurve> r = make_wave_curve(right.law, right.state, formulas);
  solve(*l, *r);
  left_curve_ = l;
  right_curve_ = r;
}

void MaterialRiemann::solve(WaveCurve& left, WaveCurve& right) {
  const double gap = right_.state.velocity - left_.state.velocity;
  // Pressures are counted from the lowest that both can bear, so that a gas may come near zero and
  // a liquid may be stretched.
  const double floor = std::max(left.lowest_pressure(), right.lowest_pressure());
  const auto residual = [&](double above) {
    const WaveCurve::Point l = left.behind(floor + above), r = right.behind(floor + above);
    return eos::ValueAndSlope{l.state.velocity + r.state.velocity + gap, l.slope + r.slope};
  };
  const double zl = left_.state.density * left.sound_speed_ahead();
  const double zr = right_.state.density * right.sound_speed_ahead();
  const double acoustic =
      (zr * left_.state.pressure + zl * right_.state.pressure - zl * zr * gap) / (zl + zr) - floor;
  const double highest = std::max(left_.state.pressure, right_.state.pressure) - floor;
  double start = std::max(acoustic, 1e-3 * highest), low = start, high = start;
  while (residual(high).value < 0) {
    low = high;
    high *= 4;
  }
  // Newton's steps from above end below the root, since the curves are concave; none is so long
  // that it leaves a law's range for nothing.
  for (eos::ValueAndSlope f = residual(low); f.value > 0; f = residual(low)) {
    high = std::min(high, low);
    low = std::max(0.25 * low, low - 1.01 * f.value / f.slope);
    if (low < 1e-60 * highest) {
      throw InputError(
          fmt::format("Riemann problem of two materials: they separate at {} and a void opens "
                      "between them (no pressure above {} stops it); allowed are slower states",
                      gap, floor));
    }
  }
  start = std::clamp(start, low, high);
  const double above = eos::bracketed_root(residual, low, high, start);
  const FluidState l = left.behind(floor + above).state, r = right.behind(floor + above).state;
  const double velocity =
      0.5 * (left_.state.velocity + right_.state.velocity) + 0.5 * (r.velocity - l.velocity);
  const auto in_frame = [](WaveCurve::Speeds wave, double by) -> WaveCurve::Speeds {
    return {wave.head + by, wave.tail + by};
  };
  left_wave_ = mirrored(in_frame(left.speeds(l), -left_.state.velocity));
  right_wave_ = in_frame(right.speeds(r), right_.state.velocity);
  star_left_ = l;
  star_right_ = r;
  star_left_.velocity = star_right_.velocity = velocity;
}

MaterialRiemann::Sample MaterialRiemann::sample(double speed) const {
  if (speed >= star_velocity())
    return {behind_right(*right_curve_, star_right_, right_wave_, speed), 1};
  const FluidState image =
      behind_right(*left_curve_, exact::mirrored(star_left_), mirrored(left_wave_), -speed);
  return {exact::mirrored(image), 0};
}

double MaterialRiemann::temperature(const Sample& sample) const {
  return exact::temperature(sample.side == 0 ? left_.law : right_.law, sample.state);
}

}  // namespace sluice::exact

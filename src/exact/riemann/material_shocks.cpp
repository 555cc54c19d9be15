#include "exact/riemann/material_shocks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "eos/bracketed_root.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

int checked(int direction) {
  if (direction == 1 || direction == -1) return direction;
  throw InputError(fmt::format("wave: direction is {}; allowed are 1 and -1", direction));
}

// In the frame of the given state, from the right-running wave of the mirrored or same state.
Wave wave_of(WaveCurve& curve, double pressure, double direction) {
  Wave wave;
  wave.behind = curve.behind(pressure).state;
  const WaveCurve::Speeds speeds = curve.speeds(wave.behind);
  const double frame = curve.ahead().velocity;  // already mirrored where the wave is
  wave.behind.velocity = direction * (wave.behind.velocity + frame);
  wave.head = direction * (speeds.head + frame);
  wave.tail = direction * (speeds.tail + frame);
  return wave;
}

std::unique_ptr<WaveCurve> curve_of(const MaterialSide& ahead, int direction) {
  return make_wave_curve(ahead.law, direction == 1 ? ahead.state : mirrored(ahead.state));
}

// The right side of the problem that follows the arrival.
MaterialSide second_side(const MaterialSide& first, const std::optional<MaterialSide>& second,
                         const Wave& incident) {
  if (second) return *second;
  MaterialSide image = first;  // a wall: the shocked fluid mirrored in the wall's frame
  image.state = incident.behind;
  image.state.velocity = 2 * first.state.velocity - incident.behind.velocity;
  return image;
}

double checked_arrival(const MaterialSide& first, const std::optional<MaterialSide>& second,
                       const Wave& incident, double shock_position, double interface_position) {
  const FluidState& a = first.state;
  if (!(incident.behind.pressure > a.pressure)) {
    throw InputError(
        fmt::format("shock at an interface: the pressure behind it is {}, not above {} ahead",
                    incident.behind.pressure, a.pressure));
  }
  const FluidState& b = second ? second->state : first.state;
  if (a.velocity != b.velocity ||
      std::abs(a.pressure - b.pressure) > 1e-12 * std::abs(a.pressure)) {
    throw InputError(fmt::format(
        "shock at an interface: velocities {} and {}, pressures {} and {} on its sides before the "
        "shock; both materials must be in equilibrium",
        a.velocity, b.velocity, a.pressure, b.pressure));
  }
  const double time = (interface_position - shock_position) / (incident.head - a.velocity);
  if (time >= 0) return time;
  throw InputError(
      fmt::format("shock at an interface: the shock starts at {}, beyond the interface at {}",
                  shock_position, interface_position));
}

}  // namespace

Wave wave_to_pressure(const MaterialSide& ahead, double pressure, int direction) {
  const auto curve = curve_of(ahead, checked(direction));
  return wave_of(*curve, pressure, direction);
}

Wave shock_of_mach(const MaterialSide& ahead, double mach, int direction) {
  if (!(mach > 1) || !std::isfinite(mach))
    throw InputError(fmt::format("shock: Mach number is {}; allowed is above 1", mach));
  const auto curve = curve_of(ahead, checked(direction));
  const double speed = mach * curve->sound_speed_ahead(), floor = curve->lowest_pressure();
  const double start = ahead.state.pressure - floor;
  const auto excess = [&](double above) {
    const WaveCurve::Point p = curve->behind(floor + above);
    const double u = p.state.velocity;
    if (!(u > 0)) return eos::ValueAndSlope{curve->sound_speed_ahead() - speed, 1.0};
    const double w = (above - start) / (ahead.state.density * u);
    return eos::ValueAndSlope{w - speed, (1 / ahead.state.density - w * p.slope) / u};
  };
  double high = 2 * start;
  while (excess(high).value < 0) high *= 2;
  return wave_of(*curve, floor + eos::bracketed_root(excess, start, high, high), direction);
}

Wave wave_from_wall(const MaterialSide& ahead, double wall_velocity, int direction) {
  const auto curve = curve_of(ahead, checked(direction));
  const double gain = direction * (wall_velocity - ahead.state.velocity);
  const double floor = curve->lowest_pressure(), start = ahead.state.pressure - floor;
  const auto excess = [&](double above) {
    const WaveCurve::Point p = curve->behind(floor + above);
    return eos::ValueAndSlope{p.state.velocity - gain, p.slope};
  };
  double low = start, high = start;
  while (excess(high).value < 0) high *= 2;
  for (eos::ValueAndSlope f = excess(low); f.value > 0; f = excess(low)) {
    low = std::max(0.5 * low, low - 1.01 * f.value / f.slope);  // below the root: concave curve
    if (low < 1e-60 * start) {
      throw InputError(fmt::format(
          "wave from a wall: the fluid cannot follow at {} and a void opens; allowed are slower "
          "walls",
          wall_velocity));
    }
  }
  return wave_of(*curve, floor + eos::bracketed_root(excess, low, high, high), direction);
}

ShockMeetsInterface::ShockMeetsInterface(const MaterialSide& first,
                                         const std::optional<MaterialSide>& second,
                                         double pressure_behind, double shock_position,
                                         double interface_position)
    : first_(first),
      second_(second ? *second : first),
      shock_position_(shock_position),
      interface_position_(interface_position),
      incident_(wave_to_pressure(first, pressure_behind, 1)),
      arrival_(checked_arrival(first, second, incident_, shock_position, interface_position)),
      arrival_position_(interface_position + first.state.velocity * arrival_),
      after_({first.law, incident_.behind}, second_side(first, second, incident_)) {}

MaterialRiemann::Sample ShockMeetsInterface::at(double x, double t) const {
  if (t > arrival_) return after_.sample((x - arrival_position_) / (t - arrival_));
  if (x < shock_position_ + incident_.head * t) return {incident_.behind, 0};
  const bool second = x >= interface_position_ + first_.state.velocity * t;
  return {second ? second_.state : first_.state, second ? 1 : 0};
}

double ShockMeetsInterface::temperature(const MaterialRiemann::Sample& sample) const {
  return exact::temperature(sample.side == 0 ? first_.law : second_.law, sample.state);
}

}  // namespace sluice::exact

// Waves through a face.
#include "ice/boundary/waves.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::ice {
namespace {

// The incoming acoustic wave as a derivative of pressure.
double incoming(const WaveCell& cell, double transverse, const LodiSettings& settings,
                bool enters) {
  const WaveState& s = cell.here;
  const double c = cell.sound_speed, U = s.u[0], mach = U / c;
  if (mach <= -1.0) return 0.0;
  if (enters) {
    if (!cell.far_known) return 0.0;
    return settings.scale * settings.sigma * s.rho * c * (1.0 + mach) * (U - cell.far.u[0]) /
           cell.domain_size;
  }
  const double back = -0.5 * settings.scale * settings.sigma * (1.0 + mach) *
                      (s.p - settings.press_infinity) / cell.domain_size;
  return transverse + back;
}

// c - (U - U0). A mean may be far from the flow in a cell, as beside a jet: it makes the wave at
// most twice as strong.
double speed_past(const WaveCell& cell) {
  const double c = cell.sound_speed, U = cell.here.u[0];
  if (cell.far_known) return c - (U - cell.far.u[0]);
  return cell.carrier_known ? std::max(c - (U - cell.carrier.u[0]), 0.5 * c) : c;
}

}  // namespace

double transverse_part(const WaveCell& cell) {
  const WaveState& s = cell.here;
  const WaveState& carrier = cell.far_known ? cell.far : cell.carrier;
  const double c = cell.sound_speed;
  double sum = 0;
  for (int t = 0; t < 2; ++t) {
    const WaveState& d = cell.along[t];
    const double speed = s.u[1 + t] - carrier.u[1 + t];
    sum += (speed * d.p + s.rho * c * c * d.u[1 + t]) - s.rho * c * speed * d.u[0];
  }
  return 0.5 * sum / speed_past(cell);
}

WaveState outward_slopes(const WaveCell& cell, double transverse, const LodiSettings& settings) {
  const WaveState &s = cell.here, &d = cell.normal;
  const double c = cell.sound_speed, U = s.u[0], impedance = s.rho * c;
  if (U >= c) return d;
  const bool enters = U < 0;
  const double out = U <= -c ? 0.0 : 0.5 * (d.p + impedance * d.u[0]);
  const double in = incoming(cell, transverse, settings, enters);
  WaveState slope;
  slope.p = out + in;
  slope.u[0] = (out - in) / impedance;
  double entropy = enters ? 0.0 : d.rho - d.p / (c * c);
  if (enters && cell.far_known) {
    // No further than to the target in one cell.
    const double rate = settings.scale * settings.sigma * (c - U * U / c) / cell.domain_size;
    entropy = -std::min(rate / -U, 1.0 / cell.spacing) * (s.rho - cell.far.rho);
  }
  slope.rho = entropy + slope.p / (c * c);
  for (int t = 1; t < 3; ++t) slope.u[t] = enters ? 0.0 : d.u[t];
  return slope;
}

}  // namespace sluice::ice

#include "mpm/step/artificial_viscosity.hpp"

#include <cmath>

namespace sluice::mpm {
namespace {

bool flows(const Material& law) {
  for (const HistoryColumn& h : law.history())
    if (h.label.name() == "p.plasticStrain") return true;
  return false;
}

}  // namespace

void add_viscosity(const MpmScene& solids, const Body& body, const BlockWork& w, std::size_t at,
                   int n, double dt, Vec3 spacing, const GridAtParticles& read, double* heating,
                   double* wave_speed) {
  const Columns& columns = body.carried->columns;
  const auto old = [&](int column) { return w.set->column(static_cast<std::size_t>(column)) + at; };
  const auto made = [&](int column) {
    return w.next->column(static_cast<std::size_t>(column)) + at;
  };
  const double *m = old(columns.mass), *old_q = old(columns.viscous),
               *old_volume = old(columns.volume);
  const double* volume = made(columns.volume);
  double *q = made(columns.viscous), *energy = made(columns.energy);
  const double h = (spacing.x + spacing.y + spacing.z) / 3;
  const double K = body.material->law->bulk_modulus();
  const double specific_heat = body.material->constants.specific_heat;
  double* heat_so_far = columns.viscous_heat >= 0 ? made(columns.viscous_heat) : nullptr;
  const double* heat_before = columns.viscous_heat >= 0 ? old(columns.viscous_heat) : nullptr;
  const bool heats = solids.viscosity_heats && specific_heat > 0 && flows(*body.material->law);
  for (int p = 0; p < n; ++p) {
    const double rate = read.L[0][p] + read.L[4][p] + read.L[8][p];
    const double squeeze = rate < 0 ? -rate * h : 0.0;  // m/s
    const double rho = m[p] / volume[p];
    // Q = A_1 c_b + A_2 |tr D| h: q = rho Q |tr D| h. With what acts a step later a bar of linear
    // elements is stable up to h/(Q + sqrt(Q^2 + c^2)) (Hallquist, LS-DYNA theory manual, 2006).
    const double Q = solids.viscosity_1 * std::sqrt(K / rho) + solids.viscosity_2 * squeeze;
    q[p] = rho * Q * squeeze;
    const double c = wave_speed[p];
    wave_speed[p] = squeeze > 0 ? Q + std::sqrt(Q * Q + c * c) : c;
    const double power = -old_q[p] * old_volume[p] * rate;
    energy[p] += dt * power;
    if (heats) heating[p] += power / (m[p] * specific_heat);
    if (heat_so_far != nullptr) heat_so_far[p] = heat_before[p] + (heats ? dt * power : 0.0);
  }
}

}  // namespace sluice::mpm

#include "mpm/step/artificial_viscosity.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

bool flows(const Material& law) {
  for (const HistoryColumn& h : law.history())
    if (h.label.name() == "p.plasticStrain") return true;
  return false;
}

}  // namespace

bool ArtificialViscosity::possible(const std::vector<Carried>& carried) {
  return std::any_of(carried.begin(), carried.end(),
                     [](const Carried& of) { return of.columns.viscous >= 0; });
}

void ArtificialViscosity::give(const BlockWork& w, ParticlesToGrid& columns) const {
  const int q = (*carried_)[static_cast<std::size_t>(w.kind)].columns.viscous;
  if (q >= 0) columns.extra_pressure = w.set->column(static_cast<std::size_t>(q));
}

void ArtificialViscosity::to_particles(const Chunk& chunk) {
  const Columns& columns = chunk.columns();
  if (columns.viscous < 0) return;
  const Body& body = *chunk.body;
  const Vec3 spacing = level_->spacing;
  const GridAtParticles& read = chunk.read();
  double *heating = chunk.buffers->heating, *wave_speed = chunk.buffers->wave_speed;
  const double dt = chunk.dt();
  const double *m = chunk.old(columns.mass), *old_q = chunk.old(columns.viscous),
               *old_volume = chunk.old(columns.volume);
  const double* volume = chunk.made(columns.volume);
  double *q = chunk.made(columns.viscous), *energy = chunk.made(columns.energy);
  const double h = (spacing.x + spacing.y + spacing.z) / 3;
  const double K = body.material->law->bulk_modulus();
  const double specific_heat = body.material->constants.specific_heat;
  double* heat_so_far = columns.viscous_heat >= 0 ? chunk.made(columns.viscous_heat) : nullptr;
  const double* heat_before = columns.viscous_heat >= 0 ? chunk.old(columns.viscous_heat) : nullptr;
  const bool heats = solids_->viscosity_heats && specific_heat > 0 && flows(*body.material->law);
  for (int p = 0; p < chunk.n; ++p) {
    const double rate = read.L[0][p] + read.L[4][p] + read.L[8][p];
    const double squeeze = rate < 0 ? -rate * h : 0.0;  // m/s
    const double rho = m[p] / volume[p];
    // Q = A_1 c_b + A_2 |tr D| h: q = rho Q |tr D| h. With what acts a step later a bar of linear
    // elements is stable up to h/(Q + sqrt(Q^2 + c^2)) (Hallquist, LS-DYNA theory manual, 2006).
    const double Q = solids_->viscosity_1 * std::sqrt(K / rho) + solids_->viscosity_2 * squeeze;
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

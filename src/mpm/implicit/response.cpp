#include "mpm/implicit/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/implicit/neo_hook_tangent.hpp"
#include "mpm/material/base/tensor.hpp"
#include "mpm/material/elastic/neo_hook.hpp"

namespace sluice::mpm {
namespace {

// Between round-off over it and its square, both parts of 1e-10 or less of a stiffness.
constexpr double nudge = 1e-6;

Matrix matrix_at(const ChunkOfMatrices& m, int q) {
  Matrix to;
  for (std::size_t e = 0; e < 9; ++e) to[e] = m.e[e][q];
  return to;
}

// det and det(m) m^-1.
double adjugate_of(const Matrix& m, Matrix& to) {
  to = {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
        m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
        m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
  return m[0] * to[0] + m[1] * to[3] + m[2] * to[6];
}

}  // namespace

std::string describe_fault(const ParticleSet& set, std::size_t kind, const SolidMaterial& material,
                           const ResponseFault& fault) {
  const Vec3 x = set.position(fault.particle);
  return fmt::format("particle {} of material {} '{}' at [{:g}, {:g}, {:g}]: {} ({:g})",
                     set.id(fault.particle), kind, material.name, x.x, x.y, x.z, fault.reason,
                     fault.value);
}

Response::Response(const MpmScene& solids, const SolidMaterial& material, const Carried& carried,
                   double spacing, std::array<bool, 3> active)
    : solids_(&solids),
      material_(&material),
      carried_(&carried),
      spacing_(spacing),
      active_(active) {}

void Response::at_rest(const Span& s, ChunkOfMatrices& phi) const {
  for (int e = 0; e < 9; ++e)
    if (solids_->total_lagrangian)
      std::copy_n(s.set->column(static_cast<std::size_t>(carried_->columns.F + e)) + s.at, s.count,
                  phi.e[e]);
    else
      std::fill_n(phi.e[e], s.count, e % 4 == 0 ? 1.0 : 0.0);
}

std::optional<ResponseFault> Response::forces(const Span& s, const ChunkOfMatrices& phi,
                                              ParticleSet& to, std::size_t to_at,
                                              ChunkOfMatrices& T) {
  const Columns& c = carried_->columns;
  Batch& b = columns_.between(*s.set, s.at, to, to_at, *carried_, s.count);
  b.time = s.time;
  b.dt = s.dt;
  b.spacing = spacing_;
  for (std::size_t e = 0; e < 9; ++e) b.L[e] = L_[e];
  b.wave_speed = wave_;
  b.heating = heating_;
  std::fill_n(heating_, s.count, 0.0);
  double* F[9];
  for (int e = 0; e < 9; ++e) F[e] = to.column(static_cast<std::size_t>(c.F + e)) + to_at;
  double* volume = to.column(static_cast<std::size_t>(c.volume)) + to_at;
  for (int q = 0; q < s.count; ++q) {
    Matrix old, moved = matrix_at(phi, q), step = moved, adjugate;
    for (std::size_t e = 0; e < 9; ++e) old[e] = b.old_F[e][q];
    if (solids_->total_lagrangian) {
      const double det = adjugate_of(old, adjugate);
      step = product(moved, adjugate);
      for (double& x : step) x /= det;
    } else {
      moved = product(moved, old);
    }
    const double J = determinant(moved);
    if (!(J > 0))
      return ResponseFault{s.at + static_cast<std::size_t>(q),
                           "the step turns it inside out, det F", J};
    for (std::size_t e = 0; e < 9; ++e) {
      F[e][q] = moved[e];
      L_[e][q] = (step[e] - (e % 4 == 0 ? 1.0 : 0.0)) / s.dt;
    }
    volume[q] = J * b.volume_0[q];
  }
  if (const auto fault = material_->law->update(b))
    return ResponseFault{s.at + static_cast<std::size_t>(fault->particle), fault->reason,
                         fault->value};
  constexpr std::size_t place[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  for (int q = 0; q < s.count; ++q) {
    Matrix adjugate, stress;
    const double factor = volume[q] / adjugate_of(matrix_at(phi, q), adjugate);
    for (std::size_t e = 0; e < 9; ++e) stress[e] = b.stress[place[e]][q];
    for (std::size_t r = 0; r < 3; ++r)  // sigma Phi^-T
      for (std::size_t k = 0; k < 3; ++k)
        T.e[3 * r + k][q] =
            factor * (stress[3 * r] * adjugate[3 * k] + stress[3 * r + 1] * adjugate[3 * k + 1] +
                      stress[3 * r + 2] * adjugate[3 * k + 2]);
  }
  return std::nullopt;
}

void Response::make_trial(const ParticleSet& like) {
  if (trial_.size() != 0) return;
  trial_ = ParticleSet(like.attribute_count());
  for (int q = 0; q < chunk_size; ++q) trial_.add({}, 0);
}

std::optional<ResponseFault> Response::trial_forces(const Span& s, const ChunkOfMatrices& phi,
                                                    ChunkOfMatrices& T) {
  make_trial(*s.set);
  return forces(s, phi, trial_, 0, T);
}

void Response::closed_tangents(const Span& s, const ChunkOfMatrices& phi,
                               const NeoHookConstants& constants, double* A) const {
  const Columns& c = carried_->columns;
  const double* V0 = s.set->column(static_cast<std::size_t>(c.volume_0)) + s.at;
  NeoHookPoint point{constants.bulk, constants.shear, 0, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {}};
  for (int q = 0; q < s.count; ++q) {
    point.volume_0 = V0[q];
    point.phi = matrix_at(phi, q);
    for (std::size_t e = 0; e < 9 && !solids_->total_lagrangian; ++e)
      point.before[e] =
          s.set->column(static_cast<std::size_t>(c.F) + e)[s.at + static_cast<std::size_t>(q)];
    neo_hook_tangent(point, A + 81 * static_cast<std::size_t>(q));
  }
}

std::optional<ResponseFault> Response::tangents(const Span& s, const ChunkOfMatrices& phi,
                                                ChunkOfMatrices& T, double* A) {
  make_trial(*s.set);
  const std::optional<NeoHookConstants> neo_hook = neo_hookean(*material_->law);
  if (neo_hook && neo_hook->expansion == 0 && neo_hook->J0 == 1) {
    if (auto fault = forces(s, phi, trial_, 0, T)) return fault;
    closed_tangents(s, phi, *neo_hook, A);
    return std::nullopt;
  }
  ChunkOfMatrices moved = phi, up, down;
  for (std::size_t r = 0; r < 9; ++r) {
    if (!active_[r / 3] || !active_[r % 3]) continue;
    for (int q = 0; q < s.count; ++q) moved.e[r][q] = phi.e[r][q] + nudge;
    if (auto fault = forces(s, moved, trial_, 0, up)) return fault;
    for (int q = 0; q < s.count; ++q) moved.e[r][q] = phi.e[r][q] - nudge;
    if (auto fault = forces(s, moved, trial_, 0, down)) return fault;
    for (int q = 0; q < s.count; ++q) {
      moved.e[r][q] = phi.e[r][q];
      const double width = (phi.e[r][q] + nudge) - (phi.e[r][q] - nudge);
      for (std::size_t e = 0; e < 9; ++e)
        A[81 * static_cast<std::size_t>(q) + 9 * e + r] = (up.e[e][q] - down.e[e][q]) / width;
    }
  }
  return forces(s, phi, trial_, 0, T);
}

}  // namespace sluice::mpm

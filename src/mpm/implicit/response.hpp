// What stress a particle gives to its nodes when these move, and how that changes with what they
// move.
//
//   Phi = Phi_0 + sum u_i (x) G_i      Phi_0 = I, G of the places at the start of the step;
//                                      total Lagrangian: Phi_0 = F_n, G of the reference places
//   F = Phi F_n (total Lagrangian: F = Phi),   T = V sigma Phi^-T,   f_i = -T G_i
//   A = dT/dPhi, by central differences of the law itself: consistent with whatever the law does in
//   the step, so that Newton's method converges quadratically with any of them. Of the neo-Hookean
//   law it has a closed form (neo_hook_tangent.hpp).
#pragma once
#include <optional>
#include <string>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/step/law_batch.hpp"

namespace sluice::mpm {

struct NeoHookConstants;

// Nine columns of a chunk of particles, row after row.
struct ChunkOfMatrices {
  alignas(64) double e[9][chunk_size];
};

struct ResponseFault {
  std::size_t particle = 0;
  std::string reason;
  double value = 0;
};
// "particle 7 of material 0 'bar' at [...]: ..."
std::string describe_fault(const ParticleSet& set, std::size_t kind, const SolidMaterial& material,
                           const ResponseFault& fault);

class Response {
 public:
  Response(const MpmScene& solids, const SolidMaterial& material, const Carried& carried,
           double spacing, std::array<bool, 3> active);

  struct Span {
    const ParticleSet* set;
    std::size_t at;
    int count;
    double time, dt;
  };

  // Phi_0 of some particles.
  void at_rest(const Span& span, ChunkOfMatrices& phi) const;
  // T; what the law makes of the particles stands in `to` from `to_at` on.
  std::optional<ResponseFault> forces(const Span& span, const ChunkOfMatrices& phi, ParticleSet& to,
                                      std::size_t to_at, ChunkOfMatrices& T);
  // T alone.
  std::optional<ResponseFault> trial_forces(const Span& span, const ChunkOfMatrices& phi,
                                            ChunkOfMatrices& T);
  // The same with A, 81 numbers a particle: A[9 q + r] = dT_q/dPhi_r.
  std::optional<ResponseFault> tangents(const Span& span, const ChunkOfMatrices& phi,
                                        ChunkOfMatrices& T, double* A);
  // Of the last call of forces(): dT/dt of the law itself, K/s.
  const double* heating() const { return heating_; }
  // Of the last call: the speed of compression waves, m/s.
  const double* wave_speed() const { return wave_; }

 private:
  void make_trial(const ParticleSet& like);
  void closed_tangents(const Span& span, const ChunkOfMatrices& phi,
                       const NeoHookConstants& constants, double* A) const;

  const MpmScene* solids_;
  const SolidMaterial* material_;
  const Carried* carried_;
  double spacing_;
  std::array<bool, 3> active_;
  ParticleSet trial_;
  LawBatch columns_;
  alignas(64) double L_[9][chunk_size], wave_[chunk_size], heating_[chunk_size];
};

}  // namespace sluice::mpm

// Stresses of all particles in trial displacements of the nodes, and their tangents.
//
//   Phi = Phi_0 + sum u_i (x) G_i,   T = V sigma Phi^-T,   A = dT/dPhi       (response.hpp)
#pragma once
#include <string>

#include "framework/task/thread_team.hpp"
#include "mpm/implicit/nodes_of_step.hpp"
#include "mpm/implicit/response.hpp"

namespace sluice::mpm {

class ParticleStresses {
 public:
  // `time`: of the start of the step.
  ParticleStresses(const NodesOfStep::Parts& parts, const ThreadTeam& team, double time);

  // T of all particles at nodes.u. False: the law refuses one of them, for this reason.
  bool evaluate(const NodesOfStep& nodes, std::string& reason);
  // T and A.
  bool evaluate_tangents(const NodesOfStep& nodes, std::string& reason);
  // The symmetric part of each A without its negative eigenvalues: the nearest matrix that is
  // positive semi-definite. J. Teran, E. Sifakis, G. Irving, R. Fedkiw, Proc. ACM SIGGRAPH/
  // Eurographics Symp. Computer Animation (2005) 181.
  void make_positive();

  // Phi of some particles of a kind.
  void deformation(const NodesOfStep& nodes, std::size_t kind, const Response::Span& span,
                   const Response& response, ChunkOfMatrices& phi) const;

  std::size_t kinds() const { return T_.size(); }
  // By kind: 9 numbers a particle, J; 81 numbers A[9 q + r] = dT_q/dPhi_r, J. Empty for rigid
  // kinds.
  const std::vector<double>& stress(std::size_t kind) const { return T_[kind]; }
  const std::vector<double>& tangent(std::size_t kind) const { return A_[kind]; }
  // By kind, as last evaluated: rho c^2 of a particle, Pa.
  const std::vector<double>& modulus(std::size_t kind) const { return modulus_[kind]; }
  // The largest |A - A^T| of a particle over its largest |A|.
  double asymmetry() const { return asymmetry_; }
  // By kind: the largest |A| of a particle, J.
  const std::vector<double>& stiffest(std::size_t kind) const { return stiffest_[kind]; }

 private:
  struct Chunk {
    std::size_t kind, at;
    int count;
  };
  bool evaluate_all(const NodesOfStep& nodes, bool with_tangents, std::string& reason);
  void keep(const Chunk& chunk, const Response& response, const ChunkOfMatrices& T);
  void measure_tangents();

  NodesOfStep::Parts parts_;
  const ThreadTeam* team_;
  double time_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<double>> T_, A_, modulus_, stiffest_;
  double asymmetry_ = 0;
};

}  // namespace sluice::mpm

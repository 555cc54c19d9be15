// An implicit step of all solids on one level: nodes, Newton's method, heat, particles.
//
// Every rank computes the step of all particles and keeps its own: ranks change no bit, and make
// nothing faster. An attempt writes beside what there is; the journal takes it over.
#pragma once
#include <memory>

#include "framework/run/component/step_shape.hpp"
#include "mpm/implicit/equilibrium.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {

class ImplicitStep {
 public:
  ImplicitStep(const Scene& scene, const MpmScene& solids, const std::vector<Carried>& carried,
               const std::vector<ParticleKind>& kinds);

  // The stages of a step, in order.
  Verdict begin(const StageScope& scope);               // particles of all ranks, nodes
  Verdict find_displacements(const StageScope& scope);  // Newton's method
  Verdict conduct(const StageScope& scope);             // temperatures of nodes
  Verdict to_particles(const StageScope& scope);        // what particles are at the end
  Verdict take_over(const StageScope& scope);

  // Of the last step.
  const NewtonReport& newton() const { return newton_; }

 private:
  NodesOfStep::Parts parts() const;
  void find_rigid_displacements(double time, double dt);
  void find_forces(const StageScope& scope);
  void record_events(const StageScope& scope) const;
  void fill_forces(double time, NodesOfStep::Vectors& forces);
  bool move_kind(const StageScope& scope, std::size_t kind, std::string& reason);
  bool move_chunk(std::size_t kind, const Response::Span& span, Response& response,
                  std::string& reason);
  void read_nodes(std::size_t kind, const Response::Span& span);
  void warm(std::size_t kind, const Response::Span& span, const double* heating);
  void keep_rigid(std::size_t kind, double dt);
  void find_rates(const StageScope& scope);

  const Scene* scene_;
  const MpmScene* solids_;
  const std::vector<Carried>* carried_;
  const std::vector<ParticleKind>* kinds_;
  Level level_;
  std::unique_ptr<NodeBoundary> boundary_;
  std::unique_ptr<OutsideForces> outside_;
  AllParticles particles_;
  std::unique_ptr<ReachedNodes> reached_;
  NodesOfStep::Vectors rigid_, forces_before_, forces_;
  std::vector<bool> stopped_;  // rigid kinds, by a rule
  std::unique_ptr<NodesOfStep> nodes_;
  std::unique_ptr<Equilibrium> equilibrium_;
  SparseSolver solver_;
  NewtonReport newton_;
  bool retried_ = false;        // this step is shorter than the one that failed
  int failures_ = 0;            // attempts at this step that failed
  std::vector<double> warmed_;  // change of temperature of nodes; empty: heat rests
  std::vector<double> new_rates_;
};

}  // namespace sluice::mpm

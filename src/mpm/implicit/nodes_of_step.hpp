// Nodes of an implicit step: what particles give them, what is given, what Newton's method finds.
//
//   M = sum m S, v_0 = sum m v S/M, a_0 = sum m a S/M      over all that deforms: one velocity
//   u: displacement of a node in the step; given on sides and where rigid particles reach it
//   v_1 = 2 u/dt - v_0, a_1 = 4 u/dt^2 - 4 v_0/dt - a_0    (trapezoidal rule of Newmark)
//   given nodes: v_1 = u/dt, a_1 = 0;   without inertia: v_1 = u/dt, a_1 = 0
#pragma once
#include <array>
#include <vector>

#include "mpm/implicit/stencils.hpp"

namespace sluice::mpm {

class NodesOfStep {
 public:
  struct Parts {
    const Scene* scene;
    const MpmScene* solids;
    const Level* level;
    const NodeBoundary* boundary;
    const std::vector<Carried>* carried;
    const AllParticles* particles;
    const ReachedNodes* reached;
  };
  // By kind: displacements of rigid particles in the step, forces from outside at its end (empty:
  // none).
  using Vectors = std::vector<std::vector<Vec3>>;
  NodesOfStep(const Parts& parts, const Vectors& rigid, const Vectors& forces, double dt,
              bool first_step);

  std::size_t count() const { return mass.size(); }
  bool is_free(std::size_t n, int d) const {
    return deforms[n] && level_->active[static_cast<std::size_t>(d)] &&
           !given[n][static_cast<std::size_t>(d)];
  }
  double dt() const { return dt_; }
  bool dynamic() const { return dynamic_; }
  // 4 M/dt^2; 0 without inertia.
  double inertia(std::size_t n) const { return dynamic_ ? 4 * mass[n] / (dt_ * dt_) : 0; }
  Vec3 acceleration(std::size_t n) const;  // a_1
  Vec3 velocity(std::size_t n) const;      // v_1

  std::vector<bool> deforms;  // something that deforms is there, if only by its gradient
  std::vector<double> mass;
  std::vector<Vec3> v0, a0, force, u, way;  // force: from outside, gravity too; way: u where given
  std::vector<std::array<bool, 3>> given, by_rigid;  // by_rigid: by bodies, not by sides

 private:
  void sum(const Parts& parts, const Vectors& forces);
  void find_given(const Parts& parts, const Vectors& rigid);
  // Has a node mass of a material that deforms.
  bool holds(std::size_t n, std::size_t material) const { return kinds_[material][n]; }

  std::vector<std::vector<bool>> kinds_;  // by material

  const Level* level_;
  double dt_;
  bool dynamic_;
};

}  // namespace sluice::mpm

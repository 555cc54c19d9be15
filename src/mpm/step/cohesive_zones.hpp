// Cohesive zones: points between two materials whose forces hold these together.
//
// A point has the velocities of the material below and of that above it, each a mean over the
// nodes around it with hat functions S and masses M, and its force goes to these nodes by the same
// shares, so that the work of the force is that of the separation D:
//
//   w_i = S_i M_i/sum_j S_j M_j,   f_i = +- A t(D) w_i,   dD/dt = sum_i w_i v*_i (above - below)
//
// The point moves with the middle of both materials. Sums of forces on nodes are exact integers,
// like those of particles. A point that has one of its materials no longer around holds nothing.
#pragma once
#include <array>
#include <vector>

#include "framework/run/component/component.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/loads/cohesive_law.hpp"
#include "mpm/shape/axis.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

// What points carry: the kinds of particles behind those of the materials, in the deck's order.
ParticleKind cohesive_kind(const MpmScene& solids, std::size_t zone);
// The points of a zone that lie in these cells.
void start_cohesive(const MpmScene& solids, std::size_t zone, const Level& level,
                    const IndexBox& cells, ParticleSet& set);
// Work that separating the points of a zone has taken, J.
void add_cohesive_energy(const ParticleStore& points, Totals& to);

class CohesiveZones final : public SolidEffect {
 public:
  // Keeps references.
  CohesiveZones(const MpmScene& solids, const std::vector<ParticleKind>& kinds,
                const LevelNodes& nodes, std::vector<Body>& bodies);

  // Points in their boxes.
  void begin(const StageScope& scope) override;
  // The points of a zone in one box, in this step; where their next state will stand.
  void add_points(std::size_t zone, const ParticleSet& set, ParticleSet& next);
  double most_force(int body) const override { return most_[static_cast<std::size_t>(body)]; }
  // Nodes around the points.
  void add_nodes() override;
  // Forces and stiffness by masses that all ranks agree on; once ranks agree on them too, the
  // forces into the nodes.
  void on_sums() override;
  // From velocities after the step: the next state of the points.
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  void limit(StepReport& report) const override;

 private:
  struct Work {
    const CohesiveZone* zone;
    const ParticleSet* set;
    ParticleSet* next;
  };

  // Shares of the nodes around a point; none: the material is not there.
  struct Shares {
    int count = 0;
    std::array<int, 8> block{}, lane{};  // of Body::nodes: block, first lane of the node in it
    std::array<double, 8> share{};       // S M
    double sum = 0;
  };

  // act(node, S) for the nodes around a place; of one beyond a periodic side, that which it is the
  // image of.
  template <class Act>
  void around(Vec3 place, int material, Act&& act) const;
  template <class Mass>
  Shares shares_of(Vec3 place, int material, Mass&& mass) const;
  void give_all();
  void push(const Work& work, std::size_t p, const Shares& shares, double sign, int material);
  void take();
  bool read(Vec3 place, int material, Vec3& velocity) const;
  // By the ways of the materials below and above in the step.
  void advance_point(const Work& work, std::size_t p, Vec3 way_b, Vec3 way_a, bool held);

  const MpmScene* solids_;
  const std::vector<ParticleKind>* kinds_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  std::array<Axis, 3> axes_;
  std::vector<Work> work_;
  std::vector<double> most_;      // by material
  std::vector<NodeLanes> lanes_;  // by material, sums: stiffness, -, -, - | force
  double stiffness_scale_ = 1;
  double rate_ = 0, travel_ = 0;
  bool left_ = false;
};

}  // namespace sluice::mpm

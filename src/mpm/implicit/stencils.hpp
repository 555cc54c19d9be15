// Which nodes particles reach, with what weights: all nodes of a level's particles, numbered along
// x, y, z, and the list of every particle.
//
// A node beyond a mirror or a periodic side is that of which it is the image; the components of
// vectors that change their sign there are marked.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/solve/block/node_numbers.hpp"
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/implicit/all_particles.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// The nodes of one kind's particles: entry n per + s is node s of particle n.
struct Stencils {
  int per = 0;
  std::vector<std::int32_t> node;
  std::vector<std::uint8_t> flipped;         // bit d: component d
  std::vector<double> weight;                // S
  std::vector<std::array<double, 3>> slope;  // grad S, 1/m

  std::size_t first(std::size_t particle) const { return particle * static_cast<std::size_t>(per); }
  // Has the particle weight or slope at an entry; entries without have any node of the particle.
  bool acts(std::size_t entry) const {
    return weight[entry] != 0 || slope[entry][0] != 0 || slope[entry][1] != 0 ||
           slope[entry][2] != 0;
  }
  // +1 or -1: the sign of component d at an entry.
  double sign(std::size_t entry, int d) const {
    return (flipped[entry] >> d & 1) != 0 ? -1.0 : 1.0;
  }
};

class ReachedNodes {
 public:
  // Finds the stencils of all kinds.
  ReachedNodes(const MpmScene& solids, const Level& level, const NodeBoundary& boundary,
               const std::vector<Carried>& carried, const AllParticles& particles);

  std::size_t count() const { return at_.size(); }
  IntVec3 index(std::size_t node) const { return at_[node]; }
  // -1: no particle reaches it.
  std::int32_t find(IntVec3 index) const { return numbers_(index); }
  // The node of the domain that one beyond a periodic side is.
  IntVec3 wrap(IntVec3 index) const;
  bool active(int d) const { return active_[static_cast<std::size_t>(d)]; }
  const Stencils& of(std::size_t kind) const { return stencils_[kind]; }
  std::size_t kinds() const { return stencils_.size(); }

 private:
  void find_stencils(const MpmScene& solids, const Level& level, const Carried& carried,
                     const ParticleSet& set, std::size_t kind);
  void replace_images(const NodeBoundary& boundary);
  void number();

  std::vector<Stencils> stencils_;
  std::vector<std::vector<IntVec3>> raw_;  // nodes before they are numbered, by kind
  std::vector<IntVec3> at_;
  solve::NodeNumbers numbers_;
  IndexBox domain_;
  std::array<bool, 3> active_, periodic_;
};

}  // namespace sluice::mpm

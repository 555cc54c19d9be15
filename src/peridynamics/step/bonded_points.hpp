// The points of a rank with their bonds: what they are, how they stand and move, what bonds do.
//
// Made from the particles whenever these come to other boxes. A step writes beside the state that
// there is (`next`); commit() makes that the state and hands it to the particles.
#pragma once
#include <memory>
#include <string>

#include "framework/run/levels/particle_cloud.hpp"
#include "peridynamics/bonds/bond_kernels.hpp"
#include "peridynamics/points/columns.hpp"

namespace sluice::peridynamics {

// Displacement (m), velocity (m/s), acceleration (m/s^2).
struct Motion {
  Columns3 u, v, a;
};

class BondedPoints {
 public:
  BondedPoints(const PeriScene& scene, const PointColumns& columns);

  // Finds families and evaluates the forces of what the particles are. Collective.
  void make(const ParticleCloud& cloud, const ThreadTeam* team, Communicator& ranks);
  // Of points at rest, on a level.
  void make(const std::vector<OwnPoint>& own, const Level& level, const ThreadTeam* team,
            Communicator& ranks);
  bool made() const { return points_.size() > 0; }

  const PeriScene& scene() const { return *scene_; }
  PointTable& points() { return points_; }
  const PointTable& points() const { return points_; }
  const Families& families() const { return families_; }
  Motion& present() { return present_; }
  const Motion& present() const { return present_; }
  Motion& next() { return next_; }
  double density(int entry) const {
    return scene_->materials[static_cast<std::size_t>(points_.material[entry])].density;
  }
  double horizon(int entry) const {
    return scene_->materials[static_cast<std::size_t>(points_.material[entry])].horizon;
  }
  double mass(int entry) const { return mass_[entry]; }

  // Of displacements u, in the order of a step; the last four are of own points. Collective where
  // images are filled.
  void fill_displacements(Columns3& u);
  void sum_dilatations(const Columns3& u, const ThreadTeam* team);
  void fill_dilatations();
  // Forces of all bonds to force() and energy(); whether one is beyond its limit.
  bool sum_forces(const Columns3& u, const ThreadTeam* team);
  // Breaks these bonds; how many (directed).
  std::int64_t break_bonds(const Columns3& u);

  const Columns3& force() const { return force_; }  // N/m^3
  const Column& energy() const { return energy_; }  // J/m^3
  const Column& dilatation() const { return theta_; }
  double damage(int entry) const;
  int neighbours(int entry) const { return families_.sums.neighbours[entry]; }
  double weighted_volume(int entry) const { return families_.sums.m[entry]; }
  std::array<double, 6> stress(int entry) const;  // xx, yy, zz, yz, xz, xy

  // The largest sqrt(lambda_max/(2 rho)), 1/s: no step of 1/rate or less is unstable.
  double step_rate() const { return step_rate_; }
  std::int64_t limiting_point() const { return limiting_point_; }
  // The new state becomes the present one, and that of the particles.
  void commit(ParticleCloud& cloud);
  // Of a particle of these ids, its entry; -1: none.
  int entry_of(std::int64_t id) const;
  // Bytes of bonds.
  std::size_t bond_bytes() const { return families_.bytes(); }

 private:
  void place(const std::vector<OwnPoint>& own, const Level& level, const ThreadTeam* team,
             Communicator& ranks);
  void evaluate(const ThreadTeam* team);
  void read(const ParticleCloud& cloud);
  void find_constants();
  void find_limits();
  void find_step_rate();
  void read_broken();
  void write_broken(const BondTile& tile, const BondChunk& chunk, int lane);
  BondInput input(const Columns3& u) const;
  template <class Work>
  void for_chunks(const ThreadTeam* team, Work work);

  const PeriScene* scene_;
  PointColumns columns_;
  PointTable points_;
  std::vector<std::vector<std::vector<int>>> entries_;  // by kind, box, particle
  Families families_;
  Motion present_, next_;
  Column mass_;
  Column B_, C_, D_, A_of_theta_, d_per_m_;  // constants of bonds, as bond_kernels.hpp has them
  Column sums_, theta_, A_;
  Columns3 force_;
  Column energy_;
  Column stretch_limit_, energy_limit_, never_, horizon_;
  std::vector<Column> broken_;
  std::vector<std::vector<unsigned char>> beyond_;  // by tile, chunk: a bond is beyond its limit
  std::vector<std::pair<std::int64_t, int>> by_id_;
  double step_rate_ = 0;
  std::int64_t limiting_point_ = -1;
};

}  // namespace sluice::peridynamics

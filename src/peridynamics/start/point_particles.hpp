// The points of all materials as the run keeps them: particles that live by their reference place.
#pragma once
#include <array>
#include <map>
#include <memory>

#include "framework/run/component/particle_method.hpp"
#include "mpm/start/seed.hpp"
#include "peridynamics/step/bonded_points.hpp"

namespace sluice::peridynamics {

class PointParticles final : public ParticleMethod {
 public:
  PointParticles(const PeriScene& scene, const Grid& grid);

  const std::vector<ParticleKind>& kinds() const override { return kinds_; }
  void start(int kind, const Level& level, const IndexBox& cells,
             ParticleSet& particles) const override;
  std::optional<std::int64_t> count_at_start(int kind, const Level& level,
                                             const IndexBox& cells) const override;
  void laid_out(const ParticleCloud& cloud, const ThreadTeam* team) const override;
  bool in_stages() const override { return true; }
  using ParticleMethod::in_stages;
  bool reflects(int, int, Side, IntVec3) const override { return false; }
  bool starts_at_zero(int kind, Label label) const override;
  std::vector<double> rates(const ParticleCloud& cloud, int level) const override;

  BondedPoints& bonded() const { return *bonded_; }
  int largest_family() const { return largest_family_; }
  double typical_family() const { return typical_family_; }

 private:
  void add_derived(ParticleKind& kind) const;
  void read_displacements();

  const PeriScene* scene_;
  mpm::Seeder seeder_;
  int largest_family_ = 0;
  double typical_family_ = 0;
  Carried carried_;
  // Of points of files that give them, by place.
  std::map<std::array<double, 3>, Vec3> displacements_;
  std::vector<ParticleKind> kinds_;
  std::unique_ptr<BondedPoints> bonded_;  // of the run that particles were laid out for last
};

}  // namespace sluice::peridynamics

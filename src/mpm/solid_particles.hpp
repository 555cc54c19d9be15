// The particles of all solids, as the run keeps them: what they carry, how they start.
#pragma once
#include "framework/run/component/particle_method.hpp"
#include "mpm/loads/load_curves.hpp"
#include "mpm/start/seed.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

class SolidParticles final : public ParticleMethod {
 public:
  SolidParticles(const Scene& scene, const MpmScene& solids);

  const std::vector<ParticleKind>& kinds() const override { return kinds_; }
  const std::vector<Carried>& carried() const { return carried_; }

  void start(int kind, const Level& level, const IndexBox& cells,
             ParticleSet& particles) const override;
  // Sizes below the first and parts that a surface cuts are left out.
  std::optional<std::int64_t> count_at_start(int kind, const Level& level,
                                             const IndexBox& cells) const override;
  bool reflects(int, int, Side, IntVec3) const override { return false; }
  bool in_stages() const override { return true; }
  using ParticleMethod::in_stages;
  void follow_wrapped(int kind, const Level& level, ParticleSet& set) const override;
  // Solids on a finer level stay there; else where stress or stretch exceed the deck's thresholds,
  // or everywhere where it names none.
  bool asks_refinement(int kind, const ParticleSet& set, std::size_t n, int level,
                       int coarse) const override;
  std::vector<Label> grid_labels() const override;
  bool starts_at_zero(int kind, Label label) const override;
  bool is_absent(const std::string& name) const override;
  void store_on_grid(const StageScope& scope, std::vector<GridFields>& by_level) const override;
  std::vector<double> rates(const ParticleCloud& cloud, int level) const override;

 private:
  void seed(int kind, const Level& level, const IndexBox& cells, ParticleSet& set) const;
  void put_seeded(int kind, const Level& level, const SeededParticles& seeded, std::size_t p,
                  ParticleSet& set) const;
  void mark(int kind, const Level& level, const SeededParticles& seeded, std::size_t p,
            ParticleSet& set) const;
  // Also raises the largest c_p/h.
  double rate_of_step(int kind, const Level& level, const ParticleSet& set, double& wave) const;

  const Scene* scene_;
  const MpmScene* solids_;
  Seeder seeder_;
  std::vector<Carried> carried_;  // by material
  std::vector<ParticleKind> kinds_;
  LoadCurves loads_;
};

}  // namespace sluice::mpm

// The particles of two methods as those of one: the kinds of the first come first.
//
// Of a component with parts that have particles each: solids that stages of the step move, and
// tracers that go with the flow once the step is accepted.
#pragma once
#include "framework/run/component/particle_method.hpp"

namespace sluice {

class JoinedParticles final : public ParticleMethod {
 public:
  // Keeps references to both.
  JoinedParticles(const ParticleMethod& first, const ParticleMethod& second);

  const std::vector<ParticleKind>& kinds() const override { return kinds_; }
  void start(int kind, const Level& level, const IndexBox& cells,
             ParticleSet& particles) const override;
  std::optional<std::int64_t> count_at_start(int kind, const Level& level,
                                             const IndexBox& cells) const override;
  void advance(int kind, const ParticleStep& step, ParticleSet& particles) const override;
  bool asks_refinement(int kind, const ParticleSet& set, std::size_t n, int level,
                       int coarse) const override;
  bool in_stages() const override { return first_->in_stages() || second_->in_stages(); }
  bool in_stages(int kind) const override;
  void follow_wrapped(int kind, const Level& level, ParticleSet& set) const override;
  // The maxima and the fields on the grid are those of the first.
  std::vector<double> rates(const ParticleCloud& cloud, int level) const override {
    return first_->rates(cloud, level);
  }
  std::vector<Label> grid_labels() const override { return first_->grid_labels(); }
  bool is_absent(const std::string& name) const override {
    return first_->is_absent(name) && !carries(*second_, name);
  }
  void store_on_grid(const StageScope& scope, std::vector<GridFields>& by_level) const override {
    first_->store_on_grid(scope, by_level);
  }
  bool reflects(int kind, int level, Side side, IntVec3 cell) const override;
  void laid_out(const ParticleCloud& cloud, const ThreadTeam* team) const override {
    first_->laid_out(cloud, team);
    second_->laid_out(cloud, team);
  }

 private:
  // The method of a kind, whose number becomes that of it there.
  const ParticleMethod& of(int& kind) const;
  static bool carries(const ParticleMethod& method, const std::string& name);

  const ParticleMethod *first_, *second_;
  std::vector<ParticleKind> kinds_;
};

}  // namespace sluice

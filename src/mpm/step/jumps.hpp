// InsertParticles: particles of a colour are elsewhere at the end of a step, with another velocity.
#pragma once
#include "mpm/loads/insertions.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class Jumps final : public SolidEffect {
 public:
  explicit Jumps(std::vector<Insertion> all) : all_(std::move(all)) {}
  void begin(const StageScope& scope) override {
    now_ = insertions_in(all_, scope.step.time, scope.step.dt);
  }
  void to_particles(const Chunk& chunk) override;

 private:
  void jump(const Chunk& chunk, int q, const Insertion& by) const;

  std::vector<Insertion> all_, now_;  // of the run, of this step
};

}  // namespace sluice::mpm

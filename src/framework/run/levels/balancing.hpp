// Moves boxes to other ranks where that makes the busiest rank faster.
#pragma once
#include "framework/run/levels/levels.hpp"
#include "framework/run/levels/particle_cloud.hpp"

namespace sluice {

class Balancing {
 public:
  // `particles`: null without any.
  Balancing(const Scene& scene, Communicator& communicator, Levels& levels,
            ParticleCloud* particles)
      : scene_(&scene), communicator_(&communicator), levels_(&levels), particles_(particles) {}

  // True when boxes have moved. Looks after three coarse steps, then every 50. Collective.
  bool balance(int step);
  // Goes on from that of an earlier part of the run.
  void succeed(const Balancing& earlier);

  // How often boxes moved, and the wall time of it.
  int count() const { return count_; }
  double seconds() const { return seconds_; }

 private:
  const Scene* scene_;
  Communicator* communicator_;
  Levels* levels_;
  ParticleCloud* particles_;
  int next_ = 3;  // step of the next look
  int count_ = 0;
  double seconds_ = 0;
};

}  // namespace sluice

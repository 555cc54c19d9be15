// What points carry from step to step, and where it stands among the columns of their particles.
#pragma once
#include <vector>

#include "framework/run/component/particle_method.hpp"
#include "peridynamics/deck/peri_scene.hpp"

namespace sluice::peridynamics {

// First of the columns; -1: points of this scene have none.
struct PointColumns {
  int volume = 0, mass = 1;
  int displacement = 2, velocity = 5;
  int broken = -1, broken_count = 0;  // bits of broken bonds, 52 a column
};

inline constexpr int bits_of_column = 52;

struct PointLabels {
  Label volume, mass, displacement, velocity;  // what points carry
  Label acceleration, internal_force, dilatation, damage, neighbours, reference, horizon,
      energy_density, weighted_volume, stress;
};
const PointLabels& point_labels();
Label broken_label(int column);

struct Carried {
  PointColumns columns;
  std::vector<ParticleAttribute> attributes;
};
// `family`: no point has more neighbours.
Carried carried_by(const PeriScene& scene, int family);

}  // namespace sluice::peridynamics

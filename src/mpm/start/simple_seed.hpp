#pragma once
#include "framework/grid/index_box.hpp"
#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/start/seeded_particles.hpp"
namespace sluice::mpm {
SeededParticles seed_simply(const SolidMaterial& material, const Level& level, const IndexBox& cells);
}

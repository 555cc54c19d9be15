// One material on the nodes of a level, and the blocks of its particles.
#pragma once
#include <vector>

#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/nodes/node_blocks.hpp"
#include "mpm/step/body_energy.hpp"
#include "mpm/step/columns.hpp"
#include "mpm/step/rates.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// The particles of one block of a box, as threads take them.
struct BlockWork {
  int kind = 0;
  const ParticleSet* set = nullptr;
  ParticleSet* next = nullptr;
  BlockRun run;
  int box = 0;                                // local number
  IntVec3 lowest{}, highest{};                // nodes that they reach
  IntVec3 middle_lowest{}, middle_highest{};  // at the middle of the step: midpoint transfer
};

// What every scene asks of a material there. Arrays of effects stand with these.
struct Body {
  Body(const SolidMaterial& of, const Carried& what, const BlockShape& shape)
      : material(&of), carried(&what), table(shape) {}

  const SolidMaterial* material;
  const Carried* carried;
  BlockTable table;
  NodeLanes nodes;
  TransferGrid grid;
  KindRates rates;
  SumUnits units;
  EnergyUnits energy_units;
  double most_force = 0;  // from outside on one particle, any component, N; of all levels
};

// Axes and active directions of a level, widths of particles.
TransferGrid transfer_grid(const MpmScene& solids, const Level& level,
                           const std::array<double, 3>& half);

}  // namespace sluice::mpm

// What a step sums for the books of a run, beside what its particles tell.
#pragma once
#include <array>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "mpm/step/body_energy.hpp"

namespace sluice::mpm {

struct StepSums {
  // Impulse of boundary values; of body forces; work of both; of contact: what friction and impacts
  // took from the nodes' kinetic energy, force and torque on masters. Of nodes: what they gained of
  // kinetic energy, K* - K, and the work of the forces that particles gave them.
  enum Index {
    impulse_x,
    impulse_y,
    impulse_z,
    force_x,
    force_y,
    force_z,
    work,
    force_work,
    contact_loss,
    node_gain,
    node_work,
    // Of the midpoint transfer: what kicks gave to particles beyond that gain of nodes.
    beyond_nodes,
    inner_gain,  // what spins and affine velocities within particles got
    lost_heat,   // what of the energy lost became heat
    open_gain,   // of it, what is not lost yet: motion within cells, the open half of a step
    load_work,   // of forces from outside on particles, within node_work and force_work
    reaction_x,
    reaction_y,
    reaction_z,
    torque_x,
    torque_y,
    torque_z,
    // Beside a fluid: heat that particles exchange with it; what its forces on corners work on
    // nodes; what exchange adds to the kinetic energy of particles; what solids work on it, less
    // that of the reference pressure. J
    heat_from_fluid,
    corner_work,
    exchange_gain,
    surface_work,
    // What particles that leave the domain take along: momentum, kinetic and internal energy, the
    // work of the reference pressure on their volume. Behind `count` their mass, by material; then
    // the sums of BodyEnergySums, material by material.
    left_x,
    left_y,
    left_z,
    left_kinetic,
    left_internal,
    left_reference,
    count
  };
  static std::size_t of_body(std::size_t materials, std::size_t body) {
    return count + materials + body * BodyEnergySums::count;
  }
  static std::size_t all(std::size_t materials) { return of_body(materials, materials); }
};

// Exact sums over nodes; impulses that bodies that transmit forces gave to others, by body.
using Impulse = std::array<ExactSum, 3>;
using MassAndImpulse = std::array<ExactSum, 4>;
struct NodeBooks {
  std::array<ExactSum, StepSums::count> sums;
  std::vector<Impulse> given;
  std::vector<BodyEnergySums> bodies;

  // For so many bodies, each of which may transmit forces.
  void make_room(std::size_t count);
  void merge(const NodeBooks& other);
  void add(int sum, double value) { sums[static_cast<std::size_t>(sum)].add(value); }
  BodyEnergySums& body(int m) { return bodies[static_cast<std::size_t>(m)]; }
};

}  // namespace sluice::mpm

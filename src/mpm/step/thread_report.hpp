// What the threads of a step report, each of its own particles.
#pragma once
#include "mpm/step/law_batch.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpm/transfer/impulses_from_grid.hpp"

namespace sluice::mpm {

// Its window, buffers of a chunk of particles, and what these came to.
struct SolidStep::ThreadReport {
  ThreadReport(const BlockShape& shape, std::size_t kinds)
      : window(shape, 1),
        friction(shape, 1),
        loss_nodes(shape, 1),
        loss_mapped(shape, 1),
        loss_before(shape, 1),
        loss_after(shape, 1),
        rates(kinds) {
    books.bodies.resize(kinds);
  }

  Window window, friction;
  Window loss_nodes, loss_mapped, loss_before, loss_after;  // step/lost_energy.cpp
  std::unique_ptr<PoreWater::Reads> water;                  // null until a material has some
  GridAtParticles read, loss_read;
  ImpulsesAtParticles impulses;
  alignas(64) double wave_speed[chunk_size], heating[chunk_size];
  double rate = 0;    // of the time step, 1/s
  double travel = 0;  // farthest way of a particle, cells
  bool left = false;
  Vec3 up{}, down{};  // of x and -x at the middle of the step, of a block
  std::vector<KindRates> rates;
  NodeBooks books;  // of loads, and of rigid bodies with a prescribed motion
  LawBatch columns;
  std::vector<double> dilatation;
  std::string fault;  // of the particle with the lowest id; empty: none
  std::int64_t fault_id = 0;

  void keep_fault(std::int64_t id, std::string text) {
    if (!fault.empty() && fault_id <= id) return;
    fault = std::move(text);
    fault_id = id;
  }
};

}  // namespace sluice::mpm

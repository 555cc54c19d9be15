// Particles in the hands of a thread, what it needs for them, and what they come to.
#pragma once
#include <string>
#include <vector>

#include "framework/run/component/step_shape.hpp"
#include "mpm/step/body.hpp"
#include "mpm/step/law_batch.hpp"
#include "mpm/step/step_sums.hpp"
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/impulses_from_grid.hpp"

namespace sluice::mpm {

// What a thread reports of its particles; then all of them.
struct StepReport {
  explicit StepReport(std::size_t kinds) : rates(kinds) { books.bodies.resize(kinds); }

  void keep_fault(std::int64_t id, std::string text);
  void merge(const StepReport& other);

  double rate = 0;    // of the time step, 1/s
  double travel = 0;  // farthest way of a particle, cells
  bool left = false;  // a particle is out of the domain
  std::vector<KindRates> rates;
  NodeBooks books;    // of loads, and of rigid bodies with a prescribed motion
  std::string fault;  // of the particle with the lowest id; empty: none
  std::int64_t fault_id = 0;
};

// Buffers of a thread.
struct ChunkBuffers {
  explicit ChunkBuffers(const BlockShape& shape) : window(shape, 1) {}

  Window window;  // the nodes of which particles read
  GridAtParticles read;
  ImpulsesAtParticles impulses;  // of the midpoint transfer
  // Of the law: m/s, K/s, dT/T of the step along an isentrope.
  alignas(64) double wave_speed[chunk_size], heating[chunk_size], isentropic[chunk_size];
  Vec3 up{}, down{};  // of x and -x at the middle of the step, of a block
  LawBatch columns;
  std::vector<double> shared;  // dilatation of the particles of a block
};

// n particles from `at` on, of a block.
struct Chunk {
  const BlockWork* work;
  const Body* body;
  const StageScope* scope;
  ChunkBuffers* buffers;
  StepReport* report;
  int thread = 0;
  std::size_t at = 0;
  int n = 0;

  int kind() const { return work->kind; }
  const Columns& columns() const { return body->carried->columns; }
  double dt() const { return scope->step.dt; }
  // Of these particles: a column as it was, and as the step makes it.
  const double* old(int column) const {
    return work->set->column(static_cast<std::size_t>(column)) + at;
  }
  double* made(int column) const {
    return work->next->column(static_cast<std::size_t>(column)) + at;
  }
  GridAtParticles& read() const { return buffers->read; }
  BodyEnergySums& sums() const { return report->books.body(kind()); }
};

// act(chunk) for the particles of a block, chunk after chunk.
template <class Act>
void for_each_chunk(Chunk chunk, Act&& act) {
  const BlockRun& run = chunk.work->run;
  for (chunk.at = run.begin; chunk.at < run.end; chunk.at += chunk_size) {
    chunk.n = static_cast<int>(std::min<std::size_t>(chunk_size, run.end - chunk.at));
    act(chunk);
  }
}

}  // namespace sluice::mpm

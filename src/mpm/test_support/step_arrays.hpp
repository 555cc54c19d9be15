// The arrays of a step of solids, of a deck, on one level and rank: for tests that build a part of
// the step alone.
#pragma once
#include <deque>
#include <memory>
#include <stdexcept>

#include "framework/base/communicator.hpp"
#include "framework/particle/block_order.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/solid_particles.hpp"
#include "mpm/step/chunk.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/particles_to_nodes.hpp"
#include "mpm/step/sum_bounds.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm {

struct StepArrays {
  explicit StepArrays(const SolidDeck& deck, const std::string& component = "mpm")
      : read(read_of(deck, component)), team(1) {
    if (any_error(read.faults)) throw std::runtime_error(read.text);
    method = std::make_unique<SolidParticles>(read.scene, read.solids);
    nodes.level = read.scene.grid.levels.front();
    nodes.shape = block_shape(nodes.level.active);
    nodes.boundary = std::make_unique<NodeBoundary>(read.scene, read.solids, nodes.level);
    nodes.exchange = std::make_unique<NodeExchange>(nodes.level, world());
    nodes.team = &team;
    buffers = ChunkBuffers(nodes.shape);
    for (std::size_t m = 0; m < read.solids.materials.size(); ++m) add_body(m);
    find_units();
    scope.ranks = &world();
    scope.step.dt = scope.dt_before = 1e-3;
  }
  StepArrays(const StepArrays&) = delete;
  StepArrays& operator=(const StepArrays&) = delete;

  const MpmScene& solids() const { return read.solids; }
  const Columns& columns(std::size_t m) const { return method->carried()[m].columns; }
  double* column(std::size_t m, int number) {
    return sets[m].column(static_cast<std::size_t>(number));
  }
  const double* made(std::size_t m, int number) const {
    return nexts[m].column(static_cast<std::size_t>(number));
  }
  // After particles were changed: bounds and units of sums.
  void find_units() {
    for (std::size_t m = 0; m < bodies.size(); ++m) {
      Body& b = bodies[m];
      b.rates = rates_of(solids().basis, b.grid, sets[m], sets[m], columns(m), 0, sets[m].size());
      const LevelSpacings spacings{nodes.level.spacing, nodes.level.spacing};
      b.units = sum_units(solids(), *nodes.boundary, spacings, b, static_cast<int>(m), b.rates, 0);
      b.energy_units = energy_units(solids(), nodes.level, b, true);
    }
  }
  // Particles to nodes, images to their nodes.
  void give(const SolidEffectList& effects = {}) {
    ParticlesToNodes(solids(), nodes, bodies).give(work, effects);
    for (std::size_t m = 0; m < bodies.size(); ++m)
      nodes.boundary->fold(static_cast<int>(m), bodies[m].table, bodies[m].nodes);
  }
  // All particles of a body (at most chunk_size), in the hands of a thread.
  Chunk chunk(std::size_t m) {
    for (const BlockWork& w : work)
      if (w.kind == static_cast<int>(m)) {
        Chunk c{&w, &bodies[m], &scope, &buffers, &report};
        c.at = w.run.begin;
        c.n = static_cast<int>(w.run.end - w.run.begin);
        return c;
      }
    throw std::logic_error("a body without particles");
  }
  // act(lanes of a node, its index) for nodes of a body with mass.
  template <class Act>
  void for_each_full(std::size_t m, const NodeLanes& of, Act&& act) const {
    const BlockTable& table = bodies[m].table;
    for (int b = 0; b < table.count(); ++b)
      for_each_node(nodes.shape, nodes.lower(table, b), [&](int n, IntVec3 at) {
        const std::int64_t* node = of.sums(b) + n * lanes;
        if (node[count_lane] != 0) act(node, at);
      });
  }

  ReadDeck read;
  ThreadTeam team;
  std::unique_ptr<SolidParticles> method;
  LevelNodes nodes;
  std::deque<ParticleSet> sets, nexts;  // by material
  std::vector<Body> bodies;
  std::vector<BlockWork> work;
  StageScope scope;
  ChunkBuffers buffers{BlockShape{}};
  StepReport report{8};

 private:
  static ReadDeck read_of(const SolidDeck& deck, const std::string& component) {
    std::string text = text_of(deck);
    const std::string usual = "type='mpm'";
    text.replace(text.find(usual), usual.size(), "type='" + component + "'");
    ReadDeck read;
    read.deck = load_deck_text(text, "solids.ups", {}, solid_schema());
    finish_reading(read);
    return read;
  }
  void add_body(std::size_t m) {
    const Carried& carried = method->carried()[m];
    const ParticleKind& kind = method->kinds()[m];
    bodies.emplace_back(solids().materials[m], carried, nodes.shape);
    bodies.back().grid = transfer_grid(solids(), nodes.level, carried.half);
    ParticleSet& set = sets.emplace_back(kind.columns());
    method->start(static_cast<int>(m), nodes.level, nodes.level.domain, set);
    const std::vector<BlockRun> runs = sort_by_blocks(set, nodes.level);
    ParticleSet& next = nexts.emplace_back(kind.columns());
    next.make_room(set, kind.advanced_columns());
    for (const BlockRun& run : runs) {
      BlockWork& w = work.emplace_back();
      w.kind = static_cast<int>(m);
      w.set = &set;
      w.next = &next;
      w.run = run;
    }
  }
};

}  // namespace sluice::mpm

// All particles of a run, on the levels as they are: start, steps, output, restart.
//
// Particles live on the finest level that holds their cell. A coarse step is taken, once it is
// accepted, in as many parts as the finest level has substeps; between parts particles change box,
// rank and level. Numbers and order of particles depend on none of these.
#pragma once
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "framework/archive/field_piece.hpp"
#include "framework/particle/domain_ends.hpp"
#include "framework/particle/particle_store.hpp"
#include "framework/run/component/particle_method.hpp"
#include "framework/run/component/run_report.hpp"
#include "framework/run/levels/level_solver.hpp"

namespace sluice {

class ArchiveStep;

// What is written of particles; `numbers` holds what views point into.
struct ParticlePieces {
  std::vector<FieldPiece> pieces;
  std::deque<std::vector<double>> numbers;
};

class ParticleCloud {
 public:
  using Levels = std::vector<LevelSolver*>;  // that exist, coarse to fine

  ParticleCloud(const ParticleMethod& method, Communicator& communicator);

  void start(const Levels& levels, double time);
  // A coarse step that ends at `end`: states before and after it, ghosts filled; of the kinds that
  // no stage moves. Collective.
  void advance(const Levels& levels, double end, int parts);
  // Of a method in stages: what was made beside the particles (next) is what they are at `end`.
  void commit(double end);
  // Particles that left the domain go, periodic ones are wrapped, all go to their boxes: needed
  // when one may have left its domain, or its block by most of a cell. Collective.
  void relocate();
  // The numbers of those in a box that relocate() drops: they have left the domain.
  std::vector<std::uint32_t> leaving(int kind, int level, int box) const;
  // Of those in a box only the particles numbered `kept` stay, in that order; relocate() is next.
  void keep_only(int kind, int level, int box, const std::vector<std::uint32_t>& kept);
  // A copy of particle n of a box at another place (m), with a number of its own; relocate() is
  // next.
  void add_copy(int kind, int level, int box, std::size_t n, Vec3 place, std::int64_t id);
  // Particles of a box to other kinds that carry the same: to[k][n], of particle n of kind k, none
  // of a kind where to[k] is empty. They count as made of the new kind. relocate() is next.
  void change_kinds(int level, int box, const std::vector<std::vector<int>>& to);
  // ParticleMethod::rates of all ranks. Collective.
  std::vector<double> rates(int level) const;
  // Boxes have changed. Collective.
  void follow(const Levels& levels);
  // InputError where the checkpoint is that of a run with other particles.
  void restore(const ArchiveStep& checkpoint, const Levels& levels);
  // The particles of another method with kinds of the same materials, on levels like these: what
  // both carry, the rest zero. Collective.
  void succeed(const ParticleCloud& earlier, const Levels& levels);

  int level_count() const { return static_cast<int>(box_seconds_.size()); }
  const Level& level(int l) const { return map_->levels()[l]; }
  // Labels that can be saved.
  std::vector<Label> labels() const;
  // Of all labels for which `wanted`; position and id come with any of them.
  using Wanted = std::function<bool(Label label, int material, int level)>;
  void add_pieces(const Wanted& wanted, ParticlePieces& pieces) const;

  // Cells of a level that hold particles of this rank, for each kind that asks for finer levels.
  std::vector<FlagSeeds> flag_seeds(int level) const;

  int kind_count() const { return static_cast<int>(kinds_.size()); }
  ParticleStore& store(int kind) { return kinds_[kind].store; }
  const ParticleStore& store(int kind) const { return kinds_[kind].store; }
  std::vector<ParticleCount> counts() const;  // collective
  std::int64_t local_count() const;           // of this rank, all kinds
  // Wall seconds spent on the particles of each local box of a level since boxes were laid out;
  // estimated by their number where they step in stages.
  const std::vector<double>& box_seconds(int level) const { return box_seconds_[level]; }
  // For checkpoints. Collective.
  std::string state() const;

 private:
  struct Kind {
    ParticleStore store;
    std::int64_t made = 0, left = 0;  // by this rank
  };
  void lay_out(const Levels& levels);
  void settle();
  void advance_box(int kind, LevelSolver& level, int box, ParticleStep step);
  void keep_inside(int kind, const Level& level, ParticleSet& set);
  Reflects reflects(int kind, const Level& level) const;

  const ParticleMethod* method_;
  Communicator* communicator_;
  std::unique_ptr<ParticleMap> map_;
  std::vector<Kind> kinds_;
  std::vector<std::vector<double>> box_seconds_;  // by level, local box
  double time_ = 0;                               // of the particles
};

}  // namespace sluice

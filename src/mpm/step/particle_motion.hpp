// How the particles of a body move, and of which velocities of nodes their gradients are: one class
// for each way in which a transfer does it.
//
// In one pass particles take new velocities, places and gradients from the same nodes. Where their
// new velocities go back to nodes (MappedBack) there are two: the first makes these velocities, the
// last reads what became of them on nodes.
#pragma once
#include "mpm/step/chunk.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/mapped_back.hpp"
#include "mpm/step/transmitted_forces.hpp"

namespace sluice::mpm {

class ParticleMotion {
 public:
  virtual ~ParticleMotion() = default;

  // The first of two passes: the nodes around a block; its chunks; all of the block (bounds of what
  // goes back to nodes).
  virtual void load_first(const BlockWork& /*work*/, const Body& /*body*/,
                          ChunkBuffers& /*buffers*/) const {}
  virtual void first(const Chunk& /*chunk*/) const {}
  virtual void end_first(BlockWork& /*work*/, const Chunk& /*block*/) const {}
  // The last: the nodes around a block; L of a chunk, which moves nothing; its new places, in one
  // pass its new velocities too, and its L.
  virtual void load(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const = 0;
  virtual void read_gradient(const Chunk& chunk) const = 0;
  virtual void last(const Chunk& chunk) const = 0;
};

// The transfers that take all from the nodes of the step.
class OnePassMotion final : public ParticleMotion {
 public:
  OnePassMotion(const MpmScene& solids, const Level& level) : solids_(&solids), level_(&level) {}
  void load(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const override;
  void read_gradient(const Chunk& chunk) const override;
  void last(const Chunk& chunk) const override;

 private:
  const MpmScene* solids_;
  const Level* level_;
};

// MUSL: particles move first, gradients are those of their new velocities.
class MuslMotion final : public ParticleMotion {
 public:
  MuslMotion(const MpmScene& solids, const Level& level, const MappedBack& mapped)
      : solids_(&solids), level_(&level), mapped_(&mapped) {}
  void load_first(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const override;
  void first(const Chunk& chunk) const override;
  void end_first(BlockWork& work, const Chunk& block) const override;
  void load(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const override;
  void read_gradient(const Chunk& chunk) const override;
  void last(const Chunk& chunk) const override { read_gradient(chunk); }

 private:
  const MpmScene* solids_;
  const Level* level_;
  const MappedBack* mapped_;
};

// Rigid bodies go with their own velocity, with that which a rule of contact prescribes, or, where
// they transmit forces, with what these make of it.
class RigidMotion final : public ParticleMotion {
 public:
  // Keeps references. `rules`: null without contact.
  RigidMotion(const MpmScene& solids, const Level& level, const Contact* rules,
              const TransmittedForces& transmitted)
      : solids_(&solids), level_(&level), rules_(rules), transmitted_(&transmitted) {}
  void first(const Chunk& chunk) const override;
  void end_first(BlockWork& work, const Chunk& block) const override;
  void load(const BlockWork& /*work*/, const Body& /*body*/, ChunkBuffers& /*b*/) const override {}
  void read_gradient(const Chunk& chunk) const override;
  void last(const Chunk& chunk) const override;

 private:
  void read(const Chunk& chunk, bool booked) const;
  void read_particle(const Chunk& chunk, int q, const MasterMotion* motion, Vec3 pushed,
                     bool booked) const;

  const MpmScene* solids_;
  const Level* level_;
  const Contact* rules_;
  const TransmittedForces* transmitted_;
};

// Positions and velocities after the step, of what was read; corners with them. FLIP: v + dv; PIC
// and APIC: u; XPIC: the filtered velocity and dv, which nodes hold as one, and places move with u;
// as the format has XPIC2, by dt S v + dt (v_new - v)/2.
void move_by_transfer(const MpmScene& solids, const Level& level, const Chunk& chunk);
// How far particles have gone, and whether they left the domain.
void report_ways(const Level& level, const Chunk& chunk);
// Bounds of the new velocities of a block.
void report_velocities(const Chunk& block);

}  // namespace sluice::mpm

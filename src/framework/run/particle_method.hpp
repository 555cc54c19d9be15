// What a component that carries particles offers to the run loop.
//
// The run keeps the particles with the levels: it moves them between boxes, ranks and levels,
// writes and restores them. The method says which there are, starts them and takes them through
// time. A component without particles offers none, and then nothing of this exists.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/grid/side.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

// The particles of one material. Position and id have the labels of particle_labels().
struct ParticleKind {
  std::string name;
  int material = 0;
  std::vector<Label> attributes;  // real numbers, in the order of ParticleSet
  // Cells with such particles ask for a finer level as far as this around them; below 0: they do
  // not.
  double refine_distance = -1;
};

// A part of a coarse step, of one local box.
struct ParticleStep {
  double begin = 0, end = 0;             // of the part
  double old_time = 0, new_time = 0;     // of the states
  const Warehouse* old_state = nullptr;  // at the start and the end of the coarse step, ghosts
  const Warehouse* new_state = nullptr;  // filled; of the level on which the particles live
  int box = 0;                           // local number
  std::span<const IndexBox> cells;       // of the box that no finer level covers
};

class ParticleMethod {
 public:
  virtual ~ParticleMethod() = default;

  virtual const std::vector<ParticleKind>& kinds() const = 0;
  // Adds the particles that are in these cells at the start.
  virtual void start(int kind, const Level& level, const IndexBox& cells,
                     ParticleSet& particles) const = 0;
  // Takes particles from begin to end, to where they may be out of box and domain, by no more than
  // the ghost layers allow; adds those that appear meanwhile.
  virtual void advance(int kind, const ParticleStep& step, ParticleSet& particles) const = 0;
  // Does the boundary throw particles back at the face of this cell; else it lets them out.
  virtual bool reflects(int kind, int level, Side side, IntVec3 cell) const = 0;
};

// Of every kind.
struct ParticleLabels {
  Label position, id;
};
const ParticleLabels& particle_labels();

}  // namespace sluice

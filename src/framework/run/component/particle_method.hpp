// What a component that carries particles offers to the run loop.
//
// The run keeps the particles with the levels: it moves them between boxes, ranks and levels,
// writes and restores them. The method says which there are, starts them and takes them through
// time. A component without particles offers none, and then nothing of this exists.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/grid/side.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

// What each particle carries beside position and id.
struct ParticleAttribute {
  Label label;
  // A step writes it anew, beside what was before it (ParticleCloud::next).
  bool advanced = false;
  // Of a symmetric tensor six columns are kept: xx, yy, zz, yz, xz, xy.
  bool symmetric = false;

  ParticleAttribute(Label of, bool is_advanced = false, bool is_symmetric = false)
      : label(of), advanced(is_advanced), symmetric(is_symmetric) {}
  int columns() const { return symmetric ? 6 : component_count(label.info().type); }
};

// What is saved of particles and follows from what they carry; `columns` are of its components.
struct DerivedAttribute {
  Label label;
  std::function<void(const ParticleSet&, std::vector<std::vector<double>>& columns)> compute;
};

// The particles of one material. Position and id have the labels of particle_labels().
struct ParticleKind {
  std::string name;
  int material = 0;
  std::vector<ParticleAttribute> attributes;  // in the order of the columns of ParticleSet
  // Cells with such particles ask for a finer level as far as this (m) around them; below 0: they
  // do not.
  double refine_distance = -1;
  // Kept in blocks of 64 cells, in any order inside; by cell and id otherwise.
  bool by_blocks = false;
  std::vector<DerivedAttribute> derived;
  // Of particles that live by another place than where they are, such as that of the start: where
  // they are (p.x of archives), and the label by which the other is saved and restored.
  std::optional<DerivedAttribute> present;
  Label home;

  std::size_t columns() const;
  std::vector<std::size_t> advanced_columns() const;
};

// A part of a coarse step, of one local box. Times in s.
struct ParticleStep {
  double begin = 0, end = 0;             // of the part
  double old_time = 0, new_time = 0;     // of the states
  const Warehouse* old_state = nullptr;  // at the start and the end of the coarse step, ghosts
  const Warehouse* new_state = nullptr;  // filled; of the level on which the particles live
  int box = 0;                           // local number
  std::span<const IndexBox> cells;       // of the box that no finer level covers
};

class GridFields;
class ParticleCloud;
class ThreadTeam;
struct StageScope;

class ParticleMethod {
 public:
  virtual ~ParticleMethod() = default;

  virtual const std::vector<ParticleKind>& kinds() const = 0;
  // Adds the particles that are in these cells at the start.
  virtual void start(int kind, const Level& level, const IndexBox& cells,
                     ParticleSet& particles) const = 0;
  // Particles have been put into the boxes in which they live from now on. Collective.
  virtual void laid_out(const ParticleCloud& /*cloud*/, const ThreadTeam* /*team*/) const {}
  // How many start() adds there, found without making any; nothing where that is not known.
  virtual std::optional<std::int64_t> count_at_start(int /*kind*/, const Level& /*level*/,
                                                     const IndexBox& /*cells*/) const {
    return {};
  }
  // Takes particles from begin to end, to where they may be out of box and domain, by no more than
  // the ghost layers allow; adds those that appear meanwhile.
  virtual void advance(int /*kind*/, const ParticleStep& /*step*/,
                       ParticleSet& /*particles*/) const {}
  // Does a particle on `level` ask for a finer one than `coarse`, where its kind asks at all.
  virtual bool asks_refinement(int /*kind*/, const ParticleSet& /*set*/, std::size_t /*n*/,
                               int /*level*/, int /*coarse*/) const {
    return true;
  }
  // Stages of the step move the particles (StepFacet::declare_stages): advance() is not asked.
  virtual bool in_stages() const { return false; }
  // The same of one kind: others of the method may move by advance() all the same.
  virtual bool in_stages(int /*kind*/) const { return in_stages(); }
  // The run has taken particles of a set across periodic sides: places that they carry follow.
  virtual void follow_wrapped(int /*kind*/, const Level& /*level*/, ParticleSet& /*set*/) const {}
  // Of particles in stages: what the next step's length and sums rest on, of this rank's particles
  // on a level; as many maxima as the component reduces, in its units.
  virtual std::vector<double> rates(const ParticleCloud& /*cloud*/, int /*level*/) const {
    return {};
  }
  // What particles have on the grid, computed when it is saved, of a state between two steps: into
  // the labels that the fields of each level have. Collective.
  virtual std::vector<Label> grid_labels() const { return {}; }
  // Is an attribute zero in every particle at a start.
  virtual bool starts_at_zero(int /*kind*/, Label /*label*/) const { return false; }
  // Is it a label that particles have in other scenes alone: nothing is saved of it.
  virtual bool is_absent(const std::string& /*name*/) const { return false; }
  virtual void store_on_grid(const StageScope& /*scope*/,
                             std::vector<GridFields>& /*by_level*/) const {}
  // Does the boundary throw particles back at the face of this cell; else it lets them out.
  virtual bool reflects(int kind, int level, Side side, IntVec3 cell) const = 0;
};

// Of every kind.
struct ParticleLabels {
  Label position, id;
};
const ParticleLabels& particle_labels();

}  // namespace sluice

// All solids of a level in a step: their particles on this rank, with their outer faces.
#pragma once
#include "framework/run/levels/particle_cloud.hpp"
#include "mpmice/fields/near_cells.hpp"
#include "mpmice/surfaces/solid_set.hpp"

namespace sluice::mpmice {

template <int D>
class SolidSets {
 public:
  // `kinds`: of the run, which must live as long. `burn`: particles lose mass, so that the faces
  // between those that differ in what is left count too.
  SolidSets(const std::vector<solids::SolidKind>& kinds, bool burn) : kinds_(&kinds), burn_(burn) {}

  // The sets of the particles of a level, as a step begins.
  void list(ParticleCloud& cloud, int level);
  // Adds the cells in which they may lie during a step of dt.
  void add_cells(const Frame<D>& frame, double dt, OccupiedCells<D>& to);
  // Their faces as they are at the start of the step; where they have `moved`, at both ends. Those
  // that have strayed from where the arrays have room for them count as at rest: the step cannot be
  // taken. Collective where particles burn.
  void find_faces(const NearCells<D>& near, bool moved, Communicator& ranks);
  // Has any of this rank done so.
  bool strayed() const { return strayed_; }
  static std::string stray_reason();

  std::vector<SolidSet<D>>& all() { return sets_; }
  const std::vector<SolidSet<D>>& all() const { return sets_; }
  const solids::SolidKind& kind_of(const SolidSet<D>& s) const {
    return (*kinds_)[static_cast<std::size_t>(s.kind)];
  }
  const std::vector<solids::SolidKind>& kinds() const { return *kinds_; }
  bool all_rigid() const;
  // Pa.
  double reference_pressure() const { return solids::reference_pressure(*kinds_); }

 private:
  bool stay_near(const NearCells<D>& near) const;
  void cut(const ThreadTeam& team, SolidSet<D>& s) const;

  const std::vector<solids::SolidKind>* kinds_;
  bool burn_;
  bool strayed_ = false;
  std::vector<SolidSet<D>> sets_;
};

}  // namespace sluice::mpmice

// Forces on particles from outside, at the time of the positions: load curves, forces that point
// files give, body forces of manufactured solutions. Of axisymmetric bodies also the hoop stress,
// which acts like a force -V sigma_tt/r along r (x is r).
//
// They stand beside the particles during a step; nothing of them is state but which particles the
// loads act on and how many these are.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/loads/corner_loads.hpp"
#include "mpm/loads/load_curves.hpp"
#include "mpm/loads/manufactured.hpp"
#include "mpm/step/columns.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

// The motion of RunMMSProblem in a material; null: there is none.
std::unique_ptr<Manufactured> manufactured_of(const MpmScene& solids, const SolidMaterial& material,
                                              const Level& level);

class OutsideForces {
 public:
  using Columns3 = std::array<const double*, 3>;

  OutsideForces(const MpmScene& solids, const Level& level, const std::vector<Carried>& carried);

  // Is there any force on the particles of a kind.
  bool acts(int kind) const { return acts_[static_cast<std::size_t>(kind)]; }
  bool any() const;
  // Of every load the number of particles on all levels that it acts on: taken once, when the run
  // begins, and kept with the run; `kept` are those of a checkpoint, or zeros. Collective.
  void count(const ParticleCloud& cloud, Communicator& ranks, std::span<const double> kept);
  const std::vector<double>& counts() const { return counts_; }

  // For all sets of a level, before any of them is filled.
  void make_room(const ParticleCloud& cloud, int level);
  // For one set of so many particles of a kind, as box 0.
  void make_room(int kind, std::size_t count);
  // Forces on particles begin to end of a set at this time; sets of boxes may be filled side by
  // side. The largest component.
  double fill(int kind, int box, const ParticleSet& set, std::size_t begin, std::size_t end,
              double time);
  Columns3 forces(int kind, int box) const;  // null where none act
  // Those that act in the middle of the particles: without loads on corners.
  Columns3 middle_forces(int kind, int box) const;
  // Loads on corners (use_CBDI_boundary_condition) of particles begin to end, after fill().
  void add_corners(int kind, int box, const ParticleSet& set, std::size_t begin, std::size_t end,
                   solids::CornerForces& to) const;
  // Without the hoop stress, which does no work from outside.
  double hoop(int kind, const ParticleSet& set, std::size_t p) const;

  const LoadCurves& loads() const { return loads_; }
  LoadedParticles loaded(int kind, const ParticleSet& set, std::size_t begin,
                         std::size_t end) const;

 private:
  using Forces = std::array<std::vector<double>, 3>;

  void add_manufactured(int kind, const ParticleSet& set, std::size_t begin, std::size_t end,
                        double time, Forces& to) const;

  const MpmScene* solids_;
  Level level_;
  const std::vector<Carried>* carried_;
  LoadCurves loads_;
  std::vector<std::unique_ptr<Manufactured>> motions_;  // by kind
  std::vector<bool> acts_;
  std::vector<double> counts_;
  bool counted_ = false;
  std::vector<std::vector<Forces>> forces_;  // by kind, local box
  std::vector<std::vector<Forces>> middle_;  // likewise, where loads act on corners
};

// L_tt = v_r/r of particles at, ..., at + n - 1 of an axisymmetric run; velocities of `read` are
// counted from v_r = reference.
void add_hoop_rate(const ParticleSet& set, double reference, std::size_t at, int n,
                   GridAtParticles& read);

}  // namespace sluice::mpm

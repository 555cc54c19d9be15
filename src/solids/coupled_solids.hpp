// What a fluid sees of the solids in it, whatever method moves these, and what it gives to them.
//
// The particles of a kind have corners, so that their outer faces are the surface of a body without
// gaps. A method of solids implements CoupledSolids (`mpm/solids_beside_fluid` does); the tasks of
// the coupling know nothing else of it. Solids beside fluid lie on the finest level.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/run/component/step_shape.hpp"
#include "solids/corner_force.hpp"

namespace sluice::solids {

// First column of each quantity in the set of particles of a kind; -1: they do not have it.
struct ParticleColumns {
  int mass = -1, volume = -1, volume_0 = -1;  // kg; m^3, now and in the reference state
  int velocity = -1;                          // 3, m/s
  int spin = -1;                              // 3, 1/s
  int corners = -1;      // 3 for each corner k, which is on the high side of axis a by its bit a
  int outer = -1;        // bits 2 a + side of the faces that no other particle shares
  int stress = -1;       // 6: xx, yy, zz, yz, xz, xy, Pa
  int temperature = -1;  // K
  int energy = -1;       // work of the stress until now, J
  int lost_heat = -1;    // what of the heat is among the energies of solids already, J
  int open_energy = -1;  // of motion within cells, also among these energies, J
  // Amounts that go with the mass that a particle loses, beside its energy and volume.
  std::array<int, 4> with_mass{-1, -1, -1, -1};
  // Of what burns: the part of the volume between the corners that is left; 2 that a burning
  // surface remembers (temperature, gradient); 4 of the flame that comes to a particle (kind, share
  // come, time, way); the radius of its cracks, m.
  int filled = -1, surface = -1, flame = -1, crack_radius = -1;
};

// One kind of solid.
struct SolidKind {
  std::string name;
  bool rigid = false;             // it keeps its velocity and temperature, and feels no force
  double density = 0;             // at the start, kg/m^3
  double specific_heat = 0;       // J/(kg K)
  double conductivity = 0;        // W/(m K); 0: no heat is conducted in it
  double reference_pressure = 0;  // at which it is free of stress, Pa
  ParticleColumns columns;
};

// That of the deck, which all kinds share, Pa; 0: there are none.
inline double reference_pressure(const std::vector<SolidKind>& kinds) {
  return kinds.empty() ? 0.0 : kinds.front().reference_pressure;
}

// What the coupling books of a step: where each sum lies among those of the step.
struct BookedSums {
  int impulse = -1, reaction = -1;  // the first of three: from outside, N s; on rigid bodies, N
  int work = -1;                    // from outside, J
  int heat_from_fluid = -1;         // that particles exchange with the fluid, J
  int exchange_gain = -1;           // what exchange adds to the kinetic energy of particles, J
  int surface_work = -1;  // what solids work on the fluid, less that of the reference pressure, J
};

class CoupledSolids {
 public:
  virtual ~CoupledSolids() = default;

  // The same all through a run.
  virtual const std::vector<SolidKind>& kinds() const = 0;
  virtual BookedSums sums() const = 0;
  // Places of corners along a direction are multiples of this length, so that their sums are exact.
  virtual double unit_of_places(int direction) const = 0;

  // The stages of its step, for the table of the coupled one: before the fluid's forces are known,
  // and where a pass moves the solids again; from these forces to the particles at the end of the
  // step; once the step is accepted.
  virtual void declare_start(StepShape& step) = 0;
  virtual void declare_pass(StepShape& step) = 0;
  virtual void declare_motion(StepShape& step) = 0;
  virtual void declare_commit(StepShape& step) = 0;

  // Of the present step, from its start on, of all ranks: rate at which waves cross the cells of
  // the level in a kind (1/s; 0: none do), the mass of its heaviest particle (kg).
  virtual double wave_rate(int kind) const = 0;
  virtual double heaviest(int kind) const = 0;
  // The velocity that a rule prescribes a kind at a place of the surface; the motion is rigid.
  virtual bool is_prescribed(int kind) const = 0;
  virtual Vec3 prescribed_velocity(int kind, Vec3 place) const = 0;
  // Once it has moved, of all ranks: the farthest way of a particle and the largest extent of one
  // of a kind along a direction, cells; whether any has left the domain.
  virtual double farthest_way() const = 0;
  virtual double largest_extent(int kind) const = 0;
  virtual bool any_left() const = 0;

  // Forces of the fluid on corners of this rank's particles, by kind, after declare_start() and
  // before declare_motion(). Collective.
  virtual void add_corner_forces(const StageScope& scope, std::vector<CornerForces> forces) = 0;
  // Velocities of a kind were changed further: the largest of each component, of all ranks, and
  // the largest of their negatives.
  virtual void include_velocities(int kind, Vec3 most, Vec3 most_negative) = 0;
  // Particles were taken away: the others go to their boxes. Collective.
  virtual void relocate(ParticleCloud& particles) = 0;
};

}  // namespace sluice::solids

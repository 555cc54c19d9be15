// What a deck says of peridynamic solids, as plain data. SI units: lengths in m, densities in
// kg/m^3, moduli in Pa, energies per area in J/m^2, drag in kg/(m^3 s).
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "framework/geometry/piece.hpp"
#include "framework/grid/side.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::peridynamics {

enum class Law { pmb, lps };
// omega: 1, max(0, 1 - r/delta), delta/r.
enum class Influence { one, linear, inverse };
// beta: 1 within the horizon; clamp((delta + dx/2 - r)/dx, 0, 1).
enum class PartialVolume { none, ramp };
// Of bond stiffness at surfaces (PMB): one constant; by what each point has of its family.
enum class SurfaceWeights { none, volume };
// Three dimensions; strain along z is 0; stress along z is 0; a line of points.
enum class Plane { space, strain, stress, line };

struct DamageModel {
  enum class Criterion { none, stretch, energy } criterion = Criterion::none;
  double critical_stretch = 0;  // s0; 0: it follows from the fracture energy
  double fracture_energy = 0;   // G0
  std::vector<PiecePtr> no_fail;
  Location where;
};

struct PeriMaterial {
  std::string name;
  int index = 0;
  Law law = Law::lps;
  double density = 0;
  double bulk = 0;   // k, in as many dimensions as the run has
  double shear = 0;  // mu
  double horizon = 0;
  DamageModel damage;
  Location where;
};

// No bond crosses it: segment from a to b (in a plane), or the parallelogram a + s b + t c,
// 0 <= s, t <= 1, or the disk about a with the normal b and a radius.
struct PreCrack {
  enum class Shape { segment, rectangle, disk } shape = Shape::segment;
  Vec3 a{}, b{}, c{};
  double radius = 0;
  Location where;
};

struct PeriScene {
  mpm::MpmScene seeds;  // geometry objects and densities alone, for the places of points
  std::vector<PeriMaterial> materials;
  Influence influence = Influence::linear;
  PartialVolume partial_volume = PartialVolume::ramp;
  SurfaceWeights surface_weights = SurfaceWeights::volume;
  Plane plane = Plane::space;
  int dimensions = 3;
  double thickness = 1;     // product of the widths along directions that are none of the run
  bool all_bonded = false;  // bonds between materials too
  bool breaks_before_force = false;  // bonds break before the forces of the same step
  double damping = 0;                // gamma
  Vec3 gravity{};
  Location gravity_where;
  std::vector<PreCrack> precracks;
  std::vector<Side> mirrors;  // sides of the domain with images

  bool any(Law law) const {
    for (const PeriMaterial& m : materials)
      if (m.law == law) return true;
    return false;
  }
  bool any(DamageModel::Criterion criterion) const {
    for (const PeriMaterial& m : materials)
      if (m.damage.criterion == criterion) return true;
    return false;
  }
  bool breaks() const {
    return any(DamageModel::Criterion::stretch) || any(DamageModel::Criterion::energy);
  }
  double largest_horizon() const {
    double most = 0;
    for (const PeriMaterial& m : materials) most = m.horizon > most ? m.horizon : most;
    return most;
  }
};

}  // namespace sluice::peridynamics

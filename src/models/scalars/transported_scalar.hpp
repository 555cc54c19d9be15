// Transported scalars, whatever model brings them. Plain data.
//
// A scalar q is an amount per mass of its material (a mass fraction, a mixture fraction, a dye), in
// a unit of its own, which values at the start and bounds share:
//   d(rho q)/dt + div(rho u q) = div(rho D grad q) + rho (r0 + r1 q - (c1 c2 + c3) q) + sources
#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/field/label.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/deck/start_line.hpp"
#include "models/scalars/exponential_decay.hpp"

namespace sluice::models {

// What a region has at the start; x: position in the bounding box of the region, 0 to 1.
enum class ScalarProfile {
  constant,        // value
  linear,          // sum slope_d x_d
  sinusoidal,      // sum sin(2 pi freq_d x_d)
  triangular,      // sum coeff_d min(x_d, 1 - x_d)
  quadratic,       // sum coeff_d x_d (x_d - 1)
  cubic,           // sum coeff_d y^2 (1 - 4 y/3), y = min(x_d, 1 - x_d)
  exponential_1d,  // sum coeff_d exp(-1/(x_d (1 - x_d)))
  exponential_2d   // coeff_x exp(-1/(x (1 - x))) coeff_y exp(-1/(y (1 - y)))
};

struct ScalarRegion {
  PiecePtr piece;
  ScalarProfile profile = ScalarProfile::constant;
  double value = 0;
  // slope and coeff in the unit of q, freq without unit; a direction with weight 0 takes no part.
  Vec3 weight{};

  double at(Vec3 point) const;  // inside the region
};

// Adds `rate` per second to the scalar inside the piece, up to `most`.
struct ScalarSource {
  PiecePtr piece;
  double rate = 0, most = std::numeric_limits<double>::infinity();
};

// The scalar that counts the heat of mixing (mixed_gas.hpp), J/kg.
inline constexpr const char* cumulative_energy = "cumulativeEnergyReleased";

struct TransportedScalar {
  std::string name;
  bool plain_name = false;  // its variable is called so, not scalar-NAME: the energy above
  int material = 0;
  double diffusivity = 0;                  // m^2/s
  double constant_rate = 0, own_rate = 0;  // r0: unit of q, per s; r1: 1/s
  Decay decay;                             // c1 c2 + c3: 1/s
  std::vector<ScalarRegion> start;         // later ones overwrite earlier ones
  std::shared_ptr<const StartLine> line;   // in place of them
  double everywhere = 0;                   // where no region is
  std::vector<ScalarSource> sources;
  bool totalled = false;        // test_conservation
  bool of_species = false;      // a mass fraction that reactions change at the end of a step
  bool spreads_by_law = false;  // with a diffusivity of each cell, in place of the number above
  bool by_volume = false;       // carried so that mixing at one pressure and temperature keeps both
  double refine_above = -1;     // gradient, 1/m times q, that asks for refinement; below 0: none
  Location where, diffusivity_where;

  bool grows() const {
    return constant_rate != 0 || own_rate != 0 || decay.any || !sources.empty();
  }
  // The value of the last region that holds the point; `everywhere` without any.
  double at_start(Vec3 point) const;
  // Labels; those of outputs must be declared before anybody looks for them by name.
  void declare_labels() const;
  std::string variable() const { return plain_name ? name : "scalar-" + name; }
  Label state() const;     // of the conserved state: q itself
  Label value() const;     // scalar-NAME
  Label gradient() const;  // mag_grad_scalar-NAME
  Label total() const;     // totalSum_scalar-NAME
  // In a step, by all but transport with the mass; c2 of the decay, where there is one.
  Label diffusion() const;    // diffCoef-NAME, of a species that spreads
  Label source() const;       // scalar-NAME_src, of a species scalar_NAME_src
  Label coefficient() const;  // scalar-NAME_expDecayCoef
};

// Names of what a deck can save of it.
std::vector<std::string> labels_of(const TransportedScalar& scalar);

}  // namespace sluice::models

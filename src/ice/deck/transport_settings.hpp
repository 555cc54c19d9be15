// What a deck says of viscosity beyond one number: laws, sponges, turbulence, wall models. Plain
// data.
#pragma once
#include <cmath>
#include <optional>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/geometry/piece.hpp"
#include "framework/grid/index_box.hpp"
#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"
#include "ice/fluid/thresholds.hpp"

namespace sluice::ice {

// mu = a sqrt(T)/(1 + b/T): W. Sutherland, Phil. Mag. 36 (1893) 507.
struct Sutherland {
  double a = 0, b = 0;  // kg/(m s K^1/2), K

  double viscosity(double T) const {  // Pa s, T in K
    const double positive = T > 0 ? T : 0;
    return a * std::sqrt(positive) * (positive / (positive + b + min_divisor));
  }
};

// A region where the viscosity is at least this.
struct SpongeLayer {
  std::vector<Bounds> boxes;
  double viscosity = 0;  // Pa s
};

struct ViscosityModels {
  std::optional<Sutherland> sutherland;
  std::vector<SpongeLayer> sponges;
  Location where;

  bool any() const { return sutherland.has_value() || !sponges.empty(); }
};

// Subgrid viscosity, mu_t = rho C Delta^2 |S| with |S| = sqrt(2 S:S) and Delta the filter width.
struct Turbulence {
  // Numbers without unit.
  bool dynamic = false;          // C from the flow (Germano), else constant^2
  double constant = 0;           // C_s of Smagorinsky
  double filter_width = 1;       // Delta over the cell's
  double test_filter_width = 2;  // of the dynamic model, over Delta
  double prandtl = 0.9;          // of the subgrid heat flux: k_t = cp mu_t/Pr_t
  Location where;
};

// Friction on a side of the domain from the velocity in the cells next to it.
struct WallShear {
  Side side = Side::x_minus;
  bool smooth = false;      // the logarithmic law of smooth walls, else of rough ones
  double roughness = 0;     // z0, m
  double von_karman = 0.4;  // without unit
  Location where;
};

// All of it for the cells of one level.
struct TransportModels {
  struct Sponge {
    IndexBox cells;
    double viscosity = 0;  // Pa s
  };
  std::optional<Sutherland> sutherland;
  std::vector<Sponge> sponges;
  std::optional<Turbulence> turbulence;
  std::vector<WallShear> wall_shear;
  bool by_fraction = false;  // that of a mixed gas

  bool molecular_varies() const {
    return sutherland.has_value() || !sponges.empty() || by_fraction;
  }
};

// The cells of a level, ghosts included, whose centres lie in a sponge.
std::vector<TransportModels::Sponge> sponge_cells(const ViscosityModels&, const Level&);

}  // namespace sluice::ice

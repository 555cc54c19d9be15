// Steps of the initial state that one material and several have in common.
#pragma once
#include "ice/start/initial_state.hpp"

namespace sluice::ice {

// What an object says of its material: looked up once, put into many cells.
struct ObjectState {
  explicit ObjectState(const GeomObject& o)
      : density(o.value("density")), temperature(o.value("temperature")), velocity(o.velocity) {}
  void put(std::size_t n, PrimitiveFill& fill) const {
    fill.density[n] = density;
    fill.temperature[n] = temperature;
    for (int d = 0; d < 3; ++d) fill.velocity[d][n] = velocity[d];
  }

  double density, temperature;  // kg/m^3, K
  Vec3 velocity;                // m/s
};

void size_fill(const IndexBox& cells, PrimitiveFill& fill);  // all zero

// What of gravity a pressure at the start can balance: none along a direction that repeats, where
// nothing carries the weight and all falls. m/s^2.
Vec3 carried_gravity(const PhysicalConstants& constants, const Level& level);
bool is_hydrostatic(const IceScene& scene, const PhysicalConstants& constants, const Level& level);
// Under gravity from the bottom of the domain on, as the pressure is a sum from there.
IndexBox cells_to_fill(const IceScene& scene, const PhysicalConstants& constants,
                       const Level& level, const IndexBox& cells);

// What a pressure given beside density and temperature leaves: the temperature of a liquid or solid
// if law and deck agree on its density, the density otherwise. A function of the deck's values, in
// kg/m^3, K and Pa; DeckError where law and density disagree and the pressure knows the density
// alone.
enum class Keeps { density, temperature };
Keeps what_is_kept(const IceMaterial& m, double density, double temperature,
                   double reference_pressure);
void set_pressure(const IceMaterial& m, Keeps keeps, double pressure, std::size_t n,
                  PrimitiveFill& fill);

// The densities that a model gives the gases of this material apart, if it does.
void apply_mixture(const models::ModelList& models, int material, const Level& level,
                   PrimitiveFill& fill);
// Density, temperature and velocity are there; pressure, named starts and formulas follow.
void apply_starts(const IceScene& scene, const PhysicalConstants& constants, const IceMaterial& m,
                  const Level& coarsest, const Level& level, PrimitiveFill& fill);
// g (m/s^2) times the distance of the lowest cell from that of the coarsest level, m^2/s^2.
double depth_below_reference(Vec3 g, const Level& coarsest, const Level& level);
void apply_hydrostatics(const PhysicalConstants& constants, const IceMaterial& m,
                        const Level& coarsest, const Level& level, PrimitiveFill& fill);
// InputError when the law has no such state.
void check_admissible(const IceMaterial& m, const Level& level, IntVec3 c, std::size_t n,
                      const PrimitiveFill& fill);
PrimitiveFill cut(const PrimitiveFill& from, const IndexBox& cells);

}  // namespace sluice::ice

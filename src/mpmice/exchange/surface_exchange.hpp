// Momentum and heat that pass through the surface of one kind of solid in a step.
//
// Each contact of the surface (surface_contacts.hpp) joins a cell g of the fluid with the nodes s
// around the middle of its particle, with their share w of it. With A the contact's area, l the
// width of the cell across it, and f the fluid's share of its cell:
//   per area:  h = f K l/4 of momentum; of heat  1/(1/(f K_h l/4) + d_g/(f k_g) + d_s/k_s), W/m^2 K
//   G = w A h,  S_g, S_s: sums of G over all pairs of the cell, of the node
//   kappa = G/(1/dt + S_g/C_g + S_s/C_s)
//   I = kappa (u_g - u_s) with C the masses M;  Q = kappa (T_g - T_s) with C the heat capacities
// A coefficient per volume acts as it did in a cell of which the surface leaves one half to the
// fluid: K (1/2) (1/2) V is A (K l/4). d_g, d_s: from the surface to the centre of the cell in
// front and to the middle of the particle, or as far as heat has come since the run began,
// sqrt(pi a t) (of the half spaces that touch at t = 0; a = k/rho c). Media that do not conduct
// have one temperature in their cell, or around their node.
// Each pair has the share G/S of either capacity, so that no temperature or velocity passes that of
// the other side for any K and any number of pairs; for one pair it is the implicit exchange.
//
// M_s, u_s, T_s are sums over particles with hat functions S, and what a node gets each of them
// gets
//   of velocity  dv = sum_s S I_s/M_s,
//   of temperature  dT = sum_s S (Q_s/C_s + a_s (T_s - T)),  a_s = sum kappa/C_s <= 1
// That is a relaxation towards the temperature in front: no particle leaves the range of the two.
// What friction costs a pair goes to the fluid, and to particles what one motion of several costs.
#pragma once
#include "mpmice/exchange/passed_amounts.hpp"

namespace sluice::mpmice {

// Of a solid with each fluid.
FilmCoefficients films_of(const ice::IceScene& ice, int solid);

template <int D>
class SurfaceExchange {
 public:
  // Coefficients of each kind of solid with the fluids, of the deck.
  SurfaceExchange(const ice::FluidPart& fluid, const std::vector<solids::SolidKind>& kinds);

  bool exchanges(int kind) const { return films_[static_cast<std::size_t>(kind)].any(); }
  // What passes through the surfaces of one kind in a step. Changes amounts of the fluid,
  // velocities and temperatures of the particles as the step ends, and the books. Collective.
  void run(const StageScope& scope, int kind, const NearCells<D>& near,
           const SolidGeometry<D>& solid, std::vector<SolidSet<D>>& sets, CellAmounts<D>& amounts,
           CouplingBooks& books) const;

  // Columns over the cells that a run needs at once, of so many fluids: of what is behind, sums of
  // conductances, lanes.
  static int columns(int fluids) { return (2 + D) + (fluids + 3) + (fluids + 4 + 2 * D); }

 private:
  const ice::FluidPart* fluid_;
  const std::vector<solids::SolidKind>* kinds_;
  std::vector<FilmCoefficients> films_;  // by kind
};

}  // namespace sluice::mpmice

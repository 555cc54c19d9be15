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
#include "ice/fluid_part.hpp"
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/step/cell_masks.hpp"
#include "mpmice/step/coupling_books.hpp"
#include "mpmice/step/surface_contacts.hpp"

namespace sluice::mpmice {

// Coefficients per volume of the cell with each fluid, kg/(m^3 s) and W/(m^3 K).
struct FilmCoefficients {
  std::vector<double> drag, heat;
  bool any_drag() const;
  bool any_heat() const;
};

struct SolidConstants {
  bool rigid = false;  // it keeps its velocity and temperature
  double specific_heat = 0, conductivity = 0;
};

// What passes a pair of cells for a unit of difference: see above. Capacities without end: 0 for
// their inverse.
inline double passes(double G, double dt, double sum_g, double inverse_g, double sum_s,
                     double inverse_s) {
  return G / (1 / dt + sum_g * inverse_g + sum_s * inverse_s);
}

template <int D>
class SurfaceExchange {
 public:
  SurfaceExchange(const Frame<D>& frame, const SolidFields<D>& fields, CellAmounts<D>& amounts,
                  std::vector<SolidSet<D>>& sets, const ice::FluidPart& fluid, int kind,
                  const SolidConstants& solid, const FilmCoefficients& films);

  // Collective. Changes amounts of the fluid, velocities and temperatures of the particles as the
  // step ends, and the books.
  void run(const StageScope& scope, CouplingBooks& books);

 private:
  // A contact and one node behind it; heat: of each fluid, in a column of its own.
  struct Pair {
    std::uint32_t contact;
    std::size_t solid;  // place of the node
    double drag;        // G
  };
  struct Scales {
    double mass = 1e-300, speed = 1e-100, temperature = 1e-300;  // of particles and fluid
    double fluid_mass = 1e-300, fluid_capacity = 1e-300, drag = 1e-300, heat = 1e-300;
  };
  // Lanes of what passes; -1: none.
  struct Lanes {
    int heat_of_fluid = -1, momentum = -1, energy = -1;        // of cells in front
    int heat = -1, relaxation = -1, impulse = -1, given = -1;  // of nodes behind
    int count = 0;
  };

  void find_contacts();
  void look_at_fluid(std::size_t contact);
  CellMask cells_that_exchange() const;
  void find_scales(const StageScope& scope);
  void find_solid(const StageScope& scope);
  void add_solid(const SolidSet<D>& s);
  void find_pairs(const StageScope& scope);
  void pair_up(std::size_t contact, double time);
  double solid_resistance(const SurfaceContact<D>& c, double time) const;
  double fluid_resistance(std::size_t contact, std::size_t m, double time) const;
  double heat_conductance(std::size_t contact, std::size_t m, double behind, double time) const;
  void sum_conductances(const StageScope& scope);
  void pass(const StageScope& scope);
  void pass_heat(std::size_t pair, double dt);
  void pass_drag(std::size_t pair, double dt);
  void give_to_fluid();
  // Of one mass at a node: kick, temperature gained, share of relaxation, energy beyond u.kick.
  struct Gain {
    std::array<double, D> kick{};
    double warm = 0, relaxation = 0, energy = 0;
  };
  Gain gain_of(std::size_t node) const;
  // The n-th set of this kind.
  void give_to_set(SolidSet<D>& s, std::size_t n, ExactSum& heated, ExactSum& moved) const;
  void book_rigid(CouplingBooks& books) const;
  double inverse_mass(std::size_t node) const;
  double inverse_capacity(std::size_t node) const;
  double value(int lane, std::size_t cell, double scale) const;
  double unit_of_heat() const;
  double unit_of_impulse() const;

  const Frame<D>& frame_;
  const SolidFields<D>& fields_;
  CellAmounts<D>& amounts_;
  std::vector<SolidSet<D>>& sets_;
  const ice::FluidPart& fluid_;
  int kind_;
  SolidConstants solid_;
  FilmCoefficients films_;
  std::size_t fluids_;
  std::array<int, D> component_{};  // of the momentum; -1: none is carried

  std::vector<SurfaceContact<D>> contacts_;
  // Of the fluid in front, by contact: share, temperature and capacity of each; mass, velocity.
  std::vector<double> share_, temperature_, capacity_, mass_;
  std::vector<std::array<double, D>> velocity_;
  CellMask meets_;  // cells in which the middles of particles lie that count
  // These particles, set after set of the kind, and where each set ends.
  using Nodes = std::array<NodeShare<D>, 1 << D>;
  std::vector<std::pair<std::uint32_t, Nodes>> near_;
  std::vector<std::size_t> ends_;
  // Behind, by node: mass per cell volume, temperature, velocity.
  Column solid_mass_, solid_temperature_;
  std::array<Column, D> solid_velocity_;
  std::vector<Pair> pairs_;
  std::vector<double> heat_;                          // G, by pair and fluid
  Column drag_in_front_, drag_behind_, heat_behind_;  // sums of G
  std::vector<Column> heat_in_front_;                 // by fluid
  Scales most_;
  Lanes lanes_;
  CellSums<D> sums_;
  // Of pairs with rigid solids: impulses on the fluid and energy given to it.
  std::array<ExactSum, D> impulse_;
  ExactSum work_;
};

}  // namespace sluice::mpmice

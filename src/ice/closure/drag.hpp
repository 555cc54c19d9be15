// Drag between the materials of a cell over a step, and what pressure pushes apart.
//
// Beside the deck's K three things bind materials, so that light ones are not torn away from heavy
// ones where they cannot be apart:
//   virtual mass: pressure moves a material against another as if half of the mass that the smaller
//     volume pushes aside went with it (Drew and Lahey, Int. J. Multiphase Flow 13 (1987) 113). For
//     drops in a gas it is nothing; a bubble in a liquid gets three times its acceleration, not
//     the ratio of densities
//   interfaces: where a volume fraction jumps from cell to cell the materials lie side by side
//   traces: below 1e-8 of the volume a material moves with the mixture (free from 1e-6 on). Less
//     than 1e-2 (2e-2) of matter no denser than the mixture (than twice the mixture) feels the drag
//     of fragments as large as a cell, dw/dt = -(rho/rho_m) |w| w/dx: finer ones would feel more.
// Along a surface (surface.hpp) gas and solid slip: there the deck's K and what the surface lets
// pass resist one after the other, and no interface binds the two. Across it nothing changes. With
// its normal n, w = n (n.w) + w_t: both parts by themselves.
#pragma once
#include <optional>
#include <vector>

#include "ice/deck/exchange_settings.hpp"
#include "ice/fluid/material_set.hpp"

namespace sluice::ice::mixture {

// The materials present in a cell, one after the other.
struct DragCell {
  int count = 0;
  int index[max_materials];
  double M[max_materials], V[max_materials];  // per volume of the cell: kg/m^3, 1
  double total = 0;                           // mass, kg/m^3
  double lock = 0;                            // strength s/(1 - s) of an interface, without unit
  double bind[max_materials];                 // of each material to the mixture, without unit
  // Of the surface along which a gas slips.
  double surface = 0;                  // share of the cell that is nothing but one
  double passes = 0;                   // along it for a unit of slip, kg/(m^3 s)
  double normal[3] = {0.0, 0.0, 0.0};  // by direction
};

// Velocities (m/s) or momenta (kg/(m^2 s)) of the materials present, by direction of the state.
using ByMaterial = double[max_materials];

// Of a volume fraction, a factor: 0 where it is so small that the material moves with the mixture,
// 1 where it need not.
double freedom(double volume);
// How strongly a material of which a cell holds little is bound to the mixture, as DragCell::bind.
// `courant`: how many cells it moves against the mixture in a step.
double binding(const DragCell& cell, int i, double courant);

class Drag {
 public:
  explicit Drag(const PairCoefficients& K, const std::optional<MultiVelocityExchange>& slip = {})
      : K_(K), slip_(slip) {}

  // Velocities w (m/s) relative to the mixture, sum M w = 0, after a time: the share `part` of the
  // step dt (s).
  void decay(const DragCell& cell, double dt, double part, int directions, ByMaterial* w) const;
  // What a push (momentum by material over that time, evenly, kg/(m^2 s); sum 0) has given to them
  // from rest.
  void respond(const DragCell& cell, double dt, double part, int directions, const ByMaterial* push,
               ByMaterial* w) const;
  // The same of one direction, across the surface where there is one.
  void decay(const DragCell& cell, double dt, double part, double* w) const {
    decay_one(cell, dt, part, false, w);
  }
  void respond(const DragCell& cell, double dt, double part, const double* push, double* w) const {
    respond_one(cell, dt, part, false, push, w);
  }
  // What a pressure impulse dp along a direction pushes apart: momentum by material, sum 0; both
  // kg/(m^2 s).
  static void push(const DragCell& cell, double dp, double* momentum);
  // 1/inertia of what sound moves where nothing but pressure binds the materials: no less than that
  // of the mixture. m^3/kg.
  static double inverse_inertia(const DragCell& cell);
  // Kinetic energy of the velocities relative to the mixture, J/m^3.
  static double energy(const DragCell& cell, const double* w);

 private:
  // Of the drag `along` a surface, or across it.
  double pair(const DragCell& cell, int i, int j, double dt, double part, bool along) const;
  void relax(const DragCell& cell, double dt, double part, bool along, const double* w,
             const double* push, double* after) const;
  void decay_one(const DragCell& cell, double dt, double part, bool along, double* w) const;
  void respond_one(const DragCell& cell, double dt, double part, bool along, const double* push,
                   double* w) const;
  PairCoefficients K_;
  std::optional<MultiVelocityExchange> slip_;
};

// The materials that a cell holds; mass (kg/m^3) and volume (fraction): rows by material; i: the
// place of the cell in the rows.
void find_present(int materials, const double* const* mass, const double* const* volume, int i,
                  DragCell& cell);

}  // namespace sluice::ice::mixture

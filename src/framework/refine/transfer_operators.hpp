// What a component does where levels meet: prolongation, restriction, correction of fluxes.
//
// The framework finds the cells, moves the data and interpolates in time; the component knows what
// the numbers mean. All operators see the whole conserved state of one box (or of a scratch copy)
// as one view a component, in the order of StateFacet::slots(): StateViews.
#pragma once
#include <span>
#include <vector>

#include "framework/field/array_view.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

using StateViews = std::vector<RealView>;

struct TransferGeometry {
  IntVec3 ratio{1, 1, 1};                        // fine cells a coarse one, per direction
  std::array<bool, 3> active{true, true, true};  // other directions have one cell on both levels
};

// Fine cells to be found, and the coarse ones around them. Views of one box are laid out alike.
struct Prolongation {
  const StateViews* coarse = nullptr;
  const StateViews* fine = nullptr;
  IndexBox cells;
  // Of the same coarse cells: values between two states, (1 - share) coarse + share later. Null for
  // an operator that does not blend.
  const StateViews* later = nullptr;
  double share = 0;
};

// Changes of conserved quantities in a list of cells: mass, momentum components and total energy of
// each material per volume of those cells: kg/m^3, kg/(m^2 s), J/m^3.
struct ConservedChange {
  std::vector<IntVec3> cells;
  std::vector<std::vector<double>> amount;  // by quantity, by cell
};

class TransferOperators {
 public:
  virtual ~TransferOperators() = default;

  // Fine cells from coarse ones: the mean over the fine cells of a coarse cell equals its mass,
  // momentum and total energy. Order 0: constant, 1: limited linear, 2: limited parabola. `coarse`
  // may be addressed one layer beyond coarsen(cells, ratio) in active directions. No cell becomes
  // inadmissible that was not so before. Depends on nothing but the coarse cells around.
  virtual void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
                       const TransferGeometry& geometry, int order) const = 0;

  // Many regions, most of them strips of a few cells: an operator may compute them together.
  virtual void prolong_all(std::span<const Prolongation> regions, const TransferGeometry& geometry,
                           int order) const {
    for (const Prolongation& r : regions) prolong(*r.coarse, *r.fine, r.cells, geometry, order);
  }

  // Does prolong_all take coarse values between two states.
  virtual bool blends() const { return false; }

  // Coarse cells as exact means of mass, momentum and total energy of their fine cells; kinetic
  // energy that the mean loses becomes internal energy. The order of summation is mirror-exact.
  virtual void restrict_to(const StateViews& fine, const StateViews& coarse,
                           const IndexBox& coarse_cells,
                           const TransferGeometry& geometry) const = 0;

  // How many quantities a flux register keeps a face: mass, momenta, total energy, by material;
  // 0: fluxes are not matched.
  virtual int flux_quantities() const = 0;

  // Adds share * change to the conserved state of each listed cell, with the largest share of
  // 1, 1/2, 1/4, 1/8, 0 that leaves the cell admissible with a margin; `share` (one a cell) says
  // which.
  virtual void correct(const StateViews& state, const ConservedChange& change,
                       std::span<double> share) const = 0;
};

}  // namespace sluice

// What a component does where levels meet, and where it wants finer ones. The defaults are those of
// a component on one level.
#pragma once
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/refine/transfer_operators.hpp"

namespace sluice {

// A variable whose estimated error decides on refinement: two diagnostic labels.
struct ErrorEstimate {
  Label value, estimate;
  int material = 0;
  double tolerance = 0;  // largest estimate, as a share of the range of the value over the domain
};

// Cells that no row kernel finds (those that hold particles, those that a material's interface
// passes), and how far around them a finer level is wanted.
struct FlagSeeds {
  std::vector<IntVec3> cells;  // in the boxes of this rank
  double distance = 0;         // m, the same on every level
};

class LevelFacet {
 public:
  virtual ~LevelFacet() = default;

  // Prolongation, restriction, correction of fluxes.
  virtual const TransferOperators& transfer() const;
  // How many cells before its end a level is to know of it, by direction; 0: need not.
  virtual IntVec3 interface_depth(const Level& /*level*/) const { return {}; }

  // The diagnostic label that is 1 in cells that ask for refinement.
  virtual Label refine_flag() const;
  // Criteria that need to know the range of a variable over all levels and ranks.
  virtual std::vector<ErrorEstimate> error_estimates() const { return {}; }
  // Criteria that are no diagnostic of a state; as many on every rank.
  virtual std::vector<FlagSeeds> flag_seeds(const Warehouse& /*state*/) const { return {}; }
};

}  // namespace sluice

// A number of a level and the next coarser one, for the ghost cells between them.
//
// A ghost cell beside a face of a coarser level gets the parabola through the first and the second
// fine cell, f1 and f2, and a value c* of the coarser level, at distances 1/2, 3/2 and r/2 of fine
// cells from the face:
//   g = 8/((r + 1)(r + 3)) c* + 2 (r - 1)/(r + 1) f1 - (r - 1)/(r + 3) f2
//   c* = c + sum over tangents of  o (c+ - c-)/2 + o^2/2 (c+ - 2 c + c-)
// o: how far, in coarse cells, the ghost's centre lies aside of c's.
#pragma once
#include "framework/grid/cell_map.hpp"
#include "framework/solve/all_boxes.hpp"

namespace sluice::ice::pressure {

class InterfaceGhosts {
 public:
  // The numbers of the cells of both levels, of the boxes of this rank; they and the levels must
  // outlive it. Collective.
  InterfaceGhosts(const Level& coarse, const Level& fine, const solve::ConstBoxViews& of_coarse,
                  const solve::ConstBoxViews& of_fine);

  // Those of a fine box with these cells that lie in the domain and in no box of the fine level.
  void fill(const RealView& d, const IndexBox& cells) const;

 private:
  double value(IntVec3 ghost) const;
  // The ghost `away` cells outward of f1 along d.
  double beside(IntVec3 f1, int d, int inward, int away) const;
  // c* beside a fine cell.
  double around(IntVec3 g, int d) const;
  double coarse_or(IntVec3 cell, double other) const {
    return coarse_map_.has(cell) ? coarse(cell) : other;
  }
  double coarse(IntVec3 cell) const {
    return coarse_map_.has(cell) ? number(coarse_map_, coarse_numbers_, cell) : 0.0;
  }
  double fine(IntVec3 cell) const { return number(fine_map_, fine_numbers_, cell); }
  static double number(const CellMap& map, const solve::AllBoxes& numbers, IntVec3 cell) {
    return numbers.views()[map.box_of(cell)](map.image(cell));
  }

  const Level& fine_;
  CellMap coarse_map_, fine_map_;
  solve::AllBoxes coarse_numbers_, fine_numbers_;
};

}  // namespace sluice::ice::pressure

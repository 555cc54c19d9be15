// Decks without any symmetry of their own, written along any axes: permuted and mirrored.
//
// A case is written in its own axes; an Orientation says which of them each axis of the deck shows
// and which way round. Domains are centred at 0 with spacings that are powers of two, so that the
// start is the same to the bit.
#pragma once
#include <algorithm>
#include <array>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::properties {

struct Orientation {
  std::array<int, 3> shows{0, 1, 2};  // axis d of the deck shows axis shows[d] of the case
  std::array<bool, 3> mirrored{};     // by axis of the deck

  Vec3 turn(Vec3 v) const;
  // Of a cell of the case in the deck, when the case has `cells` cells.
  IntVec3 turn_cell(IntVec3 cell, IntVec3 cells) const;
  IntVec3 turn_extents(IntVec3 cells) const;
  Vec3 turn_along(Vec3 v) const;  // what has no sign
};

enum class SideKind { open, waves, wall, moving_wall, slip, inflow, symmetry, periodic };

// Levels that follow density and pressure, or stay: the last entry of a list holds on.
struct SkewLevels {
  int most = 1;  // levels; 1: no <AMR>
  std::vector<IntVec3> ratios{{2, 2, 2}}, tiles{{8, 8, 8}};
  double threshold = 4;  // gradients of density and pressure that flag a cell
  IntVec3 stability{1, 1, 1}, regrid{}, deletion{1, 1, 1}, margin{1, 1, 1};
  int interval = 50;
  int order = 1;
  bool lock_step = false;
  // Levels that stay: of each finer level its boxes, lower and upper corner.
  std::vector<std::vector<std::pair<Vec3, Vec3>>> fixed{};

  IntVec3 ratio(int level) const;  // to the next coarser one
};

// Another material in the place of the dense gas.
struct SkewSecond {
  std::string eos;  // the element <EOS>; empty: there is none
  double gamma = 1.667;
  double temperature = 2;
  double drag = 1e15, heat = 0;  // coefficients of exchange
  std::string exchange{};        // what else <exchange_properties> holds
};

struct SkewCase {
  std::string name;
  IntVec3 cells;                  // one: inactive
  std::array<SideKind, 6> sides;  // x-, x+, y-, y+, z-, z+ of the case
  Vec3 gravity{};
  double viscosity = 0;
  bool second_order = true;
  bool cross_flow = false;            // the start moves along inactive directions as well
  bool internal_energy_form = false;  // the one-stage, internal-energy scheme
  SkewLevels levels{};
  double conductivity = 0;   // walls then have temperatures of their own
  std::string turbulence{};  // the model's name
  SkewSecond second{};
  bool far_flow = true;  // LODI faces know density and velocity far away

  // A direction that the grid keeps: gravity makes a dimension of one cell.
  bool active(int d) const { return cells[d] > 1 || gravity[d] != 0; }
  int materials() const { return second.eos.empty() ? 1 : 2; }
  bool has(SideKind kind) const {
    return std::find(sides.begin(), sides.end(), kind) != sides.end();
  }
  // Cells of the domain of a level.
  IntVec3 cells_of(int level) const;
};
inline std::ostream& operator<<(std::ostream& out, const SkewCase& c) {
  return out << c.name;
}

// The deck as XML; output after the first and after the last of the steps.
std::string skew_deck(const SkewCase& c, const Orientation& o, int step_count);

}  // namespace sluice::properties

// What waves leave in the ghosts of an open face, row by row of the cells next to it.
//
// What a cell gives is found once for all layers of ghosts. Rows run along one tangent of the face,
// `along`, and follow each other across it, along the other, `across`; what they hold is kept with
// unit stride whatever the direction. Of three rows that follow each other the states are kept, for
// differences.
#pragma once
#include <array>
#include <vector>

#include "ice/boundary/ghost_states.hpp"
#include "ice/boundary/waves.hpp"

namespace sluice::ice {

class WaveRows {
 public:
  // `ghosts`: those to be filled, all layers beyond one side.
  WaveRows(const GhostStates& states, const IndexBox& ghosts);

  int along() const { return a_; }
  int across() const { return b_; }
  // The row of cells with this index across; then what of their waves is the same for all ghosts,
  // of cells [begin, end) with one rule. Numbers of cells are indices along the row.
  void start(int row);
  void take(const GhostRule& rule, int begin, int end);
  // The state that waves leave in these ghosts of a layer (1: next to the face), without
  // hydrostatic pressure.
  void move_out(int layer, int begin, int end);
  WaveState at(int cell) const { return state(out_, cell - first_); }
  // Can this rule's ghosts be written as they are, layer by layer outward: one gas, nothing given.
  bool writes(const GhostRule& rule) const;
  void write(int layer, int begin, int end);

 private:
  // Elements of rows; component 0 of the velocity along the outward normal, then tangents.
  struct StateRow {
    double *rho, *p, *u[3];
  };
  // Derivatives along a tangent that waves take part in.
  struct SlopeRow {
    double *p, *normal, *own;  // the velocity across the face and that along the tangent
  };
  // LeavingWaves.
  struct WaveRow {
    double *out, *in, *hears, *entropy, *all_leave;
    StateRow inside;
  };
  // Cells next to the face, or those next to them inward.
  struct Layer {
    std::array<StateRow, 3> rows;  // this and those around, in turn
    SlopeRow slopes[2];            // along the tangents
    double *sound_speed, *transverse;
  };

  // A cell at the end of rows, what it takes its difference from, and one over their distance; zero
  // beyond the domain.
  struct Outer {
    int cell, low, high;
    double scale;
  };

  static WaveState state(const StateRow& r, int i) {
    return {r.rho[i], r.p[i], {r.u[0][i], r.u[1][i], r.u[2][i]}};
  }
  static void put(const WaveState& s, const StateRow& r, int i) {
    r.rho[i] = s.rho;
    r.p[i] = s.p;
    r.u[0][i] = s.u[0];
    r.u[1][i] = s.u[1];
    r.u[2][i] = s.u[2];
  }
  static std::size_t turn(int row) { return (row % 3 + 3) % 3; }
  IntVec3 cell(int along, int row, int inward) const;
  void find_neighbours(int row);
  void allot_room();
  void load(int row);
  void load_gas(const StateRow& to, IntVec3 first);
  void find_sound_speeds();
  void differences_along(const Layer& layer) const;
  void differences_across(const Layer& layer) const;
  void find_transverse(const Layer& layer, int begin, int end) const;
  void find_waves(int begin, int end) const;
  bool find_slopes(int layer, int begin, int end) const;

  const GhostStates& s_;
  int a_, b_, t_;                // along, across; the place of the former among the tangents
  int begin_, end_;              // cells of a row that have ghosts
  int inner_begin_, inner_end_;  // those of them with neighbours on both sides
  std::vector<Outer> outer_;     // the others
  int first_, count_;            // with what is beside them: elements of rows
  bool one_law_;                 // one gas of one law everywhere
  int row_ = 0;
  std::array<int, 3> held_;  // whose states the rows hold
  std::vector<double> room_;
  std::array<Layer, 2> layers_;
  WaveRow waves_;
  StateRow out_;
  double *energy_, *lowest_, *step_, *weight_, *nearer_;
  WaveCell common_;  // what is the same for all cells of a rule
};

}  // namespace sluice::ice

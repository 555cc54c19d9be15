// Ghosts of a side with open faces (LODI): waves, row by row, and what else there is beside them.
#include "ice/boundary/boundary_fill.hpp"
#include "ice/boundary/layer_copy.hpp"
#include "ice/boundary/wave_rows.hpp"

namespace sluice::ice {

// No column of ghosts looks at another: each may be filled by itself, outward, so that hydrostatic
// sums find the nearer ghosts filled.
void BoundaryFill::fill_open_side(GhostStates& states, const IndexBox& ghosts, Side side) const {
  const std::size_t n = index_of(side);
  const int d = direction_of(side), layers = ghosts.size()[d];
  WaveRows rows(states, ghosts);
  const int a = rows.along(), b = rows.across();
  IntVec3 ghost = ghosts.lower;
  const auto move_to = [&](int cell, int layer) {
    ghost[a] = cell;
    ghost[d] = is_plus(side) ? ghosts.lower[d] + layer : ghosts.upper[d] - 1 - layer;
  };
  const auto region_at = [&](int cell) {
    move_to(cell, 0);
    return region(side, ghost);
  };
  for (int row = ghosts.lower[b]; row < ghosts.upper[b]; ++row) {
    ghost[b] = row;
    rows.start(row);
    for (int begin = ghosts.lower[a], end; begin < ghosts.upper[a]; begin = end) {
      const std::size_t here = region_at(begin);
      end = regions_[n]->uniform() ? ghosts.upper[a] : begin + 1;
      while (end < ghosts.upper[a] && region_at(end) == here) ++end;
      const GhostRule& rule = rules_[n][here];
      if (rule.waves) rows.take(rule, begin, end);
      for (int layer = 0; layer < layers; ++layer) {
        if (rule.waves) rows.move_out(1 + layer, begin, end);
        if (rule.waves && rows.writes(rule)) {
          rows.write(1 + layer, begin, end);
          continue;
        }
        for (int cell = begin; cell < end; ++cell) {
          move_to(cell, layer);
          if (!rule.waves) {
            fill_ghost(states, side, here, ghost);
            continue;
          }
          const IntVec3 source = source_cell(ghost, d, is_plus(side), false, level_->domain);
          if (mixtures_[n].empty())
            states.waves(rule, rows.at(cell), ghost, source);
          else
            states.mixture_waves(mixtures_[n][here], rows.at(cell), ghost, source);
        }
      }
    }
  }
}

}  // namespace sluice::ice

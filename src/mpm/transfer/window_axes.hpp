// Where the nodes of a window are in memory, along the active directions alone.
#pragma once
#include "mpm/transfer/particle_shape.hpp"
#include "mpm/transfer/window.hpp"

namespace sluice::mpm {

template <int D>
struct WindowAxes {
  WindowAxes(const TransferGrid& grid, const Window& window) {
    for (int a = 0; a < D; ++a) {
      stride[a] = window.stride(grid.active[a]);
      low[a] = window.lower()[grid.active[a]];
    }
  }

  std::ptrdiff_t stride[D];  // of nodes that follow each other, in lanes
  int low[D];                // index of the first nodes
};

}  // namespace sluice::mpm

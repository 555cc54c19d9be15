#include "mpm/step/particles_to_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {

void find_nodes_of(const MpmScene& solids, const BlockShape& shape, const Body& body,
                   BlockWork& w) {
  const Columns& c = body.carried->columns;
  const int reach = std::max(reach_of(solids.basis),
                             static_cast<int>(std::floor(max_stray + body.rates.extent)) + 1);
  w.lowest = w.highest = shape.lower(w.run.block);
  const std::array<const double*, 3> x = places_of(*w.set, c);
  for (int d = 0; d < 3; ++d) {
    if (shape.edge[d] == 1) continue;
    if (c.reference < 0) {
      w.lowest[d] -= reach;
      w.highest[d] += shape.edge[d] + reach;
      continue;
    }
    const double* places = x[static_cast<std::size_t>(d)];
    const auto [low, high] = std::minmax_element(places + w.run.begin, places + w.run.end);
    const Axis& axis = body.grid.axes[static_cast<std::size_t>(d)];
    w.lowest[d] = static_cast<int>(std::floor(axis.place(*low) + axis.first)) - 1;
    w.highest[d] = static_cast<int>(std::floor(axis.place(*high) + axis.first)) + 2;
  }
}

void ParticlesToNodes::find_nodes(std::vector<BlockWork>& work) const {
  for (Body& body : *bodies_) {
    body.table.clear();
    body.nodes.clear();
  }
  for (BlockWork& w : work) {
    Body& body = (*bodies_)[static_cast<std::size_t>(w.kind)];
    find_nodes_of(*solids_, nodes_->shape, body, w);
    add_blocks(body.table, w.lowest, w.highest);
  }
}

void ParticlesToNodes::give(std::vector<BlockWork>& work, const SolidEffectList& effects) const {
  find_nodes(work);
  for (SolidEffect* effect : effects) effect->add_nodes();
  for (Body& body : *bodies_) body.nodes.fit(body.table);
  const ThreadTeam& team = *nodes_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(nodes_->shape, 1));
  team.for_each(work.size(), [&](std::size_t n, int thread) {
    give_block(work[n], effects, windows[static_cast<std::size_t>(thread)], team.size() > 1);
  });
  for (SolidEffect* effect : effects) effect->give_beside();
}

void ParticlesToNodes::give_block(const BlockWork& w, const SolidEffectList& effects,
                                  Window& window, bool shared) const {
  Body& body = (*bodies_)[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  ParticlesToGrid p;
  p.x = places_of(*w.set, c);
  p.shape = shape_of(*w.set, c);
  p.reference_gradients = solids_->total_lagrangian;
  p.v = read_columns<3>(*w.set, c.velocity);
  p.mass = w.set->column(static_cast<std::size_t>(c.mass));
  p.volume = w.set->column(static_cast<std::size_t>(c.volume));
  p.stress = read_columns<6>(*w.set, c.stress);
  p.affine = read_columns<9>(*w.set, c.affine);
  p.spin = read_columns<3>(*w.set, c.spin);
  for (const SolidEffect* effect : effects) effect->give(w, p);
  window.begin(w.lowest, w.highest);
  add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                static_cast<int>(w.run.end), body.units, window);
  window.add_to(body.table, body.nodes, shared);
}

}  // namespace sluice::mpm

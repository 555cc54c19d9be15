#include "mpm/step/body_surfaces.hpp"

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

BodySurfaces::BodySurfaces(const MpmScene& solids, const Contact& contact, const LevelNodes& nodes)
    : contact_(&contact),
      nodes_(&nodes),
      units_(surface_units(nodes.level, solids.axisymmetric)),
      sums_(solids.materials.size()) {}

void BodySurfaces::clear() {
  for (NodeLanes& of : sums_) of.clear();
}

SurfaceAtNode BodySurfaces::at(BlockMember of, int node) const {
  return surface_at(sums(of.body).sums(of.block) + node * lanes, units_);
}

// By block: those where a body meets others, and those with images of nodes there.
std::vector<char> BodySurfaces::blocks_of(int m, const Body& body,
                                          const std::vector<char>& marks) const {
  const BlockShape& shape = nodes_->shape;
  const NodeBoundary& boundary = *nodes_->boundary;
  std::vector<char> wanted = marks;
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = nodes_->lower(body.table, b);
    if (!boundary.has_images(low, shape.edge, m)) continue;
    for_each_node(shape, low, [&](int, IntVec3 node) {
      if (!boundary.is_image(node, m)) return;
      const int of = body.table.find(shape.block_of(boundary.image(node, m).of));
      if (of >= 0 && marks[static_cast<std::size_t>(of)] != 0)
        wanted[static_cast<std::size_t>(b)] = 1;
    });
  }
  return wanted;
}

// Whether the particles of a block reach one of the blocks of nodes that are wanted.
bool BodySurfaces::reaches(const BlockWork& w, const BlockTable& table,
                           const std::vector<char>& wanted) const {
  const IntVec3 edge = nodes_->shape.edge, by{edge.x > 1, edge.y > 1, edge.z > 1};
  for (int k = -by.z; k <= by.z; ++k)
    for (int j = -by.y; j <= by.y; ++j)
      for (int i = -by.x; i <= by.x; ++i) {
        const int b = table.find(w.run.block + IntVec3{i, j, k});
        if (b >= 0 && wanted[static_cast<std::size_t>(b)] != 0) return true;
      }
  return false;
}

void BodySurfaces::gather(const MeetingBlocks& where, std::span<Body> bodies,
                          std::span<const BlockWork> work, std::span<const SharedBlocks> shared) {
  std::vector<std::vector<char>> wanted;
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    const int number = static_cast<int>(m);
    wanted.push_back(blocks_of(number, bodies[m], where.marks(number)));
    sums_[m].fit(bodies[m].table);
  }
  const ThreadTeam& team = *nodes_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(nodes_->shape, 1));
  team.for_each(work.size(), [&](std::size_t n, int thread) {
    const auto k = static_cast<std::size_t>(work[n].kind);
    if (contact_->takes(work[n].kind) && reaches(work[n], bodies[k].table, wanted[k]))
      add(work[n], bodies[k], windows[static_cast<std::size_t>(thread)], team.size() > 1);
  });
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    nodes_->boundary->fold(static_cast<int>(m), bodies[m].table, sums_[m]);
    nodes_->exchange->share_some(bodies[m].table, sums_[m], shared[m],
                                 where.marks(static_cast<int>(m)));
  }
}

void BodySurfaces::add(const BlockWork& w, const Body& body, Window& window, bool shared) {
  TransferGrid grid = body.grid;
  grid.half = contact_->half(w.kind);
  std::array<const double*, 3> x;
  for (int d = 0; d < 3; ++d) x[static_cast<std::size_t>(d)] = w.set->coordinate(d);
  window.begin(w.run.block);
  add_surfaces(grid, x, w.set->column(static_cast<std::size_t>(body.carried->columns.volume)),
               static_cast<int>(w.run.begin), static_cast<int>(w.run.end), units_, window);
  window.add_to(body.table, sums_[static_cast<std::size_t>(w.kind)], shared);
}

}  // namespace sluice::mpm

#include "mpm/step/mirror_books.hpp"

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {
namespace {

// Does a mirror of the domain act on a body.
bool has_mirror(const NodeBoundary& boundary, const Body& body, int m) {
  return !body.material->rigid &&
         (boundary.mirrored(0, m) || boundary.mirrored(1, m) || boundary.mirrored(2, m));
}

// act(node number, image) for images beyond mirrors in a block, where there is mass.
template <class Act>
void for_each_image(const LevelNodes& nodes, IntVec3 low, int m, const std::int64_t* of,
                    Act&& act) {
  if (!nodes.boundary->has_images(low, nodes.shape.edge, m)) return;
  for (int n = 0; n < block_nodes; ++n) {
    if (of[n * lanes + count_lane] == 0) continue;
    const IntVec3 at = node_of(nodes.shape, low, n);
    if (nodes.boundary->is_image(at, m)) act(n, nodes.boundary->image(at, m));
  }
}

}  // namespace

void book_mirrored_forces(const LevelNodes& nodes, const Body& body, BlockMember of, double kick,
                          NodeBooks& books) {
  if (!has_mirror(*nodes.boundary, body, of.body) || !nodes.booked(body.table, of.block)) return;
  const std::int64_t* node = body.nodes.sums(of.block);
  for_each_image(nodes, nodes.lower(body.table, of.block), of.body, node,
                 [&](int n, const NodeBoundary::Image& image) {
                   for (int d = 0; d < 3; ++d)
                     if (image.flipped[static_cast<std::size_t>(d)])
                       books.add(StepSums::impulse_x + d,
                                 -2 * kick * as_real(node[n * lanes + 4 + d]));
                 });
}

void book_mirrored_changes(const LevelNodes& nodes, const Body& body, int m, const NodeLanes& of,
                           NodeBooks& books) {
  if (!has_mirror(*nodes.boundary, body, m)) return;
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = nodes.lower(body.table, b);
    if (!nodes.boundary->meets(low, nodes.shape.edge) || !nodes.booked(body.table, b)) continue;
    const std::int64_t* images = of.sums(b);
    for_each_image(nodes, low, m, images, [&](int n, const NodeBoundary::Image& image) {
      const int block = body.table.find(nodes.shape.block_of(image.of));
      if (block < 0) return;
      const std::int64_t* node = of.sums(block) + nodes.shape.place(image.of) * lanes;
      const double mass = as_real(images[n * lanes + 3]);
      for (int d = 0; d < 3; ++d)
        if (image.flipped[static_cast<std::size_t>(d)])
          books.add(StepSums::impulse_x + d, -2 * mass * as_real(node[4 + d]));
    });
  }
}

}  // namespace sluice::mpm

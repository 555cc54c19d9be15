// Impulse of mirrors on particles whose shape functions reach beyond them.
//
// The sums of an image i' join those of its node i with the normal component turned round, and the
// image gets the node's change of velocity likewise. Along the normal particles therefore take
// (M_i - M_i') dv_i where the node has (M_i + M_i') dv_i, and f_i - f_i' acts where f_i + f_i' sums
// up to nothing. The mirror gives the difference, -2 (dk f_i' + M_i' dv_i).
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {
namespace {

bool has_mirror(const NodeBoundary& boundary, int m) {
  return boundary.mirrored(0, m) || boundary.mirrored(1, m) || boundary.mirrored(2, m);
}

// act(node number, image) for images beyond mirrors in a block, where there is mass.
template <class Act>
void for_each_image(const NodeBoundary& boundary, const BlockShape& shape, IntVec3 low, int m,
                    const std::int64_t* nodes, Act&& act) {
  if (!boundary.has_images(low, shape.edge, m)) return;
  for (int n = 0; n < block_nodes; ++n) {
    if (nodes[n * lanes + count_lane] == 0) continue;
    const IntVec3 at = node_of(shape, low, n);
    if (boundary.is_image(at, m)) act(n, boundary.image(at, m));
  }
}

}  // namespace

void SolidStep::book_mirrored_forces(const NodeStep& step, int m, int block,
                                     NodeBooks& books) const {
  const Body& body = bodies_[static_cast<std::size_t>(m)];
  if (!has_mirror(*boundary_, m) || body.material->rigid || !exchange_->is_home(body.table, block))
    return;
  const std::int64_t* nodes = body.nodes.sums(block);
  for_each_image(*boundary_, shape_, shape_.lower(body.table.block(block)), m, nodes,
                 [&](int n, const NodeBoundary::Image& image) {
                   for (int d = 0; d < 3; ++d)
                     if (image.flipped[static_cast<std::size_t>(d)])
                       books.sums[static_cast<std::size_t>(StepSums::impulse_x + d)].add(
                           -2 * step.kick * as_real(nodes[n * lanes + 4 + d]));
                 });
}

// After the step on nodes, before images get the velocities of their nodes.
void SolidStep::book_mirrored_changes(NodeBooks& books) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const int m = static_cast<int>(k);
    if (!has_mirror(*boundary_, m) || bodies_[k].material->rigid) continue;
    book_mirrored_changes(m, bodies_[k].nodes, books);
    if (water_ != nullptr && water_->in(m)) book_mirrored_changes(m, water_->lanes_of(m), books);
  }
}

// Of the velocity that these lanes hold.
void SolidStep::book_mirrored_changes(int m, const NodeLanes& of, NodeBooks& books) const {
  const Body& body = bodies_[static_cast<std::size_t>(m)];
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = shape_.lower(body.table.block(b));
    if (!boundary_->meets(low, shape_.edge) || !exchange_->is_home(body.table, b)) continue;
    const std::int64_t* nodes = of.sums(b);
    for_each_image(*boundary_, shape_, low, m, nodes, [&](int n, const NodeBoundary::Image& image) {
      const int block = body.table.find(shape_.block_of(image.of));
      if (block < 0) return;
      const std::int64_t* node = of.sums(block) + shape_.place(image.of) * lanes;
      const double mass = as_real(nodes[n * lanes + 3]);
      for (int d = 0; d < 3; ++d)
        if (image.flipped[static_cast<std::size_t>(d)])
          books.sums[static_cast<std::size_t>(StepSums::impulse_x + d)].add(-2 * mass *
                                                                            as_real(node[4 + d]));
    });
  }
}

}  // namespace sluice::mpm

#include "mpm/boundary/node_boundary.hpp"

#include "framework/grid/gaps.hpp"
#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

NodeBoundary::NodeBoundary(const Scene& scene, const MpmScene& solids, const Level& level)
    : scene_(&scene),
      solids_(&solids),
      level_(level),
      gaps_(level.index == 0 && has_gaps(level)),
      mirror_(solids.materials.size()) {
  for (const SolidBoundary& b : solids.boundaries) {
    if (b.kind != SolidBoundary::Kind::symmetric || !level.active[direction_of(b.side)]) continue;
    for (std::size_t m = 0; m < mirror_.size(); ++m)
      if (b.material < 0 || b.material == static_cast<int>(m)) mirror_[m][index_of(b.side)] = true;
  }
}

bool NodeBoundary::meets(IntVec3 lower, IntVec3 edge) const {
  if (gaps_) return true;
  for (int d = 0; d < 3; ++d)
    if (level_.active[d] &&
        (lower[d] <= level_.domain.lower[d] || lower[d] + edge[d] > level_.domain.upper[d]))
      return true;
  return false;
}

// A Dirichlet value also holds at nodes beyond its side: those that wide shape functions reach.
GivenVelocity NodeBoundary::at(IntVec3 node, int material) const {
  GivenVelocity g;
  for (const SolidBoundary& b : solids_->boundaries) {
    const int d = direction_of(b.side);
    if (!level_.active[d] || (b.material >= 0 && b.material != material)) continue;
    const bool on =
        is_plus(b.side) ? node[d] >= level_.domain.upper[d] : node[d] <= level_.domain.lower[d];
    if (!on) continue;
    if (b.kind == SolidBoundary::Kind::symmetric) {
      g.given[d] = true;
      g.value[d] = 0;
    } else if (b.kind == SolidBoundary::Kind::velocity) {
      if (b.region > 0) {
        Vec3 place = level_.anchor + to_real(node) * level_.spacing;
        const BoundarySide& side = scene_->boundary.side(b.side);
        if (!side.regions[b.region].shape.contains(d, place)) continue;
      }
      g.given = {true, true, true};
      g.value = b.value;
    }
  }
  // What sticks to a wall does so on all its nodes.
  if (gaps_ && lies_on_gap(level_, node)) return {{true, true, true}, {}};
  return g;
}

bool NodeBoundary::is_image(IntVec3 node, int material) const {
  const auto& mirror = mirror_[material];
  for (int d = 0; d < 3; ++d) {
    if (!level_.active[d]) continue;
    const int low = level_.domain.lower[d], high = level_.domain.upper[d];
    if (level_.periodic[d]
            ? node[d] < low || node[d] >= high
            : (mirror[2 * d] && node[d] < low) || (mirror[2 * d + 1] && node[d] > high))
      return true;
  }
  return false;
}

std::array<bool, 3> NodeBoundary::on_mirror(IntVec3 node, int material) const {
  const auto& mirror = mirror_[material];
  std::array<bool, 3> on{};
  for (int d = 0; d < 3; ++d) {
    on[d] = (mirror[2 * d] && node[d] == level_.domain.lower[d]) ||
            (mirror[2 * d + 1] && node[d] == level_.domain.upper[d]);
  }
  return on;
}

NodeBoundary::Image NodeBoundary::image(IntVec3 node, int material) const {
  const auto& mirror = mirror_[material];
  Image image{node, {}};
  for (int d = 0; d < 3; ++d) {
    if (!level_.active[d]) continue;
    const int low = level_.domain.lower[d], high = level_.domain.upper[d], cells = high - low;
    if (level_.periodic[d]) {
      image.of[d] = low + ((node[d] - low) % cells + cells) % cells;
    } else if (mirror[2 * d] && node[d] < low) {
      image.of[d] = 2 * low - node[d];
      image.flipped[d] = true;
    } else if (mirror[2 * d + 1] && node[d] > high) {
      image.of[d] = 2 * high - node[d];
      image.flipped[d] = true;
    }
  }
  return image;
}

namespace {

// Of the nodes of a block along one direction: which are images, and of which.
struct AxisImages {
  int of[block_nodes];
  bool is[block_nodes], flipped[block_nodes];
};

// act(block, number in it of a node that is an image, of what it is one).
template <class Act>
void visit_images(const NodeBoundary& boundary, int material, const BlockTable& table, Act&& act) {
  const BlockShape& shape = table.shape();
  AxisImages axes[3];
  for (int b = 0, blocks = table.count(); b < blocks; ++b) {
    const IntVec3 low = shape.lower(table.block(b));
    if (!boundary.has_images(low, shape.edge, material)) continue;
    for (int d = 0; d < 3; ++d)
      for (int i = 0; i < shape.edge[d]; ++i) {
        IntVec3 node = low;
        node[d] += i;
        const NodeBoundary::Image image = boundary.image(node, material);
        axes[d].of[i] = image.of[d];
        axes[d].is[i] = image.of[d] != node[d];
        axes[d].flipped[i] = image.flipped[static_cast<std::size_t>(d)];
      }
    int n = 0;
    for (int k = 0; k < shape.edge.z; ++k)
      for (int j = 0; j < shape.edge.y; ++j)
        for (int i = 0; i < shape.edge.x; ++i, ++n)
          if (axes[0].is[i] || axes[1].is[j] || axes[2].is[k])
            act(b, n,
                NodeBoundary::Image{{axes[0].of[i], axes[1].of[j], axes[2].of[k]},
                                    {axes[0].flipped[i], axes[1].flipped[j], axes[2].flipped[k]}});
  }
}

// Lane of a component: of momentum (or v) and of force (or dv).
constexpr int first_lane[2] = {1, 4};

}  // namespace

void NodeBoundary::fold(int material, BlockTable& table, NodeLanes& nodes) const {
  fold(material, table, nodes, true);
}

void NodeBoundary::fold_scalars(int material, BlockTable& table, NodeLanes& nodes) const {
  fold(material, table, nodes, false);
}

void NodeBoundary::fold(int material, BlockTable& table, NodeLanes& nodes, bool vectors) const {
  visit_images(*this, material, table, [&](int b, int n, const Image& to) {
    if (nodes.sums(b)[n * lanes + count_lane] == 0) return;
    const int block = table.find_or_add(table.shape().block_of(to.of));
    nodes.fit(table);
    const std::int64_t* from = nodes.sums(b) + n * lanes;
    std::int64_t* sums = nodes.sums(block) + table.shape().place(to.of) * lanes;
    const std::int64_t count = from[count_lane];
    for (int l = 0; l < count_lane; ++l) {
      std::int64_t value = wrapped_difference(from[l], count);
      for (int d = 0; d < 3; ++d)
        if (vectors && to.flipped[d] && (l == first_lane[0] + d || l == first_lane[1] + d))
          value = -value;
      sums[l] = wrapped_sum(sums[l], wrapped_sum(value, count));
    }
    sums[count_lane] = wrapped_sum(sums[count_lane], count);
  });
}

void NodeBoundary::unfold(int material, const BlockTable& table, NodeLanes& nodes) const {
  unfold(material, table, nodes, true);
}

void NodeBoundary::unfold_scalars(int material, const BlockTable& table, NodeLanes& nodes) const {
  unfold(material, table, nodes, false);
}

void NodeBoundary::unfold(int material, const BlockTable& table, NodeLanes& nodes,
                          bool vectors) const {
  IntVec3 of_block{};  // neighbours are mostly images of one block
  int block = -1;
  visit_images(*this, material, table, [&](int b, int n, const Image& of) {
    if (const IntVec3 at = table.shape().block_of(of.of); block < 0 || !(at == of_block)) {
      of_block = at;
      block = table.find(at);
    }
    if (block < 0) return;
    const std::int64_t* from = nodes.sums(block) + table.shape().place(of.of) * lanes;
    std::int64_t* to = nodes.sums(b) + n * lanes;
    for (int l = 0; l < lanes; ++l) to[l] = from[l];
    for (int d = 0; d < 3; ++d)
      if (vectors && of.flipped[d])
        for (const int first : {0, 4}) to[first + d] = as_bits(-as_real(from[first + d]));
  });
}

}  // namespace sluice::mpm

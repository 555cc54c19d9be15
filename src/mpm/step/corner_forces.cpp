#include "mpm/step/corner_forces.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

// act(node, weight) for the nodes around the place of a corner; `first`: lowest node of the domain.
template <class Act>
void for_each_node_around(const TransferGrid& grid, IntVec3 first, Vec3 place, Act&& act) {
  AxisWeights<2> weights[3];
  IntVec3 size{1, 1, 1};
  for (int a = 0; a < grid.count; ++a) {
    const int d = grid.active[static_cast<std::size_t>(a)];
    const double x = place[d];
    Linear::weights<false>(grid.axes[static_cast<std::size_t>(d)], &x, 0, 1, weights[d]);
    first[d] = weights[d].first[0];
    size[d] = 2;
  }
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const IntVec3 at = first + IntVec3{i, j, k};
        double w = 1;
        for (int d = 0; d < 3; ++d)
          if (size[d] == 2) w *= weights[d].w[at[d] - first[d]][0];
        act(at, w);
      }
}

// The number of the block that was asked for last: most nodes around a corner lie in one.
class LastBlock {
 public:
  // find(block): its number.
  template <class Find>
  int of(IntVec3 block, Find&& find) {
    if (!known_ || !(block == block_)) number_ = find(block);
    known_ = true;
    block_ = block;
    return number_;
  }

 private:
  bool known_ = false;
  IntVec3 block_{};
  int number_ = -1;
};

}  // namespace

CornerForces::CornerForces(const MpmScene& solids, const LevelNodes& nodes,
                           std::vector<Body>& bodies, const std::vector<BlockWork>& work,
                           const OutsideForces& outside, const MappedBack* mapped)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      work_(&work),
      outside_(&outside),
      mapped_(mapped),
      corners_(solids.materials.size()) {}

void CornerForces::begin(const StageScope& /*scope*/) {
  for (OfBody& of : corners_) {
    of.forces.clear();
    of.loads = 0;
  }
  if (!solids_->loads_on_corners || !outside_->any()) return;
  for (const BlockWork& w : *work_)
    if (outside_->acts(w.kind))
      outside_->add_corners(w.kind, w.box, *w.set, w.run.begin, w.run.end,
                            corners_[static_cast<std::size_t>(w.kind)].forces);
  for (OfBody& of : corners_) of.loads = of.forces.size();
}

double CornerForces::most_force(int m) const {
  double most = 0;
  for (const CornerForce& c : corners_[static_cast<std::size_t>(m)].forces)
    for (int d = 0; d < 3; ++d) most = std::max(most, std::fabs(c.force[d]));
  return most;
}

void CornerForces::add(int m, std::span<const CornerForce> forces) {
  solids::CornerForces& all = corners_[static_cast<std::size_t>(m)].forces;
  all.insert(all.end(), forces.begin(), forces.end());
}

void CornerForces::give_beside() {
  for (std::size_t m = 0; m < corners_.size(); ++m) {
    Body& body = (*bodies_)[m];
    LastBlock last;
    for (const CornerForce& corner : corners_[m].forces)
      for_each_node_around(
          body.grid, nodes_->level.domain.lower, corner.place, [&](IntVec3 at, double weight) {
            const double w = body.units.force * weight;
            const int block = last.of(nodes_->shape.block_of(at), [&](IntVec3 b) {
              const int found = body.table.find_or_add(b);
              body.nodes.fit(body.table);
              return found;
            });
            std::int64_t* node = body.nodes.sums(block) + nodes_->shape.place(at) * lanes;
            add_rounded(node, Four{});
            add_rounded(node + 4,
                        Four{w * corner.force.x, w * corner.force.y, w * corner.force.z, 0.0});
          });
  }
}

// Mean velocity before and behind the kick around a corner; in the midpoint transfer behind it that
// which particles have given back, at the place of the corner in the middle of the step: an impulse
// gives as much energy as it moves particles.
Vec3 CornerForces::mean_velocity(std::size_t m, Vec3 place) const {
  const Body& body = (*bodies_)[m];
  LastBlock last;
  Vec3 before = body.units.reference, after = body.units.reference;
  const auto visit = [&](Vec3 at, const auto& act) {
    for_each_node_around(body.grid, nodes_->level.domain.lower, at, [&](IntVec3 node, double w) {
      const int block =
          last.of(nodes_->shape.block_of(node), [&](IntVec3 b) { return body.table.find(b); });
      if (block >= 0) act(block, nodes_->shape.place(node) * lanes, w);
    });
  };
  visit(place, [&](int block, int at, double w) {
    const std::int64_t* node = body.nodes.sums(block) + at;
    for (int d = 0; d < 3; ++d) {
      before[d] += w * (as_real(node[d]) - as_real(node[4 + d]));
      after[d] += w * as_real(node[d]);
    }
  });
  if (mapped_ == nullptr) return 0.5 * (before + after);
  const Vec3 middle = place + (0.5 * step_.dt) * after;
  const int number = static_cast<int>(m);
  after = mapped_->units(number).reference;
  visit(middle, [&](int block, int at, double w) {
    const std::int64_t* node = mapped_->of(number).sums(block) + at;
    for (int d = 0; d < 3; ++d) after[d] += w * as_real(node[d]);
  });
  return 0.5 * (before + after);
}

void CornerForces::after_nodes(const NodeStep& step, NodeBooks& books) {
  step_ = step;
  if (mapped_ == nullptr) book_work(books);
}

void CornerForces::before_particles(const StageScope& /*scope*/, NodeBooks& books) {
  if (mapped_ != nullptr) book_work(books);
}

// Of forces begin to end - 1 of a body.
void CornerForces::add_work(std::size_t m, std::size_t begin, std::size_t end,
                            NodeBooks& books) const {
  const OfBody& of = corners_[m];
  for (std::size_t n = begin; n < end; ++n) {
    const double power = dot(of.forces[n].force, mean_velocity(m, of.forces[n].place));
    const double work = step_.kick * power;
    const bool load = n < of.loads;
    books.bodies[m][load ? BodyEnergySums::load_work : BodyEnergySums::corner_work].add(work);
    if (load) books.add(StepSums::force_work, work);
  }
}

void CornerForces::book_work(NodeBooks& books) const {
  constexpr std::size_t range = 1024;  // forces that a thread takes at once
  std::vector<NodeBooks> own(static_cast<std::size_t>(nodes_->team->size()));
  for (NodeBooks& b : own) b.make_room(corners_.size());
  for (std::size_t m = 0; m < corners_.size(); ++m) {
    const std::size_t count = corners_[m].forces.size();
    nodes_->team->for_each((count + range - 1) / range, [&](std::size_t n, int thread) {
      add_work(m, n * range, std::min(count, (n + 1) * range),
               own[static_cast<std::size_t>(thread)]);
    });
  }
  for (const NodeBooks& b : own) books.merge(b);
}

}  // namespace sluice::mpm

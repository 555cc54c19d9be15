// Loads on corners go to nodes; the books of forces from outside, and their saved column.
#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// Impulse dk f and work dk f . (v + v*)/2 at the places of the particles: with the weights of the
// particle sum to the same over nodes. The work of loads on corners is booked with these.
void SolidStep::take_outside_forces(const BlockWork& w, std::size_t at, int n,
                                    const GridAtParticles& read, NodeBooks& books) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(w.kind)].columns;
  const OutsideForces::Columns3 f = outside_->forces(w.kind, w.box);
  if (c.outside_force >= 0)
    for (int d = 0; d < 3; ++d) {
      double* to = w.next->column(static_cast<std::size_t>(c.outside_force + d)) + at;
      for (int q = 0; q < n; ++q) {
        const std::size_t p = at + static_cast<std::size_t>(q);
        to[q] = f[0] == nullptr ? 0.0 : f[static_cast<std::size_t>(d)][p];
        if (d == 0) to[q] -= outside_->hoop(w.kind, *w.set, p);
      }
    }
  if (c.heat_source >= 0) {
    const double* q_p = heat_ != nullptr ? heat_->sources(w.kind, w.box) : nullptr;
    double* to = w.next->column(static_cast<std::size_t>(c.heat_source)) + at;
    for (int q = 0; q < n; ++q) to[q] = q_p != nullptr ? q_p[at + static_cast<std::size_t>(q)] : 0;
  }
  if (f[0] == nullptr) return;
  const OutsideForces::Columns3 middle = outside_->middle_forces(w.kind, w.box);
  const Vec3 reference = bodies_[static_cast<std::size_t>(w.kind)].units.reference;
  for (int q = 0; q < n; ++q) {
    const std::size_t p = at + static_cast<std::size_t>(q);
    const Vec3 whole{f[0][p], f[1][p], f[2][p]};
    if (whole == Vec3{}) continue;
    for (int d = 0; d < 3; ++d)
      books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(kick_ * whole[d]);
    Vec3 force = middle[0] == nullptr ? Vec3{} : Vec3{middle[0][p], middle[1][p], middle[2][p]};
    force.x -= outside_->hoop(w.kind, *w.set, p);
    double power = 0;
    for (int d = 0; d < 3; ++d)
      power += force[d] * (reference[d] + read.u[d][q] - 0.5 * read.dv[d][q]);
    books.sums[StepSums::force_work].add(kick_ * power);
    books.bodies[static_cast<std::size_t>(w.kind)][BodyEnergySums::load_work].add(kick_ * power);
  }
}

// The largest component of a force on a corner.
double SolidStep::find_corners(int kind) {
  Body& body = bodies_[static_cast<std::size_t>(kind)];
  body.corners.clear();
  if (!outside_->acts(kind)) return 0;
  for (const BlockWork& w : work_)
    if (w.kind == kind)
      outside_->add_corners(kind, w.box, *w.set, w.run.begin, w.run.end, body.corners);
  double most = 0;
  for (const CornerForce& c : body.corners)
    for (int d = 0; d < 3; ++d) most = std::max(most, std::fabs(c.force[d]));
  return most;
}

void SolidStep::add_corner_forces(int m, std::span<const CornerForce> forces) {
  std::vector<CornerForce>& all = body(m).corners;
  all.insert(all.end(), forces.begin(), forces.end());
}

// act(node, weight) for the nodes around the place of a corner: hat functions, whatever the basis.
template <class Act>
static void for_each_node_around(const TransferGrid& grid, IntVec3 first, Vec3 place, Act&& act) {
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

void SolidStep::corners_to_grid() {
  for (Body& body : bodies_)
    for (const CornerForce& corner : body.corners)
      for_each_node_around(
          body.grid, level_.domain.lower, corner.place, [&](IntVec3 at, double weight) {
            const double w = body.units.force * weight;
            const int block = body.table.find_or_add(shape_.block_of(at));
            body.nodes.fit(body.table);
            std::int64_t* node = body.nodes.sums(block) + shape_.place(at) * lanes;
            add_rounded(node, Four{});
            add_rounded(node + 4,
                        Four{w * corner.force.x, w * corner.force.y, w * corner.force.z, 0.0});
          });
}

// Mean velocity before and behind the kick around a corner; in the midpoint transfer behind it that
// which particles have given back, at the place of the corner in the middle of the step: an impulse
// gives as much energy as it moves particles.
Vec3 SolidStep::mean_velocity_of_corner(const Body& body, Vec3 place, double dt) const {
  Vec3 before = body.units.reference, after = body.units.reference;
  const auto visit = [&](Vec3 at, const auto& act) {
    for_each_node_around(body.grid, level_.domain.lower, at, [&](IntVec3 node, double w) {
      const int block = body.table.find(shape_.block_of(node));
      if (block >= 0) act(block, shape_.place(node) * lanes, w);
    });
  };
  visit(place, [&](int block, int at, double w) {
    const std::int64_t* node = body.nodes.sums(block) + at;
    for (int d = 0; d < 3; ++d) {
      before[d] += w * (as_real(node[d]) - as_real(node[4 + d]));
      after[d] += w * as_real(node[d]);
    }
  });
  if (!solids_->midpoint()) return 0.5 * (before + after);
  const Vec3 middle = place + (0.5 * dt) * after;
  after = body.mapped_units.reference;
  visit(middle, [&](int block, int at, double w) {
    const std::int64_t* node = body.mapped.sums(block) + at;
    for (int d = 0; d < 3; ++d) after[d] += w * as_real(node[d]);
  });
  return 0.5 * (before + after);
}

// Work of loads on corners, and of what a fluid gives to corners.
void SolidStep::book_corner_work(double dt, NodeBooks& books) const {
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    const Body& body = bodies_[m];
    for (std::size_t n = 0; n < body.corners.size(); ++n) {
      const CornerForce& corner = body.corners[n];
      const double power = dot(corner.force, mean_velocity_of_corner(body, corner.place, dt));
      const bool load = n < body.corner_loads;
      books.bodies[m][load ? BodyEnergySums::load_work : BodyEnergySums::corner_work].add(kick_ *
                                                                                          power);
      if (load) books.sums[StepSums::force_work].add(kick_ * power);
    }
  }
}

// InsertParticles: particles of a colour are elsewhere at the end of the step.
void SolidStep::jump(const BlockWork& w, std::size_t at, int n, bool& left) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(w.kind)].columns;
  if (c.colour < 0) return;
  const double* colour = w.set->column(static_cast<std::size_t>(c.colour)) + at;
  for (const Insertion& i : jumps_) {
    if (i.material >= 0 && i.material != w.kind) continue;
    for (int q = 0; q < n; ++q) {
      if (colour[q] != i.colour) continue;
      for (int d = 0; d < 3; ++d) {
        (w.next->coordinate(d) + at)[q] += i.way[d];
        (w.next->column(static_cast<std::size_t>(c.velocity + d)) + at)[q] = i.velocity[d];
        if (c.spin >= 0) (w.next->column(static_cast<std::size_t>(c.spin + d)) + at)[q] = 0;
        const double way = bodies_[static_cast<std::size_t>(w.kind)]
                               .grid.axes[static_cast<std::size_t>(d)]
                               .rounded(i.way[d]);
        for (int k = 0; k < c.corner_count; ++k)
          (w.next->column(static_cast<std::size_t>(c.corners + 3 * k + d)) + at)[q] += way;
      }
      left = true;  // of its block at least
    }
  }
}

}  // namespace sluice::mpm

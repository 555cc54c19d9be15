#include "mpm/implicit/step_books.hpp"

#include "framework/base/exact_sum.hpp"
#include "mpm/material/base/tensor.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {
namespace {

using Sums3 = std::array<ExactSum, 3>;

Vec3 gravity_of(const NodesOfStep::Parts& p) {
  Vec3 g{};
  for (int d = 0; d < 3; ++d)
    if (p.level->active[static_cast<std::size_t>(d)]) g[d] = p.scene->constants.gravity[d];
  return g;
}

struct NodeForces {
  std::vector<Vec3> inner, outer;  // of stresses; of loads and gravity
};

// Of what particles are before the step.
NodeForces forces_before(const FinishedStep& s) {
  const NodesOfStep::Parts& p = s.parts;
  NodeForces f{std::vector<Vec3>(s.nodes->count()), std::vector<Vec3>(s.nodes->count())};
  const Vec3 gravity = gravity_of(p);
  constexpr int place[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    if (p.solids->materials[k].rigid) continue;
    const ParticleSet& set = p.particles->kind(k).now;
    const Columns& c = (*p.carried)[k].columns;
    const Stencils& to = p.reached->of(k);
    const auto value = [&](int column, std::size_t q) {
      return set.column(static_cast<std::size_t>(column))[q];
    };
    for (std::size_t q = 0; q < set.size(); ++q) {
      Matrix T, F;
      for (std::size_t e = 0; e < 9; ++e) {
        T[e] = value(c.volume, q) * value(c.stress + place[e], q);
        F[e] = value(c.F + static_cast<int>(e), q);
      }
      if (p.solids->total_lagrangian) T = product(T, transposed(inverse(F)));
      const Vec3 load = (*s.loads_before)[k].empty() ? Vec3{} : (*s.loads_before)[k][q];
      for (std::size_t e = to.first(q); e < to.first(q + 1); ++e) {
        const auto n = static_cast<std::size_t>(to.node[e]);
        const std::array<double, 3>& g = to.slope[e];
        for (int d = 0; d < 3; ++d) {
          const std::size_t row = 3 * static_cast<std::size_t>(d);
          const double sign = to.sign(e, d);
          f.inner[n][d] -= sign * (T[row] * g[0] + T[row + 1] * g[1] + T[row + 2] * g[2]);
          f.outer[n][d] += sign * to.weight[e] * (load[d] + value(c.mass, q) * gravity[d]);
        }
      }
    }
  }
  return f;
}

struct ParticleSums {
  Sums3 outside;  // momentum that loads and gravity give, in the mean of start and end
  Sums3 gained;   // that particles gain
  Sums3 rigid;    // of these those of rigid bodies
  ExactSum rigid_gain;
};

void add_of_particles(const FinishedStep& s, ParticleSums& sums) {
  const NodesOfStep::Parts& p = s.parts;
  const Vec3 gravity = gravity_of(p);
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    const AllParticles::Kind& kind = p.particles->kind(k);
    const Columns& c = (*p.carried)[k].columns;
    const double* m = kind.now.column(static_cast<std::size_t>(c.mass));
    const auto v0 = read_columns<3>(kind.now, c.velocity),
               v1 = read_columns<3>(kind.next, c.velocity);
    const bool rigid = p.solids->materials[k].rigid, loaded = !(*s.loads)[k].empty();
    for (std::size_t q = 0; q < kind.now.size(); ++q)
      for (int d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        const double change = m[q] * (v1[axis][q] - v0[axis][q]);
        sums.gained[axis].add(change);
        if (rigid) {
          sums.rigid[axis].add(change);
          sums.rigid_gain.add(0.5 * change * (v1[axis][q] + v0[axis][q]));
          continue;
        }
        sums.outside[axis].add(s.dt * m[q] * gravity[d]);
        if (loaded)
          sums.outside[axis].add(0.5 * s.dt * ((*s.loads_before)[k][q][d] + (*s.loads)[k][q][d]));
      }
  }
}

// What the nodes beyond a mirror throw back: particles feel these with the other sign.
void add_of_mirrors(const FinishedStep& s, Sums3& impulse) {
  const NodesOfStep::Parts& p = s.parts;
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    if (p.solids->materials[k].rigid) continue;
    const ParticleSet& set = p.particles->kind(k).now;
    const double* m = set.column(static_cast<std::size_t>((*p.carried)[k].columns.mass));
    const Stencils& to = p.reached->of(k);
    const std::vector<double>& T = s.equilibrium->particles().stress(k);
    for (std::size_t e = 0; e < to.node.size(); ++e) {
      if (to.flipped[e] == 0) continue;
      const std::size_t q = e / static_cast<std::size_t>(to.per);
      const auto n = static_cast<std::size_t>(to.node[e]);
      const std::array<double, 3>& g = to.slope[e];
      for (int d = 0; d < 3; ++d) {
        if (to.sign(e, d) > 0) continue;
        const auto axis = static_cast<std::size_t>(d);
        const double* row = T.data() + 9 * q + 3 * axis;
        const double change = s.nodes->velocity(n)[d] - s.nodes->v0[n][d];
        impulse[axis].add(-2 * m[q] * to.weight[e] * change);
        impulse[axis].add(s.dt * (row[0] * g[0] + row[1] * g[1] + row[2] * g[2]));
      }
    }
  }
}

// Force of what deforms on rigid bodies at the end of the step, and its torque about the origin.
void add_reactions(const FinishedStep& s, std::vector<double>& sums) {
  const NodesOfStep& nodes = *s.nodes;
  const Level& level = *s.parts.level;
  Sums3 force, torque;
  for (std::size_t n = 0; n < nodes.count(); ++n) {
    Vec3 f{};
    const Vec3 v1 = nodes.velocity(n);
    for (int d = 0; d < 3; ++d) {
      if (!nodes.by_rigid[n][static_cast<std::size_t>(d)]) continue;
      f[d] = s.equilibrium->inner_forces()[n][d] + s.equilibrium->smoothing_forces()[n][d] +
             nodes.force[n][d];
      if (nodes.dynamic()) f[d] -= nodes.mass[n] * (v1[d] - nodes.v0[n][d]) / s.dt;
      force[static_cast<std::size_t>(d)].add(f[d]);
    }
    const Vec3 x = level.anchor + to_real(s.parts.reached->index(n)) * level.spacing;
    torque[0].add(x.y * f.z - x.z * f.y);
    torque[1].add(x.z * f.x - x.x * f.z);
    torque[2].add(x.x * f.y - x.y * f.x);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    sums[StepSums::reaction_x + d] += force[d].value();
    sums[StepSums::torque_x + d] += torque[d].value();
  }
}

struct NodeSums {
  Sums3 impulse;  // of all that acts, in the sense of the rule, but the stresses within
  ExactSum gain, within, outside, given, smoothed;
};

void add_of_nodes(const FinishedStep& s, NodeSums& sums) {
  const NodesOfStep& nodes = *s.nodes;
  const std::vector<Vec3>& inner = s.equilibrium->inner_forces();
  const std::vector<Vec3>& smoothing = s.equilibrium->smoothing_forces();
  const NodeForces before = forces_before(s);
  for (std::size_t n = 0; n < nodes.count(); ++n) {
    if (!(nodes.mass[n] > 0)) continue;
    const Vec3 v1 = nodes.velocity(n), v0 = nodes.v0[n];
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      const double change = nodes.mass[n] * (v1[d] - v0[d]), gain = 0.5 * change * (v1[d] + v0[d]);
      const double within = 0.5 * (before.inner[n][d] + inner[n][d]) * nodes.u[n][d],
                   outside = 0.5 * (before.outer[n][d] + nodes.force[n][d]) * nodes.u[n][d];
      sums.gain.add(gain);
      sums.within.add(within);
      sums.outside.add(outside);
      // Second differences begin with no force.
      const double smoothed = 0.5 * smoothing[n][d] * nodes.u[n][d];
      sums.smoothed.add(smoothed);
      if (nodes.is_free(n, d) && nodes.dynamic()) {
        sums.impulse[axis].add(0.5 * s.dt * (nodes.mass[n] * nodes.a0[n][d] + nodes.force[n][d]));
      } else {
        sums.impulse[axis].add(change - 0.5 * s.dt * (inner[n][d] + smoothing[n][d]));
        // Without inertia a node's motion is not gained from anything.
        sums.given.add(nodes.is_free(n, d) ? gain : gain - within - outside - smoothed);
      }
    }
  }
}

}  // namespace

void book_step(const FinishedStep& step, std::vector<double>& sums) {
  ParticleSums of_particles;
  add_of_particles(step, of_particles);
  NodeSums of_nodes;
  add_of_nodes(step, of_nodes);
  Sums3 mirrors;
  add_of_mirrors(step, mirrors);
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const double outside = of_particles.outside[axis].value();
    const double acted = step.nodes->dynamic()
                             ? of_nodes.impulse[axis].value() + mirrors[axis].value() +
                                   of_particles.rigid[axis].value()
                             : of_particles.gained[axis].value();
    sums[static_cast<std::size_t>(StepSums::impulse_x + d)] += acted - outside;
    sums[static_cast<std::size_t>(StepSums::force_x + d)] += outside;
  }
  add_reactions(step, sums);
  const double rigid_gain = of_particles.rigid_gain.value();
  sums[StepSums::work] += of_nodes.given.value() + rigid_gain;
  sums[StepSums::force_work] += of_nodes.outside.value();
  sums[StepSums::node_gain] += of_nodes.gain.value() + rigid_gain;
  sums[StepSums::node_work] += of_nodes.within.value();
  // No friction in implicit steps: the place is free (ImplicitMpmBudgets).
  sums[StepSums::contact_loss] -= of_nodes.smoothed.value();
}

}  // namespace sluice::mpm

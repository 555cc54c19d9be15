#include "mpm/implicit/nodes_of_step.hpp"

namespace sluice::mpm {

NodesOfStep::NodesOfStep(const Parts& parts, const Vectors& rigid, const Vectors& forces, double dt,
                         bool first_step)
    : level_(parts.level), dt_(dt), dynamic_(parts.solids->implicit->dynamic) {
  const std::size_t n = parts.reached->count();
  deforms.assign(n, false);
  mass.assign(n, 0.0);
  for (std::vector<Vec3>* field : {&v0, &a0, &force, &u, &way}) field->assign(n, Vec3{});
  given.assign(n, {});
  by_rigid.assign(n, {});
  kinds_.assign(parts.particles->count(), std::vector<bool>(n, false));
  sum(parts, forces);
  find_given(parts, rigid);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(mass[i] > 0)) continue;
    // A run begins with the acceleration of what acts on it then.
    if (first_step) a0[i] = (1 / mass[i]) * force[i];
    for (int d = 0; d < 3; ++d) {
      if (!level_->active[static_cast<std::size_t>(d)]) continue;
      u[i][d] = dt_ * (v0[i][d] + (dynamic_ ? 0.5 * dt_ * a0[i][d] : 0));
    }
  }
}

void NodesOfStep::sum(const Parts& p, const Vectors& forces) {
  Vec3 gravity{};
  for (int d = 0; d < 3; ++d)
    if (level_->active[static_cast<std::size_t>(d)]) gravity[d] = p.scene->constants.gravity[d];
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    if (p.solids->materials[k].rigid) continue;
    const ParticleSet& set = p.particles->kind(k).now;
    const Columns& c = (*p.carried)[k].columns;
    const Stencils& s = p.reached->of(k);
    const double* m = set.column(static_cast<std::size_t>(c.mass));
    const auto v = read_columns<3>(set, c.velocity), a = read_columns<3>(set, c.acceleration);
    for (std::size_t q = 0; q < set.size(); ++q)
      for (std::size_t e = s.first(q); e < s.first(q + 1); ++e) {
        const auto n = static_cast<std::size_t>(s.node[e]);
        const double share = m[q] * s.weight[e];
        mass[n] += share;
        if (share > 0) kinds_[k][n] = true;
        const std::array<double, 3>& g = s.slope[e];
        if (share > 0 || g[0] != 0 || g[1] != 0 || g[2] != 0) deforms[n] = true;
        for (int d = 0; d < 3; ++d) {
          const auto axis = static_cast<std::size_t>(d);
          const double sign = s.sign(e, d);
          v0[n][d] += share * sign * v[axis][q];
          a0[n][d] += share * sign * a[axis][q];
          force[n][d] += share * sign * gravity[d];
          if (!forces[k].empty()) force[n][d] += s.weight[e] * sign * forces[k][q][d];
        }
      }
  }
  for (std::size_t n = 0; n < count(); ++n)
    if (mass[n] > 0) {
      v0[n] = (1 / mass[n]) * v0[n];
      a0[n] = (1 / mass[n]) * a0[n];
    }
}

// Sides first; where they do not say, rigid particles do, by their mean displacement.
void NodesOfStep::find_given(const Parts& p, const Vectors& rigid) {
  for (std::size_t n = 0; n < count(); ++n)
    for (std::size_t k = 0; k < p.particles->count(); ++k) {
      if (p.solids->materials[k].rigid || (mass[n] > 0 && !holds(n, k))) continue;
      const GivenVelocity g = p.boundary->at(p.reached->index(n), static_cast<int>(k));
      for (int d = 0; d < 3; ++d)
        if (g.given[static_cast<std::size_t>(d)]) {
          given[n][static_cast<std::size_t>(d)] = true;
          way[n][d] = dt_ * g.value[d];
        }
    }
  for (const ContactRule& rule : p.solids->rigid_contacts) {
    std::vector<double> share(count());
    std::vector<Vec3> moved(count());
    for (std::size_t k = 0; k < p.particles->count(); ++k) {
      if (!p.solids->materials[k].rigid || rigid[k].empty() || !rule.takes(static_cast<int>(k)))
        continue;
      const ParticleSet& set = p.particles->kind(k).now;
      const double* m = set.column(static_cast<std::size_t>((*p.carried)[k].columns.mass));
      const Stencils& s = p.reached->of(k);
      for (std::size_t q = 0; q < set.size(); ++q)
        for (std::size_t e = s.first(q); e < s.first(q + 1); ++e) {
          const auto n = static_cast<std::size_t>(s.node[e]);
          const double weight = m[q] * s.weight[e];
          share[n] += weight;
          for (int d = 0; d < 3; ++d) moved[n][d] += weight * s.sign(e, d) * rigid[k][q][d];
        }
    }
    for (std::size_t n = 0; n < count(); ++n) {
      bool takes = !(mass[n] > 0);
      for (std::size_t k = 0; k < p.particles->count(); ++k)
        takes |= holds(n, k) && rule.takes(static_cast<int>(k));
      if (!(share[n] > 0) || !takes) continue;
      for (int d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        if (rule.directions[d] == 0 || !level_->active[axis] || given[n][axis]) continue;
        given[n][axis] = by_rigid[n][axis] = true;
        way[n][d] = moved[n][d] / share[n];
      }
    }
  }
}

Vec3 NodesOfStep::acceleration(std::size_t n) const {
  Vec3 a{};
  if (!dynamic_) return a;
  for (int d = 0; d < 3; ++d)
    if (is_free(n, d)) a[d] = 4 * u[n][d] / (dt_ * dt_) - 4 * v0[n][d] / dt_ - a0[n][d];
  return a;
}

Vec3 NodesOfStep::velocity(std::size_t n) const {
  Vec3 v{};
  for (int d = 0; d < 3; ++d) {
    if (!level_->active[static_cast<std::size_t>(d)]) continue;
    v[d] = dynamic_ && is_free(n, d) ? 2 * u[n][d] / dt_ - v0[n][d] : u[n][d] / dt_;
  }
  return v;
}

}  // namespace sluice::mpm

#include "mpm/implicit/second_differences.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

constexpr double share = 1e-4, share_of_few = 1e-3;  // g; where particles are few
constexpr double many = 1.5;                         // volume of a particle over V_c/2^d: few
constexpr double most_shear = 3.5;                   // E over the shear modulus: of nu = .3
constexpr double most_courant = 10;                  // with inertia: none up to here
constexpr double difference[3] = {1, -2, 1};         // c

double cell_volume(const Level& level) {
  return level.spacing.x * level.spacing.y * level.spacing.z;
}

// Volume hardly changes in modes that need this stiffness: of materials that resist such changes
// far more than shear, a part of rho c^2 counts.
double part_of_modulus(const Material& law) {
  const double shear = law.shear_modulus(), all = law.bulk_modulus() + 4.0 / 3 * shear;
  return shear > 0 && all > most_shear * shear ? most_shear * shear / all : 1;
}

}  // namespace

bool SecondDifferences::needed(const NodesOfStep::Parts& parts, const NodesOfStep& nodes,
                               const ParticleStresses& particles) {
  if (!nodes.dynamic()) return true;
  double least = 1e300, largest = 0;
  for (int d = 0; d < 3; ++d)
    if (parts.level->active[static_cast<std::size_t>(d)])
      least = std::min(least, parts.level->spacing[d]);
  for (std::size_t k = 0; k < particles.kinds(); ++k) {
    const std::vector<double>& modulus = particles.modulus(k);
    if (modulus.empty()) continue;
    const ParticleSet& set = parts.particles->kind(k).now;
    const Columns& c = (*parts.carried)[k].columns;
    const double* m = set.column(static_cast<std::size_t>(c.mass));
    const double* V = set.column(static_cast<std::size_t>(c.volume));
    for (std::size_t p = 0; p < modulus.size(); ++p)
      largest = std::max(largest, modulus[p] * V[p] / m[p]);
  }
  return std::sqrt(largest) * nodes.dt() > most_courant * least;
}

SecondDifferences::SecondDifferences(const NodesOfStep::Parts& parts, const NodesOfStep& nodes,
                                     const ParticleStresses& particles, NodePairs& pairs) {
  find_triples(*parts.reached, nodes, pairs);
  find_coefficients(parts, particles);
  pairs.add(triples_);
}

void SecondDifferences::find_triples(const ReachedNodes& reached, const NodesOfStep& nodes,
                                     const NodePairs& pairs) {
  for (std::size_t n = 0; n < reached.count(); ++n) {
    if (!nodes.deforms[n]) continue;
    const auto middle = static_cast<std::int32_t>(n);
    for (int d = 0; d < 3; ++d) {
      if (!reached.active(d)) continue;
      IntVec3 before = reached.index(n), after = before;
      --before[d];
      ++after[d];
      const std::int32_t a = reached.find(reached.wrap(before)),
                         b = reached.find(reached.wrap(after));
      // Nodes of two bodies that no particle joins are none of a body.
      if (a < 0 || b < 0 || a == b || !pairs.act(a, middle) || !pairs.act(middle, b)) continue;
      triples_.push_back({a, middle, b});
      axis_.push_back(static_cast<std::int8_t>(d));
    }
  }
}

// Means over the particles of a node, by mass.
void SecondDifferences::find_coefficients(const NodesOfStep::Parts& parts,
                                          const ParticleStresses& particles) {
  const std::size_t n = parts.reached->count();
  std::vector<double> mass(n), modulus(n), volume(n);
  double dimensions = 0;
  for (const bool active : parts.level->active) dimensions += active ? 1 : 0;
  for (std::size_t k = 0; k < particles.kinds(); ++k) {
    if (particles.modulus(k).empty()) continue;
    const ParticleSet& set = parts.particles->kind(k).now;
    const Columns& c = (*parts.carried)[k].columns;
    const double* m = set.column(static_cast<std::size_t>(c.mass));
    const double* V0 = set.column(static_cast<std::size_t>(c.volume_0));
    const Stencils& s = parts.reached->of(k);
    const double part = part_of_modulus(*parts.solids->materials[k].law);
    for (std::size_t p = 0; p < set.size(); ++p)
      for (std::size_t e = s.first(p); e < s.first(p + 1); ++e) {
        const auto node = static_cast<std::size_t>(s.node[e]);
        // S, and h |G| where S is round-off
        double reach = std::fabs(s.weight[e]);
        for (int d = 0; d < 3; ++d)
          reach = std::max(
              reach, std::fabs(s.slope[e][static_cast<std::size_t>(d)]) * parts.level->spacing[d]);
        const double weight = m[p] * reach;
        mass[node] += weight;
        modulus[node] += weight * part * particles.modulus(k)[p];
        volume[node] += weight * V0[p];
      }
  }
  const double cell = cell_volume(*parts.level);
  for (std::size_t t = 0; t < triples_.size(); ++t) {
    const auto middle = static_cast<std::size_t>(triples_[t][1]);
    const double h = parts.level->spacing[axis_[t]], M = mass[middle];
    const bool few = volume[middle] > many * M * cell / std::pow(2.0, dimensions);
    coefficient_.push_back(
        M > 0 ? (few ? share_of_few : share) * modulus[middle] / M * cell / (h * h) : 0);
  }
}

void SecondDifferences::add_forces(const NodesOfStep& nodes, std::vector<Vec3>& forces) const {
  for (std::size_t t = 0; t < triples_.size(); ++t) {
    Vec3 second{};  // c^T u
    for (std::size_t i = 0; i < 3; ++i)
      second += difference[i] * nodes.u[static_cast<std::size_t>(triples_[t][i])];
    for (std::size_t i = 0; i < 3; ++i)
      forces[static_cast<std::size_t>(triples_[t][i])] -= coefficient_[t] * difference[i] * second;
  }
}

void SecondDifferences::add_stiffness(Stiffness& stiffness) const {
  for (std::size_t t = 0; t < triples_.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        stiffness.add(triples_[t][i], triples_[t][j],
                      coefficient_[t] * difference[i] * difference[j]);
}

}  // namespace sluice::mpm

#include "mpm/contact/node_rules.hpp"

#include <cmath>

namespace sluice::mpm {

static double length(Vec3 a) {
  return std::sqrt(dot(a, a));
}

// Mean by mass, counted from the first: equal velocities give that velocity to the bit.
template <class Counts>
static bool mean_velocity(std::span<const ContactBody> parties, Counts&& counts, Vec3& v) {
  const AtNode* first = nullptr;
  double mass = 0;
  Vec3 sum{};
  for (const ContactBody& p : parties) {
    if (!counts(p)) continue;
    if (first == nullptr) first = p.at;
    mass += p.at->mass;
    sum += p.at->mass * (p.at->v - first->v);
  }
  if (first == nullptr) return false;
  v = first->v + (1 / mass) * sum;
  return true;
}

bool held_velocity(std::span<const ContactBody> parties, Vec3& v) {
  return mean_velocity(
      parties, [](const ContactBody& p) { return p.held; }, v);
}

void stick(std::span<ContactBody> parties) {
  Vec3 v;
  if (!held_velocity(parties, v))
    mean_velocity(
        parties, [](const ContactBody&) { return true; }, v);
  for (ContactBody& p : parties)
    if (!p.held) p.at->v = v;
}

// Sums go over the others, never total minus own: masses of 1 : 1e-17 would leave 0/0.
bool normal_of(std::span<const ContactBody> parties, std::size_t m, bool common, Vec3& normal) {
  const ContactBody& own = parties[m];
  Vec3 rest{};
  for (std::size_t k = 0; k < parties.size(); ++k)
    if (k != m && parties[k].gives_normal) rest -= parties[k].at->gradient;
  Vec3 n = rest;
  const double size_of_own = length(own.at->gradient), size_of_rest = length(rest);
  if (!common || (own.gives_normal && size_of_own > size_of_rest) || size_of_rest == 0)
    n = own.at->gradient;
  else if (own.gives_normal && size_of_own == size_of_rest)  // mirror images: neither is chosen
    n += own.at->gradient;
  const double size = length(n);
  if (!(size > 0)) return false;
  normal = (1 / size) * n;
  return true;
}

double gap_of(std::span<const ContactBody> parties, std::size_t m, Vec3 normal, Vec3 spacing) {
  double volume = 0;
  Vec3 sum{};
  const SurfaceTable* table = nullptr;
  for (std::size_t k = 0; k < parties.size(); ++k) {
    if (k == m) continue;
    const AtNode& other = *parties[k].at;
    volume += other.volume;
    sum += other.volume * other.place;
    if (table == nullptr) table = parties[k].table;
  }
  // Weights are products over the axes: along any normal their spread is that of one axis, with
  // this width of a cell.
  const double h = length(normal * spacing);
  const double own = dot(parties[m].at->place, normal) / h;
  const double others = dot((1 / volume) * sum, normal) / h;
  return table->surface(others) + parties[m].table->surface(-own);
}

// d: velocity of m against the others as they would be together; delta shortens it.
static Vec3 change_of(std::span<const ContactBody> parties, std::size_t m, Vec3 d,
                      const Slip& slip) {
  Vec3 n;
  if (!normal_of(parties, m, slip.common_normals, n)) return {};
  const double dn = dot(d, n);
  if (!(dn > 0)) return {};
  if (gap_of(parties, m, n, slip.spacing) > touching_gap) return {};
  const Vec3 t = d - dn * n;
  const double along = length(t), limit = slip.friction * dn;
  const double share = along > limit ? limit / along : 1;
  return -1.0 * (dn * n + share * t);
}

void slide(std::span<ContactBody> all, const Slip& slip) {
  static thread_local std::vector<ContactBody> parties;
  static thread_local std::vector<Vec3> changes;
  parties.clear();
  for (const ContactBody& p : all)
    if (p.at->volume > 0) parties.push_back(p);
  if (parties.size() < 2) return;
  Vec3 centre{};
  const bool held = held_velocity(parties, centre);
  double mass = 0;
  for (const ContactBody& p : parties) mass += p.at->mass;
  changes.assign(parties.size(), {});
  Vec3 mean{};
  for (std::size_t m = 0; m < parties.size(); ++m) {
    if (parties[m].held) continue;
    Vec3 d{};
    if (held) {
      d = parties[m].at->v - centre;
    } else {  // v_m - v_cm without taking near numbers from each other
      for (const ContactBody& k : parties) d += k.at->mass * (parties[m].at->v - k.at->v);
      d = (1 / mass) * d;
    }
    changes[m] = change_of(parties, m, d, slip);
    mean += parties[m].at->mass * changes[m];
  }
  // The mean is taken out: momentum is exact for any number of bodies, and energy only falls.
  mean = held ? Vec3{} : (1 / mass) * mean;
  for (std::size_t m = 0; m < parties.size(); ++m)
    if (!parties[m].held) parties[m].at->v += changes[m] - mean;
}

}  // namespace sluice::mpm

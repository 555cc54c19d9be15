#include "mpm/step/outside_forces.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice::mpm {
std::unique_ptr<Manufactured> manufactured_of(const MpmScene& solids, const SolidMaterial& material,
                                              const Level& level) {
  if (solids.manufactured.empty() || solids.manufactured == "none" || material.rigid)
    return nullptr;
  ManufacturedConstants k;
  k.density = material.constants.density;
  k.shear = material.law->shear_modulus();
  k.lambda = material.law->bulk_modulus() - 2 * k.shear / 3;
  k.amplitude = solids.manufactured_amplitude;
  for (int d = 0; d < 3; ++d) k.active[d] = level.active[static_cast<std::size_t>(d)] ? 1 : 0;
  return manufactured(solids.manufactured, k);
}

OutsideForces::OutsideForces(const MpmScene& solids, const Level& level,
                             const std::vector<Carried>& carried)
    : solids_(&solids), level_(level), carried_(&carried), loads_(solids) {
  for (std::size_t k = 0; k < solids.materials.size(); ++k) {
    motions_.push_back(manufactured_of(solids, solids.materials[k], level));
    acts_.push_back((loads_.forces(static_cast<int>(k)) && carried[k].columns.marks >= 0) ||
                    carried[k].columns.given_force >= 0 || motions_.back() != nullptr ||
                    solids.axisymmetric);
  }
  forces_.resize(solids.materials.size());
  middle_.resize(solids.materials.size());
}

bool OutsideForces::any() const {
  return loads_.count() > 0 || std::find(acts_.begin(), acts_.end(), true) != acts_.end();
}

void OutsideForces::count(const ParticleCloud& cloud, Communicator& ranks,
                          std::span<const double> kept) {
  if (counted_) return;
  counted_ = true;
  counts_.assign(kept.begin(), kept.end());
  if (std::any_of(kept.begin(), kept.end(), [](double n) { return n > 0; })) return;
  std::vector<std::int64_t> found(loads_.count());
  for (int k = 0; k < static_cast<int>(carried_->size()); ++k) {
    const Columns& c = (*carried_)[static_cast<std::size_t>(k)].columns;
    if (c.marks < 0) continue;
    const ParticleStore& store = cloud.store(k);
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        for (const double* marks : read_columns<max_marks>(set, c.marks))
          for (std::size_t p = 0; p < set.size(); ++p)
            if (marks[p] > 0) ++found[static_cast<std::size_t>(marks[p]) - 1];
      }
  }
  Reduction all;
  std::vector<Reduction::Count> slots;
  for (const std::int64_t n : found) slots.push_back(all.add_count(n));
  if (!found.empty()) ranks.reduce(all);
  for (std::size_t n = 0; n < found.size(); ++n)
    counts_[n] = static_cast<double>(all.count(slots[n]));
}

void OutsideForces::make_room(const ParticleCloud& cloud, int level) {
  for (int k = 0; k < static_cast<int>(carried_->size()); ++k) {
    if (!acts(k)) continue;
    std::vector<Forces>& boxes = forces_[static_cast<std::size_t>(k)];
    const ParticleStore& store = cloud.store(k);
    boxes.resize(static_cast<std::size_t>(store.box_count(level)));
    for (int b = 0; b < store.box_count(level); ++b)
      for (std::vector<double>& f : boxes[static_cast<std::size_t>(b)])
        f.resize(store.set(level, b).size());
    if (solids_->loads_on_corners) middle_[static_cast<std::size_t>(k)] = boxes;
  }
}

void OutsideForces::make_room(int kind, std::size_t count) {
  std::vector<Forces>& boxes = forces_[static_cast<std::size_t>(kind)];
  boxes.resize(1);
  for (std::vector<double>& f : boxes.front()) f.resize(count);
}

OutsideForces::Columns3 OutsideForces::forces(int kind, int box) const {
  if (!acts(kind)) return {};
  const Forces& f = forces_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)];
  return {f[0].data(), f[1].data(), f[2].data()};
}

OutsideForces::Columns3 OutsideForces::middle_forces(int kind, int box) const {
  if (!acts(kind) || !solids_->loads_on_corners) return forces(kind, box);
  const Forces& f = middle_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)];
  return {f[0].data(), f[1].data(), f[2].data()};
}

void OutsideForces::add_corners(int kind, int box, const ParticleSet& set, std::size_t begin,
                                std::size_t end, solids::CornerForces& to) const {
  const Carried& carried = (*carried_)[static_cast<std::size_t>(kind)];
  if (carried.columns.marks < 0) return;
  const LoadedParticles p = loaded(kind, set, begin, end);
  const auto size = read_columns<9>(set, carried.columns.size);
  const Columns3 all = forces(kind, box), middle = middle_forces(kind, box);
  for (std::size_t i = begin; i < end; ++i) {
    Vec3 force{};
    for (int d = 0; d < 3; ++d)
      force[d] = all[static_cast<std::size_t>(d)][i] - middle[static_cast<std::size_t>(d)][i];
    if (force == Vec3{}) continue;
    std::array<Vec3, 3> rest{}, edges{};
    for (std::size_t e = 0; e < 3; ++e)
      for (int d = 0; d < 3; ++d) {
        const auto row = static_cast<std::size_t>(d);
        rest[e][d] = size[0] != nullptr ? size[3 * row + e][i] * level_.spacing[d]
                     : row == e         ? p.width[e]
                                        : 0.0;
      }
    for (std::size_t e = 0; e < 3; ++e)
      for (int d = 0; d < 3; ++d)
        for (int k = 0; k < 3; ++k)
          edges[e][d] += p.F[static_cast<std::size_t>(3 * d + k)][i] * rest[e][k];
    for (const CornerForce& c :
         corner_forces(set.position(i), force, loads_.face_of(p, i), edges, rest))
      to.push_back(c);
  }
}

LoadedParticles OutsideForces::loaded(int kind, const ParticleSet& set, std::size_t begin,
                                      std::size_t end) const {
  const Carried& carried = (*carried_)[static_cast<std::size_t>(kind)];
  LoadedParticles p;
  p.begin = begin;
  p.end = end;
  for (std::size_t d = 0; d < 3; ++d) {
    p.x[d] = set.coordinate(static_cast<int>(d));
    p.width[d] = 2 * carried.half_at_rest[d] * level_.spacing[static_cast<int>(d)];
  }
  p.marks = read_columns<max_marks>(set, carried.columns.marks);
  p.F = read_columns<9>(set, carried.columns.F);
  p.normal = read_columns<3>(set, carried.columns.normal);
  return p;
}

// f = m b(X, t) at the particle's place in the reference state.
void OutsideForces::add_manufactured(int kind, const ParticleSet& set, std::size_t begin,
                                     std::size_t end, double time, Forces& to) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(kind)].columns;
  const Manufactured& motion = *motions_[static_cast<std::size_t>(kind)];
  const double* m = set.column(static_cast<std::size_t>(c.mass));
  const auto u = read_columns<3>(set, c.displacement);
  for (std::size_t p = begin; p < end; ++p) {
    const Vec3 X = set.position(p) - Vec3{u[0][p], u[1][p], u[2][p]};
    const Vec3 b = motion.body_force(X, time);
    for (int d = 0; d < 3; ++d) to[static_cast<std::size_t>(d)][p] += m[p] * b[d];
  }
}

double OutsideForces::hoop(int kind, const ParticleSet& set, std::size_t p) const {
  if (!solids_->axisymmetric) return 0;
  const Columns& c = (*carried_)[static_cast<std::size_t>(kind)].columns;
  double around = set.column(static_cast<std::size_t>(c.stress + 2))[p];
  if (c.viscous >= 0) around -= set.column(static_cast<std::size_t>(c.viscous))[p];
  return -set.column(static_cast<std::size_t>(c.volume))[p] * around / set.coordinate(0)[p];
}

double OutsideForces::fill(int kind, int box, const ParticleSet& set, std::size_t begin,
                           std::size_t end, double time) {
  const Columns& c = (*carried_)[static_cast<std::size_t>(kind)].columns;
  Forces& to = forces_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)];
  for (std::size_t d = 0; d < 3; ++d) {
    double* f = to[d].data();
    const double* given =
        c.given_force >= 0 ? set.column(static_cast<std::size_t>(c.given_force) + d) : nullptr;
    for (std::size_t p = begin; p < end; ++p) f[p] = given != nullptr ? given[p] : 0.0;
  }
  // In the middle of the particles first, then what acts on their corners too.
  if (motions_[static_cast<std::size_t>(kind)] != nullptr)
    add_manufactured(kind, set, begin, end, time, to);
  if (solids_->axisymmetric)
    for (std::size_t p = begin; p < end; ++p) to[0][p] += hoop(kind, set, p);
  if (solids_->loads_on_corners)
    for (std::size_t d = 0; d < 3; ++d)
      std::copy(to[d].begin() + static_cast<std::ptrdiff_t>(begin),
                to[d].begin() + static_cast<std::ptrdiff_t>(end),
                middle_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)][d].begin() +
                    static_cast<std::ptrdiff_t>(begin));
  if (c.marks >= 0)
    loads_.add_forces(time, counts_, loaded(kind, set, begin, end),
                      {to[0].data(), to[1].data(), to[2].data()});
  double most = 0;
  for (int d = 0; d < 3; ++d) {
    // A force along a direction that the level has not has no effect.
    const bool active = level_.active[static_cast<std::size_t>(d)];
    double* f = to[static_cast<std::size_t>(d)].data();
    for (std::size_t p = begin; p < end; ++p) {
      if (!active) f[p] = 0;
      const double size = std::fabs(f[p]);
      if (!(size <= most)) most = size;  // NaN too
    }
  }
  return most;
}

void add_hoop_rate(const ParticleSet& set, double reference, std::size_t at, int n,
                   GridAtParticles& read) {
  const double* r = set.coordinate(0) + at;
  for (int q = 0; q < n; ++q) read.L[8][q] = (reference + read.u[0][q]) / r[q];
}

}  // namespace sluice::mpm

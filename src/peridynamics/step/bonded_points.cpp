#include "peridynamics/step/bonded_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/base/reduction.hpp"
#include "peridynamics/bonds/elastic_constants.hpp"

namespace sluice::peridynamics {

BondedPoints::BondedPoints(const PeriScene& scene, const PointColumns& columns)
    : scene_(&scene), columns_(columns) {}

template <class Work>
void BondedPoints::for_chunks(const ThreadTeam* team, Work work) {
  const auto of_tile = [&](std::size_t t, int) {
    const std::vector<BondChunk>& chunks = families_.tiles[t].chunks;
    for (std::size_t c = 0; c < chunks.size(); ++c) work(t, c);
  };
  if (team != nullptr)
    team->for_each(families_.tiles.size(), of_tile);
  else
    for (std::size_t t = 0; t < families_.tiles.size(); ++t) of_tile(t, 0);
}

void BondedPoints::make(const ParticleCloud& cloud, const ThreadTeam* team, Communicator& ranks) {
  const Level& level = cloud.level(0);
  std::vector<OwnPoint> own;
  entries_.assign(static_cast<std::size_t>(cloud.kind_count()), {});
  for (int k = 0; k < cloud.kind_count(); ++k) {
    const ParticleStore& store = cloud.store(k);
    for (int b = 0; b < store.box_count(0); ++b) {
      const ParticleSet& set = store.set(0, b);
      const double* volume = set.column(static_cast<std::size_t>(columns_.volume));
      std::vector<int>& numbers = entries_[static_cast<std::size_t>(k)].emplace_back();
      for (std::size_t n = 0; n < set.size(); ++n) {
        numbers.push_back(static_cast<int>(own.size()));
        own.push_back({set.position(n), volume[n], set.id(n), k});
      }
    }
  }
  place(own, level, team, ranks);
  for (auto& of_kind : entries_)
    for (auto& of_box : of_kind)
      for (int& n : of_box) n = points_.entries()[static_cast<std::size_t>(n)];
  read(cloud);
  evaluate(team);
}

void BondedPoints::make(const std::vector<OwnPoint>& own, const Level& level,
                        const ThreadTeam* team, Communicator& ranks) {
  place(own, level, team, ranks);
  for (std::size_t i = 0; i < mass_.size(); ++i)
    if (points_.is_own(static_cast<int>(i))) mass_[i] = density(static_cast<int>(i)) * points_.V[i];
  evaluate(team);
}

// Families, and columns of the right length.
void BondedPoints::place(const std::vector<OwnPoint>& own, const Level& level,
                         const ThreadTeam* team, Communicator& ranks) {
  std::vector<OwnPoint> flat = own;
  for (OwnPoint& p : flat)
    for (int d = 0; d < 3; ++d)
      if (!level.active[static_cast<std::size_t>(d)]) p.place[d] = 0;
  points_.build(flat, level, *scene_, ranks);
  families_ = find_families(points_, *scene_, team);
  const std::size_t size = static_cast<std::size_t>(points_.size());
  for (Motion* motion : {&present_, &next_})
    for (Columns3* columns : {&motion->u, &motion->v, &motion->a})
      for (Column& column : *columns) column.assign(size, 0.0);
  for (Column& column : force_) column.assign(size, 0.0);
  for (Column* column : {&mass_, &sums_, &theta_, &energy_}) column->assign(size, 0.0);
  A_.assign(scene_->any(Law::lps) ? size : 0, 0.0);
  broken_.assign(static_cast<std::size_t>(columns_.broken_count), Column(size, 0.0));
  beyond_.resize(families_.tiles.size());
  for (std::size_t t = 0; t < beyond_.size(); ++t)
    beyond_[t].assign(families_.tiles[t].chunks.size(), 0);
  by_id_.clear();
  for (int i = 0; i < points_.size(); ++i)
    if (points_.is_own(i)) by_id_.emplace_back(points_.id[static_cast<std::size_t>(i)], i);
  std::sort(by_id_.begin(), by_id_.end());
}

// Constants of bonds, and the forces of the present places.
void BondedPoints::evaluate(const ThreadTeam* team) {
  find_constants();
  if (scene_->breaks()) find_limits();
  find_step_rate();
  fill_displacements(present_.u);
  sum_dilatations(present_.u, team);
  fill_dilatations();
  sum_forces(present_.u, team);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < mass_.size(); ++i)
      if (points_.is_own(static_cast<int>(i)))
        present_.a[d][i] =
            force_[d][i] / density(static_cast<int>(i)) + scene_->gravity[static_cast<int>(d)];
}

// Of the particles, as they are.
void BondedPoints::read(const ParticleCloud& cloud) {
  for (int k = 0; k < cloud.kind_count(); ++k)
    for (int b = 0; b < cloud.store(k).box_count(0); ++b) {
      const ParticleSet& set = cloud.store(k).set(0, b);
      const std::vector<int>& entries =
          entries_[static_cast<std::size_t>(k)][static_cast<std::size_t>(b)];
      const auto take = [&](int column, Column& to) {
        const double* from = set.column(static_cast<std::size_t>(column));
        for (std::size_t n = 0; n < set.size(); ++n)
          to[static_cast<std::size_t>(entries[n])] = from[n];
      };
      take(columns_.mass, mass_);
      for (int d = 0; d < 3; ++d) {
        take(columns_.displacement + d, present_.u[static_cast<std::size_t>(d)]);
        take(columns_.velocity + d, present_.v[static_cast<std::size_t>(d)]);
      }
      for (int c = 0; c < columns_.broken_count; ++c)
        take(columns_.broken + c, broken_[static_cast<std::size_t>(c)]);
    }
  if (columns_.broken_count > 0) read_broken();
}

// Bit k of a point is that of its k-th bond in the order of the columns.
void BondedPoints::read_broken() {
  for (BondTile& tile : families_.tiles)
    for (const BondChunk& chunk : tile.chunks)
      for (int l = 0; l < chunk.lanes; ++l) {
        const std::size_t i = static_cast<std::size_t>(chunk.first + l);
        int k = 0;
        for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
          if (!tile.has_bond(row, l)) continue;
          const auto bits =
              static_cast<std::uint64_t>(broken_[static_cast<std::size_t>(k / bits_of_column)][i]);
          if ((bits >> (k % bits_of_column)) & 1) {
            tile.w[8 * row + static_cast<std::size_t>(l)] = -0.0f;
            --families_.sums.neighbours[i];
          }
          ++k;
        }
        write_broken(tile, chunk, l);
      }
}

// Bits and the intact volume of a point, from its bonds.
void BondedPoints::write_broken(const BondTile& tile, const BondChunk& chunk, int lane) {
  const std::size_t i = static_cast<std::size_t>(chunk.first + lane);
  const BondRule rule{scene_->influence, scene_->partial_volume};
  std::uint64_t bits = 0;
  int k = 0;
  double intact = 0;
  const auto store = [&] {
    broken_[static_cast<std::size_t>((k - 1) / bits_of_column)][i] = static_cast<double>(bits);
    bits = 0;
  };
  for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
    if (!tile.has_bond(row, lane)) continue;
    const std::size_t j = static_cast<std::size_t>(tile.neighbour(row, lane));
    if (tile.intact(row, lane)) {
      const double delta = std::min(horizon(static_cast<int>(i)), horizon(static_cast<int>(j)));
      intact += rule.beta(tile.r[8 * row + static_cast<std::size_t>(lane)], delta,
                          0.5 * (points_.spacing[i] + points_.spacing[j])) *
                points_.V[j];
    } else {
      bits |= std::uint64_t{1} << (k % bits_of_column);
    }
    if (++k % bits_of_column == 0) store();
  }
  if (k % bits_of_column != 0) store();
  families_.sums.intact[i] = intact;
}

// Constants of bonds, of own points and images.
void BondedPoints::find_constants() {
  const std::size_t size = mass_.size();
  const double d = scene_->dimensions;
  for (Column* column : {&B_, &C_, &D_, &A_of_theta_, &d_per_m_}) column->assign(size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    if (!points_.is_own(static_cast<int>(i))) continue;
    const PeriMaterial& m = scene_->materials[static_cast<std::size_t>(points_.material[i])];
    const double weighted = families_.sums.m[i], S = families_.sums.s[i];
    const double k = m.bulk, mu = m.shear;
    if (!(weighted > 0)) continue;  // without bonds
    if (m.law == Law::lps) {
      d_per_m_[i] = d / weighted;
      A_of_theta_[i] = (d * k - (d + 2) * mu) / weighted;
      B_[i] = d * (d + 2) * mu / weighted;
      D_[i] = std::max(d * d * k, d * (d + 2) * mu) / weighted;
    } else if (scene_->surface_weights == SurfaceWeights::volume) {
      C_[i] = k * d * d / S;
    } else {
      C_[i] = k * d * d / family_integral(*scene_, m.horizon);
    }
  }
  points_.ghosts().fill(std::array<double*, 3>{B_.data(), C_.data(), D_.data()});
  if (!scene_->any(Law::lps)) B_.clear(), D_.clear();
  if (!scene_->any(Law::pmb)) C_.clear();
}

void BondedPoints::find_limits() {
  constexpr double never = 1e290;
  const std::size_t size = mass_.size();
  const auto column = [&](DamageModel::Criterion criterion, Column& to) {
    if (scene_->any(criterion)) to.assign(size, never);
  };
  column(DamageModel::Criterion::stretch, stretch_limit_);
  column(DamageModel::Criterion::energy, energy_limit_);
  never_.assign(size, 0.0);
  horizon_.assign(size, 1.0);
  std::map<std::pair<int, std::int64_t>, double> known;  // of a material and spacing
  for (std::size_t i = 0; i < size; ++i) {
    const int material = points_.material[i];
    if (material < 0) continue;
    const PeriMaterial& m = scene_->materials[static_cast<std::size_t>(material)];
    horizon_[i] = m.horizon;
    const Vec3 place{points_.X[0][i], points_.X[1][i], points_.X[2][i]};
    for (const PiecePtr& piece : m.damage.no_fail)
      if (points_.is_own(static_cast<int>(i)) && piece->inside(place)) never_[i] = never;
    if (m.damage.criterion == DamageModel::Criterion::none) continue;
    // The sum over a lattice depends on delta/dx alone but for its size.
    const double dx = points_.spacing[i];
    const std::int64_t rounded = std::llround(1e6 * dx / m.horizon);
    const bool by_energy = m.damage.criterion == DamageModel::Criterion::energy;
    const auto [at, fresh] = known.try_emplace({material, rounded}, 0.0);
    if (fresh)
      at->second =
          by_energy ? critical_bond_energy(*scene_, m, dx) : critical_stretch(*scene_, m, dx);
    (by_energy ? energy_limit_ : stretch_limit_)[i] = at->second;
  }
  points_.ghosts().fill(std::array<double*, 1>{never_.data()});
}

BondInput BondedPoints::input(const Columns3& u) const {
  BondInput in;
  for (std::size_t d = 0; d < 3; ++d) {
    in.X[d] = points_.X[d].data();
    in.u[d] = u[d].data();
  }
  in.V = points_.V.data();
  if (!B_.empty()) in.A = A_.data(), in.B = B_.data();
  if (!C_.empty()) in.C = C_.data();
  if (!stretch_limit_.empty()) in.stretch = stretch_limit_.data();
  if (!energy_limit_.empty()) in.energy = energy_limit_.data();
  if (scene_->breaks()) in.never = never_.data(), in.horizon = horizon_.data();
  in.influence = scene_->influence;
  in.dimensions = scene_->dimensions;
  return in;
}

void BondedPoints::find_step_rate() {
  Column bound(mass_.size(), 0.0);
  const BondInput in = input(present_.u);
  for_chunks(nullptr, [&](std::size_t t, std::size_t c) {
    const BondTile& tile = families_.tiles[t];
    bound_stiffness(tile, tile.chunks[c], in, D_.empty() ? nullptr : D_.data(), bound.data());
  });
  step_rate_ = 0;
  for (std::size_t i = 0; i < bound.size(); ++i) {
    if (!points_.is_own(static_cast<int>(i))) continue;
    const double rate = std::sqrt(bound[i] / (2 * density(static_cast<int>(i))));
    if (rate > step_rate_) {
      step_rate_ = rate;
      limiting_point_ = points_.id[i];
    }
  }
}

void BondedPoints::fill_displacements(Columns3& u) {
  if (points_.has_ghosts()) points_.ghosts().fill_vector({u[0].data(), u[1].data(), u[2].data()});
}

void BondedPoints::sum_dilatations(const Columns3& u, const ThreadTeam* team) {
  if (B_.empty()) return;
  const BondInput in = input(u);
  for_chunks(team, [&](std::size_t t, std::size_t c) {
    const BondTile& tile = families_.tiles[t];
    const BondChunk& chunk = tile.chunks[c];
    sum_extensions(tile, chunk, in, sums_.data());
    for (int i = chunk.first; i < chunk.first + chunk.lanes; ++i) {
      const std::size_t n = static_cast<std::size_t>(i);
      theta_[n] = d_per_m_[n] * sums_[n];
      A_[n] = A_of_theta_[n] * theta_[n];
    }
  });
}

void BondedPoints::fill_dilatations() {
  if (!B_.empty() && points_.has_ghosts()) points_.ghosts().fill(std::array<double*, 1>{A_.data()});
}

bool BondedPoints::sum_forces(const Columns3& u, const ThreadTeam* team) {
  const BondInput in = input(u);
  const BondOutput out{{force_[0].data(), force_[1].data(), force_[2].data()}, energy_.data()};
  const double d = scene_->dimensions;
  for_chunks(team, [&](std::size_t t, std::size_t c) {
    const BondTile& tile = families_.tiles[t];
    const BondChunk& chunk = tile.chunks[c];
    beyond_[t][c] = peridynamics::sum_forces(tile, chunk, in, out);
    if (B_.empty()) return;
    for (int i = chunk.first; i < chunk.first + chunk.lanes; ++i) {
      const std::size_t n = static_cast<std::size_t>(i);
      const PeriMaterial& m = scene_->materials[static_cast<std::size_t>(points_.material[n])];
      energy_[n] += (0.5 * m.bulk - (d + 2) * m.shear / (2 * d)) * theta_[n] * theta_[n];
    }
  });
  return std::any_of(beyond_.begin(), beyond_.end(), [](const auto& of_tile) {
    return std::any_of(of_tile.begin(), of_tile.end(), [](unsigned char b) { return b != 0; });
  });
}

std::int64_t BondedPoints::break_bonds(const Columns3& u) {
  const BondInput in = input(u);
  std::int64_t count = 0;
  for (std::size_t t = 0; t < beyond_.size(); ++t)
    for (std::size_t c = 0; c < beyond_[t].size(); ++c) {
      if (beyond_[t][c] == 0) continue;
      BondTile& tile = families_.tiles[t];
      const BondChunk& chunk = tile.chunks[c];
      int broken[8] = {};
      count += peridynamics::break_bonds(tile, chunk, in, broken);
      for (int l = 0; l < chunk.lanes; ++l) {
        if (broken[l] == 0) continue;
        families_.sums.neighbours[static_cast<std::size_t>(chunk.first + l)] -= broken[l];
        write_broken(tile, chunk, l);
      }
    }
  return count;
}

double BondedPoints::damage(int entry) const {
  const std::size_t i = static_cast<std::size_t>(entry);
  if (!(families_.sums.volume[i] > 0)) return 0;
  return 1 - families_.sums.intact[i] / families_.sums.volume[i];
}

// sigma = sum t_ij M xi V_j, its symmetric part; t_ij: of a bond what its own end gives.
std::array<double, 6> BondedPoints::stress(int entry) const {
  const auto tile =
      std::partition_point(families_.tiles.begin(), families_.tiles.end(), [&](const BondTile& t) {
        const BondChunk& last = t.chunks.back();
        return last.first + last.lanes <= entry;
      });
  const auto chunk =
      std::partition_point(tile->chunks.begin(), tile->chunks.end(),
                           [&](const BondChunk& c) { return c.first + c.lanes <= entry; });
  const std::size_t i = static_cast<std::size_t>(entry);
  std::array<double, 6> sigma{};
  for (std::size_t row = chunk->begin; row < chunk->end; ++row) {
    const int lane = entry - chunk->first;
    if (!tile->intact(row, lane)) continue;
    const std::size_t j = static_cast<std::size_t>(tile->neighbour(row, lane));
    const std::size_t at = 8 * row + static_cast<std::size_t>(lane);
    const double r = tile->r[at];
    Vec3 xi, y;
    double product = 0, square = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const int axis = static_cast<int>(d);
      const double eta = present_.u[d][j] - present_.u[d][i];
      xi[axis] = points_.X[d][j] - points_.X[d][i];
      y[axis] = xi[axis] + eta;
      product += eta * (xi[axis] + y[axis]);
      square += y[axis] * y[axis];
    }
    const double length = std::sqrt(square), e = product / (length + r);
    double t = 0;
    if (!B_.empty()) t += r * A_[i] + e * B_[i];
    if (!C_.empty()) t += e / r * 0.5 * (C_[i] + C_[j]);
    const double scale = tile->w[at] * t * points_.V[j] / length;
    for (int d = 0; d < 3; ++d) sigma[static_cast<std::size_t>(d)] += scale * y[d] * xi[d];
    sigma[3] += 0.5 * scale * (y.y * xi.z + y.z * xi.y);
    sigma[4] += 0.5 * scale * (y.x * xi.z + y.z * xi.x);
    sigma[5] += 0.5 * scale * (y.x * xi.y + y.y * xi.x);
  }
  return sigma;
}

int BondedPoints::entry_of(std::int64_t id) const {
  const auto at = std::lower_bound(by_id_.begin(), by_id_.end(), std::pair(id, -1));
  return at == by_id_.end() || at->first != id ? -1 : at->second;
}

void BondedPoints::commit(ParticleCloud& cloud) {
  std::swap(present_, next_);
  for (int k = 0; k < cloud.kind_count(); ++k)
    for (int b = 0; b < cloud.store(k).box_count(0); ++b) {
      const ParticleSet& set = cloud.store(k).set(0, b);
      ParticleSet& next = cloud.store(k).next(0, b);
      const std::vector<int>& entries =
          entries_[static_cast<std::size_t>(k)][static_cast<std::size_t>(b)];
      std::vector<std::size_t> advanced;
      for (int c = columns_.displacement; c < columns_.velocity + 3 + columns_.broken_count; ++c)
        advanced.push_back(static_cast<std::size_t>(c));
      next.make_room(set, advanced);
      const auto give = [&](int column, const Column& from) {
        double* to = next.column(static_cast<std::size_t>(column));
        for (std::size_t n = 0; n < set.size(); ++n)
          to[n] = from[static_cast<std::size_t>(entries[n])];
      };
      for (int d = 0; d < 3; ++d) {
        std::copy_n(set.coordinate(d), set.size(), next.coordinate(d));
        give(columns_.displacement + d, present_.u[static_cast<std::size_t>(d)]);
        give(columns_.velocity + d, present_.v[static_cast<std::size_t>(d)]);
      }
      for (int c = 0; c < columns_.broken_count; ++c)
        give(columns_.broken + c, broken_[static_cast<std::size_t>(c)]);
    }
}

}  // namespace sluice::peridynamics

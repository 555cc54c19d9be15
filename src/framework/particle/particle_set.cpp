// Adding, choosing and packing particles.
#include "framework/particle/particle_set.hpp"

#include <bit>

namespace sluice {
namespace {

template <class T>
void select_values(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  std::vector<T> chosen;
  chosen.reserve(kept.size());
  for (const std::uint32_t n : kept) chosen.push_back(values[n]);
  values.swap(chosen);
}

}  // namespace

void ParticleSet::reserve(std::size_t count) {
  for (std::vector<double>& x : positions_) x.reserve(count);
  ids_.reserve(count);
  for (std::vector<double>& a : attributes_) a.reserve(count);
}

void ParticleSet::shrink() {
  for (std::vector<double>& x : positions_) x.shrink_to_fit();
  ids_.shrink_to_fit();
  for (std::vector<double>& a : attributes_) a.shrink_to_fit();
}

void ParticleSet::add(Vec3 place, std::int64_t id) {
  for (int d = 0; d < 3; ++d) positions_[d].push_back(place[d]);
  ids_.push_back(id);
  for (std::vector<double>& a : attributes_) a.push_back(0.0);
}

void ParticleSet::add_from(const ParticleSet& other, std::size_t n) {
  add(other.position(n), other.id(n));
  for (std::size_t a = 0; a < attributes_.size(); ++a)
    attributes_[a].back() = other.attributes_[a][n];
}

void ParticleSet::make_room(const ParticleSet& present,
                            const std::vector<std::size_t>& attributes) {
  for (std::vector<double>& x : positions_) x.resize(present.size());
  for (const std::size_t a : attributes) attributes_[a].resize(present.size());
}

void ParticleSet::exchange(ParticleSet& next, const std::vector<std::size_t>& attributes) {
  positions_.swap(next.positions_);
  for (const std::size_t a : attributes) attributes_[a].swap(next.attributes_[a]);
}

void ParticleSet::clear() {
  for (std::vector<double>& x : positions_) x.clear();
  ids_.clear();
  for (std::vector<double>& a : attributes_) a.clear();
}

void ParticleSet::select(const std::vector<std::uint32_t>& kept) {
  for (std::vector<double>& x : positions_) select_values(x, kept);
  select_values(ids_, kept);
  for (std::vector<double>& a : attributes_) select_values(a, kept);
}

void ParticleSet::pack(std::size_t n, double* to) const {
  for (const std::vector<double>& x : positions_) *to++ = x[n];
  *to++ = std::bit_cast<double>(ids_[n]);
  for (const std::vector<double>& a : attributes_) *to++ = a[n];
}

void ParticleSet::add_packed(const double* from) {
  add({from[0], from[1], from[2]}, std::bit_cast<std::int64_t>(from[3]));
  for (std::size_t a = 0; a < attributes_.size(); ++a) attributes_[a].back() = from[4 + a];
}

}  // namespace sluice

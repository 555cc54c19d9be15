// The particles of one kind in one box, as a structure of arrays: positions in m, attributes in the
// units of their labels.
//
// Kept sorted by cell, then by id, so that what particles take from cells and give to them streams
// through memory, and so that the order depends on neither ranks nor history.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

// Ids stay below this: every tool that takes numbers for doubles has them exactly.
inline constexpr std::int64_t most_particle_id = std::int64_t{1} << 53;

class ParticleSet {
 public:
  // `attributes`: real numbers that each particle carries beside its position and id.
  explicit ParticleSet(std::size_t attributes = 0) : attributes_(attributes) {}

  std::size_t size() const { return ids_.size(); }
  bool empty() const { return ids_.empty(); }
  std::size_t attribute_count() const { return attributes_.size(); }

  Vec3 position(std::size_t n) const {
    return {positions_[0][n], positions_[1][n], positions_[2][n]};
  }
  void move_to(std::size_t n, Vec3 place) {
    for (int d = 0; d < 3; ++d) positions_[d][n] = place[d];
  }
  std::int64_t id(std::size_t n) const { return ids_[n]; }
  double& attribute(std::size_t a, std::size_t n) { return attributes_[a][n]; }

  const std::vector<double>& coordinates(int direction) const { return positions_[direction]; }
  const std::vector<std::int64_t>& ids() const { return ids_; }
  const std::vector<double>& attribute_values(std::size_t a) const { return attributes_[a]; }
  // Columns of all particles, for loops over them.
  double* column(std::size_t a) { return attributes_[a].data(); }
  const double* column(std::size_t a) const { return attributes_[a].data(); }
  double* coordinate(int direction) { return positions_[direction].data(); }
  const double* coordinate(int direction) const { return positions_[direction].data(); }
  // Room for what a step makes of these attributes and of the positions of another set.
  void make_room(const ParticleSet& present, const std::vector<std::size_t>& attributes);
  // These attributes and the positions become those of the other, whose own are handed back.
  void exchange(ParticleSet& next, const std::vector<std::size_t>& attributes);

  // Memory for that many particles in all; and none beyond those that there are.
  void reserve(std::size_t count);
  std::size_t capacity() const { return ids_.capacity(); }
  void shrink();

  // With attributes 0; its number is size() - 1.
  void add(Vec3 place, std::int64_t id);
  void add_from(const ParticleSet& other, std::size_t n);
  void clear();
  // Keeps the particles numbered `kept`, in that order.
  void select(const std::vector<std::uint32_t>& kept);

  // A particle as numbers for a message: as many as packed_size().
  std::size_t packed_size() const { return 4 + attributes_.size(); }
  void pack(std::size_t n, double* to) const;
  void add_packed(const double* from);

 private:
  std::array<std::vector<double>, 3> positions_;
  std::vector<std::int64_t> ids_;
  std::vector<std::vector<double>> attributes_;
};

}  // namespace sluice

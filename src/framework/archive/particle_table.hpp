// All particles of a material in an archived step, in the order of their ids, whatever boxes, ranks
// and levels they were on.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

// Every step of Sluice that holds particles holds these two of each; a raw one may have no numbers.
inline constexpr const char* particle_position_name = "p.x";
inline constexpr const char* particle_id_name = "p.particleID";

struct ParticleColumn {
  FieldInfo info;                               // level: the lowest
  std::vector<std::vector<double>> components;  // by component and particle, in the field's unit
};

struct ParticleTable {
  int material = 0;
  std::vector<std::int64_t> ids;        // ascending
  bool numbered = true;                 // false: ids count the particles in stored order
  std::vector<int> levels;              // on which each lives
  std::vector<ParticleColumn> columns;  // by name, without the ids; positions are one of them

  std::size_t size() const { return ids.size(); }
  const ParticleColumn* find(std::string_view name) const;
  Vec3 position(std::size_t n) const;  // m
};

// Materials of which the step holds particles, ascending.
std::vector<int> particle_materials(const ArchiveStep& step);
// Columns that the filter selects, and positions. DamageError where columns have different lengths,
// or positions are missing; also where ids are, unless the archive is raw.
ParticleTable read_particles(const ArchiveStep& step, int material, const LabelFilter& labels = {});

}  // namespace sluice

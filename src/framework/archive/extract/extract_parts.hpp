// The ways of choosing values of one step, one file each. Each writes rows and returns what it
// says where there are none: the nearest point, say.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/extract/extract.hpp"
#include "framework/archive/extract/quantity.hpp"

namespace sluice {

std::string extract_box(const ArchiveStep& step, const ExtractOptions& options, const Quantity& q,
                        ValueRows& rows);
std::string extract_points(const ArchiveStep& step, const ExtractOptions& options,
                           const Quantity& q, ValueRows& rows);
std::string extract_line(const ArchiveStep& step, const ExtractOptions& options, const Quantity& q,
                         ValueRows& rows);
// `followed`: filled at the first time that has rows, where options.follow asks for it.
std::string extract_particles(const ArchiveStep& step, const ExtractOptions& options,
                              const Quantity& q, FollowedParticles& followed, ValueRows& rows);

// "value", or one for each component.
std::vector<std::string> value_columns(const Quantity& q, ValueType type);
// The numbers of a place, from all components there.
void add_values(const Quantity& q, const double* components, int count, ValueRows& rows);

// Which points lie in the box; of those outside, the nearest.
class BoxOfPoints {
 public:
  explicit BoxOfPoints(const ExtractOptions& options) : options_(options) {}

  // place(): text, made where this point is nearer than all before.
  template <class Place>
  bool contains(Vec3 p, Place&& place) {
    const double distance = distance_to(p);
    if (distance == 0) return true;
    if (nearest_.empty() || distance < distance_) {
      distance_ = distance;
      nearest_ = at(place(), p);
    }
    return false;
  }
  const std::string& nearest() const { return nearest_; }

 private:
  double distance_to(Vec3 p) const;  // squared; 0 inside
  static std::string at(const std::string& place, Vec3 p);

  const ExtractOptions& options_;
  double distance_ = 0;
  std::string nearest_;
};

}  // namespace sluice

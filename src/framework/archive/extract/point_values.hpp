// Values of a label at any points: of the finest cell (face, node) there, or linear between them.
#pragma once
#include <optional>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

// Of one material, read where the points need it. Lengths in m.
class PointValues {
 public:
  // `fields`: of one label and material, by level.
  PointValues(const ArchiveStep& step, const std::vector<FieldInfo>& fields,
              const std::vector<Vec3>& points);

  struct Holder {
    std::size_t field = 0;  // among those given
    IntVec3 index;
  };
  // The cell that holds a point (the nearest node; of faces the nearest one along their normal), on
  // the finest level that has a value there. A flat direction holds every point. None: the point is
  // outside, or nothing is stored there.
  std::optional<Holder> holder(Vec3 p) const;
  const FieldInfo& field(const Holder& h) const { return loaded_[h.field].info; }
  Vec3 place(const Holder& h) const;  // of its centre
  void values(const Holder& h, double* components) const;

  // Linear along each direction between the places of the holder's level. Those that this level
  // does not have are taken from the coarser one, linearly as well. In the half cell at the end of
  // the domain the line of the last two goes on; where a value between is missing or NaN, the value
  // is that of the holder. Linear fields come out exactly.
  void linear(Vec3 p, const Holder& h, double* components) const;

 private:
  struct Loaded {
    FieldInfo info;
    DenseField values;
  };
  struct Corners;
  bool inside(Vec3 p) const;
  std::optional<IntVec3> index_on(const Loaded& on, Vec3 p) const;
  Corners corners(const Loaded& on, Vec3 p) const;
  bool linear_on(std::size_t field, Vec3 p, double* components) const;
  bool at_corner(std::size_t field, IntVec3 index, double* components) const;

  const Grid& grid_;
  std::vector<Loaded> loaded_;  // coarse to fine
};

}  // namespace sluice

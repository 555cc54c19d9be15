// The labels of one output as arrays of VTK, over any box of a level; its particles as points.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "framework/archive/drawing/array_names.hpp"
#include "framework/archive/selection.hpp"
#include "framework/archive/vtk/vtk_file.hpp"
#include "framework/archive/vtk/vtk_level.hpp"

namespace sluice {

// Cell labels are cell data; node labels point data; a face label becomes two cell arrays, NAME_low
// and NAME_high, the values on the cell's two faces (nothing is averaged).
class VtkStep {
 public:
  // All of them must live while the arrays are written, which is when values are read.
  VtkStep(const ArchiveStep& step, const LabelFilter& labels, const ArrayNames& names);

  bool empty() const { return by_name_.empty(); }
  // Every box of a hierarchy has the same arrays: NaN (0 of integers) where nothing is stored.
  std::vector<VtkArray> arrays(const VtkLevel& level, const IndexBox& cells) const;

 private:
  struct OfLevel {
    FieldInfo info;
    IndexBox stored;  // all indices that hold a value
  };
  VtkArray array(const std::map<int, OfLevel>& fields, const std::string& name,
                 const VtkLevel& level, const IndexBox& cells, IntVec3 shift) const;

  const ArchiveStep& step_;
  std::map<std::string, std::map<int, OfLevel>> by_name_;  // by level
};

// Particles of one material on all levels, in the order of their numbers.
void write_particles(const ArchiveStep& step, int material, const LabelFilter& labels,
                     const std::filesystem::path& path);

}  // namespace sluice

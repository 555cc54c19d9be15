// Values of one label as rows of numbers, for scripts: of a box, at points, along a line, of
// particles; over outputs.
//
//   time,level,material,i,j,k,x,y,z,value     a box, or the cells that hold points
//   time,level,material,x,y,z,value           at points, linear between centres
//   time,distance,level,material,x,y,z,value  along a line, from its first point
//   time,level,material,id,x,y,z,value        particles
//
// value_x,value_y,value_z for vectors, value_xx to value_zz for tensors; value for one part
// (quantity.hpp). Interior points only; rows by time, then material, level, k, j, i, or in the
// order of the points; of particles by material, id. With all levels every point comes once, from
// the finest level that holds a value there. Particles of a raw archive without numbers have no id,
// and the order of their patches. Lengths in m, times in s.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/extract/value_rows.hpp"

namespace sluice {

// Numbers by material, ascending; those of the first time.
using FollowedParticles = std::optional<std::map<int, std::vector<std::int64_t>>>;

struct ExtractLine {
  Vec3 first, last;
  int points = 0;  // evenly, both ends with them; 0: the middle of each cell's piece of the line
};

struct ExtractOptions {
  std::string label;             // or a part of one: vel_CC.x
  std::optional<int> material;   // none: all that the label has
  int level = -1;                // < 0: all
  std::optional<Vec3> from, to;  // closed box that must hold the point
  std::vector<Vec3> at = {};     // in place of a box
  std::optional<ExtractLine> line = {};
  bool linear = false;                       // at points and along lines
  std::vector<std::int64_t> particles = {};  // only those of these numbers
  bool follow = false;  // particles that the box holds at the first time, wherever they go
};

// Rows of one step after the other.
class Extraction {
 public:
  Extraction(ExtractOptions options, ValueRows& rows) : options_(std::move(options)), rows_(rows) {}

  // InputError for a label, part, material or level that the step does not have.
  void add(const ArchiveStep& step);
  // InputError where no step had a row, with the nearest point that there is.
  void finish();

 private:
  ExtractOptions options_;
  ValueRows& rows_;
  std::string missed_;  // the nearest point of the last step
  FollowedParticles followed_;
};

// One step as CSV; the number of rows after the header.
std::int64_t extract_csv(const ArchiveStep& step, const ExtractOptions& options,
                         const WriteText& write);

}  // namespace sluice

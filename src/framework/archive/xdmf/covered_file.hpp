// fields_covered.h5: the marks of cells below finer levels of all outputs, one byte a cell.
//
// One data set, /covered, grid after grid, level after level, box after box, of the boxes that are
// covered in part; outputs that follow each other on the same grid share their marks.
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <vector>

#include "framework/archive/drawing/replacing_file.hpp"
#include "framework/archive/hdf5_handle.hpp"
#include "framework/archive/hdf5_target.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// Level and lower corner of a box.
using BoxKey = std::array<int, 4>;
inline BoxKey key_of(int level, const IndexBox& box) {
  return {level, box.lower.x, box.lower.y, box.lower.z};
}
// Where the marks of the boxes of a grid begin.
using CoveredBoxes = std::map<BoxKey, std::int64_t>;

class CoveredFile {
 public:
  // Writes beside `path`; finish() puts the file in its place.
  explicit CoveredFile(const std::filesystem::path& path);

  CoveredBoxes add(const Grid& grid);
  std::int64_t total() const { return total_; }  // marks so far
  void finish();

 private:
  void append(const std::vector<std::uint8_t>& marks);

  ReplacingFile disk_;
  Hdf5Target target_;
  Hdf5Handle file_, marks_;
  std::int64_t total_ = 0;
  std::vector<std::vector<IndexBox>> last_grid_;  // boxes by level
  CoveredBoxes last_;
};

}  // namespace sluice

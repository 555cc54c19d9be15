// VTK's XML files with raw appended data, compressed by zlib: images (.vti) and points (.vtp).
//
// Values are compressed a block at a time as they are handed over: a file takes no more memory than
// its largest array does where it comes from.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/archive/archive_record.hpp"

namespace sluice {

class ReplacingFile;

// Takes the values of one array and writes them as VTK wants them.
class VtkValues {
 public:
  VtkValues(ReplacingFile& file, StoredType stored, std::int64_t count);

  void add(double value);
  void add(std::int64_t value);
  // std::logic_error when other than `count` values came.
  void finish();

 private:
  template <class T>
  void put(T value);
  void flush();

  ReplacingFile& file_;
  StoredType stored_;
  std::int64_t begin_;                 // of the array in the file
  std::vector<std::uint64_t> header_;  // blocks, their size, that of the last, and compressed sizes
  std::size_t blocks_ = 0;             // written so far
  std::vector<char> block_, compressed_;
  std::size_t used_ = 0;  // bytes of the block
  std::int64_t missing_;  // values that have not come yet
};

struct VtkArray {
  std::string name;
  StoredType stored = StoredType::float64;
  bool on_points = false;
  int components = 1;
  std::int64_t tuples = 0;
  // Hands all values over: component fastest, then x, y, z, in the unit of what is named.
  std::function<void(VtkValues&)> put;
};

// With `from_zero` the extent starts at 0 and the origin at the box's corner (what AMR data sets
// need); else extents are the level's own indices.
void write_vti(const std::filesystem::path& path, const Level& level, const IndexBox& cells,
               bool from_zero, const std::vector<VtkArray>& arrays);

// Points with values; `positions` has three components, m.
void write_vtp(const std::filesystem::path& path, const VtkArray& positions,
               const std::vector<VtkArray>& arrays);

}  // namespace sluice

// A file that HDF5 lays out and we write: HDF5 never learns of a full disk.
//
// HDF5 1.10 cannot close a file whose last flush has failed: its structures stay open and the
// library's own clean-up at the exit of the program flushes them again, through freed memory. So
// its writes always succeed here. The first one that the disk refuses is remembered for check();
// from then on the bytes are kept in memory, where HDF5 finds what it wrote until it has closed.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "framework/archive/posix_file.hpp"

namespace sluice {

class Hdf5Target {
 public:
  // Of an empty file, which must outlive HDF5's.
  explicit Hdf5Target(PosixFile& file) : file_(&file) {}
  Hdf5Target(const Hdf5Target&) = delete;
  Hdf5Target& operator=(const Hdf5Target&) = delete;

  // Files made with this access list are written here, whatever name they are given.
  void attach(hid_t access_list);
  // Throws what the first refused write threw.
  void check() const;

  // For the driver.
  void write(std::int64_t at, const char* bytes, std::size_t count) noexcept;
  void read(std::int64_t at, char* bytes, std::size_t count) noexcept;
  void set_size(std::int64_t bytes) noexcept;
  std::int64_t size() const { return size_; }

 private:
  struct Kept {
    std::int64_t at;
    std::string bytes;
  };
  PosixFile* file_;
  std::int64_t size_ = 0;  // as HDF5 knows it
  std::exception_ptr failure_;
  std::vector<Kept> kept_;  // by time
};

}  // namespace sluice

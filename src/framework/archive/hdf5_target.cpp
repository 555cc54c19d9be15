// The virtual file driver behind a target: HDF5's calls, one line each.
#include "framework/archive/hdf5_target.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "framework/archive/hdf5_handle.hpp"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace sluice {
namespace {

// An open file of HDF5's; the base must come first.
struct Driver : H5FD_t {
  Hdf5Target* target = nullptr;
  haddr_t end = 0;  // of what HDF5 has given out
};

Driver& driver_of(H5FD_t* file) {
  return *static_cast<Driver*>(file);
}
const Driver& driver_of(const H5FD_t* file) {
  return *static_cast<const Driver*>(file);
}

H5FD_t* open_file(const char*, unsigned, hid_t access_list, haddr_t) {
  const void* information = H5Pget_driver_info(access_list);
  if (information == nullptr) return nullptr;
  auto* driver = new Driver{};
  driver->target = *static_cast<Hdf5Target* const*>(information);
  return driver;
}

herr_t close_file(H5FD_t* file) {
  delete &driver_of(file);
  return 0;
}

// As the driver for plain files: what it writes is laid out alike.
herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_space(const H5FD_t* file, H5FD_mem_t) {
  return driver_of(file).end;
}
herr_t set_end_of_space(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  driver_of(file).end = end;
  return 0;
}
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) {
  return static_cast<haddr_t>(driver_of(file).target->size());
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t count, void* bytes) {
  driver_of(file).target->read(static_cast<std::int64_t>(at), static_cast<char*>(bytes), count);
  return 0;
}
herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t count, const void* bytes) {
  driver_of(file).target->write(static_cast<std::int64_t>(at), static_cast<const char*>(bytes),
                                count);
  return 0;
}
herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  driver_of(file).target->set_size(static_cast<std::int64_t>(driver_of(file).end));
  return 0;
}

const H5FD_class_t& driver_class() {
  static const H5FD_class_t driver = [] {
    H5FD_class_t d{};
#if H5_VERSION_GE(1, 13, 0)
    d.version = H5FD_CLASS_VERSION;
    d.value = static_cast<H5FD_class_value_t>(H5_VFD_RESERVED);  // the first free for programs
#endif
    d.name = "sluice";
    d.maxaddr = HADDR_MAX;
    d.fc_degree = H5F_CLOSE_WEAK;
    d.fapl_size = sizeof(Hdf5Target*);
    d.open = open_file;
    d.close = close_file;
    d.query = query;
    d.get_eoa = end_of_space;
    d.set_eoa = set_end_of_space;
    d.get_eof = end_of_file;
    d.read = read;
    d.write = write;
    d.truncate = truncate;
    constexpr H5FD_mem_t two_kinds[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(two_kinds), std::end(two_kinds), d.fl_map);
    return d;
  }();
  return driver;
}

}  // namespace

void Hdf5Target::attach(hid_t access_list) {
  static const hid_t driver = H5FDregister(&driver_class());
  const std::string file = file_->path().string();
  if (driver < 0) fail_hdf5("register a file driver", file);
  Hdf5Target* self = this;
  checked(H5Pset_driver(access_list, driver, static_cast<const void*>(&self)), "set the driver",
          file);
}

void Hdf5Target::check() const {
  if (failure_) std::rethrow_exception(failure_);
}

void Hdf5Target::write(std::int64_t at, const char* bytes, std::size_t count) noexcept {
  size_ = std::max(size_, at + static_cast<std::int64_t>(count));
  try {
    if (!failure_) return file_->write_at(at, bytes, count);
  } catch (...) {
    failure_ = std::current_exception();
  }
  kept_.push_back({at, std::string(bytes, count)});
}

void Hdf5Target::read(std::int64_t at, char* bytes, std::size_t count) noexcept {
  std::memset(bytes, 0, count);  // as beyond the end of a file
  const std::int64_t end = at + static_cast<std::int64_t>(count);
  try {
    const std::int64_t stored = std::min(end, file_->size());
    if (stored > at) file_->read_at(at, bytes, stored - at);
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
  }
  for (const Kept& k : kept_) {
    const std::int64_t from = std::max(at, k.at),
                       to = std::min(end, k.at + static_cast<std::int64_t>(k.bytes.size()));
    if (from < to) std::memcpy(bytes + (from - at), k.bytes.data() + (from - k.at), to - from);
  }
}

void Hdf5Target::set_size(std::int64_t bytes) noexcept {
  size_ = bytes;
  try {
    if (!failure_) file_->truncate(bytes);
  } catch (...) {
    failure_ = std::current_exception();
  }
}

}  // namespace sluice

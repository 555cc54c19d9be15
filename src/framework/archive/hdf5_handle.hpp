// HDF5 identifiers that close themselves, and calls that name what failed.
#pragma once
#include <hdf5.h>

#include <string>
#include <utility>

namespace sluice {

// Throws SystemError: "cannot ACTION in FILE: HDF5's own words".
[[noreturn]] void fail_hdf5(const std::string& action, const std::string& file);

// HDF5 prints its error stack unless told not to; our messages carry its innermost reason.
void silence_hdf5();

class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }
  // Closes now; false when HDF5 could not.
  bool close() { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

// A handle, or SystemError.
inline Hdf5Handle checked(hid_t id, Hdf5Handle::Close closer, const char* action,
                          const std::string& file) {
  if (id < 0) fail_hdf5(action, file);
  return {id, closer};
}
inline void checked(herr_t status, const char* action, const std::string& file) {
  if (status < 0) fail_hdf5(action, file);
}

}  // namespace sluice

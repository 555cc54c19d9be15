// The innermost entry of HDF5's error stack as a message.
#include "framework/archive/hdf5_handle.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "framework/archive/posix_file.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

herr_t remember(unsigned depth, const H5E_error2_t* entry, void* text) {
  if (depth == 0 && entry->desc) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

}  // namespace

void fail_hdf5(const std::string& action, const std::string& file) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, remember, &reason);
  H5Eclear2(H5E_DEFAULT);
  // The file driver's words end with "errno = 28, error message = ...".
  const std::size_t at = reason.find("errno = ");
  const int error_number = at == reason.npos ? 0 : std::atoi(reason.c_str() + at + 8);
  if (error_number != 0) fail_system(action + " in", file, error_number);
  throw SystemError(fmt::format("cannot {} in {}: {}", action, file, reason));
}

void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace sluice

// Reading through zlib, which hands on what is not packed.
#include "framework/base/packed_text.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <memory>

#include "framework/base/error.hpp"

namespace sluice {

std::string unpacked_text(const std::string& file, const std::string& what) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{} {}: {}", what, file, why));
  };
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  if (in == nullptr) fail("cannot be opened");
  std::string text;
  char buffer[1 << 16];
  int read = 0;
  while ((read = gzread(in.get(), buffer, sizeof buffer)) > 0) text.append(buffer, read);
  int state = Z_OK;
  const char* why = gzerror(in.get(), &state);
  if (state == Z_BUF_ERROR) fail("ends before it is unpacked completely");
  if (read < 0 || (state != Z_OK && state != Z_STREAM_END))
    fail(fmt::format("cannot be unpacked: {}", why));
  return text;
}

}  // namespace sluice

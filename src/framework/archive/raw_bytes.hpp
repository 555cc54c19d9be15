// Numbers of raw binary files, in either byte order.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "framework/archive/xml_text.hpp"

namespace sluice {

template <class T>
T raw_number(const char* bytes, bool big_endian) {
  char own[sizeof(T)];
  std::memcpy(own, bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(own, own + sizeof(T));
  T value;
  std::memcpy(&value, own, sizeof(T));
  return value;
}

// Reads one number after the other; DamageError at the end of the bytes.
class RawBytes {
 public:
  RawBytes(std::string_view bytes, bool big_endian, std::string context)
      : rest_(bytes), big_endian_(big_endian), context_(std::move(context)) {}

  template <class T>
  T read() {
    if (rest_.size() < sizeof(T)) throw DamageError(context_ + ": the file ends too early");
    const T value = raw_number<T>(rest_.data(), big_endian_);
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  IntVec3 read_ints() {
    IntVec3 v;
    for (int d = 0; d < 3; ++d) v[d] = read<std::int32_t>();
    return v;
  }
  Vec3 read_reals() {
    Vec3 v;
    for (int d = 0; d < 3; ++d) v[d] = read<double>();
    return v;
  }

 private:
  std::string_view rest_;
  bool big_endian_;
  std::string context_;
};

}  // namespace sluice

// CRC-32C: polynomial arithmetic modulo 0x1EDC6F41 over GF(2), bits reflected.
//
// Appending n zero bytes multiplies the register by x^(8n); that joins the checksums of
// independently computed parts (combination), with a table of that product for fixed lengths.
#include "framework/base/crc32c.hpp"

#include <array>
#include <bit>
#include <cstring>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

namespace sluice {
namespace {

constexpr std::uint32_t polynomial = 0x82f63b78;  // reflected 0x1EDC6F41
constexpr std::uint32_t one = 0x80000000;         // x^0, reflected

// a b mod P
constexpr std::uint32_t multiply(std::uint32_t a, std::uint32_t b) {
  std::uint32_t product = 0;
  for (std::uint32_t bit = one; bit != 0; bit >>= 1) {
    if ((a & bit) != 0) product ^= b;
    b = (b >> 1) ^ ((b & 1) != 0 ? polynomial : 0);
  }
  return product;
}

// x^(8 bytes) mod P, by squaring
constexpr std::uint32_t power_of_bytes(std::uint64_t bytes) {
  std::uint32_t result = one;
  std::uint32_t square = one >> 8;  // x^8
  for (; bytes != 0; bytes >>= 1) {
    if ((bytes & 1) != 0) result = multiply(result, square);
    square = multiply(square, square);
  }
  return result;
}

using Table = std::array<std::array<std::uint32_t, 256>, 4>;

// The product with a fixed power, one byte of the register at a time.
Table make_shift_table(std::uint64_t bytes) {
  const std::uint32_t power = power_of_bytes(bytes);
  Table table;
  for (std::uint32_t position = 0; position < 4; ++position) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      table[position][byte] = multiply(power, byte << (8 * position));
    }
  }
  return table;
}

[[maybe_unused]] std::uint32_t shift(const Table& table, std::uint32_t crc) {
  return table[0][crc & 0xff] ^ table[1][(crc >> 8) & 0xff] ^ table[2][(crc >> 16) & 0xff] ^
         table[3][crc >> 24];
}

// Slicing by eight: table[n][b] is byte b followed by n zero bytes.
std::array<std::array<std::uint32_t, 256>, 8> make_slicing_table() {
  std::array<std::array<std::uint32_t, 256>, 8> table;
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? polynomial : 0);
    table[0][byte] = crc;
  }
  for (std::size_t n = 1; n < 8; ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[n - 1][byte];
      table[n][byte] = (before >> 8) ^ table[0][before & 0xff];
    }
  }
  return table;
}

#if defined(__x86_64__)

std::uint64_t load(const unsigned char* data) {
  std::uint64_t word;
  std::memcpy(&word, data, sizeof word);
  return word;
}

// Three streams of `stream` bytes each hide the instruction's latency of three cycles.
template <std::size_t stream>
__attribute__((target("sse4.2"))) std::uint32_t three_streams(std::uint32_t crc,
                                                              const unsigned char*& data,
                                                              std::size_t& size) {
  static const Table one_stream = make_shift_table(stream);
  std::uint64_t a = crc;
  while (size >= 3 * stream) {
    std::uint64_t b = 0;
    std::uint64_t c = 0;
    for (std::size_t i = 0; i < stream; i += 8) {
      a = _mm_crc32_u64(a, load(data + i));
      b = _mm_crc32_u64(b, load(data + stream + i));
      c = _mm_crc32_u64(c, load(data + 2 * stream + i));
    }
    b ^= shift(one_stream, static_cast<std::uint32_t>(a));
    a = c ^ shift(one_stream, static_cast<std::uint32_t>(b));
    data += 3 * stream;
    size -= 3 * stream;
  }
  return static_cast<std::uint32_t>(a);
}

__attribute__((target("sse4.2"))) std::uint32_t crc32c_hardware(std::uint32_t crc,
                                                                const void* begin,
                                                                std::size_t size) {
  const auto* data = static_cast<const unsigned char*>(begin);
  crc = ~crc;
  crc = three_streams<8192>(crc, data, size);
  crc = three_streams<256>(crc, data, size);
  std::uint64_t wide = crc;
  for (; size >= 8; size -= 8, data += 8) wide = _mm_crc32_u64(wide, load(data));
  crc = static_cast<std::uint32_t>(wide);
  for (; size > 0; --size, ++data) crc = _mm_crc32_u8(crc, *data);
  return ~crc;
}

#endif

using Function = std::uint32_t (*)(std::uint32_t, const void*, std::size_t);

Function choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("sse4.2")) return crc32c_hardware;
#endif
  return crc32c_software;
}

}  // namespace

std::uint32_t crc32c(std::uint32_t crc, const void* data, std::size_t size) {
  static const Function function = choose();
  return function(crc, data, size);
}

std::uint32_t crc32c_software(std::uint32_t crc, const void* begin, std::size_t size) {
  static const auto table = make_slicing_table();
  const auto* data = static_cast<const unsigned char*>(begin);
  crc = ~crc;
  for (; size >= 8; size -= 8, data += 8) {
    std::array<std::uint32_t, 8> byte;
    for (std::uint32_t i = 0; i < 8; ++i) {
      byte[i] = data[i] ^ (i < 4 ? (crc >> (8 * i)) & 0xff : 0);
    }
    crc = 0;
    for (std::size_t i = 0; i < 8; ++i) crc ^= table[7 - i][byte[i]];
  }
  for (; size > 0; --size, ++data) crc = (crc >> 8) ^ table[0][(crc ^ *data) & 0xff];
  return ~crc;
}

}  // namespace sluice

// CRC-32C against the vectors of RFC 3720 appendix B.4 and against itself, bit by bit.
#include "framework/base/crc32c.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace sluice::crc32c_test {
namespace {

std::uint32_t bit_by_bit(const unsigned char* data, std::size_t size) {
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0x82f63b78U : 0U);
  }
  return ~crc;
}

std::vector<unsigned char> random_bytes(std::size_t size) {
  std::mt19937 random(17);
  std::vector<unsigned char> bytes(size);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
  return bytes;
}

TEST(Crc32c, published_vectors) {
  std::vector<unsigned char> bytes(32, 0);
  EXPECT_EQ(crc32c(0, bytes.data(), 32), 0x8a9136aaU);
  bytes.assign(32, 0xff);
  EXPECT_EQ(crc32c(0, bytes.data(), 32), 0x62a8ab43U);
  std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(0));
  EXPECT_EQ(crc32c(0, bytes.data(), 32), 0x46dd794eU);
  std::reverse(bytes.begin(), bytes.end());
  EXPECT_EQ(crc32c(0, bytes.data(), 32), 0x113fdb5cU);
  const std::vector<unsigned char> read_command = {
      0x01, 0xc0, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x04, 0x00,
      0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x18, 0x28, 0x00, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
  EXPECT_EQ(crc32c(0, read_command.data(), read_command.size()), 0xd9963a56U);
  EXPECT_EQ(crc32c(0, "123456789", 9), 0xe3069283U);
  EXPECT_EQ(crc32c(0, nullptr, 0), 0U);
}

TEST(Crc32c, every_path_agrees_bit_by_bit) {
  const std::vector<unsigned char> bytes = random_bytes(70000);
  // Lengths around the boundaries of the streams (256 and 8192 bytes, three at a time).
  for (const std::size_t size : {1UL, 7UL, 8UL, 9UL, 767UL, 768UL, 769UL, 1535UL, 24575UL, 24576UL,
                                 24577UL, 25344UL, 49152UL, 65537UL}) {
    for (const std::size_t start : {0UL, 1UL, 5UL}) {
      const std::uint32_t expected = bit_by_bit(bytes.data() + start, size);
      EXPECT_EQ(crc32c(0, bytes.data() + start, size), expected) << size;
      EXPECT_EQ(crc32c_software(0, bytes.data() + start, size), expected) << size;
    }
  }
}

TEST(Crc32c, continues) {
  const std::vector<unsigned char> bytes = random_bytes(30000);
  const std::uint32_t whole = crc32c(0, bytes.data(), bytes.size());
  for (const std::size_t cut : {0UL, 1UL, 13UL, 4096UL, 29999UL, 30000UL}) {
    const std::uint32_t first = crc32c(0, bytes.data(), cut);
    EXPECT_EQ(crc32c(first, bytes.data() + cut, bytes.size() - cut), whole);
  }
}

TEST(Crc32c, sees_every_single_bit) {
  std::vector<unsigned char> bytes = random_bytes(2048);
  const std::uint32_t good = crc32c(0, bytes.data(), bytes.size());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 37) {
    bytes[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8));
    EXPECT_NE(crc32c(0, bytes.data(), bytes.size()), good);
    bytes[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8));
  }
}

}  // namespace
}  // namespace sluice::crc32c_test

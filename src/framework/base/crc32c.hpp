// CRC-32C (Castagnoli) checksums at memory speed: what every byte of an archive is guarded by.
//
// Polynomial 0x1EDC6F41, reflected, initial value and final inversion as in RFC 3720 section
// 12.1. On x86 three independent streams of the SSE4.2 instruction are interleaved and joined by
// table; elsewhere slicing by eight.
#pragma once
#include <cstddef>
#include <cstdint>

namespace sluice {

// Continues a checksum: crc32c(crc32c(0, a), b) is the checksum of a followed by b.
std::uint32_t crc32c(std::uint32_t crc, const void* data, std::size_t size);

// The same by software alone, for machines without the instruction and for the test.
std::uint32_t crc32c_software(std::uint32_t crc, const void* data, std::size_t size);

}  // namespace sluice

// What this process takes of the machine's memory, as the kernel counts it.
#pragma once
#include <cstdint>

namespace sluice {

// The most that was resident at any time since the program started, in bytes.
std::uint64_t peak_resident_bytes();
// What is resident now, in bytes.
std::uint64_t resident_bytes();

}  // namespace sluice

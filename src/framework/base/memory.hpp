// What this process, and all ranks together, take of memory, as the kernel counts it.
#pragma once
#include <cstdint>

namespace sluice {

class Communicator;

// The most that was resident at any time since the program started, in bytes.
std::uint64_t peak_resident_bytes();
// Collective: that of every rank, added up. Pages that ranks of one machine share count once a
// rank.
std::uint64_t peak_resident_bytes_of_all(Communicator& ranks);
// What is resident now, in bytes.
std::uint64_t resident_bytes();

// Arrays that come and go (levels that follow the solution) are taken from memory that was freed
// before, without asking the system each time. Process-wide; without effect where malloc cannot.
void keep_freed_memory();
// Back to the system with what is free.
void return_freed_memory();

}  // namespace sluice

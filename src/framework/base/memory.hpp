// What this process, and all ranks together, take of memory, as the kernel counts it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace sluice {

class Communicator;

// The most that was resident at any time since the program started, in bytes.
std::uint64_t peak_resident_bytes();
// Collective: that of every rank, added up. Pages that ranks of one machine share count once a
// rank.
std::uint64_t peak_resident_bytes_of_all(Communicator& ranks);
// What is resident now, in bytes.
std::uint64_t resident_bytes();

// What a process may still take before the system ends it.
struct AvailableMemory {
  std::uint64_t bytes = 0;
  std::string limit;  // what says so: "free on this machine", "left by the control group /a/b"
};
// The least of MemAvailable, of what each control group above this process leaves (version 1 or 2;
// pages of files that it can drop count as free), and of the limit on addresses (ulimit -v).
// `root`: another one than / for tests. 0 bytes: not known.
AvailableMemory available_memory(const std::filesystem::path& root = "/");

// Arrays that come and go (levels that follow the solution) are taken from memory that was freed
// before, without asking the system each time. Process-wide; without effect where malloc cannot.
void keep_freed_memory();
// Back to the system with what is free.
void return_freed_memory();

}  // namespace sluice

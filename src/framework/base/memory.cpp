// Read from /proc/self/status: getrusage would report the peak of the parent that started us.
#include "framework/base/memory.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <sys/resource.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"

namespace sluice {
namespace {

// The value of a line such as "VmHWM:   5120 kB", in bytes; 0 when there is none.
std::uint64_t status_entry(const char* name) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(name, 0) == 0) return 1024 * std::stoull(line.substr(std::strlen(name)));
  }
  return 0;
}

}  // namespace

std::uint64_t peak_resident_bytes() {
  if (const std::uint64_t peak = status_entry("VmHWM:"); peak > 0) return peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

std::uint64_t peak_resident_bytes_of_all(Communicator& ranks) {
  Reduction sum;
  const auto total = sum.add_count(static_cast<std::int64_t>(peak_resident_bytes()));
  ranks.reduce(sum);
  return static_cast<std::uint64_t>(sum.count(total));
}

std::uint64_t resident_bytes() {
  return status_entry("VmRSS:");
}

#ifdef __GLIBC__
void keep_freed_memory() {
  constexpr int largest = 32 << 20;  // bytes of one array; larger ones are mapped each time
  mallopt(M_MMAP_THRESHOLD, largest);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}
void return_freed_memory() {
  malloc_trim(0);
}
#else
void keep_freed_memory() {}
void return_freed_memory() {}
#endif

}  // namespace sluice

// Read from /proc/self/status: getrusage would report the peak of the parent that started us.
#include "framework/base/memory.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

// The value of a line such as "VmHWM:   5120 kB", in bytes; 0 when there is none.
std::uint64_t entry_of(const fs::path& file, const char* name) {
  std::ifstream entries(file);
  std::string line;
  while (std::getline(entries, line)) {
    if (line.rfind(name, 0) == 0) return 1024 * std::stoull(line.substr(std::strlen(name)));
  }
  return 0;
}

std::uint64_t status_entry(const char* name) {
  return entry_of("/proc/self/status", name);
}

// The number that a file of a control group holds; nothing for "max" or where there is no file.
std::optional<std::uint64_t> number_in(const fs::path& file) {
  std::ifstream in(file);
  std::uint64_t number = 0;
  return in >> number ? std::optional(number) : std::nullopt;
}

// "inactive_file 4096": a line of memory.stat, in bytes.
std::uint64_t statistic(const fs::path& file, const std::string& name) {
  std::ifstream in(file);
  std::string word;
  std::uint64_t number = 0;
  while (in >> word >> number)
    if (word == name) return number;
  return 0;
}

// Names of files of the two versions of control groups.
struct GroupFiles {
  const char *folder, *limit, *used, *droppable;
};
constexpr GroupFiles version_1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                  "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles version_2 = {"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};

void lower(AvailableMemory& available, std::uint64_t bytes, const std::string& limit) {
  if (available.bytes == 0 || bytes < available.bytes)
    available = {std::max<std::uint64_t>(bytes, 1), limit};
}

// This group and all above it.
void lower_to_groups(AvailableMemory& available, const fs::path& root, const GroupFiles& files,
                     fs::path group) {
  for (;; group = group.parent_path()) {
    const fs::path folder = root / files.folder / group.relative_path();
    if (const auto limit = number_in(folder / files.limit)) {
      const std::uint64_t used = number_in(folder / files.used).value_or(0);
      const std::uint64_t held =
          used - std::min(used, statistic(folder / "memory.stat", files.droppable));
      lower(available, *limit - std::min(*limit, held),
            "left by the control group " + group.string());
    }
    if (!group.has_relative_path()) return;
  }
}

// Lines "0::/path" (version 2) and "7:cpu,memory:/path" (version 1).
void lower_to_all_groups(AvailableMemory& available, const fs::path& root) {
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string kinds = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1);
    if (kinds == ",,") lower_to_groups(available, root, version_2, group);
    if (kinds.find(",memory,") != std::string::npos)
      lower_to_groups(available, root, version_1, group);
  }
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

AvailableMemory available_memory(const fs::path& root) {
  AvailableMemory available;
  if (const std::uint64_t there = entry_of(root / "proc/meminfo", "MemAvailable:"); there > 0)
    lower(available, there, "free on this machine");
  lower_to_all_groups(available, root);
  rlimit addresses{};
  if (getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
    lower(available, addresses.rlim_cur, "the limit on addresses (ulimit -v)");
  return available;
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

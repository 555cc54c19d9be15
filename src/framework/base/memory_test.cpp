// What memory a process takes, and what it may still take.
#include "framework/base/memory.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "framework/base/temporary_folder.hpp"

namespace sluice::memory_test {
namespace {

TEST(Memory, peak_follows_what_is_touched) {
  const std::uint64_t before = peak_resident_bytes();
  constexpr std::size_t size = std::size_t{96} << 20;
  char* block = static_cast<char*>(std::malloc(size));
  ASSERT_NE(block, nullptr);
  for (std::size_t i = 0; i < size; i += 4096) const_cast<volatile char*>(block)[i] = 1;
  EXPECT_GE(resident_bytes(), size);
  std::free(block);
  EXPECT_GE(peak_resident_bytes(), size);
  EXPECT_GE(peak_resident_bytes(), before);
}

class Available : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  TemporaryFolder folder_;
};

TEST_F(Available, IsWhatTheMachineHasFree) {
  EXPECT_EQ(available_memory(folder_.path()).bytes, 0U);
  write("proc/meminfo", "MemTotal: 4000 kB\nMemFree: 10 kB\nMemAvailable:   3000 kB\n");
  const AvailableMemory there = available_memory(folder_.path());
  EXPECT_EQ(there.bytes, 3000U * 1024);
  EXPECT_EQ(there.limit, "free on this machine");
  EXPECT_GT(available_memory().bytes, 0U);
}

// Of the groups above it, too; pages of files are dropped for whoever asks.
TEST_F(Available, IsWhatControlGroupsLeave) {
  write("proc/meminfo", "MemAvailable: 3000 kB\n");
  write("proc/self/cgroup", "0::/jobs/mine\n");
  write("sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  write("sys/fs/cgroup/jobs/memory.max", "2000000\n");
  write("sys/fs/cgroup/jobs/memory.current", "1500000\n");
  write("sys/fs/cgroup/jobs/memory.stat", "anon 800000\ninactive_file 700000\n");
  const AvailableMemory left = available_memory(folder_.path());
  EXPECT_EQ(left.bytes, 1200000U);
  EXPECT_EQ(left.limit, "left by the control group /jobs");
  write("sys/fs/cgroup/jobs/memory.max", "900000000\n");
  EXPECT_EQ(available_memory(folder_.path()).bytes, 3000U * 1024);
}

TEST_F(Available, IsWhatControlGroupsOfVersion1Leave) {
  write("proc/meminfo", "MemAvailable: 3000 kB\n");
  write("proc/self/cgroup", "7:cpu,memory:/a\n6:devices:/\n");
  write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "1000000\n");
  write("sys/fs/cgroup/memory/a/memory.usage_in_bytes", "1000000\n");
  EXPECT_EQ(available_memory(folder_.path()).bytes, 1U);  // full, not unknown
}

}  // namespace
}  // namespace sluice::memory_test

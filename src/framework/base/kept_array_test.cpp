// Memory that arrays give back is taken by the next of their size.
#include "framework/base/kept_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <thread>

namespace sluice::kept_array_test {
namespace {

TEST(KeptArray, TakesTheMemoryThatTheLastOneGaveBack) {
  const double* memory = nullptr;
  {
    const KeptArray<double> first(1000, 1.0);
    memory = first.data();
  }
  const std::size_t kept = KeptMemory::kept();
  const KeptArray<double> next(1010, 2.0);  // of the same class of size
  EXPECT_EQ(next.data(), memory);
  EXPECT_LT(KeptMemory::kept(), kept);
  EXPECT_EQ(std::accumulate(next.begin(), next.end(), 0.0), 2020.0);
}

// Every size has room, lies on a cache line and wastes at most a quarter.
TEST(KeptArray, ClassesOfSizeHoldWhatIsAskedFor) {
  for (std::size_t n = 1; n < 70000; n += n / 7 + 1) {
    const std::size_t before = KeptMemory::kept();
    {
      KeptArray<std::uint8_t> a(n, 7);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % 64, 0u) << n;
      a.back() = 9;
      EXPECT_EQ(a.size(), n);
    }
    const std::size_t more = KeptMemory::kept() - before;
    if (more == 0) continue;  // of an earlier size
    EXPECT_GE(more, n);
    EXPECT_LE(more, std::max<std::size_t>(64, n + n / 4 + 1)) << n;
  }
}

// What one thread makes and another drops is there for the first again.
TEST(KeptArray, LargeOnesAreKeptForAllThreads) {
  const double* memory = nullptr;
  KeptArray<double> a;
  std::thread([&] {
    a.assign(7000, 1.0);
    memory = a.data();
  }).join();
  KeptArray<double>().swap(a);  // dropped here
  const double* again = nullptr;
  std::thread([&] {
    const KeptArray<double> b(7000, 2.0);
    again = b.data();
  }).join();
  EXPECT_EQ(again, memory);
}

TEST(KeptArray, MayBeDroppedByAnotherThread) {
  KeptArray<int> a(5000, 3);
  std::thread([b = std::move(a)]() mutable { b.clear(); }).join();
  SUCCEED();
}

}  // namespace
}  // namespace sluice::kept_array_test

// A fixed piece of arithmetic whose time tells how fast and how quiet the machine is right now.
//
// Nanoseconds per cell of a benchmark divided by nanoseconds per turn of this loop can be compared
// between machines and hours; nanoseconds alone cannot. The loop is a mixture like a flow kernel's:
// multiply-adds, a division and a select over an array that fits the first-level cache.
// Prints one number: the median nanoseconds per element of 15 repetitions.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace {

constexpr int kElements = 1024;
constexpr int kSweeps = 20000;
constexpr int kRepetitions = 15;

using Row = std::array<double, kElements>;

// Values stay in [-1, 1] for any number of sweeps.
void sweep(const Row& a, const Row& b, Row& out) {
  for (int i = 0; i < kElements; ++i) {
    const double sum = a[i] * 0.5 + b[i] * 0.25;
    const double quotient = (a[i] - b[i]) / (8.0 + a[i] * a[i]);
    out[i] = sum > 0.1 ? sum - quotient : sum + quotient;
  }
}

// Tells the compiler that the row is read here, so that no sweep may be left out.
void keep(Row& row) {
  asm volatile("" : "+m"(row));
}

double nanoseconds_per_element() {
  Row a, b, c;
  for (int i = 0; i < kElements; ++i) {
    a[i] = 0.0009 * i;
    b[i] = 1.0 - 0.0005 * i;
  }
  const auto start = std::chrono::steady_clock::now();
  for (int s = 0; s < kSweeps; ++s) {
    sweep(a, b, c);
    sweep(c, b, a);
    keep(a);
    keep(c);
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() / (2.0 * kElements * kSweeps);
}

}  // namespace

int main() {
  std::array<double, kRepetitions> times{};
  for (double& time : times) time = nanoseconds_per_element();
  std::sort(times.begin(), times.end());
  std::printf("%.6f\n", times[kRepetitions / 2]);
  return 0;
}

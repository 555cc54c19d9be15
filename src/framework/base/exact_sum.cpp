// Carries, rounding and the fast path for arrays of ExactSum.
#include "framework/base/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace sluice {
namespace {

constexpr int nan_slot = ExactSum::chunk_count;
constexpr int plus_infinity_slot = nan_slot + 1;
constexpr int minus_infinity_slot = nan_slot + 2;
constexpr int lowest_exponent = -1075;  // of the unit of chunk 0

// Moves what exceeds 32 bits of each chunk into the next one; the last chunk carries the sign.
void propagate(std::int64_t* chunks) {
  std::int64_t carry = 0;
  for (int i = 0; i < ExactSum::chunk_count - 1; ++i) {
    const std::int64_t sum = chunks[i] + carry;
    carry = sum >> 32;
    chunks[i] = sum & 0xffffffff;
  }
  chunks[ExactSum::chunk_count - 1] += carry;
}

// Bits [position, position + 64) of the number whose chunks are all in [0, 2^32).
std::uint64_t bits_at(const std::int64_t* chunks, int position) {
  std::uint64_t result = 0;
  for (int i = 0; i < 3; ++i) {
    const int chunk = position / 32 + i;
    if (chunk >= ExactSum::chunk_count) break;
    const int shift = 32 * i - position % 32;
    const auto word = static_cast<std::uint64_t>(chunks[chunk]);
    if (shift < 0) {
      result |= word >> -shift;
    } else if (shift < 64) {
      result |= word << shift;
    }
  }
  return result;
}

bool any_bit_below(const std::int64_t* chunks, int position) {
  for (int i = 0; i < position / 32; ++i) {
    if (chunks[i] != 0) return true;
  }
  const std::int64_t mask = (std::int64_t{1} << (position % 32)) - 1;
  return (chunks[position / 32] & mask) != 0;
}

// Rounds a non-negative number to the nearest double, ties to even.
double round_to_double(const std::int64_t* chunks) {
  int top = ExactSum::chunk_count - 1;
  while (top >= 0 && chunks[top] == 0) --top;
  if (top < 0) return 0.0;
  const int highest = 32 * top + 63 - std::countl_zero(static_cast<std::uint64_t>(chunks[top]));
  const int lowest = highest - 52;
  if (lowest <= 1) {  // all bits fit: subnormal, or the smallest normal numbers
    return std::ldexp(static_cast<double>(bits_at(chunks, 0)), lowest_exponent);
  }
  std::uint64_t mantissa = bits_at(chunks, lowest) & ((std::uint64_t{1} << 53) - 1);
  const bool half = (bits_at(chunks, lowest - 1) & 1) != 0;
  if (half && ((mantissa & 1) != 0 || any_bit_below(chunks, lowest - 1))) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), lowest + lowest_exponent);
}

double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

}  // namespace

void ExactSum::add_special(double x) {
  if (std::isnan(x)) {
    ++slots_[nan_slot];
  } else {
    ++slots_[x > 0 ? plus_infinity_slot : minus_infinity_slot];
  }
}

void ExactSum::carry() {
  propagate(slots_.data());
  room_ = adds_between_carries;
}

ExactSum::Slots ExactSum::canonical() const {
  Slots result = slots_;
  propagate(result.data());
  return result;
}

ExactSum ExactSum::from_slots(const Slots& slots) {
  ExactSum result;
  result.slots_ = slots;
  result.carry();
  return result;
}

// How many more adds the chunks bear after taking over another sum's; none: carry that one first.
int ExactSum::room_after(const ExactSum& other) const {
  return room_ - (adds_between_carries - other.room_) - 1;
}

void ExactSum::merge(const ExactSum& other) {
  if (const int room = room_after(other); room > 0) {
    for (int i = 0; i < slot_count; ++i) slots_[i] += other.slots_[i];
    room_ = room;
    return;
  }
  const Slots addend = other.canonical();
  for (int i = 0; i < slot_count; ++i) slots_[i] += addend[i];
  carry();
}

void ExactSum::subtract(const ExactSum& other) {
  ExactSum negative = other;
  for (int i = 0; i < chunk_count; ++i) negative.slots_[i] = -negative.slots_[i];
  std::swap(negative.slots_[plus_infinity_slot], negative.slots_[minus_infinity_slot]);
  merge(negative);
}

double ExactSum::value() const {
  Slots chunks = canonical();
  const bool up = chunks[plus_infinity_slot] > 0;
  const bool down = chunks[minus_infinity_slot] > 0;
  if (chunks[nan_slot] > 0 || (up && down)) return std::numeric_limits<double>::quiet_NaN();
  if (up) return std::numeric_limits<double>::infinity();
  if (down) return -std::numeric_limits<double>::infinity();
  if (chunks[chunk_count - 1] >= 0) return round_to_double(chunks.data());
  for (int i = 0; i < chunk_count; ++i) chunks[i] = -chunks[i];
  propagate(chunks.data());
  return -round_to_double(chunks.data());
}

namespace {

// As many doubles side by side as a register of the machine holds.
#if defined(__AVX512F__)
constexpr std::size_t lane_bytes = 64;
#elif defined(__AVX2__)
constexpr std::size_t lane_bytes = 32;
#else
constexpr std::size_t lane_bytes = 16;
#endif
using Lanes = double __attribute__((vector_size(lane_bytes)));
using LaneBits = std::int64_t __attribute__((vector_size(lane_bytes)));
constexpr std::size_t lane_count = lane_bytes / sizeof(double);
constexpr std::size_t block_size = 1024;
// 2^headroom >= block_size + 2: the sum of block_size extracted parts stays exact.
constexpr int headroom = 11;
constexpr int bits_per_level = 53 - headroom;

// Bits of the largest magnitude; infinities and NaN compare above all numbers.
std::uint64_t largest_magnitude(const double* values, std::size_t count) {
  LaneBits largest = {};
  for (std::size_t i = 0; i < count; i += lane_count) {
    LaneBits bits;
    std::memcpy(&bits, values + i, sizeof bits);
    bits &= 0x7fffffffffffffff;
    largest = bits > largest ? bits : largest;
  }
  std::int64_t result = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) result = std::max(result, largest[lane]);
  return static_cast<std::uint64_t>(result);
}

// Cuts every value into multiples of unit[l] = 2^(-53) sigma[l] and sums each kind exactly.
// Returns whether something smaller than the last unit was left over.
template <int Levels>
bool extract(const double* values, std::size_t count, const double* sigma, double* sums) {
  Lanes total[Levels] = {};
  LaneBits left_over = {};
  for (std::size_t i = 0; i < count; i += lane_count) {
    Lanes x;
    std::memcpy(&x, values + i, sizeof x);
    for (int level = 0; level < Levels; ++level) {
      const Lanes part = (sigma[level] + x) - sigma[level];
      total[level] += part;
      x -= part;
    }
    left_over |= (x != 0.0);
  }
  bool any = false;
  for (std::size_t lane = 0; lane < lane_count; ++lane) any = any || left_over[lane] != 0;
  for (int level = 0; level < Levels; ++level) {
    sums[level] = 0.0;
    for (std::size_t lane = 0; lane < lane_count; ++lane) sums[level] += total[level][lane];
  }
  return any;
}

}  // namespace

// Adds a whole number of lanes, at most block_size values, or says that it cannot: values that
// are not finite, or that spread over more binary digits than so many levels hold.
bool ExactSum::add_block(const double* values, std::size_t count, int levels) {
  const std::uint64_t largest = largest_magnitude(values, count);
  if (largest == 0) return true;
  const int exponent = static_cast<int>(largest >> 52) - 1022;  // all magnitudes < 2^exponent
  if (exponent + headroom > 1022 || exponent < -700) return false;
  double sigma[4];
  double sums[4];
  for (int l = 0; l < 4; ++l) sigma[l] = power_of_two(exponent + headroom - l * bits_per_level);
  const bool left_over =
      levels == 2 ? extract<2>(values, count, sigma, sums) : extract<4>(values, count, sigma, sums);
  if (left_over) return false;
  for (int l = 0; l < levels; ++l) add(sums[l]);
  return true;
}

void ExactSum::add(const double* values, std::size_t count) {
  while (count >= lane_count) {
    const std::size_t n = std::min(count, block_size) / lane_count * lane_count;
    if (n < 16 || !(add_block(values, n, 2) || add_block(values, n, 4))) {
      for (std::size_t i = 0; i < n; ++i) add(values[i]);
    }
    values += n;
    count -= n;
  }
  for (std::size_t i = 0; i < count; ++i) add(values[i]);
}

}  // namespace sluice

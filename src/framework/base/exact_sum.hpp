// Exact, order-independent sum of doubles, of any unit: the only sum that may reach a result.
//
// A small superaccumulator: a fixed-point number that spans all doubles, held as 67 chunks of
// 32 bits in int64 words with deferred carries. Adding is integer arithmetic, so the sum has no
// rounding error and no memory of order, threads, ranks or boxes; value() rounds once, to nearest
// even. A sum of zeros is +0 whatever their signs. NaN and infinities are sticky and counted.
//
// R. M. Neal, Fast exact summation using small and large superaccumulators, arXiv:1505.05571
// (2015), section 2; blocks: S. M. Rump, T. Ogita, S. Oishi, Accurate floating-point summation I,
// SIAM J. Sci. Comput. 31 (2008) 189-224, extraction of section 3.
// Limits: fewer than 2^60 values in all, fewer than 2^30 ranks.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sluice {

class ExactSum {
 public:
  static constexpr int chunk_count = 67;
  // The chunks, then how many NaN, +inf and -inf were added: plain integers, which may be summed
  // over ranks word by word and kept in a checkpoint.
  static constexpr int slot_count = chunk_count + 3;
  using Slots = std::array<std::int64_t, slot_count>;

  ExactSum() = default;
  // From slots as canonical() gives them, or from the word-by-word sum of several such.
  static ExactSum from_slots(const Slots& slots);

  void add(double x);
  void add(const double* values, std::size_t count);
  void merge(const ExactSum& other);
  void subtract(const ExactSum& other);

  // The sum, rounded once to the nearest double (ties to even); +-inf on overflow.
  double value() const;
  // Equal for equal sums, however they came about: carries done, all chunks but the last
  // in [0, 2^32).
  Slots canonical() const;

  friend bool operator==(const ExactSum& a, const ExactSum& b) {
    return a.canonical() == b.canonical();
  }

 private:
  // Chunk i counts units of 2^(32 i - 1075). Every add changes a chunk by less than 2^52, so that
  // this many fit into 63 bits.
  static constexpr int adds_between_carries = 2046;

  void add_special(double x);
  bool add_block(const double* values, std::size_t count, int levels);
  void carry();
  int room_after(const ExactSum& other) const;

  Slots slots_{};
  int room_ = adds_between_carries;
};

inline void ExactSum::add(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  std::uint64_t exponent = (bits >> 52) & 0x7ff;
  if (exponent == 0x7ff) [[unlikely]] {
    add_special(x);
    return;
  }
  const std::uint64_t normal = exponent != 0;
  const std::uint64_t mantissa = (bits & ((std::uint64_t{1} << 52) - 1)) | (normal << 52);
  exponent += 1 - normal;
  const std::uint64_t chunk = exponent >> 5;
  const std::uint64_t shift = exponent & 31;
  const auto low = static_cast<std::int64_t>((mantissa << shift) & 0xffffffffU);
  const auto high = static_cast<std::int64_t>(mantissa >> (32 - shift));
  const std::int64_t sign = -static_cast<std::int64_t>(bits >> 63);
  slots_[chunk] += (low ^ sign) - sign;
  slots_[chunk + 1] += (high ^ sign) - sign;
  if (--room_ == 0) [[unlikely]]
    carry();
}

}  // namespace sluice

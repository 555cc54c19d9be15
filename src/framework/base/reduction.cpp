// Layout of a reduction record: for each slot its kind, then its payload, all 64-bit words.
// Doubles travel as integers of the same order, so that minima are exact to the bit (-0 < +0).
#include "framework/base/reduction.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sluice {
namespace {

enum Kind : std::int64_t { kind_minimum = 1, kind_maximum, kind_sum, kind_count, kind_any };
constexpr std::int64_t kind_mismatch = -1;

std::size_t payload_words(std::int64_t kind) {
  switch (kind) {
    case kind_minimum:
    case kind_maximum:
      return 2;
    case kind_sum:
      return ExactSum::slot_count;
    case kind_count:
    case kind_any:
      return 1;
    default:
      return 0;
  }
}

// Negative doubles order backwards in their bits; flipping all but the sign puts that right.
std::int64_t to_ordered(double x, std::int64_t for_nan) {
  if (std::isnan(x)) return for_nan;
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : bits ^ std::numeric_limits<std::int64_t>::max();
}

double from_ordered(std::int64_t ordered, std::int64_t for_nan) {
  if (ordered == for_nan) return std::numeric_limits<double>::quiet_NaN();
  return std::bit_cast<double>(ordered >= 0 ? ordered
                                            : ordered ^ std::numeric_limits<std::int64_t>::max());
}

constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();

// into = the better of the two (value, tag) pairs.
void take_better(const std::int64_t* from, std::int64_t* into, bool from_is_better) {
  if (from_is_better) {
    into[0] = from[0];
    into[1] = from[1];
  } else if (from[0] == into[0]) {
    into[1] = std::min(from[1], into[1]);
  }
}

}  // namespace

Reduction::Minimum Reduction::add_minimum(double value, std::int64_t tag) {
  words_.insert(words_.end(), {kind_minimum, to_ordered(value, lowest), tag});
  return {words_.size() - 2};
}

Reduction::Maximum Reduction::add_maximum(double value, std::int64_t tag) {
  words_.insert(words_.end(), {kind_maximum, to_ordered(value, highest), tag});
  return {words_.size() - 2};
}

Reduction::Sum Reduction::add_sum(const ExactSum& value) {
  const ExactSum::Slots slots = value.canonical();
  words_.push_back(kind_sum);
  words_.insert(words_.end(), slots.begin(), slots.end());
  return {words_.size() - slots.size()};
}

Reduction::Count Reduction::add_count(std::int64_t value) {
  words_.insert(words_.end(), {kind_count, value});
  return {words_.size() - 1};
}

Reduction::Any Reduction::add_any(bool value) {
  words_.insert(words_.end(), {kind_any, value ? 1 : 0});
  return {words_.size() - 1};
}

double Reduction::minimum(Minimum slot) const {
  return from_ordered(words_[slot.word], lowest);
}
std::int64_t Reduction::tag(Minimum slot) const {
  return words_[slot.word + 1];
}
double Reduction::maximum(Maximum slot) const {
  return from_ordered(words_[slot.word], highest);
}
std::int64_t Reduction::tag(Maximum slot) const {
  return words_[slot.word + 1];
}
std::int64_t Reduction::count(Count slot) const {
  return words_[slot.word];
}
bool Reduction::any(Any slot) const {
  return words_[slot.word] != 0;
}

ExactSum Reduction::sum(Sum slot) const {
  ExactSum::Slots slots;
  std::copy_n(words_.begin() + static_cast<std::ptrdiff_t>(slot.word), slots.size(), slots.begin());
  return ExactSum::from_slots(slots);
}

bool Reduction::combine(const std::int64_t* from, std::int64_t* into, std::size_t count) {
  std::size_t at = 0;
  while (at < count) {
    const std::int64_t kind = into[at];
    const std::size_t payload = payload_words(kind);
    if (kind != from[at] || payload == 0 || at + 1 + payload > count) {
      into[at] = kind_mismatch;
      return false;
    }
    const std::int64_t* a = from + at + 1;
    std::int64_t* b = into + at + 1;
    switch (kind) {
      case kind_minimum:
        take_better(a, b, a[0] < b[0]);
        break;
      case kind_maximum:
        take_better(a, b, a[0] > b[0]);
        break;
      case kind_any:
        b[0] |= a[0];
        break;
      default:
        for (std::size_t i = 0; i < payload; ++i) b[i] += a[i];
    }
    at += 1 + payload;
  }
  return true;
}

bool Reduction::is_consistent() const {
  std::size_t at = 0;
  while (at < words_.size()) {
    const std::size_t payload = payload_words(words_[at]);
    if (payload == 0) return false;
    at += 1 + payload;
  }
  return true;
}

}  // namespace sluice

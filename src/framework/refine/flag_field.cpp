// Flags of cells as rows of bits, and the box filter that widens them.
#include "framework/refine/flag_field.hpp"

#include <algorithm>
#include <bit>

namespace sluice {

namespace {

constexpr int word_bits = 64;
using Word = std::uint64_t;

// Bits [low, high) of a word; 0 <= low < high <= 64.
Word mask(int low, int high) {
  const Word up_to = high == word_bits ? ~Word{0} : (Word{1} << high) - 1;
  return up_to & ~((Word{1} << low) - 1);
}

// Calls f(word, mask) for the words that hold bits [low, high).
template <class F>
void for_each_word(int low, int high, F&& f) {
  for (int w = low / word_bits; w * word_bits < high; ++w)
    f(w, mask(std::max(low - w * word_bits, 0), std::min(high - w * word_bits, word_bits)));
}

// to |= from moved towards lower bits (shift > 0), `count` words each; `from` may be `to`.
void or_shifted_down(const Word* from, Word* to, int shift, std::size_t count) {
  const std::size_t whole = shift / word_bits;
  const int part = shift % word_bits;
  for (std::size_t w = 0; w + whole < count; ++w) {
    Word bits = from[w + whole] >> part;
    if (part != 0 && w + whole + 1 < count) bits |= from[w + whole + 1] << (word_bits - part);
    to[w] |= bits;
  }
}

// Widens one row by less than a word, where what wraps around wraps by whole words: bits come from
// the words on both sides. Windows of 1, 2, 4, ... bits are joined, then of reach + 1.
void widen_row(Word* row, std::size_t words, int reach, bool periodic) {
  const Word first = row[0];
  Word before = periodic ? row[words - 1] : 0;
  for (std::size_t w = 0; w < words; ++w) {
    Word up = row[w], down = up, below = before,
         above = w + 1 < words ? row[w + 1] : (periodic ? first : 0);
    before = up;
    if ((up | below | above) == 0) continue;
    for (int done = 1, step = 0; done <= reach; done += step) {
      step = std::min(done, reach + 1 - done);
      up |= up << step | below >> (word_bits - step);
      below |= below << step;
      down |= down >> step | above << (word_bits - step);
      above |= above >> step;
    }
    row[w] = up | down;
  }
}

// Widens one row: bit i of the result is the or of bits i - reach .. i + reach.
class RowFilter {
 public:
  RowFilter(int cells, int reach, bool periodic)
      : cells_(cells), reach_(std::min(reach, cells)), periodic_(periodic) {}

  void apply(Word* row, std::size_t row_words) {
    if (reach_ < word_bits && (!periodic_ || cells_ % word_bits == 0)) {
      widen_row(row, row_words, reach_, periodic_);
    } else {
      widen_far(row, row_words);
    }
    if (cells_ % word_bits != 0) row[row_words - 1] &= mask(0, cells_ % word_bits);
  }

 private:
  void widen_far(Word* row, std::size_t row_words) {
    extended_.assign((cells_ + 2 * reach_) / word_bits + 1, Word{0});
    extend(row, row_words);
    // Windows of growing width: or of 1, 2, 4, ... bits, then of 2 reach + 1.
    const int width = 2 * reach_ + 1;
    int done = 1;
    while (done < width) {
      const int step = std::min(done, width - done);
      or_shifted_down(extended_.data(), extended_.data(), step, extended_.size());
      done += step;
    }
    std::copy_n(extended_.data(), row_words, row);
  }
  // The row behind `reach_` bits that are empty, or the row's other end.
  void extend(const Word* row, std::size_t row_words) {
    const std::size_t whole = reach_ / word_bits;
    const int part = reach_ % word_bits;
    for (std::size_t w = 0; w < row_words; ++w) {
      if (row[w] == 0) continue;
      extended_[w + whole] |= row[w] << part;
      if (part != 0 && w + whole + 1 < extended_.size())
        extended_[w + whole + 1] |= row[w] >> (word_bits - part);
    }
    if (!periodic_) return;
    for (int i = 0; i < reach_; ++i) {
      copy_bit(row, cells_ - reach_ + i, i);
      copy_bit(row, i, cells_ + reach_ + i);
    }
  }
  void copy_bit(const Word* row, int from, int to) {
    const Word bit = row[from / word_bits] >> (from % word_bits) & 1u;
    extended_[to / word_bits] |= bit << (to % word_bits);
  }

  int cells_, reach_;
  bool periodic_;
  std::vector<Word> extended_;
};

void or_rows(const Word* from, Word* to, std::size_t count) {
  for (std::size_t w = 0; w < count; ++w) to[w] |= from[w];
}

bool empty_row(const Word* row, std::size_t count) {
  return std::all_of(row, row + count, [](Word w) { return w == 0; });
}

// Widens `n` rows (or planes) of `words` each that follow each other: each becomes the or of those
// up to `reach` <= n before and behind it. `extended`: room.
void widen(Word* rows, std::size_t words, int n, int reach, bool periodic,
           std::vector<Word>& extended) {
  const std::size_t border = reach * words, inside = n * words;
  if (empty_row(rows, inside)) return;
  extended.assign(inside + 2 * border, Word{0});
  Word* const first = extended.data();
  std::copy_n(rows, inside, first + border);
  if (periodic) {
    std::copy_n(rows + inside - border, border, first);
    std::copy_n(rows, border, first + border + inside);
  }
  // Windows of growing width, as within a row.
  const int width = 2 * reach + 1;
  for (int done = 1, step = 0; done < width; done += step) {
    step = std::min(done, width - done);
    const std::size_t ahead = step * words, end = extended.size() - ahead;
#pragma GCC ivdep
    for (std::size_t w = 0; w < end; ++w) first[w] |= first[w + ahead];
  }
  std::copy_n(first, inside, rows);
}

}  // namespace

FlagField::FlagField(const IndexBox& domain)
    : domain_(domain), size_(domain.empty() ? IntVec3{} : domain.size()) {
  row_words_ = (size_.x + word_bits - 1) / word_bits;
  words_.assign(row_words_ * size_.y * size_.z, Word{0});
}

void FlagField::fill(const IndexBox& cells) {
  const IndexBox b = intersection(cells, domain_);
  if (b.empty()) return;
  const IntVec3 low = b.lower - domain_.lower, high = b.upper - domain_.lower;
  for (int z = low.z; z < high.z; ++z)
    for (int y = low.y; y < high.y; ++y)
      for_each_word(low.x, high.x, [&, bits = row(y, z)](std::size_t w, Word m) { bits[w] |= m; });
}

bool FlagField::any() const {
  return !empty_row(words_.data(), words_.size());
}

bool FlagField::any(const IndexBox& cells) const {
  const IndexBox b = intersection(cells, domain_);
  if (b.empty()) return false;
  const IntVec3 low = b.lower - domain_.lower, high = b.upper - domain_.lower;
  Word found = 0;
  for (int z = low.z; z < high.z && found == 0; ++z)
    for (int y = low.y; y < high.y && found == 0; ++y)
      for_each_word(low.x, high.x,
                    [&, bits = row(y, z)](std::size_t w, Word m) { found |= bits[w] & m; });
  return found != 0;
}

std::int64_t FlagField::count() const {
  std::int64_t n = 0;
  for (const Word w : words_) n += std::popcount(w);
  return n;
}

FlagField FlagField::dilated(IntVec3 reach, const std::array<bool, 3>& periodic) const {
  FlagField wide = *this;
  if (reach.x > 0) {
    RowFilter filter(size_.x, reach.x, periodic[0]);
    for (std::size_t start = 0; start < wide.words_.size(); start += row_words_)
      if (!empty_row(wide.words_.data() + start, row_words_))
        filter.apply(wide.words_.data() + start, row_words_);
  }
  std::vector<Word> room;
  const std::size_t planes = size_.z, plane = row_words_ * size_.y;
  if (const int y = std::min(reach.y, size_.y); y > 0)
    for (std::size_t z = 0; z < planes; ++z)
      widen(wide.words_.data() + z * plane, row_words_, size_.y, y, periodic[1], room);
  if (const int z = std::min(reach.z, size_.z); z > 0)
    widen(wide.words_.data(), plane, size_.z, z, periodic[2], room);
  return wide;
}

FlagField& FlagField::operator|=(const FlagField& other) {
  or_rows(other.words_.data(), words_.data(), words_.size());
  return *this;
}

FlagField& FlagField::operator&=(const FlagField& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
  return *this;
}

bool FlagField::within(const FlagField& other) const {
  Word outside = 0;
  for (std::size_t w = 0; w < words_.size(); ++w) outside |= words_[w] & ~other.words_[w];
  return outside == 0;
}

}  // namespace sluice

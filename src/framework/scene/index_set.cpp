// Index sets of decks: "0, 2-4, -1"; empty means everything.
#include "framework/scene/index_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "framework/base/error.hpp"

namespace sluice {

bool IndexSet::contains(int index, int count) const {
  if (all_) return true;
  return std::any_of(members_.begin(), members_.end(),
                     [&](int m) { return m == index || (m < 0 && m + count == index); });
}

namespace {

constexpr int largest_index = 100000;

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::vector<int> members() {
    std::vector<int> result;
    skip_separators();
    while (at_ < text_.size()) {
      const int first = number();
      int last = first;
      skip_blanks();
      if (at_ < text_.size() && text_[at_] == '-') {
        ++at_;
        skip_blanks();
        last = number();
        if (last < first) fail(fmt::format("the range {} - {} runs backwards", first, last));
      }
      for (int i = first; i <= last; ++i) result.push_back(i);
      skip_separators();
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  void skip_separators() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == ',')) {
      ++at_;
    }
  }
  int number() {
    int value = 0;
    const char* begin = text_.data() + at_;
    const char* end = text_.data() + text_.size();
    const std::from_chars_result r = std::from_chars(begin, end, value);
    if (r.ec != std::errc{} || value > largest_index || value < -largest_index)
      fail("expected a whole number here");
    at_ += static_cast<std::size_t>(r.ptr - begin);
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format(
        "index set '{}', character {}: {}; write it like \"0, 2-4, -1\", or leave it empty for all",
        text_, at_ + 1, what));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

IndexSet parse_index_set(std::string_view text) {
  if (text.find_first_not_of(" \t,") == std::string_view::npos) return {};
  return IndexSet(Reader(text).members());
}

}  // namespace sluice

// The largest of many numbers, eight at a time.
#pragma once
#include <cmath>
#include <cstddef>

#include "framework/base/eight.hpp"

namespace sluice {

// The larger of both into `most`; what is no number stays.
inline void keep_larger(double& most, double x) {
  if (x > most || x != x) most = x;
}

// max(from, f(begin), ..., f(end - 1)); what is not finite makes it no number. f takes a reader of
// columns, OneOf or EightOf, and returns what that does.
template <class F>
[[gnu::always_inline]] inline double largest(std::size_t begin, std::size_t end, double from,
                                             F&& f) {
  Eight most = Eight{} + from, unsound{};
  std::size_t i = begin;
  for (; i + 8 <= end; i += 8) {
    const Eight x = f(EightOf{i});
    most = x > most ? x : most;
    unsound += 0.0 * x;
  }
  double all = from, sum = 0;
  for (; i < end; ++i) {
    const double x = f(OneOf{i});
    all = x > all ? x : all;
    sum += 0 * x;
  }
  for (int l = 0; l < 8; ++l) {
    all = most[l] > all ? most[l] : all;
    sum += unsound[l];
  }
  return sum == 0 ? all : std::nan("");
}

// The largest of a number and of those that were added, one or eight at a time. What is no number
// is passed over, as std::max(most, x) does.
class Most {
 public:
  explicit Most(double from) : one_(from), all_(Eight{} + from) {}
  void add(double x) { one_ = larger(one_, x); }
  [[gnu::always_inline]] void add(const Eight& x) { all_ = larger(all_, x); }
  double value() const {
    double most = one_;
    for (int l = 0; l < 8; ++l) most = larger(most, double{all_[l]});
    return most;
  }

 private:
  double one_;
  Eight all_;
};

}  // namespace sluice

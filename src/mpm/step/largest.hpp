// The largest of many numbers, eight at a time.
#pragma once
#include <cmath>
#include <cstddef>

namespace sluice::mpm {

// The larger of both into `most`; what is no number stays.
inline void keep_larger(double& most, double x) {
  if (x > most || x != x) most = x;
}

// max(from, f(begin), ..., f(end - 1)); what is not finite makes it no number.
template <class F>
double largest(std::size_t begin, std::size_t end, double from, F&& f) {
  constexpr std::size_t wide = 8;
  double most[wide], unsound[wide] = {};
  for (double& m : most) m = from;
  std::size_t i = begin;
  for (; i + wide <= end; i += wide)
    for (std::size_t l = 0; l < wide; ++l) {
      const double x = f(i + l);
      most[l] = x > most[l] ? x : most[l];
      unsound[l] += 0 * x;
    }
  for (; i < end; ++i) {
    const double x = f(i);
    most[0] = x > most[0] ? x : most[0];
    unsound[0] += 0 * x;
  }
  double all = most[0], sum = unsound[0];
  for (std::size_t l = 1; l < wide; ++l) {
    all = most[l] > all ? most[l] : all;
    sum += unsound[l];
  }
  return sum == 0 ? all : std::nan("");
}

}  // namespace sluice::mpm

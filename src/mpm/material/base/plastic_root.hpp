// The plastic multiplier of a return: the root of a function that falls. Arguments and values may
// have any units; `tolerance` has that of f.
#pragma once
#include <algorithm>
#include <cmath>

namespace sluice::mpm {

// x in [0, high] with |f(x)| <= tolerance, or between neighbouring numbers; f(0) = f_0 > 0 and
// f(high) <= 0. `guess` is tried first. Chandrupatla 1997: inverse quadratic interpolation where
// three points are monotone enough, halving elsewhere, so that it ends for any f.
template <class Function>
double falling_root(const Function& f, double f_0, double high, double guess, double tolerance) {
  double a = 0, fa = f_0, b = high, fb = f(high);
  if (std::abs(fb) <= tolerance) return high;
  if (fb > 0) return high;
  double t = guess > 0 && guess < high ? guess / high : fa / (fa - fb);
  for (int step = 0; step < 200; ++step) {
    const double x = a + t * (b - a), fx = f(x);
    double c, fc;
    if ((fx > 0) == (fa > 0)) {
      c = a;
      fc = fa;
    } else {
      c = b;
      fc = fb;
      b = a;
      fb = fa;
    }
    a = x;
    fa = fx;
    if (std::abs(fa) <= tolerance) return a;
    const double least = 4e-16 * std::max(std::abs(a), std::abs(b)) / std::abs(b - a);
    if (!(least < 0.5)) return a;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      t = fa / (fb - fa) * (fc / (fb - fc)) +
          (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb));
    t = std::clamp(t, least, 1 - least);
  }
  return a;
}

// The same by the secant method from a good guess in (0, high): a few values of f. Negative where
// that does not end soon.
template <class Function>
double secant_root(const Function& f, double f_0, double high, double guess, double tolerance) {
  double a = 0, fa = f_0, b = guess;
  for (int step = 0; step < 8; ++step) {
    const double fb = f(b);
    if (std::abs(fb) <= tolerance) return b;
    const double next = b + fb * (b - a) / (fa - fb);
    a = b;
    fa = fb;
    b = next;
    if (!(b > 0 && b < high)) return -1;
  }
  return -1;
}

// The plastic change of volume y of a step (without unit), y = settle(y).volume, where `first` =
// settle(0).volume: a cap that hardens, a fluid that is pressed make |volume| less; one that
// softens can make it more.
template <class Settle>
double settled_volume(const Settle& settle, double first) {
  if (first == 0) return 0;
  const double sign = first < 0 ? -1 : 1;
  const auto over = [&](double x) { return sign * settle(sign * x).volume - x; };
  double high = std::abs(first);
  for (int k = 0; k < 60 && over(high) > 0; ++k) high *= 2;
  return sign * falling_root(over, std::abs(first), high, 0, 1e-14 * std::abs(first));
}

}  // namespace sluice::mpm

// Triples of numbers: positions, velocities, cell indices.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sluice {

template <class T>
struct Triple {
  T x{}, y{}, z{};

  constexpr T& operator[](int d) { return d == 0 ? x : d == 1 ? y : z; }
  constexpr const T& operator[](int d) const { return d == 0 ? x : d == 1 ? y : z; }

  constexpr friend bool operator==(const Triple&, const Triple&) = default;
  constexpr friend Triple operator+(Triple a, Triple b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  constexpr friend Triple operator-(Triple a, Triple b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  constexpr friend Triple operator*(Triple a, Triple b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  constexpr friend Triple operator*(Triple a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  constexpr friend Triple operator*(T s, Triple a) { return a * s; }
  constexpr Triple& operator+=(Triple b) { return *this = *this + b; }
  constexpr Triple& operator-=(Triple b) { return *this = *this - b; }

  static constexpr Triple all(T s) { return {s, s, s}; }
};

using Vec3 = Triple<double>;
using IntVec3 = Triple<int>;

constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr IntVec3 min(IntVec3 a, IntVec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr IntVec3 max(IntVec3 a, IntVec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
constexpr Vec3 to_real(IntVec3 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

}  // namespace sluice

// Bodies of particles with corners, and their motions, for tests of the geometry.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mpmice/geometry/cell_blocks.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

template <int D>
using Point = std::array<double, D>;
template <int D>
using Motion = std::function<Point<D>(const Point<D>&)>;

// A number in [-1, 1) of some whole numbers.
inline double hashed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t h = a * 0x9e3779b97f4a7c15u + b * 0xc2b2ae3d27d4eb4fu + 0x165667b19e3779f9u;
  for (int i = 0; i < 3; ++i) h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

// Particles of a lattice whose corners are points of a map: neighbours share corners to the bit.
template <int D>
struct Body {
  static constexpr std::size_t corners = corners_of_particle<D>;
  std::string name;
  std::array<std::array<std::vector<double>, D>, corners> start, end;
  std::vector<std::uint8_t> outer;

  std::size_t size() const { return outer.size(); }
  static CornerColumns<D> columns(const decltype(start)& from) {
    CornerColumns<D> c;
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t d = 0; d < D; ++d) c[k][d] = from[k][d].data();
    return c;
  }
  void move(const Motion<D>& to) {
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t p = 0; p < size(); ++p) {
        Point<D> x;
        for (std::size_t d = 0; d < D; ++d) x[d] = start[k][d][p];
        x = to(x);
        for (std::size_t d = 0; d < D; ++d) end[k][d][p] = x[d];
      }
  }
  void take_step() { start = end; }
  OuterFaces<D> faces() const {
    OuterFaces<D> f;
    const auto to = columns(end);
    f.add(columns(start), &to, outer.data(), size());
    return f;
  }
};

// The particles of `counts` cells of a lattice that are kept; `place`: where lattice points are.
template <int D>
Body<D> lattice_body(const std::string& name, const Cell<D>& counts,
                     const std::function<bool(const Cell<D>&)>& kept,
                     const std::function<Point<D>(const Cell<D>&)>& place) {
  Body<D> body;
  body.name = name;
  const auto inside = [&](const Cell<D>& c) {
    for (std::size_t d = 0; d < D; ++d)
      if (c[d] < 0 || c[d] >= counts[d]) return false;
    return kept(c);
  };
  std::size_t total = 1;
  for (const int n : counts) total *= static_cast<std::size_t>(n);
  for (std::size_t i = 0; i < total; ++i) {
    Cell<D> c;
    std::size_t rest = i;
    for (std::size_t d = 0; d < D; ++d) {
      c[d] = static_cast<int>(rest % static_cast<std::size_t>(counts[d]));
      rest /= static_cast<std::size_t>(counts[d]);
    }
    if (!inside(c)) continue;
    unsigned outer = 0;
    for (std::size_t d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) {
        Cell<D> beside = c;
        beside[d] += side == 1 ? 1 : -1;
        if (!inside(beside)) outer |= 1u << (2 * d + static_cast<unsigned>(side));
      }
    body.outer.push_back(static_cast<std::uint8_t>(outer));
    for (std::size_t k = 0; k < Body<D>::corners; ++k) {
      Cell<D> corner = c;
      for (std::size_t d = 0; d < D; ++d) corner[d] += static_cast<int>(k >> d) & 1;
      const Point<D> x = place(corner);
      for (std::size_t d = 0; d < D; ++d) body.start[k][d].push_back(x[d]);
    }
  }
  body.end = body.start;
  return body;
}

template <int D>
Cell<D> all(int n) {
  Cell<D> c;
  c.fill(n);
  return c;
}

// The middle of all bodies lies near (4.5, 4.7, 4.9).
inline constexpr std::array<double, 3> body_middle{4.5, 4.7, 4.9};

// A block of `n` particles a direction with edges of half a cell, its corners moved by up to
// `random` edges and then rounded to multiples of `unit` (0: not).
template <int D>
Body<D> block(const std::string& name, int n, Point<D> low, double random = 0, double unit = 0) {
  return lattice_body<D>(
      name, all<D>(n), [](const Cell<D>&) { return true; },
      [=](const Cell<D>& c) {
        Point<D> x;
        std::uint64_t key = 0;
        for (const int i : c) key = key * 1000 + static_cast<std::uint64_t>(i);
        for (std::size_t d = 0; d < D; ++d) {
          x[d] = low[d] + 0.5 * (c[d] + random * hashed(key, d));
          if (unit > 0) x[d] = unit * std::round(x[d] / unit);
        }
        return x;
      });
}

// A ball of radius 2.3 as a mapped cube of n particles a direction.
template <int D>
Body<D> ball(int n = 9, double radius = 2.3) {
  return lattice_body<D>(
      "ball", all<D>(n), [](const Cell<D>&) { return true; },
      [=](const Cell<D>& c) {
        Point<D> x;
        double square = 0, largest = 0;
        for (std::size_t d = 0; d < D; ++d) {
          x[d] = 2.0 * c[d] / n - 1;
          square += x[d] * x[d];
          largest = std::max(largest, std::abs(x[d]));
        }
        const double stretch = square > 0 ? largest / std::sqrt(square) : 1;
        for (std::size_t d = 0; d < D; ++d) x[d] = body_middle[d] + radius * stretch * x[d];
        return x;
      });
}

// Particles of half a cell whose middles lie in a ball.
template <int D>
Body<D> ball_of_stairs() {
  const int n = 9;
  return lattice_body<D>(
      "ball of stairs", all<D>(n),
      [](const Cell<D>& c) {
        double square = 0;
        for (const int i : c) square += (i - 4.0) * (i - 4.0);
        return square < 4.4 * 4.4;
      },
      [](const Cell<D>& c) {
        Point<D> x;
        for (std::size_t d = 0; d < D; ++d) x[d] = body_middle[d] - 2.25 + 0.5 * c[d];
        return x;
      });
}

template <int D>
std::vector<Body<D>> bodies() {
  Point<D> off, on;
  for (std::size_t d = 0; d < D; ++d) {
    off[d] = body_middle[d] - 1.9 + 0.07 * static_cast<double>(d);
    on[d] = 2;
  }
  std::vector<Body<D>> all{block<D>("block", 7, off),
                           block<D>("block on grid planes", 8, on),
                           ball<D>(),
                           ball_of_stairs<D>(),
                           block<D>("corners at random", 7, off, 0.3),
                           block<D>("the same on quarters", 7, on, 0.3, 0.25),
                           block<D>("the same on halves", 7, on, 0.3, 0.5)};
  // Particles may be turned inside out; in 1-D and 2-D as well.
  all.push_back(block<D>("corners at random, half an edge", 7, off, 0.5));
  return all;
}

template <int D>
struct NamedMotion {
  std::string name;
  Motion<D> to;
  Point<D> uniform;  // in cells a step; 1e300: it is not
};

template <int D>
NamedMotion<D> translation(const std::string& name, std::array<double, 3> by) {
  Point<D> v;
  for (std::size_t d = 0; d < D; ++d) v[d] = by[d];
  return {name,
          [v](const Point<D>& x) {
            Point<D> y;
            for (std::size_t d = 0; d < D; ++d) y[d] = x[d] + v[d];
            return y;
          },
          v};
}

template <int D>
Motion<D> rotation(double angle) {
  return [angle](const Point<D>& x) {
    Point<D> y = x;
    if constexpr (D > 1) {
      const double c = std::cos(angle), s = std::sin(angle);
      const double u = x[0] - body_middle[0], v = x[1] - body_middle[1];
      y[0] = body_middle[0] + c * u - s * v;
      y[1] = body_middle[1] + s * u + c * v;
    }
    return y;
  };
}

// x + bend: every direction is sheared and stretched by the others.
template <int D>
Motion<D> deformation() {
  return [](const Point<D>& x) {
    Point<D> y = x;
    for (std::size_t d = 0; d < D; ++d) {
      const double other = x[(d + 1) % D] - body_middle[(d + 1) % D];
      y[d] += 0.12 * std::sin(0.9 * other + 0.3) - 0.06 * (x[d] - body_middle[d]);
    }
    return y;
  };
}

template <int D>
std::vector<NamedMotion<D>> motions() {
  Point<D> none;
  none.fill(1e300);
  return {translation<D>("oblique", {0.37, -0.22, 0.17}),
          translation<D>("along x", {0.4, 0, 0}),
          translation<D>("whole cells", {1, 0, -0.5}),
          translation<D>("at rest", {0, 0, 0}),
          {"turning", rotation<D>(0.2), none},
          {"deforming", deformation<D>(), none}};
}

// Cells wide enough for all of them, and the blocks around these.
template <int D>
struct TestCells {
  Cell<D> lower = all<D>(-6), upper = all<D>(16);
  CellBlocks<D> blocks = CellBlocks<D>::around({lower, upper});

  std::size_t index(const Cell<D>& c) const { return blocks.index(c); }
  std::size_t size() const { return blocks.size(); }
};
template <int D>
const TestCells<D>& test_cells() {
  static const TestCells<D> cells;
  return cells;
}
// Those of arrays over them.
template <template <int> class Arrays, int D>
const TestCells<D>& cells_of(const Arrays<D>&) {
  return test_cells<D>();
}
template <int D, class Act>
void for_cells(const TestCells<D>& cells, Act&& act) {
  for_each_cell_of<D>({cells.lower, cells.upper},
                      [&](const Cell<D>& c) { act(c, cells.index(c)); });
}

template <int D, class Act>
void for_each_body(Act&& act) {
  for (const Body<D>& body : bodies<D>()) act(body);
}

}  // namespace sluice::mpmice

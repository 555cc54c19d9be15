// A start with planar, cylindrical or spherical symmetry, from which the radial solvers run. SI
// units: kg/m^3, m/s, Pa, m; momentum kg/(m^2 s) and energy J/m^3 of means.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace sluice::exact {

struct RadialProblem {
  int dimension = 1;  // 1 plane, 2 cylinder, 3 sphere
  double gamma = 1.4;
  double low = 0, high = 1;  // of the radius; low must be 0 unless dimension is 1
  int cells = 2000;
  double cfl = 0.8;
  bool outflow = false;  // at the high end (a wall otherwise); the low end is a wall

  // Piecewise uniform start: state i holds from edge i-1 to edge i.
  struct Piece {
    double end = 0;  // its upper radius; the last reaches to high
    double density = 0, velocity = 0, pressure = 0;
    friend bool operator==(const Piece&, const Piece&) = default;
  };
  std::vector<Piece> pieces;

  // Internal energy on top of it, spread as exp(-(r/radius)^2) about the origin: both sides of a
  // plane (J/m^2), per length of an axis (J/m), in all (J).
  struct Deposit {
    double energy = 0, radius = 1;
    friend bool operator==(const Deposit&, const Deposit&) = default;
  };
  Deposit deposit;
  friend bool operator==(const RadialProblem&, const RadialProblem&) = default;
};

struct RadialState {
  double density, velocity, pressure;
};

// Means of what is conserved over a cell.
struct RadialMeans {
  double density = 0, momentum = 0, energy = 0;
};

// Throws InputError for a problem without sense.
void check(const RadialProblem& problem);

// Volume between two radii, per unit of area (m), of angle and length (m^2), or of solid angle
// (m^3).
double radial_volume(double low, double high, int dimension);

// Mean of the start between two radii: edges may lie inside.
RadialMeans start_means(const RadialProblem& problem, double low, double high);

// Slope of two one-sided differences, of any quantity: `central` at most twice the smaller one (van
// Leer).
inline double limited_slope(double a, double b, double central) {
  const double size = std::min(std::abs(central), 2 * std::min(std::abs(a), std::abs(b)));
  return a * b > 0 ? std::copysign(size, a) : 0.0;
}

}  // namespace sluice::exact

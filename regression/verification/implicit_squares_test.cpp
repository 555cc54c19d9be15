// Semi-implicit steps: two squares with published numbers, a moving lid and natural convection.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/case_run.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::implicit_squares_test {
namespace {

// Values at places x (rising), at `at`: the cubic through the nearest four.
double interpolated(const std::vector<double>& x, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(x.size()) - 4));
  double sum = 0;
  for (std::size_t a = first; a < first + 4; ++a) {
    double term = values[a];
    for (std::size_t b = first; b < first + 4; ++b)
      if (b != a) term *= (at - x[b]) / (x[a] - x[b]);
    sum += term;
  }
  return sum;
}

// A component of the velocity along a centre line of a square with an even number of cells, with
// what it is at both walls.
struct Line {
  std::vector<double> x, values;
  double at(double place) const { return interpolated(x, values, place); }
};
Line centre_line(const CellValues& u, int along, double low, double high) {
  const int n = u.size.x, half = n / 2;
  Line line{{0}, {low}};
  for (int k = 0; k < n; ++k) {
    line.x.push_back((k + 0.5) / n);
    line.values.push_back(along == 0 ? 0.5 * (u.at(k, half - 1) + u.at(k, half))
                                     : 0.5 * (u.at(half - 1, k) + u.at(half, k)));
  }
  line.x.push_back(1);
  line.values.push_back(high);
  return line;
}

// U. Ghia, K. N. Ghia, C. T. Shin, J. Comput. Phys. 48 (1982) 387-411, tables I and II, without the
// walls.
struct Point {
  double place, of_100, of_1000;  // Reynolds numbers
};
constexpr Point ghia_u[] = {  // along x = 1/2
    {0.9766, 0.84123, 0.65928},   {0.9688, 0.78871, 0.57492},   {0.9609, 0.73722, 0.51117},
    {0.9531, 0.68717, 0.46604},   {0.8516, 0.23151, 0.33304},   {0.7344, 0.00332, 0.18719},
    {0.6172, -0.13641, 0.05702},  {0.5000, -0.20581, -0.06080}, {0.4531, -0.21090, -0.10648},
    {0.2813, -0.15662, -0.27805}, {0.1719, -0.10150, -0.38289}, {0.1016, -0.06434, -0.29730},
    {0.0703, -0.04775, -0.22220}, {0.0625, -0.04192, -0.20196}, {0.0547, -0.03717, -0.18109}};
constexpr Point ghia_v[] = {  // along y = 1/2
    {0.9688, -0.05906, -0.21388}, {0.9609, -0.07391, -0.27669}, {0.9531, -0.08864, -0.33714},
    {0.9453, -0.10313, -0.39188}, {0.9063, -0.16914, -0.51550}, {0.8594, -0.22445, -0.42665},
    {0.8047, -0.24533, -0.31966}, {0.5000, 0.05454, 0.02526},   {0.2344, 0.17527, 0.32235},
    {0.2266, 0.17507, 0.33075},   {0.1563, 0.16077, 0.37095},   {0.0938, 0.12317, 0.32627},
    {0.0781, 0.10890, 0.30353},   {0.0703, 0.10091, 0.29012},   {0.0625, 0.09233, 0.27485}};

// O. Botella, R. Peyret, Computers & Fluids 27 (1998) 421-433: v along y = 1/2 at Reynolds number
// 1,000, at the places of ghia_v. Ghia's values are off by up to 0.0185 there.
constexpr double spectral_v[] = {-0.2279225, -0.2936869, -0.3553213, -0.4103754, -0.5264392,
                                 -0.4264545, -0.3202137, 0.0257995,  0.3253592,  0.3339924,
                                 0.3769189,  0.3330442,  0.3099097,  0.2962703,  0.2807056};

// The largest distance from Ghia's u and v on the centre lines, and from spectral_v, in velocities
// of the lid.
struct FromTables {
  double u = 0, v = 0, spectral = 0;
};
FromTables distance_from_ghia(int n, int reynolds, double end) {
  const CaseRun run(
      "implicit_cavity",
      until(end) + Overrides{resolution(n, n),
                             fmt::format("MaterialProperties/ICE/material/dynamic_viscosity={:g}",
                                         1.0 / reynolds)});
  EXPECT_EQ(run.events(), 0);
  const Line u = centre_line(run.field("vel_CC", 0), 1, 0, 1);
  const Line v = centre_line(run.field("vel_CC", 1), 0, 0, 0);
  FromTables off;
  const auto wanted = [&](const Point& p) { return reynolds == 100 ? p.of_100 : p.of_1000; };
  for (const Point& p : ghia_u) off.u = std::max(off.u, std::fabs(u.at(p.place) - wanted(p)));
  for (const Point& p : ghia_v) off.v = std::max(off.v, std::fabs(v.at(p.place) - wanted(p)));
  for (std::size_t k = 0; k < std::size(spectral_v); ++k)
    off.spectral = std::max(off.spectral, std::fabs(v.at(ghia_v[k].place) - spectral_v[k]));
  record("u", off.u);
  record("v", off.v);
  record("spectral", off.spectral);
  return off;
}

constexpr double allowed = 0.01;

TEST(ImplicitCavity, OfFewCellsIsNearGhia) {
  const FromTables off = distance_from_ghia(16, 100, 10);
  EXPECT_LE(std::max(off.u, off.v), 0.03);  // measured 0.023
}
TEST(FullImplicitCavity, OfReynoldsNumber100IsGhias) {
  const FromTables off = distance_from_ghia(64, 100, 20);
  EXPECT_LE(std::max(off.u, off.v), allowed);  // measured 0.0042, 0.0087
}
// Not met: 0.01 of Ghia's v, where the spectral solution is 0.0185 off. Measured 0.0122; 0.0043 of
// u, 0.0063 of the spectral v.
TEST(FullImplicitCavity, OfReynoldsNumber1000IsGhiasInUAndSpectralInV) {
  const FromTables off = distance_from_ghia(128, 1000, 60);
  EXPECT_LE(off.u, allowed);
  EXPECT_LE(off.spectral, allowed);
  EXPECT_LE(off.v, 0.013);
}

// The largest and smallest velocities on the middle lines at Reynolds number 100. C. H. Marchi,
// R. Suero, L. K. Araki, J. Braz. Soc. Mech. Sci. Eng. 31 (2009) 186-198: 1,024 x 1,024 cells,
// extrapolated; stream function and vorticity with 64 and 128 squared extrapolate to -0.21401,
// 0.17953, -0.25376. Ghia's own are 1.5, 2.4 and 3.3 % smaller.
struct Extremes {
  double u_least, v_most, v_least;
};
constexpr Extremes marchi = {-0.21404, 0.17957, -0.25380};

// Of the quartic through the five values around the extreme one, in relative distances.
double extreme(const std::vector<double>& values, double sign) {
  std::size_t top = 2;
  for (std::size_t k = 3; k + 2 < values.size(); ++k)
    if (sign * values[k] > sign * values[top]) top = k;
  std::vector<double> x, five;
  for (std::size_t k = top - 2; k <= top + 2; ++k) {
    x.push_back(static_cast<double>(k));
    five.push_back(values[k]);
  }
  double most = sign * values[top];
  for (int n = -50; n <= 50; ++n)
    most = std::max(most, sign * interpolated(x, five, static_cast<double>(top) + 0.01 * n));
  return sign * most;
}

double distance_from_marchi(int n) {
  const std::string gas = "MaterialProperties/ICE/material/geom_object/";
  const CaseRun run(  // Mach number 1e-3
      "implicit_cavity",
      until(20) + Overrides{resolution(n, n), "PhysicalConstants/reference_pressure=714285.714",
                            gas + "pressure=714285.714", gas + "temperature=1785714.285"});
  const Line u = centre_line(run.field("vel_CC", 0), 1, 0, 1);
  const Line v = centre_line(run.field("vel_CC", 1), 0, 0, 0);
  double off = 0;
  const auto compare = [&](const char* name, double found, double wanted) {
    record(name, found);
    off = std::max(off, std::fabs(found / wanted - 1));
  };
  compare("u least", extreme(u.values, -1), marchi.u_least);
  compare("v most", extreme(v.values, 1), marchi.v_most);
  compare("v least", extreme(v.values, -1), marchi.v_least);
  return off;
}

// Walls are of second order: measured 0.029, 0.0046.
TEST(FullImplicitCavity, ExtremesAreOfSecondOrder) {
  const double coarse = distance_from_marchi(32), fine = distance_from_marchi(64);
  EXPECT_LE(fine, 0.006);
  EXPECT_LE(fine, coarse / 3.7);
}

// G. de Vahl Davis, Int. J. Numer. Methods Fluids 3 (1983) 249-264: in thermal diffusivities over a
// side, on the centre lines.
struct Convection {
  double rayleigh;
  int cells;
  double end;  // of the run, in units of sqrt(side over reduced gravity)
  double nusselt, u, v;
};

// The largest of a line of cell values: of the parabola through the three around it.
double peak(const std::vector<double>& values) {
  const auto top = std::max_element(values.begin() + 1, values.end() - 1);
  const double low = *(top - 1), here = *top, high = *(top + 1);
  const double bend = low - 2 * here + high;
  return bend < 0 ? here - (high - low) * (high - low) / (8 * bend) : here;
}

// The largest relative distance from the benchmark.
double distance_from_benchmark(const Convection& c) {
  constexpr double prandtl = 0.71;
  const double mu = std::sqrt(prandtl / c.rayleigh), k = 1.4 / std::sqrt(prandtl * c.rayleigh);
  const std::string gas = "MaterialProperties/ICE/material/";
  const CaseRun run("implicit_natural_convection",
                    until(c.end) + Overrides{resolution(c.cells, c.cells),
                                             gas + fmt::format("dynamic_viscosity={:.17g}", mu),
                                             gas + fmt::format("thermal_conductivity={:.17g}", k)});
  EXPECT_EQ(run.events(), 0);
  const double diffusivity = k / 1.4;  // cp 1.4, density and side 1
  const Line u = centre_line(run.field("vel_CC", 0), 1, 0, 0);
  const Line v = centre_line(run.field("vel_CC", 1), 0, 0, 0);
  const CellValues T = run.field("temp_CC");
  // Heat through the hot wall, by the parabola through it and two cells.
  constexpr double hot = 1794642.857142857, difference = 17857.142857142724;
  double heat = 0;
  for (int j = 0; j < c.cells; ++j)
    heat += (8 * hot - 9 * T.at(0, j) + T.at(1, j)) / 3 / difference;  // times n, over n rows
  const auto off = [](const char* name, double value, double wanted) {
    record(name, value);
    return std::fabs(value / wanted - 1);
  };
  return std::max({off("Nu", heat, c.nusselt), off("u", peak(u.values) / diffusivity, c.u),
                   off("v", peak(v.values) / diffusivity, c.v)});
}

class ImplicitConvectionSquare : public testing::TestWithParam<Convection> {};

// Measured Nu, u, v: 1.118 3.635 3.684; 2.242 16.17 19.59; 4.537 34.59 68.15; 8.875 64.78 219.2.
TEST_P(ImplicitConvectionSquare, IsTheBenchmark) {
  EXPECT_LE(distance_from_benchmark(GetParam()), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Full, ImplicitConvectionSquare,
                         testing::Values(Convection{1e3, 32, 30, 1.118, 3.649, 3.697},
                                         Convection{1e4, 64, 40, 2.243, 16.178, 19.617},
                                         Convection{1e5, 64, 60, 4.519, 34.73, 68.59},
                                         Convection{1e6, 96, 80, 8.800, 64.63, 219.36}),
                         [](const auto& test) {
                           return "of_1e" +
                                  std::to_string(static_cast<int>(std::log10(test.param.rayleigh)));
                         });

TEST(ImplicitConvection, OfFewCellsIsNearTheBenchmark) {
  EXPECT_LE(distance_from_benchmark({1e3, 12, 20, 1.118, 3.649, 3.697}), 0.06);
}

}  // namespace
}  // namespace sluice::verification::implicit_squares_test

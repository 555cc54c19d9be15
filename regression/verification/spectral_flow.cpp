// Fourier modes, products on the grid without the highest third of the modes, Runge-Kutta of fourth
// order. Transforms are plain sums along one side at a time.
#include "verification/spectral_flow.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace sluice::verification {
namespace {

using Complex = std::complex<double>;
using Field = std::vector<Complex>;
using Vector = std::array<Field, 3>;

class SpectralFlow {
 public:
  SpectralFlow(int n, double viscosity)
      : n_(static_cast<std::size_t>(n)), size_(n_ * n_ * n_), viscosity_(viscosity) {
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t x = 0; x < n_; ++x)
        wave_.push_back(std::polar(
            1.0, 2 * std::numbers::pi * static_cast<double>(k * x % n_) / static_cast<double>(n_)));
  }

  Vector start() const {
    Vector u;
    for (Field& f : u) f.assign(size_, 0.0);
    for (std::size_t p = 0; p < size_; ++p) {
      const std::array<double, 3> x = place(p);
      u[0][p] = std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]);
      u[1][p] = -std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]);
    }
    for (Field& f : u) transform(f, false);
    return u;
  }

  // du/dt of the modes: projected convection and friction.
  Vector rate(const Vector& u) const {
    const std::array<double, 3> none{};
    Vector on_grid = u, convection;
    for (Field& f : on_grid) transform(f, true);
    for (std::size_t a = 0; a < 3; ++a) {
      convection[a].assign(size_, 0.0);
      for (std::size_t b = 0; b < 3; ++b) {
        Field product(size_);
        for (std::size_t p = 0; p < size_; ++p) product[p] = on_grid[a][p] * on_grid[b][p];
        transform(product, false);
        for (std::size_t p = 0; p < size_; ++p)
          convection[a][p] -= Complex(0, wave_number(p)[b]) * product[p];
      }
    }
    for (std::size_t p = 0; p < size_; ++p) {
      const std::array<double, 3> k = kept(p) ? wave_number(p) : none;
      const double square = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
      Complex along = 0;
      for (std::size_t a = 0; a < 3; ++a) along += k[a] * convection[a][p];
      for (std::size_t a = 0; a < 3; ++a) {
        const Complex pressure = square > 0 ? k[a] * along / square : 0.0;
        convection[a][p] =
            kept(p) ? convection[a][p] - pressure - viscosity_ * square * u[a][p] : 0.0;
      }
    }
    return convection;
  }

  void step(Vector& u, double dt) const {
    const Vector a = rate(u), b = rate(moved(u, a, dt / 2)), c = rate(moved(u, b, dt / 2)),
                 d = rate(moved(u, c, dt));
    for (std::size_t q = 0; q < 3; ++q)
      for (std::size_t p = 0; p < size_; ++p)
        u[q][p] += dt / 6 * (a[q][p] + 2.0 * b[q][p] + 2.0 * c[q][p] + d[q][p]);
  }

  static double energy(const Vector& u) {
    double sum = 0;
    for (const Field& f : u)
      for (const Complex& mode : f) sum += 0.5 * std::norm(mode);
    return sum;
  }

 private:
  std::array<std::size_t, 3> index(std::size_t p) const {
    return {p % n_, p / n_ % n_, p / (n_ * n_)};
  }
  std::array<double, 3> place(std::size_t p) const {
    const auto i = index(p);
    const double h = 2 * std::numbers::pi / static_cast<double>(n_);
    return {h * static_cast<double>(i[0]), h * static_cast<double>(i[1]),
            h * static_cast<double>(i[2])};
  }
  std::array<double, 3> wave_number(std::size_t p) const {
    std::array<double, 3> k{};
    const auto i = index(p);
    for (std::size_t a = 0; a < 3; ++a)
      k[a] = static_cast<double>(i[a]) - (2 * i[a] >= n_ ? static_cast<double>(n_) : 0.0);
    return k;
  }
  bool kept(std::size_t p) const {
    for (const double k : wave_number(p))
      if (3 * std::fabs(k) >= static_cast<double>(n_)) return false;
    return true;
  }
  static Vector moved(const Vector& u, const Vector& by, double dt) {
    Vector to = u;
    for (std::size_t q = 0; q < 3; ++q)
      for (std::size_t p = 0; p < to[q].size(); ++p) to[q][p] += dt * by[q][p];
    return to;
  }
  // Modes to values on the grid, or back.
  void transform(Field& f, bool to_grid) const {
    Field line(n_);
    for (const std::size_t stride : {std::size_t{1}, n_, n_ * n_})
      for (std::size_t p = 0; p < size_; ++p) {
        if (p / stride % n_ != 0) continue;
        for (std::size_t k = 0; k < n_; ++k) {
          Complex sum = 0;
          for (std::size_t x = 0; x < n_; ++x) {
            const Complex w = wave_[k * n_ + x];
            sum += f[p + x * stride] * (to_grid ? w : std::conj(w));
          }
          line[k] = to_grid ? sum : sum / static_cast<double>(n_);
        }
        for (std::size_t k = 0; k < n_; ++k) f[p + k * stride] = line[k];
      }
  }

  std::size_t n_, size_;
  double viscosity_;
  std::vector<Complex> wave_;
};

}  // namespace

std::vector<double> taylor_green_energies(int n, double viscosity,
                                          const std::vector<double>& times) {
  const SpectralFlow flow(n, viscosity);
  Vector u = flow.start();
  constexpr double largest_step = 0.1;
  std::vector<double> energies;
  double now = 0;
  for (const double time : times) {
    const int steps = static_cast<int>(std::ceil((time - now) / largest_step));
    for (int s = 0; s < steps; ++s) flow.step(u, (time - now) / steps);
    energies.push_back(SpectralFlow::energy(u));
    now = time;
  }
  return energies;
}

double taylor_green_energy(int n, double viscosity, double time) {
  return taylor_green_energies(n, viscosity, {time}).front();
}

}  // namespace sluice::verification

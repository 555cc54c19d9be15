#include "mpm/loads/manufactured.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sluice::mpm {
namespace {

constexpr double pi = std::numbers::pi;

// c of the period 2/c of the vibrations: sqrt(E/rho_0).
double bar_speed(const ManufacturedConstants& k) {
  const double E = k.shear * (3 * k.lambda + 2 * k.shear) / (k.lambda + k.shear);
  return std::sqrt(E / k.density);
}

// dP/dX of P = lambda ln J/f + G (f - 1/f) for a stretch f, where f' and (ln J)' are given.
double slope_of_stress(const ManufacturedConstants& k, double f, double df, double log_J,
                       double d_log_J) {
  return k.lambda * (d_log_J / f - log_J * df / (f * f)) + k.shear * df * (1 + 1 / (f * f));
}

// u_d = A sin(2 pi X_d) sin(c pi t + phase_d), in a unit cube with sliding walls.
class AxisAligned final : public Manufactured {
 public:
  explicit AxisAligned(const ManufacturedConstants& k)
      : k_(k), A_(k.amplitude != 0 ? k.amplitude : 0.05), rate_(bar_speed(k) * pi) {}

  Vec3 displacement(Vec3 X, double t) const override {
    return along(
        [&](int d) { return A_ * std::sin(2 * pi * X[d]) * sign(d) * std::sin(rate_ * t); });
  }
  Vec3 velocity(Vec3 X, double t) const override {
    return along([&](int d) {
      return A_ * rate_ * std::sin(2 * pi * X[d]) * sign(d) * std::cos(rate_ * t);
    });
  }
  Vec3 body_force(Vec3 X, double t) const override {
    const double beat = std::sin(rate_ * t);
    const Vec3 f = along([&](int d) {
      return 2 * pi * A_ * std::cos(2 * pi * X[d]) * sign(d) * beat;  // F_dd - 1
    });
    const double log_J = std::log1p(f.x) + std::log1p(f.y) + std::log1p(f.z);
    return along([&](int d) {
      const double F = 1 + f[d];
      const double u = A_ * std::sin(2 * pi * X[d]) * sign(d) * beat;
      const double dF = -4 * pi * pi * u;
      return -rate_ * rate_ * u - slope_of_stress(k_, F, dF, log_J, dF / F) / k_.density;
    });
  }

 private:
  // Phases 0, pi, 0: at rest in shape, not in motion, when the run begins.
  static double sign(int d) { return d == 1 ? -1.0 : 1.0; }
  template <class Act>
  Vec3 along(Act&& act) const {
    Vec3 v{};
    for (int d = 0; d < 3; ++d)
      if (k_.active[d] != 0) v[d] = act(d);
    return v;
  }

  ManufacturedConstants k_;
  double A_, rate_;
};

// A ring of radii 0.4 and 0.6 whose radial displacement is T(t) (c_3 R^3 + c_2 R^2 + c_1 R):
// without
// strain along r, and so (with lambda = 0) without traction, at both edges. T = A sin(c pi t).
class ExpandingRing final : public Manufactured {
 public:
  explicit ExpandingRing(const ManufacturedConstants& k)
      : k_(k), A_(k.amplitude != 0 ? k.amplitude : 0.1), rate_(bar_speed(k) * pi) {
    constexpr double inner = 0.4, outer = 0.6;
    constexpr double scale = outer * outer * (outer - 3 * inner);
    c_[0] = -6 * inner * outer / scale;
    c_[1] = 3 * (outer + inner) / scale;
    c_[2] = -2 / scale;
  }

  Vec3 displacement(Vec3 X, double t) const override {
    return radial(X, A_ * std::sin(rate_ * t) * shape(radius(X)));
  }
  Vec3 velocity(Vec3 X, double t) const override {
    return radial(X, A_ * rate_ * std::cos(rate_ * t) * shape(radius(X)));
  }
  Vec3 body_force(Vec3 X, double t) const override {
    const double R = radius(X), T = A_ * std::sin(rate_ * t);
    const double u = T * shape(R), du = T * (c_[0] + R * (2 * c_[1] + 3 * c_[2] * R)),
                 ddu = T * (2 * c_[1] + 6 * c_[2] * R);
    const double radially = 1 + du, around = 1 + u / R;
    const double log_J = std::log(radially * around);
    const double d_log_J = ddu / radially + (du - u / R) / R / around;
    const double dP = slope_of_stress(k_, radially, ddu, log_J, d_log_J);
    return radial(X, -rate_ * rate_ * u -
                         (dP + (stress(radially, log_J) - stress(around, log_J)) / R) / k_.density);
  }

 private:
  static double radius(Vec3 X) { return std::hypot(X.x, X.y); }
  static Vec3 radial(Vec3 X, double value) {
    const double R = radius(X);
    return {value * X.x / R, value * X.y / R, 0};
  }
  double shape(double R) const { return R * (c_[0] + R * (c_[1] + R * c_[2])); }
  // First Piola-Kirchhoff along a principal direction of stretch f.
  double stress(double f, double log_J) const {
    return k_.lambda * log_J / f + k_.shear * (f - 1 / f);
  }

  ManufacturedConstants k_;
  double A_, rate_, c_[3];
};

// A ring of radii 0.75 and 1.25 whose circles turn by alpha = (A/2)(1 - cos 2 pi t) h(R),
// h = (16 R^2 - 32 R + 15)^2: without traction at both edges, volume kept.
class GeneralizedVortex final : public Manufactured {
 public:
  explicit GeneralizedVortex(const ManufacturedConstants& k)
      : k_(k), A_(k.amplitude != 0 ? k.amplitude : 1) {}

  Vec3 displacement(Vec3 X, double t) const override {
    return turned(X, angle(X, t)) - Vec3{X.x, X.y, 0};
  }
  Vec3 velocity(Vec3 X, double t) const override {
    const double rate = A_ * pi * std::sin(2 * pi * t) * shape(std::hypot(X.x, X.y));
    const Vec3 x = turned(X, angle(X, t));
    return {-rate * x.y, rate * x.x, 0};
  }
  Vec3 body_force(Vec3 X, double t) const override {
    const double R = std::hypot(X.x, X.y), s = R - 1;
    const double h = shape(R), dh = s * (-64 + 1024 * s * s), ddh = -64 + 3072 * s * s;
    const double g = turn(t), dg = A_ * pi * std::sin(2 * pi * t),
                 ddg = 2 * A_ * pi * pi * std::cos(2 * pi * t);
    const double c2 = k_.shear / k_.density;
    const double radially = R * (-(dg * h) * (dg * h) + c2 * (dh * g) * (dh * g));
    const double around = R * ddg * h - c2 * (3 * dh + R * ddh) * g;
    const Vec3 e = turned({X.x / R, X.y / R, 0}, angle(X, t));
    return {radially * e.x - around * e.y, radially * e.y + around * e.x, 0};
  }

 private:
  static double shape(double R) {
    const double s = R - 1, root = 16 * s * s - 1;
    return root * root;
  }
  double turn(double t) const { return 0.5 * A_ * (1 - std::cos(2 * pi * t)); }
  double angle(Vec3 X, double t) const { return turn(t) * shape(std::hypot(X.x, X.y)); }
  static Vec3 turned(Vec3 X, double by) {
    const double c = std::cos(by), s = std::sin(by);
    return {c * X.x - s * X.y, s * X.x + c * X.y, 0};
  }

  ManufacturedConstants k_;
  double A_;
};

}  // namespace

std::unique_ptr<Manufactured> manufactured(const std::string& name,
                                           const ManufacturedConstants& k) {
  if (name == "AxisAligned" || name == "AxisAligned3L") return std::make_unique<AxisAligned>(k);
  if (name == "ExpandingRing") return std::make_unique<ExpandingRing>(k);
  if (name == "GeneralizedVortex") return std::make_unique<GeneralizedVortex>(k);
  throw std::invalid_argument("there is no manufactured solution " + name);
}

}  // namespace sluice::mpm

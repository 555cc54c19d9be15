// trans_iso_hyper and visco_trans_iso_hyper: rubber with one family of fibres (Weiss, Maker and
// Govindjee 1996), such as tendons; the second with six relaxing shares.
//
//   W = K/2 (ln J)^2 + c1 (I1_bar - 3) + c2 (I2_bar - 3) + W_f(l),   l = J^(-1/3) |F a|
//   l W_f' = 0 for l <= 1, c3 (e^(c4 (l - 1)) - 1) to l*, c5 l + c6 beyond,
//   c6 = c3 (e^(c4 (l* - 1)) - 1) - c5 l*
//   sigma = K ln J/J I + (2/J) dev[(c1 + c2 I1_bar) B_bar - c2 B_bar^2] + (l W_f'/J)(a a - I/3)
// With <failure_option>: a matrix whose shear strain (C_1 - C_3)/2 of F^T F passes
// <max_matrix_strain> loses its part, a fibre whose stretch passes <max_fiber_strain> its own.
//
// Relaxing shares (Puso and Weiss 1998) of the deviator S of the second Piola-Kirchhoff stress:
//   H_k(t + dt) = e^(-dt/t_k) H_k(t) + y_k (1 - e^(-dt/t_k))/(dt/t_k) (S(t + dt) - S(t))
//   stress of S + sum H_k
#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/cell_pressure_tag.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/objective_step.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {
namespace {

constexpr int shares = 6;

struct FibreConstants {
  double K, c1, c2, c3, c4, c5, c6, stretch;  // stretch: l*
  std::array<double, 3> direction;
  bool fails;
  double max_stretch, max_shear, density;
  std::array<double, shares> y{}, t{};
  bool relaxes = false;
};

struct Parts {
  Symmetric volume, matrix, fibre;        // Cauchy
  double of_volume, of_matrix, of_fibre;  // energies per reference volume
  double stretch, tangent;                // l and l^2 W_f'' + l W_f'
};

class FibreRubber final : public Material {
 public:
  explicit FibreRubber(const FibreConstants& constants) : c_(constants) {
    history_ = {{history_label("p.stretch"), 1}, {history_label("p.fail"), 1}};
    if (c_.relaxes) {
      history_.push_back({history_label("p.elasticDeviator"), 6});
      history_.push_back({history_label("p.relaxingStress"), 6 * shares});
    }
  }
  std::span<const HistoryColumn> history() const override { return history_; }
  double bulk_modulus() const override { return c_.K; }
  double shear_modulus() const override { return 2 * (c_.c1 + c_.c2); }
  bool stress_of_state() const override { return !c_.relaxes && !c_.fails; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      for (double* column : b.history) column[i] = 0;
      const Matrix F = at(b.F, i);
      const Parts p = parts(F);
      b.history[0][i] = p.stretch;
      Symmetric sigma;
      for (std::size_t k = 0; k < 6; ++k) sigma[k] = p.volume[k] + p.matrix[k] + p.fibre[k];
      for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = sigma[k];
      if (c_.relaxes) {
        const Symmetric S = pulled(F, combined(1, p.matrix, 1, p.fibre));
        for (std::size_t k = 0; k < 6; ++k) b.history[2 + k][i] = S[k];
      }
      b.energy[i] = b.volume_0[i] * (p.of_volume + p.of_matrix + p.of_fibre);
      b.wave_speed[i] = wave_speed(F, p);
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) step(b, i);
    return std::nullopt;
  }

 private:
  // J F^-1 s F^-T
  static Symmetric pulled(const Matrix& F, const Symmetric& s) {
    const double J = determinant(F);
    Symmetric S = pushed(s, inverse(F));
    for (double& x : S) x *= J;
    return S;
  }

  Parts parts(const Matrix& F) const {
    const double J = determinant(F), ln_J = std::log(J), root = inverse_cube_root(J);
    Symmetric B = left_cauchy_green(F);
    for (double& x : B) x *= root * root;
    const Symmetric B2 = symmetric(product(full(B), full(B)));
    const double I1 = trace(B), I2 = 0.5 * (I1 * I1 - trace(B2));
    Parts p;
    const double mean = c_.K * ln_J / J;
    p.volume = {mean, mean, mean, 0, 0, 0};
    p.of_volume = 0.5 * c_.K * ln_J * ln_J;
    p.matrix = deviator(combined(2 / J * (c_.c1 + c_.c2 * I1), B, -2 / J * c_.c2, B2));
    p.of_matrix = c_.c1 * (I1 - 3) + c_.c2 * (I2 - 3);
    const std::array<double, 3>& a0 = c_.direction;
    std::array<double, 3> a;
    for (std::size_t k = 0; k < 3; ++k)
      a[k] = root * (F[3 * k] * a0[0] + F[3 * k + 1] * a0[1] + F[3 * k + 2] * a0[2]);
    const double l = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double pull = of_stretch(l) / J;
    p.fibre = deviator(Symmetric{pull * a[0] * a[0] / (l * l), pull * a[1] * a[1] / (l * l),
                                 pull * a[2] * a[2] / (l * l), pull * a[1] * a[2] / (l * l),
                                 pull * a[0] * a[2] / (l * l), pull * a[0] * a[1] / (l * l)});
    p.of_fibre = stored(l);
    p.stretch = l;
    p.tangent = l <= 1           ? 0
                : l < c_.stretch ? c_.c3 * c_.c4 * l * std::exp(c_.c4 * (l - 1))
                                 : c_.c5 * l;
    return p;
  }
  // l W_f'
  double of_stretch(double l) const {
    if (l <= 1) return 0;
    return l < c_.stretch ? c_.c3 * std::expm1(c_.c4 * (l - 1)) : c_.c5 * l + c_.c6;
  }
  // W_f: of the first form by the exponential integral.
  double stored(double l) const {
    if (l <= 1) return 0;
    const double end = std::min(l, c_.stretch);
    double W = 0;
    if (c_.c3 != 0 && c_.c4 != 0)
      W = c_.c3 *
          (std::exp(-c_.c4) * (std::expint(c_.c4 * end) - std::expint(c_.c4)) - std::log(end));
    if (l > c_.stretch) W += c_.c5 * (l - c_.stretch) + c_.c6 * std::log(l / c_.stretch);
    return W;
  }

  double wave_speed(const Matrix& F, const Parts& p) const {
    const double J = determinant(F), root = inverse_cube_root(J);
    Symmetric b = left_cauchy_green(F);
    for (double& x : b) x *= root * root;
    const double mean = trace(b) / 3, b_max = mean + eigenvalue_reach(b, mean);
    double relaxing = 1;
    for (const double y : c_.y) relaxing += y;
    const double shear = 2 * (c_.c1 + c_.c2 * b_max) * relaxing;
    const double modulus = c_.K * (1 - std::min(std::log(J), 0.9)) +
                           shear * (4.0 / 3 * mean + eigenvalue_reach(b, mean)) +
                           4.0 / 9 * std::max(p.tangent, 0.0) * relaxing;
    return std::sqrt(modulus / c_.density);
  }

  int failed(const Matrix& F, const Parts& p, int before) const {
    if (!c_.fails) return 0;
    int now = before;
    const Principal C = principal(left_cauchy_green(transposed(F)));
    if (0.5 * (C.values[2] - C.values[0]) > c_.max_shear) now |= 1;
    if (p.stretch > c_.max_stretch) now |= 2;
    return now;
  }

  void step(const Batch& b, int i) const {
    const Matrix F_0 = at(b.old_F, i), F = at(b.F, i);
    Parts p = parts(F);
    b.history[0][i] = p.stretch;
    const int fail = failed(F, p, static_cast<int>(b.old_history[1][i]));
    b.history[1][i] = fail;
    const double left[2] = {fail & 1 ? 0.0 : 1.0, fail & 2 ? 0.0 : 1.0};
    Symmetric shape = combined(left[0], p.matrix, left[1], p.fibre);
    b.wave_speed[i] = wave_speed(F, p);
    if (c_.relaxes) shape = relaxed(b, i, F, shape);
    Symmetric sigma = combined(1, p.volume, 1, shape);
    for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = sigma[k];
    if (c_.relaxes) {
      b.energy[i] = b.old_energy[i] + work(b, i, F_0, F, sigma);
    } else if (fail == 0) {
      b.energy[i] = b.volume_0[i] * (p.of_volume + p.of_matrix + p.of_fibre);
    } else {  // what had been stored where it failed is turned into heat
      const Parts old = parts(F_0);
      b.energy[i] = b.old_energy[i] + b.volume_0[i] * (p.of_volume - old.of_volume +
                                                       left[0] * (p.of_matrix - old.of_matrix) +
                                                       left[1] * (p.of_fibre - old.of_fibre));
    }
  }

  Symmetric relaxed(const Batch& b, int i, const Matrix& F, const Symmetric& shape) const {
    const Symmetric S = pulled(F, shape);
    Symmetric sum = S;
    for (std::size_t k = 0; k < 6; ++k) {
      b.history[2 + k][i] = S[k];
      const double more = S[k] - b.old_history[2 + k][i];
      for (int m = 0; m < shares; ++m) {
        const std::size_t at_share = 8 + 6 * m + k;
        const double y = c_.y[m], t = c_.t[m];
        double H = 0;
        if (y != 0 && t > 0) {
          const double x = b.dt / t;
          H = std::exp(-x) * b.old_history[at_share][i] - y * std::expm1(-x) / x * more;
        }
        b.history[at_share][i] = H;
        sum[k] += H;
      }
    }
    Symmetric s = pushed(sum, F);
    const double per_J = 1 / determinant(F);
    for (double& x : s) x *= per_J;
    return deviator(s);
  }
  double work(const Batch& b, int i, const Matrix& F_0, const Matrix& F,
              const Symmetric& sigma) const {
    const ObjectiveStep move = objective_step(at(b.L, i), b.dt);
    const Symmetric old = pushed(at(b.old_stress, i), move.half_turn);
    const Symmetric now = pushed(sigma, transposed(move.half_turn));
    return 0.5 * b.volume_0[i] *
           (determinant(F_0) * double_dot(old, move.strain) +
            determinant(F) * double_dot(now, move.strain));
  }

  FibreConstants c_;
  std::vector<HistoryColumn> history_;
};

Tags fibre_tags() {
  return {positive("bulk_modulus", "K, Pa"),
          tag("c1", "constant c1 of the matrix, Pa").once().real().at_least(0),
          tag("c2", "constant c2 of the matrix, Pa").once().real().at_least(0),
          number("c3", "constant of curled fibres, Pa"),
          number("c4", "exponent of the stress in curled fibres"),
          number("c5", "constant of straight fibres, Pa"),
          positive("fiber_stretch", "stretch l* at which fibres are straight"),
          tag("direction_of_symm", "initial direction of the fibres").once().vector(),
          number("failure_option", "1: matrix and fibres may fail", 0),
          number("max_fiber_strain", "largest stretch of fibres", 1e30),
          number("max_matrix_strain", "largest shear strain of the matrix", 1e30),
          cell_pressure_tag("useModifiedEOS")};
}

std::shared_ptr<const Material> make(const Parameters& p, bool relaxes) {
  FibreConstants c{};
  c.K = p.real("bulk_modulus");
  c.c1 = p.real("c1");
  c.c2 = p.real("c2");
  c.c3 = p.real("c3");
  c.c4 = p.real("c4");
  c.c5 = p.real("c5");
  c.stretch = p.real("fiber_stretch");
  c.c6 = c.c3 * std::expm1(c.c4 * (c.stretch - 1)) - c.c5 * c.stretch;
  if (!std::isfinite(c.c6)) {  // straight fibres never come
    c.c6 = 0;
    c.c5 = 0;
  }
  const Vec3 a = p.vector("direction_of_symm");
  const double size = std::hypot(a[0], a[1], a[2]);
  if (!(size > 0) || c.c1 + c.c2 <= 0) {
    if (!(size > 0)) p.error("direction_of_symm", "the direction of the fibres is a zero vector");
    if (c.c1 + c.c2 <= 0) p.error("c1", "<c1> and <c2> are both 0: the matrix sustains no shear");
    return nullptr;
  }
  c.direction = {a[0] / size, a[1] / size, a[2] / size};
  c.fails = p.real("failure_option") != 0;
  c.max_stretch = p.real("max_fiber_strain");
  c.max_shear = p.real("max_matrix_strain");
  c.density = p.constants().density;
  c.relaxes = relaxes;
  for (std::size_t k = 0; relaxes && k < shares; ++k) {
    c.y[k] = p.real("y" + std::to_string(k + 1));
    c.t[k] = p.real("t" + std::to_string(k + 1));
  }
  return std::make_shared<FibreRubber>(c);
}

}  // namespace

MaterialModel trans_iso_hyper_model() {
  return {"trans_iso_hyper",
          {},
          "rubber with one family of fibres, such as tendons",
          fibre_tags(),
          [](const Parameters& p) { return make(p, false); }};
}
MaterialModel visco_trans_iso_hyper_model() {
  Tags tags = fibre_tags();
  for (int k = 1; k <= shares; ++k) {
    tags.push_back(
        number("y" + std::to_string(k), "relaxing fraction of the stress", 0).at_least(0));
    tags.push_back(number("t" + std::to_string(k),
                          "relaxation time of the fraction y" + std::to_string(k) + ", s; 0: none",
                          0)
                       .at_least(0));
  }
  return {"visco_trans_iso_hyper",
          {},
          "the same with up to six relaxing parts of the stress",
          tags,
          [](const Parameters& p) { return make(p, true); }};
}

}  // namespace sluice::mpm

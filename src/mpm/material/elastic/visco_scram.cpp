// visco_scram: plastic-bonded explosive, five Maxwell elements and penny-shaped cracks that grow
// (Bennett, Haberman, Johnson, Asay and Henson 1998).
//
//   S = sum S_i,   x = (c/a)^3,   G = sum G_i,   X = 3 c^2 c'/a^3 S
//   S_i' = 2 G_i D' - S_i/tau_i - (G_i/G)[X + (2 G D' - sum S_j/tau_j - X) x/(1 + x)]
//   c'   = v (K_I/K_1)^m for K_I < K', v (1 - K_0^2/K_I^2) beyond
//   K_I  = (1.5 pi c)^(1/2) (S:S + [tension] 3 sigma_m^2)^(1/2)
//   K_0  in compression grows by friction: b = -mu sigma_m c^(1/2),
//     mu = c_f (45/(2 (3 - 2 c_f^2)))^(1/2),
//     K_0 [1 + (pi b/K_0)(1 + b/K_0)]^(1/2);   K' = K_0 (1 + 2/m)^(1/2),  K_1 = K' (1 + m/2)^(1/m)
//   v    = exp(.90564746 ln(1.5^(1/2) |D'|) - 2.90178468), times <CrackGrowthRate> in tension, at
//     most <CrackMaxGrowthRate>
//   sigma_m' = K (tr D - 3 alpha T'),   K = 2 G (1 + nu)/(3 (1 - 2 nu))
// Runge-Kutta of fourth order for S_i and c together, in sub-steps of at most half the shortest
// tau_i. The S_i turn with the particle (objective_step.hpp). Heat: -Gamma T tr D, what the Maxwell
// elements turn into it, and Beta of the work of the cracks.
#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/cell_pressure_tag.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/rate_form.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {
namespace {

constexpr std::size_t elements = 5;

struct ScramConstants {
  std::array<double, elements> G{}, rate{};  // G_i, 1/tau_i
  double shear = 0, bulk = 0, density = 0, specific_heat = 0, expansion = 0;
  double a = 0, m = 0, max_growth = 0, K_0 = 0, friction = 0, c_0 = 0, growth = 0;
  double beta = 0, gamma = 0;
  double T_0 = 298, C1 = 6.5, C2 = 120;
  bool shifts = false, objective = true;
};

// Of one particle (T: double) or of eight (T: Eight), with the same bits.
template <class T>
struct ScramState {
  std::array<std::array<T, 6>, elements> S{};
  T c{};
};

class ViscoScram final : public Material {
 public:
  explicit ViscoScram(const ScramConstants& constants)
      : c_(constants), slow_middle_(std::pow(1 + c_.m / 2, 1 / c_.m)) {
    history_ = {{history_label("p.crackRad"), 1},
                {history_label("p.maxwellStress"), 6 * static_cast<int>(elements)}};
    if (c_.expansion != 0) history_.push_back({strain_temperature_label(), 1});
  }
  std::span<const HistoryColumn> history() const override { return history_; }
  double bulk_modulus() const override { return c_.bulk; }
  double shear_modulus() const override { return c_.shear; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      for (double* column : b.history) column[i] = 0;
      for (double* column : b.stress) column[i] = 0;
      b.history[0][i] = c_.c_0;
      if (c_.expansion != 0) b.history[1 + 6 * elements][i] = b.temperature[i];
      b.energy[i] = 0;
      b.wave_speed[i] = wave_speed(determinant(at(b.F, i)));
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for_eights(0, static_cast<std::size_t>(b.count), [&](auto particles) {
      if (step(b, particles)) return;
      for (std::size_t i = particles.i; i < particles.i + 8; ++i) step(b, OneOf{i});
    });
    return std::nullopt;
  }

 private:
  double wave_speed(double J) const {
    return std::sqrt((c_.bulk + 4.0 / 3 * c_.shear) * J / c_.density);
  }

  // What does not change in a step.
  template <class T>
  struct Drive {
    std::array<T, 6> rate;  // D'
    T mean, v, shift;
  };

  template <class T>
  T crack_growth(const Drive<T>& d, const std::array<T, 6>& S, const T& c) const {
    const T none{};
    const T squares = double_dot(S, S) + (d.mean > 0.0 ? 3.0 * d.mean * d.mean : none);
    const T intensity = square_root(1.5 * 3.14159265358979323846 * c * squares);
    const double mu = c_.friction * std::sqrt(45 / (2 * (3 - 2 * c_.friction * c_.friction)));
    const T b = -mu * d.mean * square_root(c) / c_.K_0;
    const T K_0 = c_.K_0 * (d.mean < 0.0 ? square_root(1.0 + 3.14159265358979323846 * b * (1.0 + b))
                                         : none + 1.0);
    const T K_prime = K_0 * std::sqrt(1 + 2 / c_.m);
    const T fast = d.v * (1.0 - K_0 * K_0 / (intensity * intensity));
    const T slow =
        d.v * slow_growth(intensity / (K_prime * slow_middle_), d.v > 0.0, intensity < K_prime);
    return d.v > 0.0 ? (intensity < K_prime ? slow : fast) : none;
  }
  // x^m where cracks grow, and slowly.
  double slow_growth(double x, bool grows, bool slowly) const {
    return grows && slowly ? std::pow(x, c_.m) : 0;
  }
  template <class Marks>
  Eight slow_growth(const Eight& x, const Marks& grow, const Marks& slowly) const {
    Eight y{};
    for (int l = 0; l < 8; ++l)
      if (grow[l] != 0 && slowly[l] != 0) y[l] = std::pow(x[l], c_.m);
    return y;
  }

  template <class T>
  static std::array<T, 6> sum(const ScramState<T>& s) {
    std::array<T, 6> S{};
    for (const std::array<T, 6>& part : s.S)
      for (std::size_t k = 0; k < 6; ++k) S[k] += part[k];
    return S;
  }

  template <class T>
  ScramState<T> slope(const Drive<T>& d, const ScramState<T>& s) const {
    const std::array<T, 6> S = sum(s);
    ScramState<T> r;
    r.c = crack_growth(d, S, s.c);
    const double per_a3 = 1 / (c_.a * c_.a * c_.a);
    const T x = s.c * s.c * s.c * per_a3;
    const T opening = 3.0 * s.c * s.c * r.c * per_a3, share = x / (1.0 + x);
    for (std::size_t k = 0; k < 6; ++k) {
      T relaxed{};
      for (std::size_t n = 0; n < elements; ++n) relaxed += s.S[n][k] * c_.rate[n] * d.shift;
      const T X = opening * S[k];
      const T cracks = X + (2 * c_.shear * d.rate[k] - relaxed - X) * share;
      for (std::size_t n = 0; n < elements; ++n)
        r.S[n][k] = 2 * c_.G[n] * d.rate[k] - s.S[n][k] * c_.rate[n] * d.shift -
                    c_.G[n] / c_.shear * cracks;
    }
    return r;
  }
  template <class T>
  static ScramState<T> moved(const ScramState<T>& s, double h, const ScramState<T>& r) {
    ScramState<T> t = s;
    t.c += h * r.c;
    for (std::size_t n = 0; n < elements; ++n)
      for (std::size_t k = 0; k < 6; ++k) t.S[n][k] += h * r.S[n][k];
    return t;
  }
  template <class T>
  ScramState<T> after(const Drive<T>& d, ScramState<T> s, double h) const {
    const ScramState<T> k1 = slope(d, s), k2 = slope(d, moved(s, 0.5 * h, k1));
    const ScramState<T> k3 = slope(d, moved(s, 0.5 * h, k2)), k4 = slope(d, moved(s, h, k3));
    for (const auto& [weight, k] :
         {std::pair{1.0, &k1}, std::pair{2.0, &k2}, std::pair{2.0, &k3}, std::pair{1.0, &k4}})
      s = moved(s, weight * h / 6, *k);
    return s;
  }

  // Of the time that elements relax in.
  double shift_at(double T) const {
    return std::exp(c_.C1 * (T - c_.T_0) / (c_.C2 + std::max(T - c_.T_0, 1e-3 - c_.C2)));
  }
  // v by |D'|, without the factors.
  static double growth_rate(double size) {
    return size <= 1e-8 ? 0 : std::exp(0.90564746 * std::log(size) - 2.90178468);
  }
  int parts_of(double dt, double shift) const {
    const double fastest = *std::max_element(c_.rate.begin(), c_.rate.end()) * shift;
    return static_cast<int>(std::clamp(std::ceil(2 * dt * fastest), 1.0, 1e5));
  }
  // The parts of a step; 0: eight particles that do not take equally many.
  int common_parts(double dt, double shift) const { return parts_of(dt, shift); }
  int common_parts(double dt, const Eight& shift) const {
    const int parts = parts_of(dt, shift[0]);
    for (int l = 1; l < 8; ++l)
      if (parts_of(dt, shift[l]) != parts) return 0;
    return parts;
  }

  template <class T>
  Drive<T> drive_of(const std::array<T, 6>& strain, const std::array<T, 6>& stress, double dt,
                    const T& shift) const {
    Drive<T> d;
    d.rate = deviator(strain);
    for (T& x : d.rate) x /= dt;
    d.mean = trace(stress) / 3.0;
    d.shift = shift;
    d.v = each(square_root(1.5 * double_dot(d.rate, d.rate)), growth_rate);
    d.v = d.mean > 0.0 ? d.v * c_.growth : d.v;
    const T most = T{} + c_.max_growth;
    d.v = most < d.v ? most : d.v;
    return d;
  }

  // Particles of OneOf or EightOf. False, and nothing is done: eight that take steps of their own.
  template <class P>
  bool step(const Batch& b, const P& p) const {
    using T = typename P::Number;
    const double dt = b.dt;
    const T warmth = p(b.temperature);
    T shift = T{} + 1.0;
    if (c_.shifts) shift = each(warmth, [&](double t) { return shift_at(t); });
    const int parts = common_parts(dt, shift);
    if (parts == 0) return false;
    const ObjectiveStepOf<T> move =
        c_.objective ? objective_step(at(b.L, p), dt) : plain_step(at(b.L, p), dt);
    const std::array<T, 6> old = pushed(at(b.old_stress, p), move.half_turn);
    ScramState<T> s;
    s.c = p(b.old_history[0]);
    for (std::size_t n = 0; n < elements; ++n) {
      for (std::size_t k = 0; k < 6; ++k) s.S[n][k] = p(b.old_history[1 + 6 * n + k]);
      s.S[n] = pushed(s.S[n], move.half_turn);
    }
    const Drive<T> d = drive_of(move.strain, old, dt, shift);
    T viscous{}, of_cracks{};
    for (int k = 0; k < parts; ++k) {
      const ScramState<T> next = after(d, s, dt / parts);
      viscous += 0.5 * dt / parts * (relaxed_power(s, d.shift) + relaxed_power(next, d.shift));
      of_cracks += crack_work(s, next);
      s = next;
    }

    T volume = trace(move.strain);
    const T tr_D = volume / dt;
    if (c_.expansion != 0) {
      volume -= 3 * c_.expansion * (warmth - p(b.old_history[1 + 6 * elements]));
      p.put(warmth, b.history[1 + 6 * elements]);
    }
    std::array<T, 6> now = sum(s);
    for (std::size_t k = 0; k < 3; ++k) now[k] += d.mean + c_.bulk * volume;
    const T J_0 = determinant(at(b.old_F, p)), J = determinant(at(b.F, p));
    p.put(p(b.old_energy) + work_of_step(p(b.volume_0), J_0, old, J, now, move.strain), b.energy);
    p.put(square_root((c_.bulk + 4.0 / 3 * c_.shear) * J / c_.density), b.wave_speed);
    p.put(p(b.heating) + (-c_.gamma * warmth * tr_D + (viscous + c_.beta * of_cracks) * J /
                                                          (c_.density * c_.specific_heat * dt)),
          b.heating);
    now = pushed(now, move.half_turn);
    for (std::size_t k = 0; k < 6; ++k) p.put(now[k], b.stress[k]);
    p.put(s.c, b.history[0]);
    for (std::size_t n = 0; n < elements; ++n) {
      const std::array<T, 6> turned = pushed(s.S[n], move.half_turn);
      for (std::size_t k = 0; k < 6; ++k) p.put(turned[k], b.history[1 + 6 * n + k]);
    }
    return true;
  }
  // sum S_i : S_i/(2 G_i tau_i)
  template <class T>
  T relaxed_power(const ScramState<T>& s, const T& shift) const {
    T power{};
    for (std::size_t n = 0; n < elements; ++n)
      if (c_.G[n] > 0) power += double_dot(s.S[n], s.S[n]) * c_.rate[n] * shift / (2 * c_.G[n]);
    return power;
  }
  // S : d(x S)/(2 G)
  template <class T>
  T crack_work(const ScramState<T>& s, const ScramState<T>& next) const {
    const std::array<T, 6> S = sum(s), N = sum(next);
    const auto cube = [](double ratio) { return std::pow(ratio, 3); };
    const T x = each(s.c / c_.a, cube), y = each(next.c / c_.a, cube);
    return double_dot(combined(0.5, S, 0.5, N), combined(y, N, -x, S)) / (2 * c_.shear);
  }

  ScramConstants c_;
  double slow_middle_;  // K_1/K'
  std::vector<HistoryColumn> history_;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  ScramConstants c;
  for (std::size_t n = 0; n < elements; ++n) {
    c.G[n] = p.real("G" + std::to_string(n + 1));
    c.rate[n] = p.real("RTau" + std::to_string(n + 1));
    c.shear += c.G[n];
  }
  const double nu = p.real("PR");
  if (!(nu < 0.5) || !(c.shear > 0)) {
    if (!(nu < 0.5)) p.error("PR", "<PR> must be below 1/2: the bulk modulus would be infinite");
    if (!(c.shear > 0)) p.error("G1", "the sum of <G1> to <G5> must be greater than 0");
    return nullptr;
  }
  if (p.flag("randomize_parameters")) {
    p.error("randomize_parameters",
            "<randomize_parameters> is known to the format, but not supported yet");
    return nullptr;
  }
  c.bulk = 2 * c.shear * (1 + nu) / (3 * (1 - 2 * nu));
  c.density = p.constants().density;
  c.specific_heat = p.constants().specific_heat;
  c.expansion = p.real("CoeffThermalExpansion");
  c.a = p.real("CrackParameterA");
  c.m = p.real("CrackPowerValue");
  c.max_growth = p.real("CrackMaxGrowthRate");
  c.K_0 = p.real("StressIntensityF");
  c.friction = p.real("CrackFriction");
  c.c_0 = p.real("InitialCrackRadius");
  c.growth = p.real("CrackGrowthRate");
  c.beta = p.real("Beta");
  c.gamma = p.real("Gamma");
  c.T_0 = p.real("T0");
  c.C1 = p.real("C1");
  c.C2 = p.real("C2");
  c.shifts = p.flag("use_time_temperature_equation");
  c.objective = p.flag("objective");
  return std::make_shared<ViscoScram>(c);
}

}  // namespace

MaterialModel visco_scram_model() {
  Tags tags = {
      tag("PR", "Poisson's ratio, below 1/2").once().real().above(-1),
      number("CoeffThermalExpansion", "coefficient of linear thermal expansion, 1/K", 0),
      positive("CrackParameterA", "a, radius where cracks have halved the stiffness, m"),
      positive("CrackPowerValue", "m, exponent of slow growth"),
      tag("CrackMaxGrowthRate", "m/s").once().real().at_least(0),
      positive("StressIntensityF", "K_0, Pa m^(1/2)"),
      tag("CrackFriction", "c_f").once().real().at_least(0).at_most(1.2),
      tag("InitialCrackRadius", "m").once().real().at_least(0),
      tag("CrackGrowthRate", "coefficient of crack growth in tension").once().real().at_least(0),
      number("Beta", "fraction of the cracks' work that becomes heat", 0),
      number("Gamma", "Grueneisen coefficient", 0),
      number("T0", "reference temperature of the relaxation times, K", 298),
      number("C1", "constant C1 of the shift of the relaxation times with temperature", 6.5),
      number("C2", "constant C2 of the shift of the relaxation times with temperature, K", 120),
      choice("use_time_temperature_equation", "whether temperature shifts the relaxation times",
             false),
      choice("randomize_parameters", "must be false", false),
      choice("useObjectiveRate", "accepted without effect: determined by <objective>", true),
      objective_tag()};
  for (int n = 1; n <= 5; ++n) {
    tags.push_back(tag("G" + std::to_string(n), "shear modulus of a Maxwell element, Pa")
                       .once()
                       .real()
                       .at_least(0));
    tags.push_back(tag("RTau" + std::to_string(n), "1 over its relaxation time, 1/s")
                       .once()
                       .real()
                       .at_least(0));
  }
  for (const char* name :
       {"DCp_DTemperature", "Chi", "delH", "Z", "EoverR", "dynamic_coeff_friction", "A", "B", "C",
        "Cv", "R1", "R2", "om", "rho0", "P0", "bulkPrime", "gamma"})
    tags.push_back(number(
        name, "accepted without effect: parameter of hot spots or of an equation of state", 0));
  tags.push_back(tag("volfracHE", "accepted without effect").text());
  for (const char* name :
       {"useModifiedEOS", "useJWLEOS", "useJWLCEOS", "useMurnaghanEOS", "useBirchMurnaghanEOS"})
    tags.push_back(cell_pressure_tag(name));
  return {"visco_scram",
          {},
          "plastic-bonded explosive: Maxwell elements and penny-shaped cracks",
          tags,
          make};
}

}  // namespace sluice::mpm

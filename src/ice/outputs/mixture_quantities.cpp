// Labels of each material, from the primitives of the mixture.
#include "ice/outputs/mixture_quantities.hpp"

#include <algorithm>
#include <cmath>

#include "ice/closure/traces.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/sources/sources.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/transport/subgrid_stress.hpp"

namespace sluice::ice::mixture {
namespace {

class Declarer {
 public:
  explicit Declarer(QuantityList& q)
      : q_(q),
        o_(q.options()),
        mixture_(mixture_options(o_)),
        v_(declare_variables(q.list(), mixture_)) {
    if (mixture_.materials.multi_velocity) declare_relative_velocities(q.list(), mixture_, v_);
    add_primitives(q.list(), PrimitivesInput::of(v_), mixture_, effect_diagnostics, true);
    if (o_.own_viscosity_varies())
      add_own_viscosities(q.list(), OwnViscosityInput::of(v_), mixture_, effect_diagnostics);
    if (o_.transport.models.turbulence) declare_eddies();
    if (!o_.materials.multi_velocity) velocity_ = q.velocity(v_.common.rho, v_.common.momentum);
    const SchemeVariables& c = v_.common;
    for (int m = 0; m < static_cast<int>(o_.materials.fluids.size()); ++m) {
      q.add(labels().sum_rho, m, c.rho);
      q.add(labels().pressure, m, c.pressure);
      const VariableId u = velocity_of(m);
      declare_material(m);
      q.slopes(c.pressure, labels().gradient_pressure, m);
      q.slopes(u, labels().divergence_velocity, m, true);
      q.vorticity(u, m);
      q.mach(u, c.sound, m);
    }
    declare_compressibility();
    declare_front();
  }

 private:
  static SchemeOptions mixture_options(const SchemeOptions& o) {
    SchemeOptions mixture = o;
    mixture.materials.mixture = true;
    mixture.transport.viscosity_varies = o.transport.viscous;
    return mixture;
  }
  // Of the common motion, for every material alike.
  void declare_eddies() {
    const SchemeVariables& c = v_.common;
    const StateVariables state{c.rho, c.energy, c.velocity};
    add_eddy_viscosity({q_.list(), mixture_, effect_diagnostics, "eddies of the mixture: "}, state,
                       c.eddy_viscosity);
    const SubgridStress stress{q_.fresh(labels().subgrid_normal, 0),
                               q_.fresh(labels().subgrid_shear, 0)};
    add_subgrid_stress({q_.list(), mixture_, effect_diagnostics, "compute the subgrid stress"},
                       state, c.eddy_viscosity, stress);
    for (int m = 1; m < static_cast<int>(o_.materials.fluids.size()); ++m) {
      q_.add(labels().subgrid_normal, m, stress.normal);
      q_.add(labels().subgrid_shear, m, stress.shear);
    }
  }
  // By level direction; that of the mixture where the material is absent.
  VariableId velocity_of(int m) {
    if (!o_.materials.multi_velocity) {
      if (m > 0) q_.add(labels().velocity, m, velocity_);
      return velocity_;
    }
    const VariableId to = q_.fresh(labels().velocity, m);
    TaskBuilder t = q_.task(labels().velocity, m);
    const In rho = t.read(v_.common.rho), momentum = t.read(v_.common.momentum);
    const In mass = t.read(v_.mass[m]), slip = t.read(v_.slip.slip[m]);
    const Out out = t.write(to);
    t.kernel([=, components = o_.grid.components, direction = o_.grid.direction](const Row& row) {
      const int n = row.count();
      const double *r = row(rho), *M = row(mass);
      for (int d = 0; d < 3; ++d) std::fill(row(out, d), row(out, d) + n, 0.0);
      for (int c = 0; c < components; ++c) {
        const double *P = row(momentum, c), *S = row(slip, c);
        double* u = row(out, direction[c]);
        for (int i = 0; i < n; ++i) u[i] = P[i] / r[i] + (M[i] > 0.0 ? S[i] / M[i] : 0.0);
      }
    });
    return to;
  }
  // One component of a variable, under a name of its own.
  VariableId single(VariableId from, int c, Label label, int m) {
    const VariableId to = q_.fresh(label, m);
    TaskBuilder t = q_.task(label, m);
    const In in = t.read(from);
    const Out out = t.write(to);
    t.kernel([=](const Row& row) {
      const double* q = row(in, c);
      double* copy = row(out);
      for (int i = 0; i < row.count(); ++i) copy[i] = q[i];
    });
    return to;
  }
  // f(density, energy per volume) of the material itself, 0 where it is absent.
  template <class F>
  VariableId closure(Label label, int m, F f) {
    return law_closure(label, m, [f](const Fluid&, double r, double e) { return f(r, e); });
  }
  // f(law, density, energy per volume), the law being that of the cell.
  template <class F>
  VariableId law_closure(Label label, int m, F f) {
    const VariableId to = q_.fresh(label, m);
    TaskBuilder t = q_.task(label, m);
    const In density = t.read(v_.density), energy = t.read(v_.specific_energy);
    const LawsOfCells laws(t, q_.list(), mixture_);
    const Out out = t.write(to);
    t.kernel([=](const Row& row) {
      const double *r = row(density, m), *e = row(energy, m);
      double* value = row(out);
      Fluid room;
      for (int i = 0; i < row.count(); ++i)
        value[i] = r[i] > 0.0 ? f(laws.at(row, m, i, room), r[i], e[i]) : 0.0;
    });
    return to;
  }
  // A trace is as warm as the heaviest material.
  VariableId temperature(int m) {
    const VariableId to = q_.fresh(labels().temperature, m);
    TaskBuilder t = q_.task(labels().temperature, m);
    const In density = t.read(v_.density), energy = t.read(v_.specific_energy);
    const In total = t.read(v_.common.rho);
    std::vector<In> mass;
    for (const VariableId id : v_.mass) mass.push_back(t.read(id));
    const LawsOfCells laws(t, q_.list(), mixture_);
    const Out out = t.write(to);
    t.kernel([=](const Row& row) {
      Fluid room;
      const auto own = [&](int k, int i) {
        return laws.at(row, k, i, room).temperature(row(density, k)[i], row(energy, k)[i]);
      };
      const double *M = row(mass[m]), *rho = row(total);
      double* T = row(out);
      for (int i = 0; i < row.count(); ++i) {
        if (M[i] == 0.0 || has_temperature(M[i], rho[i])) {
          T[i] = M[i] == 0.0 ? 0.0 : own(m, i);
          continue;
        }
        std::size_t heaviest = 0;
        for (std::size_t k = 1; k < mass.size(); ++k)
          if (row(mass[k])[i] > row(mass[heaviest])[i]) heaviest = k;
        T[i] = own(static_cast<int>(heaviest), i);
      }
    });
    return to;
  }

  // Molecular and subgrid viscosity of a material and their sum, 0 where it is absent.
  void declare_viscosities(int m) {
    const Labels& l = labels();
    const double constant = o_.transport.viscosities[m];
    const VariableId molecular =
        o_.own_viscosity_varies()
            ? single(v_.own_viscosity, m, l.viscosity, m)
            : closure(l.viscosity, m, [=](double, double) { return constant; });
    const VariableId eddy = eddy_viscosity(m);
    const VariableId total = q_.fresh(l.total_viscosity, m);
    TaskBuilder t = q_.task(l.total_viscosity, m);
    const In a = t.read(molecular), b = t.read(eddy);
    const Out out = t.write(total);
    t.kernel([=](const Row& row) {
      const double *mu = row(a), *mu_t = row(b);
      double* sum = row(out);
      for (int i = 0; i < row.count(); ++i) sum[i] = mu[i] + mu_t[i];
    });
  }
  // rho_m C Delta^2 |S|.
  VariableId eddy_viscosity(int m) {
    if (!o_.transport.models.turbulence)
      return closure(labels().eddy_viscosity, m, [](double, double) { return 0.0; });
    const VariableId to = q_.fresh(labels().eddy_viscosity, m);
    TaskBuilder t = q_.task(labels().eddy_viscosity, m);
    const In density = t.read(v_.density), all = t.read(v_.common.rho);
    const In eddy = t.read(v_.common.eddy_viscosity);
    const Out out = t.write(to);
    t.kernel([=](const Row& row) {
      const double *r = row(density, m), *rho = row(all), *mu_t = row(eddy);
      double* own = row(out);
      for (int i = 0; i < row.count(); ++i) own[i] = mu_t[i] * (r[i] / rho[i]);
    });
    return to;
  }

  // Of the molecules, 0 where the material is absent.
  void declare_conductivity(int m) {
    const VariableId to = q_.fresh(labels().thermal_conductivity, m);
    TaskBuilder t = q_.task(labels().thermal_conductivity, m);
    const In density = t.read(v_.density);
    const LawsOfCells laws(t, q_.list(), mixture_);
    const Out out = t.write(to);
    t.kernel([=, given = o_.transport.conductivities[m]](const Row& row) {
      const double* r = row(density, m);
      const LawRow law = laws.of(row, m);
      double* value = row(out);
      for (int i = 0; i < row.count(); ++i)
        value[i] = r[i] > 0.0 ? law.conductivity(i, given) : 0.0;
    });
  }

  void declare_material(int m) {
    const Labels& l = labels();
    q_.add(l.rho, m, v_.mass[m]);
    q_.add(l.volume_fraction, m, v_.volume[m]);
    single(v_.density, m, l.rho_micro, m);
    closure(l.specific_volume, m, [](double r, double) { return 1.0 / r; });
    const VariableId T = temperature(m);
    law_closure(l.sound_speed, m, [](const Fluid& law, double r, double e) {
      return std::sqrt(law.modulus_of_state(r, e) / r);
    });
    compressibility_.push_back(law_closure(
        l.compressibility, m,
        [](const Fluid& law, double r, double e) { return 1.0 / law.modulus_of_state(r, e); }));
    declare_viscosities(m);
    declare_conductivity(m);
    law_closure(l.gamma, m,
                [](const Fluid& law, double r, double e) { return law.heat_capacity_ratio(r, e); });
    law_closure(l.specific_heat, m,
                [](const Fluid& law, double r, double e) { return law.heat_capacity(r, e); });
    q_.slopes(v_.mass[m], l.gradient_rho, m);
    q_.slopes(T, l.gradient_temperature, m);
    q_.slopes(v_.volume[m], l.gradient_volume_fraction, m);
  }

  // Of F behind a prescribed front.
  void declare_front() {
    const auto front = o_.forces.sources == nullptr ? std::nullopt : o_.forces.sources->front();
    if (!front) return;
    const VariableId share = q_.list().temporary("burned share of a front");
    TaskBuilder t = q_.list().task("burned share of a front", effect_diagnostics);
    const In from = t.read(v_.mass[front->first]), to = t.read(v_.mass[front->second]);
    const Out out = t.write(share);
    t.kernel([=](const Row& row) {
      const double *reactant = row(from), *product = row(to);
      double* F = row(out);
      for (int i = 0; i < row.count(); ++i) F[i] = models::JwlPp::share(reactant[i], product[i]);
    });
    q_.slopes(share, models::front_gradient_label(), front->second);
  }

  // sum V_m/K_m, and the share of each in it.
  void declare_compressibility() {
    const VariableId sum = q_.fresh(labels().compressibility_of_cell, 0);
    TaskBuilder t = q_.task(labels().compressibility_of_cell, 0);
    std::vector<In> volume, own;
    for (const VariableId id : v_.volume) volume.push_back(t.read(id));
    for (const VariableId id : compressibility_) own.push_back(t.read(id));
    const Out out = t.write(sum);
    t.kernel([=](const Row& row) {
      double* to = row(out);
      std::fill_n(to, row.count(), 0.0);
      for (std::size_t m = 0; m < own.size(); ++m) {
        const double *V = row(volume[m]), *k = row(own[m]);
        for (int i = 0; i < row.count(); ++i) to[i] += V[i] * k[i];
      }
    });
    for (int m = 0; m < static_cast<int>(o_.materials.fluids.size()); ++m) declare_share(sum, m);
  }
  void declare_share(VariableId of_all, int m) {
    const VariableId share = q_.fresh(labels().compressibility_share, m);
    TaskBuilder t = q_.task(labels().compressibility_share, m);
    const In volume = t.read(v_.volume[m]), own = t.read(compressibility_[m]), all = t.read(of_all);
    const Out out = t.write(share);
    t.kernel([=](const Row& row) {
      const double *V = row(volume), *each = row(own), *sum = row(all);
      double* to = row(out);
      for (int i = 0; i < row.count(); ++i) to[i] = V[i] * each[i] / sum[i];
    });
  }

  QuantityList& q_;
  const SchemeOptions& o_;
  const SchemeOptions mixture_;
  Variables v_;
  VariableId velocity_;
  std::vector<VariableId> compressibility_;
};

}  // namespace

void declare_quantities(QuantityList& quantities) {
  Declarer{quantities};
}

}  // namespace sluice::ice::mixture

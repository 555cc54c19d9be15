// Sources on rows of cells; sources.hpp has the formulas.
#include "ice/sources/sources.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::ice {
namespace {

// threshold: volume fraction that a source gives to a cell without the material, or leaves of
//   one, at least; unit: 1; test: none
constexpr double min_moved_volume = 1e-16;

double* change_row(const SourceRows& r, int component) {
  return (*r.row)(r.change, component);
}

double density_at(const SourceRows& r, int i) {
  double rho = 0;
  for (int m = 0; m < r.layout.materials; ++m) rho += r.mass[m][i];
  return rho;
}

// Velocity of a material relative to the mixture.
double drift(const SourceRows& r, std::size_t m, int c, int i) {
  if (!r.multi_velocity() || r.mass[m][i] == 0.0) return 0.0;
  return r.slip[m][c][i] / r.mass[m][i];
}

// Material k comes to have mass M and velocity v, the others (of mass `others` together) keep
// theirs: momentum and slips of component c. `mean`: the velocity of the mixture before.
void move_apart(const SourceRows& r, std::size_t k, int c, int i, double mean, double others,
                double M, double v) {
  double& own = r.slip[k][c][i];
  const double momentum = others > 0 ? (others * mean - own) + M * v : M * v;
  const double now = momentum / (others + M);
  for (std::size_t m = 0; m < static_cast<std::size_t>(r.layout.materials); ++m)
    if (m != k && r.mass[m][i] != 0.0) r.slip[m][c][i] += r.mass[m][i] * (mean - now);
  own = others > 0 ? M * (v - now) : 0.0;
  r.momentum[c][i] = momentum;
}

}  // namespace

Sources::Sources(const models::ModelList& models, const std::vector<models::AddedHeat>& heat,
                 const std::vector<Fluid>& fluids, const Level& level,
                 const std::array<int, 3>& direction)
    : anchor_(level.anchor), spacing_(level.spacing) {
  double volume = 1;
  int count = 0;
  for (int d = 2; d >= 0; --d)
    if (level.active[d]) {
      volume *= level.spacing[d];
      along_ = d;
      ++count;
    }
  edge_ = std::pow(volume, 1.0 / std::max(count, 1));
  for (const models::MassExchange& x : models.mass_exchanges)
    if (x.by_front || (x.by_pressure ? x.by_pressure->G > 0 : x.rate > 0)) {
      exchanges_.push_back(x);
      if (x.by_pressure) fluids_ = fluids;
    }
  for (const models::AddedHeat& h : heat)
    if (h.power != 0) heat_.push_back(h);
  for (const models::FixedValues& f : models.fixed_values) {
    const Fluid& fluid = fluids[f.material];
    Fixed fixed{f.material, f.density, fluid.energy_from_temperature(f.density, f.temperature),
                {},         f.when,    CellRuns(*f.region, level)};
    for (std::size_t c = 0; c < 3; ++c) fixed.velocity[c] = f.velocity[direction[c]];
    fixed_.push_back(std::move(fixed));
  }
}

bool Sources::takes_from(int material) const {
  return std::any_of(exchanges_.begin(), exchanges_.end(),
                     [&](const models::MassExchange& x) { return x.from == material; });
}

bool Sources::takes_from(int material, const StepConstants& step) const {
  return std::any_of(exchanges_.begin(), exchanges_.end(), [&](const models::MassExchange& x) {
    return x.from == material && (x.by_pressure || x.by_front || x.share(step.time, step.dt) > 0);
  });
}

std::optional<std::pair<int, int>> Sources::front() const {
  for (const models::MassExchange& x : exchanges_)
    if (x.by_front) return std::pair{x.from, x.to};
  return std::nullopt;
}

void Sources::apply(const SourceRows& r) const {
  const StepConstants& step = r.row->step();
  const int n = r.row->count();
  for (int c = 0; c < r.layout.count(); ++c) std::fill_n(change_row(r, c), n, 0.0);
  // With one material in the graph there is nothing to exchange.
  for (const models::MassExchange& x : exchanges_) {
    const bool burns = x.by_pressure || x.by_front;
    const double share = burns ? 0.0 : x.share(step.time, step.dt);
    if (r.layout.materials > 1 && share > 0) exchange(r, x, share);
    if (!burns) continue;
    if (r.layout.materials > 1) x.by_pressure ? burn_by_pressure(r, x) : burn_by_front(r, x);
    tell_shares(r, x);
  }
  const auto here = [&](int material) {
    return material >= r.first_material && material < r.first_material + r.layout.materials;
  };
  for (const models::AddedHeat& h : heat_)
    if (const double q = h.energy(step.time, step.dt); q != 0 && here(h.material))
      heat(r, h.material - r.first_material, q);
  for (const Fixed& f : fixed_) {
    if (!here(f.material) || !(f.when.overlap(step.time, step.dt) > 0)) continue;
    const int low = r.row->cell()[f.region.along()];
    for (const CellRuns::Run& run : f.region.runs(r.row->cell()))
      fix(r, f, std::max(run.first - low, 0), std::min(run.end - low, n));
  }
}

// What passes is what the rest differs by: nothing is lost to rounding on the way.
Sources::Passed Sources::pass(const SourceRows& r, int giver, int taker, int i,
                              double share) const {
  const std::size_t from = giver, to = taker;
  using C = SourceChange;
  const double rho = density_at(r, i), V = r.volume[from][i], receiver = r.mass[to][i];
  if (r.mass[from][i] == 0.0) return {};
  const double stays = V * (1.0 - share) < min_moved_volume ? 0.0 : 1.0 - share;
  if (stays > 0 && receiver == 0.0 && V * share < min_moved_volume) return {};
  double velocity[3] = {}, apart = 0;  // of the giver; |u_from - u_to|^2
  for (int c = 0; c < r.layout.components; ++c) {
    const double w = drift(r, from, c, i), between = w - drift(r, to, c, i);
    velocity[c] = r.momentum[c][i] / rho + w;
    apart += between * between;
  }
  const auto move = [&](double& own, double& others, C::OfMaterial q) {
    const double rest = stays * own, amount = own - rest;
    own = rest;
    others += amount;
    change_row(r, r.layout.of(giver, q))[i] -= amount;
    change_row(r, r.layout.of(taker, q))[i] += amount;
    return amount;
  };
  const double mass = move(r.mass[from][i], r.mass[to][i], C::mass);
  move(r.volume[from][i], r.volume[to][i], C::volume);
  const double energy = move(r.energy[from][i], r.energy[to][i], C::energy);
  for (int c = 0; c < r.layout.components; ++c) {
    const double carried = mass * velocity[c];
    change_row(r, r.layout.of(giver, C::momentum) + c)[i] -= carried;
    change_row(r, r.layout.of(taker, C::momentum) + c)[i] += carried;
  }
  if (!r.multi_velocity()) return {mass, energy};
  r.energy[to][i] += 0.5 * apart * (mass * receiver / (mass + receiver));
  for (std::size_t c = 0; c < static_cast<std::size_t>(r.layout.components); ++c) {
    double &own = r.slip[from][c][i], &others = r.slip[to][c][i];
    const double rest = stays * own;
    others = r.mass[to][i] == rho ? 0.0 : others + (own - rest);
    own = rest;
  }
  return {mass, energy};
}

void Sources::exchange(const SourceRows& r, const models::MassExchange& x, double share) const {
  double* const mass = change_row(r, r.layout.of(SourceChange::exchanged_mass));
  double* const energy = change_row(r, r.layout.of(SourceChange::exchanged_energy));
  for (int i = 0; i < r.row->count(); ++i) {
    const Passed passed = pass(r, x.from, x.to, i, share);
    mass[i] += passed.mass;
    energy[i] += passed.energy;
  }
}

// Mean over the volumes of the materials, which one pressure has not met yet.
double Sources::pressure(const SourceRows& r, int i) const {
  double sum = 0, volume = 0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(r.layout.materials); ++m) {
    const double V = r.volume[m][i];
    if (r.mass[m][i] == 0.0 || !(V > 0)) continue;
    sum += V * fluids_[m].pressure(r.mass[m][i] / V, r.energy[m][i] / V);
    volume += V;
  }
  return volume > 0 ? sum / volume : 0.0;
}

template <class Burned>
void Sources::burn(const SourceRows& r, const models::MassExchange& x, double heat,
                   Burned&& burned) const {
  using C = SourceChange;
  const std::size_t from = x.from, to = x.to;
  const auto row_of = [&](C::OfCell q) { return change_row(r, r.layout.of(q)); };
  for (int i = 0; i < r.row->count(); ++i) {
    const double M = r.mass[from][i], product = r.mass[to][i];
    if (M == 0.0) continue;
    const double most = burned(i);
    if (!(most > 0)) continue;
    const Passed passed = pass(r, x.from, x.to, i, std::min(most / M, 1.0));
    const double released = heat * passed.mass;
    r.energy[to][i] += released;
    change_row(r, r.layout.of(x.to, C::energy))[i] += released;
    row_of(C::total_energy)[i] += released;
    row_of(C::burned_mass)[i] += passed.mass;
    row_of(C::released_heat)[i] += released;
    row_of(C::burned_in_step)[i] += passed.mass / (M + product);
  }
}

void Sources::burn_by_pressure(const SourceRows& r, const models::MassExchange& x) const {
  const models::JwlPp& law = *x.by_pressure;
  const std::size_t from = x.from, to = x.to;
  const double dt = r.row->step().dt;
  burn(r, x, law.heat, [&](int i) {
    if (!(r.volume[from][i] > law.min_volume_fraction)) return 0.0;
    const double p = pressure(r, i);
    if (!law.burns(p, r.volume[from][i])) return 0.0;
    return law.burned(dt, p, r.mass[from][i], r.mass[to][i]);
  });
}

void Sources::burn_by_front(const SourceRows& r, const models::MassExchange& x) const {
  const models::LightTime& law = *x.by_front;
  const std::size_t from = x.from, to = x.to;
  const double end = r.row->step().time + r.row->step().dt;
  burn(r, x, law.heat, [&](int i) {
    if (!law.in_mixed_cells && !(r.volume[from][i] + r.volume[to][i] > law.full)) return 0.0;
    IntVec3 cell = r.row->cell();
    cell[along_] += i;
    Vec3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = anchor_[d] + (cell[d] + 0.5) * spacing_[d];
    const double M = r.mass[from][i], all = M + r.mass[to][i];
    return std::min(law.share(centre, end, edge_) * all - r.mass[to][i], M);
  });
}

void Sources::tell_shares(const SourceRows& r, const models::MassExchange& x) const {
  double* share = change_row(r, r.layout.of(SourceChange::burned_share));
  const auto mass_of = [&](int material, int i) {
    const int m = material - r.first_material;
    return m >= 0 && m < r.layout.materials ? r.mass[m][i] : 0.0;
  };
  for (int i = 0; i < r.row->count(); ++i)
    share[i] = models::JwlPp::share(mass_of(x.from, i), mass_of(x.to, i));
}

void Sources::heat(const SourceRows& r, int m, double q) const {
  const double* M = r.mass[m];
  double* E = r.energy[m];
  double* total = change_row(r, r.layout.of(SourceChange::total_energy));
  double* heat = change_row(r, r.layout.of(SourceChange::heat));
  for (int i = 0; i < r.row->count(); ++i) {
    const double gain = q * M[i];
    E[i] += gain;
    total[i] += gain;
    heat[i] += gain;
  }
}

void Sources::fix(const SourceRows& r, const Fixed& f, int first, int end) const {
  using C = SourceChange;
  const int m = f.material - r.first_material, materials = r.layout.materials;
  const auto row_of = [&](int component) { return change_row(r, component); };
  for (int i = first; i < end; ++i) {
    const double V = r.volume[m] != nullptr ? r.volume[m][i] : 1.0;
    if (!(V > models::FixedValues::min_volume_fraction) || r.mass[m][i] == 0.0) continue;
    const double rho = density_at(r, i), M0 = r.mass[m][i], M1 = V * f.density;
    const double E0 = r.energy[m][i], E1 = V * f.energy;
    double others = 0;
    for (int n = 0; n < materials; ++n)
      if (n != m) others += r.mass[n][i];
    double gain = 0, slip = 0;  // of kinetic energy; |u - u_f|^2
    for (int c = 0; c < r.layout.components; ++c) {
      const double mean = r.momentum[c][i] / rho, v = f.velocity[c];
      const double u = mean + drift(r, m, c, i);
      row_of(r.layout.of(m, C::momentum) + c)[i] += M1 * v - M0 * u;
      gain += 0.5 * (M1 * v * v - M0 * u * u);
      slip += (u - v) * (u - v);
      if (r.multi_velocity())
        move_apart(r, m, c, i, mean, others, M1, v);
      else
        r.momentum[c][i] = others > 0 ? others * u + M1 * v : M1 * v;
    }
    r.mass[m][i] = M1;
    r.energy[m][i] = E1;
    row_of(r.layout.of(m, C::mass))[i] += M1 - M0;
    row_of(r.layout.of(m, C::energy))[i] += E1 - E0;
    row_of(r.layout.of(C::total_energy))[i] += (E1 - E0) + gain;
    if (!(others > 0) || r.multi_velocity()) continue;
    const double lost = 0.5 * slip * others * M1 / ((others + M1) * (others + M1));  // per mass
    for (int n = 0; n < materials; ++n) {
      r.energy[n][i] += lost * r.mass[n][i];
    }
  }
}

}  // namespace sluice::ice

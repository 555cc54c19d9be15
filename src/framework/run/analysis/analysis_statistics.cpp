// What a module keeps of every cell, and what is computed of it.
#include "framework/run/analysis/analysis_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/archive.hpp"
#include "framework/deck/faults.hpp"
#include "framework/run/analysis/analysis_history.hpp"

namespace sluice {
namespace {

std::string unit_power(const std::string& unit, int power) {
  if (unit == "1" || power == 1) return unit;
  return fmt::format("({})^{}", unit, power);
}

constexpr const char* moment_names[] = {"sum_", "mean_", "variance_", "skewness_", "kurtosis_"};
constexpr const char* stress_name = "uv_vw_wu_prime";
constexpr const char* covariance_name = "covariance_";

int highest_moment(const AnalysisModule& module) {
  return module.higher_order ? 4 : 2;
}

// The velocity whose covariances with all scalars the module gives: its place; past the end: none.
std::size_t velocity_of(const AnalysisModule& module) {
  std::size_t velocity = module.variables.size();
  for (std::size_t n = 0; n < module.variables.size(); ++n)
    if (module.variables[n].fluid_velocity && module.name == "turbulentFluxes") velocity = n;
  return velocity;
}

// Central moment of order 2 to 4 of n samples from the sums of d, d^2, ...
double central_moment(int order, double n, const double* s) {
  const double m = s[0] / n, second = s[1] / n - m * m;
  if (order == 2) return second;
  const double third = s[2] / n - 3 * m * (s[1] / n) + 2 * m * m * m;
  if (order == 3) return third;
  return s[3] / n - 4 * m * (s[2] / n) + 6 * m * m * (s[1] / n) - 3 * m * m * m * m;
}

}  // namespace

bool keeps_statistics(const AnalysisModule& m) {
  return m.name == "statistics" || m.name == "turbulentFluxes";
}

std::vector<std::pair<std::string, ValueType>> fields_of_statistics(const AnalysisModule& module,
                                                                    const TypeOfVariable& type_of) {
  std::vector<std::pair<std::string, ValueType>> fields;
  const std::size_t velocity = velocity_of(module);
  for (std::size_t n = 0; n < module.variables.size(); ++n) {
    const AnalysedVariable& v = module.variables[n];
    const bool vector = type_of(v) == ValueType::vector;
    for (int moment = 0; moment <= highest_moment(module); ++moment)
      fields.emplace_back(moment_names[moment] + v.label,
                          vector ? ValueType::vector : ValueType::real);
    if (v.reynolds_stress || n == velocity) fields.emplace_back(stress_name, ValueType::vector);
    if (velocity < module.variables.size() && n != velocity && !vector)
      fields.emplace_back(covariance_name + v.label, ValueType::vector);
  }
  return fields;
}

Statistics::Statistics(const AnalysisModule& module, const FindQuantity& find, Hierarchy& hierarchy,
                       int rank)
    : module_(&module), hierarchy_(&hierarchy), rank_(rank) {
  const int powers = highest_moment(module);
  std::vector<std::vector<std::size_t>> of_variable;
  for (const AnalysedVariable& v : module.variables)
    of_variable.push_back(add_quantity(v, find, powers));
  const std::size_t velocity = velocity_of(module);
  for (std::size_t n = 0; n < module.variables.size(); ++n) {
    const AnalysedVariable& v = module.variables[n];
    const std::vector<std::size_t>& own = of_variable[n];
    const bool prime = v.reynolds_stress || velocity == n;
    if (prime && own.size() != 3)
      throw DeckError(v.where,
                      fmt::format("'{}' is not a vector: it has no Reynolds stress", v.label),
                      "use vel_CC");
    if (prime)
      add_derived(
          stress_name, ValueType::vector, unit_power("m/s", 2), v.material, 5,
          {add_product(own[0], own[1]), add_product(own[1], own[2]), add_product(own[2], own[0])},
          "Covariances over time of the components of the velocity.");
  }
  for (std::size_t n = 0; n < of_variable.size() && velocity < of_variable.size(); ++n) {
    const AnalysedVariable& v = module.variables[n];
    const std::vector<std::size_t>&own = of_variable[n], &u = of_variable[velocity];
    if (n == velocity || own.size() != 1) continue;
    add_derived(covariance_name + v.label, ValueType::vector,
                quantities_[n].label.info().unit + " m/s", v.material, 5,
                {add_product(own[0], u[0]), add_product(own[0], u[1]), add_product(own[0], u[2])},
                "Covariances over time of a scalar with the components of the velocity.");
  }
  follow_levels();
}

Statistics::~Statistics() = default;

Label Statistics::keep(const std::string& name, int material) {
  const Label label =
      declare_label({module_->name + "." + name, ValueType::real, Centring::cell, "1",
                     "Data that an analysis stores for every cell over time."});
  kept_.push_back(label);
  kept_materials_.push_back(material);
  return label;
}

void Statistics::add_derived(const std::string& name, ValueType type, const std::string& unit,
                             int material, int moment, const std::vector<std::size_t>& entries,
                             const char* text) {
  const Label label = declare_label({name, type, Centring::cell, unit, text});
  for (const Derived& d : derived_)
    if (d.label == label && d.material == material)
      throw DeckError(module_->where,
                      fmt::format("{} of material {} is analysed twice", name, material),
                      "remove one of the two");
  derived_.push_back({label, material, moment, entries});
  if (std::find(labels_.begin(), labels_.end(), label) == labels_.end()) labels_.push_back(label);
}

std::vector<std::size_t> Statistics::add_quantity(const AnalysedVariable& v,
                                                  const FindQuantity& find, int powers) {
  const AnalysedQuantity q = find(v);
  if (q.label.info().centring != Centring::cell)
    throw DeckError(
        v.where,
        fmt::format(
            "<Module name=\"{}\">: '{}' is on faces or nodes; statistics are of cell variables",
            module_->name, v.label),
        "analyse a cell variable");
  quantities_.push_back(q);
  std::vector<std::size_t> entries;
  for (int c = 0; c < q.components; ++c) {
    const char* direction[] = {".x", ".y", ".z"};
    const std::string of =
        fmt::format("{}_{}{}", v.label, v.material, q.components == 1 ? "" : direction[c]);
    Sums s{quantities_.size() - 1, c, of, {}, keep(of + ".first", v.material)};
    for (int p = 1; p <= powers; ++p)
      s.powers.push_back(keep(fmt::format("{}.{}", of, p), v.material));
    entries.push_back(sums_.size());
    sums_.push_back(std::move(s));
  }
  const ValueType type =
      q.label.info().type == ValueType::vector ? ValueType::vector : ValueType::real;
  const char* texts[] = {"Sum of samples over time.", "Mean over time.", "Variance over time.",
                         "Third central moment over time.", "Fourth central moment over time."};
  for (int moment = 0; moment <= powers; ++moment)
    add_derived(moment_names[moment] + v.label, type,
                unit_power(q.label.info().unit, std::max(1, moment)), v.material, moment, entries,
                texts[moment]);
  return entries;
}

std::size_t Statistics::add_product(std::size_t a, std::size_t b) {
  products_.push_back(
      {a, b, keep(sums_[a].name + "*" + sums_[b].name, quantities_[sums_[a].quantity].material)});
  return products_.size() - 1;
}

void Statistics::follow_levels() {
  std::vector<std::unique_ptr<LevelStore>> now;
  for (int l = 0; l < hierarchy_->level_count(); ++l) {
    const std::size_t n = l;
    const LevelStore* before = n < stores_.size() ? stores_[n].get() : nullptr;
    const Level& level = hierarchy_->level(l).level();
    if (before != nullptr && before->holds(level)) {
      now.push_back(std::move(stores_[n]));
      continue;
    }
    now.push_back(std::make_unique<LevelStore>(level, rank_, kept_, kept_materials_));
    now.back()->commit(before, l > 0 ? now[n - 1].get() : nullptr);
  }
  stores_ = std::move(now);
}

void Statistics::add_box(const LevelStore& store, const Warehouse& outputs, int box) {
  const IndexBox cells = outputs.local_boxes()[box].cells;
  const auto kept = [&](Label label) { return store.view(label, box); };
  const auto current = [&](const Sums& s) {
    const AnalysedQuantity& q = quantities_[s.quantity];
    return ConstRealView(outputs.view(outputs.find(q.label, q.material), s.component, box));
  };
  for (const Product& p : products_) {
    const ConstRealView qa = current(sums_[p.a]), qb = current(sums_[p.b]);
    const RealView a = kept(sums_[p.a].first), b = kept(sums_[p.b].first), sum = kept(p.sum);
    if (samples_ > 0)  // else both differences are zero
      for_each_cell(cells, [&](IntVec3 c) { sum(c) += (qa(c) - a(c)) * (qb(c) - b(c)); });
  }
  for (const Sums& s : sums_) {
    const ConstRealView q = current(s);
    const RealView first = kept(s.first);
    if (samples_ == 0) for_each_cell(cells, [&](IntVec3 c) { first(c) = q(c); });
    std::vector<RealView> powers;
    for (const Label& label : s.powers) powers.push_back(kept(label));
    for_each_cell(cells, [&](IntVec3 c) {
      const double d = q(c) - first(c);
      double power = d;
      for (const RealView& p : powers) {
        p(c) += power;
        power *= d;
      }
    });
  }
}

void Statistics::sample() {
  for (std::size_t l = 0; l < stores_.size(); ++l) {
    const Warehouse& outputs = hierarchy_->level(static_cast<int>(l)).outputs();
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
      add_box(*stores_[l], outputs, b);
  }
  ++samples_;
}

double Statistics::value(const Derived& d, std::size_t entry, const LevelStore& store, int box,
                         IntVec3 cell) const {
  if (samples_ == 0) return 0;
  const auto n = static_cast<double>(samples_);
  const auto kept = [&](Label label) { return store.view(label, box)(cell); };
  if (d.moment == 5) {
    const Product& p = products_[entry];
    return kept(p.sum) / n - (kept(sums_[p.a].powers[0]) / n) * (kept(sums_[p.b].powers[0]) / n);
  }
  const Sums& s = sums_[entry];
  double sums[4] = {0, 0, 0, 0};
  for (std::size_t p = 0; p < s.powers.size(); ++p) sums[p] = kept(s.powers[p]);
  if (d.moment == 0) return n * kept(s.first) + sums[0];
  if (d.moment == 1) return kept(s.first) + sums[0] / n;
  return central_moment(d.moment, n, sums);
}

void Statistics::store(const std::vector<Label>& wanted) {
  for (std::size_t l = 0; l < stores_.size(); ++l) {
    Warehouse& outputs = hierarchy_->level(static_cast<int>(l)).outputs();
    for (const Derived& d : derived_) {
      if (std::find(wanted.begin(), wanted.end(), d.label) == wanted.end()) continue;
      const int components = static_cast<int>(d.entries.size());
      const int slot = outputs.add({d.label, d.material, components, 0});
      for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
        for (int c = 0; c < components; ++c) {
          const RealView v = outputs.view(slot, c, b);
          for_each_cell(outputs.local_boxes()[b].cells,
                        [&](IntVec3 i) { v(i) = value(d, d.entries[c], *stores_[l], b, i); });
        }
    }
  }
}

void Statistics::add_checkpoint_pieces(std::vector<FieldPiece>& pieces) const {
  for (const auto& store : stores_) store->add_pieces(pieces);
}

void Statistics::restore(const ArchiveStep& checkpoint, int samples) {
  stores_.clear();
  follow_levels();
  samples_ = 0;
  for (const auto& store : stores_)
    if (!store->read(checkpoint)) return;
  samples_ = samples;
}

}  // namespace sluice

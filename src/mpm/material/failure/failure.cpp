// A law with damage and erosion.
#include "mpm/material/failure/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/metal_parts.hpp"
#include "mpm/material/base/objective_step.hpp"
#include "mpm/material/failure/damage.hpp"

namespace sluice::mpm {
namespace {

enum class Erosion { none, zero_stress, no_tension, no_shear, preserve_stress };

struct FailureConstants {
  DamageConstants damage;
  Erosion erosion = Erosion::none;
  double char_time = 0;  // s
  bool localize = true;
};

class MaterialWithFailure final : public Material {
 public:
  MaterialWithFailure(std::shared_ptr<const Material> law, const FailureConstants& constants)
      : law_(std::move(law)), c_(constants) {
    for (const HistoryColumn& h : law_->history()) {
      if (h.label == plastic_strain_label()) strain_at_ = columns_;
      add(h);
    }
    of_law_ = columns_;
    const DamageForm form = c_.damage.form;
    if (form == DamageForm::threshold)
      threshold_at_ = add({history_label("p.epsf"), 1});
    else if (form != DamageForm::none)
      damage_at_ = add({damage_label(), 1});
    if (form == DamageForm::brittle) greatest_at_ = add({history_label("p.damageForce"), 1});
    failed_at_ = law_->failed_column();
    const bool needs_it = form == DamageForm::threshold || c_.erosion != Erosion::none;
    if (needs_it && failed_at_ < 0) failed_at_ = add({localized_label(), 1});
    if (c_.char_time > 0 && failed_at_ >= 0) time_at_ = add({history_label("p.timeofloc"), 1});
  }

  std::span<const HistoryColumn> history() const override { return history_; }
  int failed_column() const override { return failed_at_; }
  bool failed_keep_their_shape() const override { return c_.erosion == Erosion::zero_stress; }
  bool rigid() const override { return law_->rigid(); }
  double bulk_modulus() const override { return law_->bulk_modulus(); }
  bool has_shock_equation() const override { return law_->has_shock_equation(); }
  double shear_modulus() const override { return law_->shear_modulus(); }

  void start(const Batch& b) const override {
    for (std::size_t k = of_law_; k < b.history.size(); ++k)
      std::fill_n(b.history[k], b.count, 0.0);
    law_->start(law_batch(b));
    for (int i = 0; i < b.count; ++i) {
      if (threshold_at_ >= 0)
        b.history[threshold_at_][i] = drawn_threshold(c_.damage, b.id[i], b.volume_0[i]);
      if (greatest_at_ >= 0)
        b.history[greatest_at_][i] = c_.damage.r_0;
      else if (damage_at_ >= 0)
        b.history[damage_at_][i] = damage_at_start(c_.damage, b.id[i]);
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (auto fault = law_->update(law_batch(b))) return fault;
    for (std::size_t k = of_law_; k < b.history.size(); ++k)
      std::copy_n(b.old_history[k], b.count, b.history[k]);
    const Six<const double> new_stress = {b.stress[0], b.stress[1], b.stress[2],
                                          b.stress[3], b.stress[4], b.stress[5]};
    for_eights(0, static_cast<std::size_t>(b.count), [&](auto p) {
      if (stays_whole(b, new_stress, p)) return;
      for (std::size_t i = p.i; i < p.i + p.count; ++i)
        take_damage(b, new_stress, static_cast<int>(i));
    });
    return std::nullopt;
  }

 private:
  int add(const HistoryColumn& h) {
    history_.push_back(h);
    const int at = columns_;
    columns_ += h.components;
    return at;
  }
  Batch law_batch(const Batch& b) const {
    Batch part = b;
    const std::size_t n = of_law_;
    part.history = b.history.first(n);
    if (!b.old_history.empty()) part.old_history = b.old_history.first(n);
    return part;
  }

  // Has none of one or eight particles failed, and will none now: there is nothing to do.
  template <class P>
  bool stays_whole(const Batch& b, const Six<const double>& stress, const P& p) const {
    if (c_.damage.form != DamageForm::threshold) return false;
    if (failed_at_ >= 0 && sum_of_lanes(magnitude(p(b.history[failed_at_]))) != 0) return false;
    return !c_.localize ||
           far_from_failing(c_.damage, p(b.old_history[threshold_at_]), at(stress, p), at(b.F, p));
  }

  void take_damage(const Batch& b, const Six<const double>& new_stress, int i) const {
    const Symmetric stress = at(new_stress, i);
    const double share = damaged(b, i, stress);
    Symmetric left = combined(share, stress, 0, stress);
    const bool gone = failed_at_ >= 0 && eroded(b, i, left);
    if (share != 1 || gone) keep(b, i, left);
  }

  // What damage leaves of the stress of particle i, having looked at it.
  double damaged(const Batch& b, int i, const Symmetric& stress) const {
    const DamageConstants& d = c_.damage;
    switch (d.form) {
      case DamageForm::none:
        return 1;
      case DamageForm::johnson_cook:
      case DamageForm::hancock_mackenzie: {
        const double more =
            strain_at_ < 0 ? 0 : b.history[strain_at_][i] - b.old_history[strain_at_][i];
        b.history[damage_at_][i] = b.old_history[damage_at_][i] +
                                   more_damage(d, stress, more, more / b.dt, b.temperature[i]);
        return 1;
      }
      case DamageForm::threshold:
        if (c_.localize && b.history[failed_at_][i] == 0)
          b.history[failed_at_][i] =
              failed_by_threshold(d, b.old_history[threshold_at_][i], stress, at(b.F, i));
        return 1;
      case DamageForm::brittle:
        break;
    }
    const BrittleState state =
        brittle(d, {b.old_history[damage_at_][i], b.old_history[greatest_at_][i]}, stress,
                at(b.F, i), b.volume_0[i] * determinant(at(b.F, i)));
    b.history[damage_at_][i] = state.damage;
    b.history[greatest_at_][i] = state.greatest;
    // Cracks that close bear again, where the deck says so.
    return trace(stress) > 0 ? 1 - state.damage : 1 - state.damage * (1 - d.recovery);
  }

  // Takes from the stress of a failed particle what it no longer bears.
  bool eroded(const Batch& b, int i, Symmetric& stress) const {
    if (b.history[failed_at_][i] == 0) return false;
    double fading = 0;
    if (time_at_ >= 0) {
      if (b.old_history[failed_at_][i] == 0) b.history[time_at_][i] = b.time + b.dt;
      fading = std::exp(-(b.time + b.dt - b.history[time_at_][i]) / c_.char_time);
    }
    const double mean = trace(stress) / 3;
    switch (c_.erosion) {
      case Erosion::none:
      case Erosion::preserve_stress:
        return false;
      case Erosion::zero_stress:
        for (double& x : stress) x *= fading;
        return true;
      case Erosion::no_tension:
        if (mean > 0)
          for (double& x : stress) x *= fading;
        else
          stress = {mean, mean, mean, 0, 0, 0};
        return true;
      case Erosion::no_shear:
        stress = {mean, mean, mean, 0, 0, 0};
        return true;
    }
    return false;
  }

  void keep(const Batch& b, int i, const Symmetric& stress) const {
    for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = stress[k];
    const Symmetric strain = objective_step(at(b.L, i), b.dt).strain;
    const double J_0 = determinant(at(b.old_F, i)), J_1 = determinant(at(b.F, i));
    b.energy[i] = b.old_energy[i] + 0.5 * b.volume_0[i] *
                                        (J_0 * double_dot(at(b.old_stress, i), strain) +
                                         J_1 * double_dot(stress, strain));
  }

  std::shared_ptr<const Material> law_;
  FailureConstants c_;
  std::vector<HistoryColumn> history_;
  int columns_ = 0, of_law_ = 0;
  int strain_at_ = -1, damage_at_ = -1, threshold_at_ = -1, greatest_at_ = -1, failed_at_ = -1,
      time_at_ = -1;
};

// ---- reading

Tags scalar_tags() {
  return {number("initial_mean_scalar_damage", "initial damage", 0).at_least(0),
          number("initial_std_scalar_damage", "standard deviation of the initial damage", 0)
              .at_least(0),
          tag("initial_scalar_damage_distrib", "distribution of the random values")
              .words({"constant", "gauss"})
              .by_default("constant"),
          number("critical_scalar_damage", "accepted without effect: damage is only saved", 1)};
}

const std::vector<Part>& damages() {
  static const std::vector<Part> list = [] {
    Tags johnson_cook = scalar_tags();
    for (const char* name : {"D1", "D2", "D3", "D4", "D5"})
      johnson_cook.push_back(number(name, "coefficient of the strain at failure"));
    johnson_cook.push_back(number("D0", "accepted without effect", 0));
    johnson_cook.push_back(number("Dc", "accepted without effect", 0));
    return std::vector<Part>{
        {"none", {}},
        {"johnson_cook", johnson_cook},
        {"hancock_mackenzie", scalar_tags()},
        {"Threshold",
         {positive("failure_mean", "mean threshold: Pa, or a strain"),
          number("failure_std", "standard deviation of the threshold; weibull: the Weibull modulus",
                 0)
              .at_least(0),
          number("failure_seed", "seed of the random thresholds", 0),
          tag("failure_distrib", "distribution of the thresholds")
              .once()
              .words({"constant", "uniform", "gauss", "weibull"}),
          tag("failure_criteria", "quantity compared with the threshold")
              .once()
              .words({"MaximumPrincipalStress", "MaximumPrincipalStrain", "MohrCoulomb",
                      "MohrColoumb"}),
          number("friction_angle", "friction angle of MohrCoulomb, degrees", 0),
          number("tensile_cutoff_fraction_of_cohesion", "largest tension divided by cohesion",
                 1e10),
          number("exponent", "exponent of the scaling by volume; absent: failure_std", 0),
          number("reference_volume", "volume at which the scaling is 1, m^3", 0),
          tag("scaling", "scaling of the threshold by the particle's volume")
              .words({"none", "kayenta"})
              .by_default("none"),
          choice("LocalizeParticles", "whether particles fail", true)}},
        {"Brittle",
         {positive("brittle_damage_initial_threshold", "r_0, Pa^(1/2)"),
          positive("brittle_damage_fracture_energy", "G_f, J/m^2"),
          positive("brittle_damage_constant_D", "d"),
          positive_or("brittle_damage_max_damage_increment", "largest increase in a step", 0.1),
          choice("brittle_damage_allowRecovery", "whether closed cracks carry load again", false),
          number("brittle_damage_recoveryCoeff", "fraction that they carry", 1),
          choice("brittle_damage_printDamage", "accepted without effect", false)}}};
  }();
  return list;
}
const std::vector<std::string> damages_not_supported = {"ThresholdVar"};

const std::vector<std::string> algorithms = {"none", "ZeroStress", "AllowNoTension", "AllowNoShear",
                                             "PreserveStress"};

void read_scalar(const Parameters& p, DamageConstants& d) {
  d.initial_mean = p.real("initial_mean_scalar_damage");
  if (p.word("initial_scalar_damage_distrib") == "gauss")
    d.initial_deviation = p.real("initial_std_scalar_damage");
  d.room = p.constants().room_temperature;
  d.melt = p.constants().melt_temperature;
}

void read_threshold(const Parameters& p, FailureConstants& c) {
  DamageConstants& d = c.damage;
  const std::string law = p.word("failure_criteria"), drawn = p.word("failure_distrib");
  d.criterion = law == "MaximumPrincipalStress"   ? Criterion::principal_stress
                : law == "MaximumPrincipalStrain" ? Criterion::principal_strain
                                                  : Criterion::mohr_coulomb;
  if (law == "MohrColoumb")
    add_warning(p.faults(), p.block("failure_criteria")->where,
                "MohrColoumb is read as MohrCoulomb", "write MohrCoulomb");
  d.distribution = drawn == "constant"  ? Distribution::constant
                   : drawn == "uniform" ? Distribution::uniform
                   : drawn == "gauss"   ? Distribution::gauss
                                        : Distribution::weibull;
  d.mean = p.real("failure_mean");
  d.deviation = p.real("failure_std");
  d.seed = static_cast<std::uint64_t>(static_cast<std::int64_t>(p.real("failure_seed")));
  if (d.distribution == Distribution::weibull && !(d.deviation > 0))
    p.error("failure_std", "weibull needs <failure_std>, its modulus, above 0");
  const double friction = p.real("friction_angle") * 3.14159265358979323846 / 180;
  d.sine = std::sin(friction);
  d.cosine = std::cos(friction);
  d.cutoff = p.real("tensile_cutoff_fraction_of_cohesion");
  d.exponent = p.real("exponent") > 0 ? p.real("exponent") : d.deviation;
  if (p.word("scaling") == "kayenta") {
    d.reference_volume = p.real("reference_volume");
    if (!(d.reference_volume > 0) || !(d.exponent > 0))
      p.error("reference_volume", "<scaling> needs <reference_volume> and <exponent> above 0");
  }
  c.localize = p.flag("LocalizeParticles");
}

void read_brittle(const Parameters& p, const Material& law, DamageConstants& d) {
  d.r_0 = p.real("brittle_damage_initial_threshold");
  d.fracture_energy = p.real("brittle_damage_fracture_energy");
  d.d = p.real("brittle_damage_constant_D");
  d.max_rise = p.real("brittle_damage_max_damage_increment");
  if (p.flag("brittle_damage_allowRecovery")) d.recovery = p.real("brittle_damage_recoveryCoeff");
  const double K = law.bulk_modulus(), G = law.shear_modulus();
  d.young = 9 * K * G / (3 * K + G);
  if (!law.stress_of_state())
    add_error(
        p.faults(), p.node().where,
        "Brittle damage needs a constitutive model whose stress depends only on the deformation",
        "comp_neo_hook, cnh_mms or comp_mooney_rivlin");
}

void read_damage(const Parameters& around, const Material& law, FailureConstants& c) {
  const ChosenSubmodel chosen =
      choose_submodel(around, "damage_model", damages(), damages_not_supported);
  if (chosen.index < 0) return;
  c.damage.form = static_cast<DamageForm>(chosen.index);
  const Parameters p = inside_submodel(around, "damage_model", damages()[chosen.index]);
  if (!p.good()) return;
  DamageConstants& d = c.damage;
  switch (d.form) {
    case DamageForm::none:
      break;
    case DamageForm::johnson_cook:
      d.D1 = p.real("D1");
      d.D2 = p.real("D2");
      d.D3 = p.real("D3");
      d.D4 = p.real("D4");
      d.D5 = p.real("D5");
      read_scalar(p, d);
      break;
    case DamageForm::hancock_mackenzie:
      read_scalar(p, d);
      break;
    case DamageForm::threshold:
      read_threshold(p, c);
      break;
    case DamageForm::brittle:
      read_brittle(p, law, d);
      break;
  }
}

void read_erosion(const DeckNode& material, FailureConstants& c, std::vector<Fault>& faults) {
  const DeckNode* node = material.child("erosion");
  if (node == nullptr) return;
  const std::string word = node->attribute("algorithm").value_or("");
  const auto found = std::find(algorithms.begin(), algorithms.end(), word);
  if (found == algorithms.end()) {
    if (!error_at(faults, node->where))
      add_error(faults, node->where,
                fmt::format("<erosion algorithm>: '{}' is not a valid word", word),
                fmt::format("valid: {}", fmt::join(algorithms, ", ")));
    return;
  }
  c.erosion = static_cast<Erosion>(found - algorithms.begin());
  const Tags tags = {number("char_time", "s", 0)};
  const Parameters p(*node, "erosion", tags, {}, faults);
  if (p.good()) c.char_time = p.real("char_time") > 1e-90 ? p.real("char_time") : 0;
}

}  // namespace

TagSpec damage_model_tag() {
  return submodel_tag("damage_model", "damage and failure of particles", damages(),
                      damages_not_supported);
}
TagSpec erosion_tag() {
  return tag("erosion", "stress that a failed particle still carries")
      .attribute(attribute("algorithm",
                           "ZeroStress: nothing; AllowNoTension: pressure; AllowNoShear: mean "
                           "stress; PreserveStress, none: all")
                     .once()
                     .words(algorithms))
      .child(
          tag("char_time", "time over which the stress decays; absent: at once").real().unit("s"));
}

bool erodes(const DeckNode& material) {
  const DeckNode* node = material.child("erosion");
  return node != nullptr && node->attribute("algorithm").value_or("none") != "none";
}

std::shared_ptr<const Material> with_failure(std::shared_ptr<const Material> law,
                                             const DeckNode& material,
                                             const MaterialConstants& constants,
                                             std::vector<Fault>& faults) {
  const std::size_t before = faults.size();
  FailureConstants c;
  static const Tags none;
  std::vector<Fault> not_ours;  // the other children of the material
  const Parameters around(material, "material", none, {constants, false}, not_ours);
  const DeckNode* damage = material.child("damage_model");
  if (damage != nullptr) {
    not_ours.clear();
    read_damage(around, *law, c);
    faults.insert(faults.end(), not_ours.begin(), not_ours.end());
  }
  read_erosion(material, c, faults);
  const bool bad = std::any_of(faults.begin() + static_cast<std::ptrdiff_t>(before), faults.end(),
                               [](const Fault& f) { return f.severity == Severity::error; });
  if (bad) return nullptr;
  if (c.damage.form == DamageForm::none && c.erosion == Erosion::none) return law;
  return std::make_shared<MaterialWithFailure>(std::move(law), c);
}

}  // namespace sluice::mpm

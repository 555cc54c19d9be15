#include "framework/run/simulation/energy_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/json.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

constexpr double driven = 0.1;  // of the work of a step: what its time may be wrong by

double taken_in(const BodyEnergy& b) {
  return std::max(b.work, 0.0) + std::max(b.heat, 0.0);
}

}  // namespace

// With K(v-) + U^n at the start of the step, `own` is the step's own share of H^n beyond it; what
// is left of the change is part of H^(n+1). Where the step changes its length, H changes by some D;
// and where loads act, part of their work is counted a step early.
EnergyGuard::Change EnergyGuard::change(const BodyBudget& budget, const BodyEnergy& b, double dt,
                                        double spacing) {
  Change c;
  const double dK = b.kinetic_after - b.kinetic_before;
  // m |v+ - v-|^2/2
  const double jump = 2 * (b.kinetic_after + b.kinetic_before) - 4 * b.kinetic_middle;
  c.rise = b.stored_after - b.stored_before;
  double own = 0, own_work = 0;
  if (budget.steps > 0) {
    const double ratio = dt / budget.dt;
    const double s = 1 / (1 + ratio);  // where U^n stands between v- and v+
    own = s * dK - 2 * s * (1 - s) * jump;
    own_work = s * b.work - s * (1 - s) * b.kick;
    // Of the jump, what the stress made.
    const double inner = std::max(0.0, jump - std::fabs(b.kick) - std::fabs(b.work));
    c.growth = inner / 3 + (c.rise - budget.rise * ratio) / 12;
    const double unequal = std::min(ratio, 1 / ratio);
    const double swing = std::max(std::fabs(c.growth), std::fabs(budget.growth));
    c.swing = 6 * swing * (budget.steps == 1 ? 1 : 1 - unequal * unequal);
    c.unjust =
        -std::max(c.swing, budget.swing) - driven * (std::fabs(b.work) + std::fabs(budget.work));
  }
  c.gain = budget.carried + own - own_work;
  c.unjust += c.gain - std::max(0.0, b.contact_slack);
  c.carried = dK + c.rise - own - (b.work - own_work);
  const double energy = b.kinetic_before + std::fabs(b.stored_before);
  const double slow = 1e-8 * spacing / dt;
  c.scale = std::max({budget.most, energy, budget.work_in + taken_in(b), b.mass * slow * slow});
  const double share = c.of_scale(c.growth), more = c.growth - budget.growth;
  if (share > std::max(large_growth, 1.05 * budget.record) && more > max_step_gain * c.scale)
    c.more = more;
  return c;
}

// What is sure of the gain, with either work of contact.
double EnergyGuard::run_gain_of(const BodyBudget& a) {
  const double low = a.gain - std::max(0.0, a.slack), high = a.gain - std::min(0.0, a.slack);
  if (high < 0) return high;
  // Of a swing, which is 6 D (1 - r^2), a fourth.
  return std::max(0.0, low - 0.25 * a.max_swing);
}

std::optional<EnergyGuard::Excess> EnergyGuard::judge(const std::vector<BodyEnergy>& step,
                                                      double dt, double spacing) const {
  std::optional<Excess> worst;
  double most = max_step_gain;
  for (std::size_t n = 0; n < step.size(); ++n) {
    const BodyBudget budget = n < budgets_.size() ? budgets_[n] : BodyBudget();
    const Change c = change(budget, step[n], dt, spacing);
    const bool grows = budget.streak > 0 || c.growth > max_growth * c.scale;
    const double gain = std::max(c.unjust, grows ? c.more : 0.0);
    if (!(gain > most * c.scale)) continue;
    most = gain / c.scale;
    worst = Excess{static_cast<int>(n), gain, c.scale};
  }
  return worst;
}

void EnergyGuard::accept(const std::vector<BodyEnergy>& step, int number, double dt,
                         double spacing) {
  budgets_.resize(std::max(budgets_.size(), step.size()));
  for (std::size_t n = 0; n < step.size(); ++n) {
    BodyBudget& a = budgets_[n];
    const Change c = change(a, step[n], dt, spacing);
    a.name = step[n].name;
    a.material = step[n].material;
    a.most = std::max(a.most, step[n].kinetic_before + std::fabs(step[n].stored_before));
    a.work_in += taken_in(step[n]);
    // After the first step H is known for the first time: of its loss until then particles tell.
    a.gain += step[n].returned + (a.steps == 1 ? -step[n].lost : c.gain);
    if (a.steps > 1) a.max_swing = std::max(a.max_swing, c.swing);
    a.slack += step[n].contact_slack;
    a.worst = std::max(a.worst, c.of_scale(c.unjust));
    a.carried = c.carried;
    a.rise = c.rise;
    a.growth = c.growth;
    a.streak = c.more > 0 ? a.streak + 1 : 0;
    a.record = std::max(0.98 * a.record, c.of_scale(c.growth));
    a.work = step[n].work;
    a.swing = c.swing;
    a.dt = dt;
    a.steps = std::min(a.steps + 1, 2);
    const auto since = [&](bool beyond, int& first) {
      if (!beyond)
        first = 0;
      else if (first == 0)
        first = number;
    };
    since(run_gain_of(a) > max_run_gain * c.scale, a.gained_since);
    since(run_gain_of(a) < -max_run_loss * c.scale, a.lost_since);
  }
  if (factor_ < 1 && --left_ <= 0) {
    factor_ = std::min(1.0, 2 * factor_);
    left_ = patience_;
  }
}

std::vector<EnergyGuard::Crossing> EnergyGuard::crossings() const {
  std::vector<Crossing> all;
  for (const BodyBudget& a : budgets_) {
    const double share = scale_of(a) > 0 ? run_gain_of(a) / scale_of(a) : 0;
    if (a.gained_since > 0) all.push_back({a.material, true, a.gained_since, share});
    if (a.lost_since > 0) all.push_back({a.material, false, a.lost_since, share});
  }
  return all;
}

// Whatever asks for it again at once asks for longer patience.
bool EnergyGuard::shorten() {
  if (factor_ <= std::ldexp(1.0, -max_halvings)) return false;
  factor_ *= 0.5;
  left_ = patience_;
  patience_ = std::min(2 * patience_, 1 << 20);
  return true;
}

Json EnergyGuard::to_json() const {
  Json json = Json::object();
  for (const BodyBudget& a : budgets_) {
    const double scale = scale_of(a);
    json[a.name] = {{"scale_J", scale},
                    {"numerical_gain_J", run_gain_of(a)},
                    {"numerical_gain_of_scale", scale > 0 ? run_gain_of(a) / scale : 0.0},
                    {"largest_gain_of_a_step", a.worst},
                    {"above_gain_limit_since_step", a.gained_since},
                    {"below_loss_limit_since_step", a.lost_since}};
  }
  return json;
}

std::string EnergyGuard::summary(std::string_view better) const {
  std::string text;
  for (const BodyBudget& a : budgets_) {
    const double scale = scale_of(a);
    if (a.gained_since > 0)
      text += fmt::format(
          "warning: solid '{}' has gained energy by numerical error, more than {:g} % of its scale "
          "since step {}; {:+.2g} % at the end. Use {}\n",
          a.name, 100 * max_run_gain, a.gained_since, 100 * run_gain_of(a) / scale,
          better.empty() ? "a smaller <timestep_multiplier> or another <interpolator>" : better);
    if (a.lost_since > 0)
      text += fmt::format(
          "solid '{}' has lost more than {:g} % of its energy in transfer and integration since "
          "step {}; {:+.3g} % of its scale at the end{}{}\n",
          a.name, 100 * max_run_loss, a.lost_since, 100 * run_gain_of(a) / scale,
          better.empty() ? "" : ". Take ", better);
  }
  return text;
}

Json EnergyGuard::checkpoint() const {
  Json bodies = Json::array();
  for (const BodyBudget& a : budgets_)
    bodies.push_back({{"name", a.name},
                      {"material", a.material},
                      {"steps", a.steps},
                      {"carried", a.carried},
                      {"rise", a.rise},
                      {"growth", a.growth},
                      {"record", a.record},
                      {"streak", a.streak},
                      {"dt", a.dt},
                      {"work", a.work},
                      {"swing", a.swing},
                      {"most", a.most},
                      {"work_in", a.work_in},
                      {"gain", a.gain},
                      {"most_swing", a.max_swing},
                      {"slack", a.slack},
                      {"worst", a.worst},
                      {"gained_since", a.gained_since},
                      {"lost_since", a.lost_since}});
  return {{"bodies", bodies}, {"factor", factor_}, {"patience", patience_}, {"left", left_}};
}

void EnergyGuard::restore(const Json& json) {
  budgets_.clear();
  for (const Json& entry : json.at("bodies").entries()) {
    BodyBudget a;
    const auto real = [&](const char* name) { return entry.at(name).get<double>(); };
    const auto whole = [&](const char* name) { return entry.at(name).get<int>(); };
    a.name = entry.at("name").get<std::string>();
    a.material = whole("material");
    a.steps = whole("steps");
    a.carried = real("carried");
    a.rise = real("rise");
    a.growth = real("growth");
    a.record = real("record");
    a.streak = whole("streak");
    a.dt = real("dt");
    a.work = real("work");
    a.swing = real("swing");
    a.most = real("most");
    a.work_in = real("work_in");
    a.gain = real("gain");
    a.max_swing = real("most_swing");
    a.slack = real("slack");
    a.worst = real("worst");
    a.gained_since = whole("gained_since");
    a.lost_since = whole("lost_since");
    budgets_.push_back(a);
  }
  factor_ = json.at("factor").get<double>();
  patience_ = json.at("patience").get<int>();
  left_ = json.at("left").get<int>();
}

}  // namespace sluice

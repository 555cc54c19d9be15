#include "app/tune/tune_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/tune/tune_deck.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

using Align = TextTable::Align;
using solve::Norm;
using solve::SolverSettings;
using solve::SolverTrial;

constexpr double worth_a_change = 1.05;
constexpr std::size_t widest_note = 80;

const char* norm_name(Norm n) {
  return n == Norm::two ? "L2" : n == Norm::one ? "L1" : "LInfinity";
}

std::string goal_text(const SolverSettings& s) {
  return s.absolute_tolerance > 0 ? fmt::format("at most {:g}", s.absolute_tolerance)
                                  : fmt::format("at most {:g} of the right-hand side", s.tolerance);
}

const char* state_name(TuneState s) {
  switch (s) {
    case TuneState::ranked:
      return "ranked";
    case TuneState::slow:
      return "slow";
    case TuneState::failed:
      return "failed";
    case TuneState::not_tried:
      return "not tried";
  }
  return "";
}

std::string shortened(const std::string& text) {
  return text.size() <= widest_note ? text : text.substr(0, widest_note - 3) + "...";
}

std::string numbers_text(const TuneReport& r) {
  std::string text;
  for (std::size_t n = 0; n < r.numbers.size(); ++n)
    text += fmt::format("{}{}", n == 0 ? "" : ", ", r.numbers[n]);
  return text;
}

std::string table_of(const TuneReport& r) {
  TextTable table({{""},
                   {"solver"},
                   {"iterations", Align::right},
                   {"set-up", Align::right},
                   {"solve", Align::right},
                   {"total", Align::right},
                   {"gain", Align::right},
                   {"memory", Align::right},
                   {"state"}});
  const std::string own = short_name(r.own);
  const double own_seconds = r.own_result().seconds();
  const bool own_ranked = r.own_result().state == TuneState::ranked;
  int place = 0;
  for (const TunedSolver& s : r.ranking) {
    const std::string name = short_name(s.settings) + (short_name(s.settings) == own ? " *" : "");
    const std::string state = s.state == TuneState::ranked ? ""
                              : s.note.empty()
                                  ? state_name(s.state)
                                  : fmt::format("{}: {}", state_name(s.state), shortened(s.note));
    if (s.trials.empty() || s.state == TuneState::failed) {
      table.row({"", name, "", "", "", "", "", "", state});
      continue;
    }
    const bool ranked = s.state == TuneState::ranked;
    table.row({ranked ? std::to_string(++place) : "", name, std::to_string(s.iterations()),
               human_duration(s.set_up_seconds()), human_duration(s.solve_seconds()),
               human_duration(s.seconds()),
               ranked && own_ranked ? fmt::format("{:.2f}", own_seconds / s.seconds()) : "",
               s.bytes() > 0 ? human_bytes(s.bytes()) : "", state});
  }
  return table.text("  ");
}

std::string verdict(const TuneReport& r) {
  const TunedSolver* best = r.best();
  if (best == nullptr) return "no solver met the goal within the budget: raise --budget\n";
  if (!r.worth_it())
    return fmt::format("{} of the deck is the fastest found, or equally fast: nothing to change\n",
                       short_name(r.own));
  if (r.gain() == 0)
    return fmt::format("the deck's own solver fails; {} does not. Tags for the deck:\n\n",
                       short_name(best->settings));
  std::string text = fmt::format("{} takes {} where the deck's own takes {}: {:.2f} times as fast",
                                 short_name(best->settings), human_duration(best->seconds()),
                                 human_duration(r.own_result().seconds()), r.gain());
  const double saved = r.own_result().seconds() - best->seconds();
  if (r.step_seconds > r.own_result().seconds())
    text += fmt::format(";\nof a step that takes {} it saves {}", human_duration(r.step_seconds),
                        human_percent(saved / r.step_seconds));
  return text + ". Tags for the deck:\n\n";
}

Json settings_json(const SolverSettings& s) {
  return {{"type", s.type},
          {"solver", s.solver},
          {"preconditioner", s.preconditioner},
          {"npre", s.before},
          {"npost", s.after},
          {"skip", s.skip},
          {"relax_type", s.relax_type},
          {"precond_maxiters", s.preconditioner_iterations},
          {"tolerance", s.tolerance},
          {"absolute_tolerance", s.absolute_tolerance},
          {"norm", norm_name(s.norm)},
          {"maxiterations", s.max_iterations}};
}

Json trials_json(const std::vector<SolverTrial>& trials) {
  Json list = Json::array();
  for (const SolverTrial& t : trials)
    list.push_back({{"iterations", t.iterations},
                    {"set_up_seconds", t.set_up_seconds},
                    {"solve_seconds", t.solve_seconds},
                    {"residual_over_goal", t.residual},
                    {"bytes", t.bytes},
                    {"failure", t.failure}});
  return list;
}

Json solvers_json(const TuneReport& r) {
  Json list = Json::array();
  for (const TunedSolver& s : r.ranking)
    list.push_back({{"name", short_name(s.settings)},
                    {"of_deck", short_name(s.settings) == short_name(r.own)},
                    {"state", state_name(s.state)},
                    {"note", s.note},
                    {"iterations", s.iterations()},
                    {"set_up_seconds", s.set_up_seconds()},
                    {"solve_seconds", s.solve_seconds()},
                    {"seconds", s.seconds()},
                    {"bytes", s.bytes()},
                    {"settings", settings_json(s.settings)},
                    {"systems_last_first", trials_json(s.trials)}});
  return list;
}

Json curves_json(const TuneReport& r) {
  Json list = Json::array();
  for (const ResidualCurve& c : r.curves)
    list.push_back({{"name", c.name},
                    {"of_deck", c.name == short_name(r.own)},
                    {"seconds", c.seconds},
                    {"residuals", c.residuals}});
  return list;
}

}  // namespace

const TunedSolver& TuneReport::own_result() const {
  const std::string name = short_name(own);
  return *std::find_if(ranking.begin(), ranking.end(),
                       [&](const TunedSolver& s) { return short_name(s.settings) == name; });
}

const TunedSolver* TuneReport::best() const {
  return ranking.front().state == TuneState::ranked ? &ranking.front() : nullptr;
}

double TuneReport::gain() const {
  if (best() == nullptr || own_result().state != TuneState::ranked) return 0;
  return own_result().seconds() / best()->seconds();
}

bool TuneReport::easy() const {
  const TunedSolver* solver = own_result().state == TuneState::ranked ? &own_result() : best();
  if (solver == nullptr || solver->trials.empty()) return false;
  constexpr std::size_t few = 2;
  for (std::size_t n = 0; n < solver->trials.size(); ++n)  // the last system is first
    if (static_cast<std::size_t>(solver->trials[n].iterations) >
        few * right_sides[right_sides.size() - 1 - n])
      return false;
  return true;
}

bool TuneReport::worth_it() const {
  return best() != nullptr && (gain() == 0 || gain() > worth_a_change);
}

std::string tune_text(const TuneReport& r) {
  std::string text = fmt::format("{}{}\n", r.deck, r.title.empty() ? "" : ": " + r.title);
  text += fmt::format(
      "{} unknowns on {} level{}; system{} {} of the first {} step{}{}; residual ({}) {}\n\n",
      human_count(r.unknowns), r.levels, r.levels == 1 ? "" : "s", r.numbers.size() == 1 ? "" : "s",
      numbers_text(r), r.steps, r.steps == 1 ? "" : "s",
      r.first_step > 0 ? fmt::format(" after step {}", r.first_step) : "", norm_name(r.own.norm),
      goal_text(r.own));
  text += table_of(r);
  text += fmt::format(
      "  * the deck's own solver. Processor time of set-up and all solves of a system, median over "
      "{} system{}; {} of the budget of {} spent\n\n",
      r.ranked_by, r.ranked_by == 1 ? "" : "s", human_duration(r.seconds),
      human_duration(r.budget));
  if (r.easy())
    text +=
        "note: each of these solves takes two iterations or fewer, so that they say little about "
        "later, harder ones: take systems from later steps, with a larger --budget, or with "
        "--restart from a checkpoint of a run\n\n";
  text += verdict(r);
  if (r.worth_it()) text += solver_xml(r.best()->settings);
  return text;
}

std::string tune_json(const TuneReport& r) {
  Json systems = Json::array();
  for (std::size_t n = 0; n < r.numbers.size(); ++n)
    systems.push_back({{"number", r.numbers[n]}, {"right_sides", r.right_sides[n]}});
  Json best = nullptr;
  if (r.best() != nullptr) best = short_name(r.best()->settings);
  const Json json = {{"deck", r.deck},
                     {"title", r.title},
                     {"unknowns", r.unknowns},
                     {"levels", r.levels},
                     {"steps", r.steps},
                     {"first_step", r.first_step},
                     {"two_iterations_or_fewer", r.easy()},
                     {"step_seconds", r.step_seconds},
                     {"systems", systems},
                     {"ranked_by_systems", r.ranked_by},
                     {"seconds", r.seconds},
                     {"budget", r.budget},
                     {"deck_solver", short_name(r.own)},
                     {"best", best},
                     {"gain", r.gain()},
                     {"change", r.worth_it()},
                     {"xml", r.worth_it() ? solver_xml(r.best()->settings) : ""},
                     {"solvers", solvers_json(r)},
                     {"curve_goal", r.curve_goal},
                     {"curves", curves_json(r)}};
  return json.dump(2) + "\n";
}

}  // namespace sluice

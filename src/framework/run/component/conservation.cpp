// The books are exact; each number that leaves them is rounded once.
#include "framework/run/component/conservation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

// JSON has no NaN and no infinities: they go as text.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(shortest_text(x));
}

Json words_of(const ExactSum& sum) {
  return Json(sum.canonical());
}
ExactSum sum_of(const Json& json) {
  return ExactSum::from_slots(json.get<ExactSum::Slots>());
}

Json words_of(const ConservedTotal& total) {
  return {{"sum", words_of(total.sum)}, {"magnitude", words_of(total.magnitude)}};
}
ConservedTotal total_of(const Json& json) {
  return {sum_of(json.at("sum")), sum_of(json.at("magnitude"))};
}

}  // namespace

void ConservedTotal::add(const double* q, std::size_t count) {
  sum.add(q, count);
  std::array<double, 256> sizes;
  while (count > 0) {
    const std::size_t n = std::min(count, sizes.size());
    for (std::size_t i = 0; i < n; ++i) sizes[i] = std::fabs(q[i]);
    magnitude.add(sizes.data(), n);
    q += n;
    count -= n;
  }
}

Conservation::Conservation(std::vector<std::string> names) {
  for (std::string& name : names) budgets_.push_back({std::move(name), {}, {}, {}, {}});
}

Conservation::Budget& Conservation::budget_of(int quantity) {
  return budgets_.at(quantity);
}
const Conservation::Budget& Conservation::budget_of(int quantity) const {
  return budgets_.at(quantity);
}

const std::string& Conservation::name(int quantity) const {
  return budget_of(quantity).name;
}

void Conservation::set_start(int quantity, const ConservedTotal& total) {
  Budget& b = budget_of(quantity);
  b = {b.name, total, total, {}, {}};
}

void Conservation::set_now(int quantity, const ConservedTotal& total) {
  budget_of(quantity).now = total;
}

void Conservation::add_boundary(int quantity, const ConservedTotal& inflow) {
  budget_of(quantity).boundary.merge(inflow);
}

void Conservation::add_sources(int quantity, const ConservedTotal& added) {
  budget_of(quantity).sources.merge(added);
}

double Conservation::start(int quantity) const {
  return budget_of(quantity).start.sum.value();
}
double Conservation::now(int quantity) const {
  return budget_of(quantity).now.sum.value();
}
double Conservation::boundary(int quantity) const {
  return budget_of(quantity).boundary.sum.value();
}
double Conservation::sources(int quantity) const {
  return budget_of(quantity).sources.sum.value();
}

double Conservation::defect(int quantity) const {
  const Budget& b = budget_of(quantity);
  ExactSum sum = b.now.sum;
  sum.subtract(b.start.sum);
  sum.subtract(b.boundary.sum);
  sum.subtract(b.sources.sum);
  return sum.value();
}

void Conservation::set_vector(int first, int components, double at_rest) {
  vector_ = {first, components, at_rest};
}

double Conservation::own_scale(int quantity) const {
  const Budget& b = budget_of(quantity);
  ExactSum passed = b.boundary.magnitude;
  passed.merge(b.sources.magnitude);
  return std::max({b.start.magnitude.value(), b.now.magnitude.value(), passed.value()});
}

double Conservation::scale(int quantity) const {
  constexpr double round_off = 1e-10;
  const int end = vector_.first + vector_.components;
  if (quantity < vector_.first || quantity >= end) return own_scale(quantity);
  double largest = 0;
  for (int q = vector_.first; q < end; ++q) largest = std::max(largest, own_scale(q));
  return largest < round_off * vector_.at_rest ? vector_.at_rest : largest;
}

double Conservation::drift(int quantity) const {
  const double difference = defect(quantity);
  return difference == 0 ? 0 : difference / scale(quantity);
}

double Conservation::worst_drift() const {
  double worst = 0;
  for (int quantity = 0; quantity < count(); ++quantity) {
    const double size = std::fabs(drift(quantity));
    if (!(size <= worst)) worst = size;  // a NaN is the worst of all, and stays
    if (std::isnan(worst)) break;
  }
  return worst;
}

Json Conservation::to_json() const {
  Json json = Json::object();
  for (int quantity = 0; quantity < count(); ++quantity) {
    json[name(quantity)] = {
        {"start", number(start(quantity))},       {"now", number(now(quantity))},
        {"boundary", number(boundary(quantity))}, {"sources", number(sources(quantity))},
        {"defect", number(defect(quantity))},     {"scale", number(scale(quantity))},
        {"drift", number(drift(quantity))}};
  }
  return json;
}

std::string Conservation::table() const {
  constexpr auto right = TextTable::Align::right;
  TextTable table({{"conserved"},
                   {"start", right},
                   {"now", right},
                   {"boundary", right},
                   {"sources", right},
                   {"drift", right}});
  for (int quantity = 0; quantity < count(); ++quantity) {
    table.row({name(quantity), fmt::format("{:.9g}", start(quantity)),
               fmt::format("{:.9g}", now(quantity)), fmt::format("{:.4g}", boundary(quantity)),
               fmt::format("{:.4g}", sources(quantity)), fmt::format("{:.2e}", drift(quantity))});
  }
  return table.text();
}

Json Conservation::checkpoint() const {
  Json json = Json::array();
  for (const Budget& b : budgets_) {
    json.push_back({{"name", b.name},
                    {"start", words_of(b.start)},
                    {"boundary", words_of(b.boundary)},
                    {"sources", words_of(b.sources)}});
  }
  return json;
}

void Conservation::restore(const Json& json) {
  try {
    if (json.size() != budgets_.size()) {
      throw InputError(fmt::format("the checkpoint contains {} conserved quantities, this run {}",
                                   json.size(), budgets_.size()));
    }
    std::vector<Budget> restored;
    for (std::size_t i = 0; i < budgets_.size(); ++i) {
      const Json& entry = json.at(i);
      const auto found = entry.at("name").get<std::string>();
      if (found != budgets_[i].name) {
        throw InputError(fmt::format(
            "the checkpoint contains the conserved quantity '{}' where this run has '{}'", found,
            budgets_[i].name));
      }
      restored.push_back({found, total_of(entry.at("start")), budgets_[i].now,
                          total_of(entry.at("boundary")), total_of(entry.at("sources"))});
    }
    budgets_ = std::move(restored);
  } catch (const JsonError& error) {
    throw InputError(fmt::format(
        "the conserved totals of a checkpoint cannot be read: {}\n  restart from an earlier "
        "checkpoint",
        error.what()));
  }
}

}  // namespace sluice

// The order of places makes "first" and "last" independent of who reports when.
#include "framework/run/component/event_ledger.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

// Doubles as integers of the same order; all NaN are one.
std::int64_t order_of(double x) {
  if (std::isnan(x)) return std::numeric_limits<std::int64_t>::max();
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : bits ^ std::numeric_limits<std::int64_t>::max();
}

IntVec3 cell_or_lowest(const EventPlace& place) {
  return place.cell.value_or(IntVec3::all(std::numeric_limits<int>::min()));
}

// JSON has no NaN and no infinities: they go as text.
Json value_to_json(double x) {
  return std::isfinite(x) ? Json(x) : Json(shortest_text(x));
}
double value_from_json(const Json& json) {
  return json.is_text() ? std::strtod(json.get<std::string>().c_str(), nullptr)
                        : json.get<double>();
}

Json place_json(const EventPlace& place) {
  Json json = {{"step", place.step},
               {"level", place.level},
               {"material", place.material},
               {"task", place.task},
               {"value", value_to_json(place.value)}};
  if (place.cell) json["cell"] = {place.cell->x, place.cell->y, place.cell->z};
  return json;
}

EventPlace place_from_json(const Json& json) {
  EventPlace place;
  place.step = json.at("step").get<int>();
  place.level = json.at("level").get<int>();
  place.material = json.at("material").get<int>();
  place.task = json.at("task").get<std::string>();
  place.value = value_from_json(json.at("value"));
  if (json.contains("cell")) {
    const Json& cell = json.at("cell");
    place.cell = IntVec3{cell.at(0).get<int>(), cell.at(1).get<int>(), cell.at(2).get<int>()};
  }
  return place;
}

EventRecord single(const EventPlace& place, std::int64_t count, bool common) {
  EventRecord record;
  record.count = count;
  record.first = place;
  record.last = place;
  record.common = common;
  return record;
}

void merge_into(std::map<std::string, EventRecord>& into, const std::string& name,
                const EventRecord& record) {
  into[name].merge(record);
}

}  // namespace

bool operator<(const EventPlace& a, const EventPlace& b) {
  const IntVec3 p = cell_or_lowest(a);
  const IntVec3 q = cell_or_lowest(b);
  const auto key = [](const EventPlace& e, const IntVec3& cell) {
    return std::make_tuple(e.step, e.level, cell.z, cell.y, cell.x, e.material, e.task,
                           order_of(e.value));
  };
  return key(a, p) < key(b, q);
}

std::string to_string(const EventPlace& place) {
  std::string text = fmt::format("step {}", place.step);
  if (!place.task.empty()) text += fmt::format(", {}", place.task);
  if (place.cell) {
    text += fmt::format(", cell [{}, {}, {}] of level {}", place.cell->x, place.cell->y,
                        place.cell->z, place.level);
  }
  if (place.material >= 0) text += fmt::format(", material {}", place.material);
  return text + fmt::format(", value {:.6g}", place.value);
}

void EventRecord::merge(const EventRecord& other) {
  if (other.count == 0) return;
  if (count == 0 || other.first < first) first = other.first;
  if (count == 0 || last < other.last) last = other.last;
  common = common || other.common;
  count += other.count;
}

struct EventLedger::Attempt {
  std::mutex mutex;
  std::map<std::string, EventRecord> events;  // forgotten when the step is rejected
  std::map<std::string, EventRecord> kept;    // counted in any case
};

EventLedger::EventLedger() : attempt_(std::make_unique<Attempt>()) {}
EventLedger::~EventLedger() = default;
EventLedger::EventLedger(EventLedger&&) noexcept = default;
EventLedger& EventLedger::operator=(EventLedger&&) noexcept = default;

void EventLedger::record(std::string_view name, const EventPlace& place, std::int64_t count) {
  const std::scoped_lock lock(attempt_->mutex);
  EventPlace whole = place;
  if (whole.step == 0) whole.step = step_;
  merge_into(attempt_->events, std::string(name), single(whole, count, false));
}

void EventLedger::keep(std::string_view name, const EventPlace& place) {
  const std::scoped_lock lock(attempt_->mutex);
  merge_into(attempt_->kept, std::string(name), single(place, 1, true));
}

void EventLedger::accept_step() {
  const std::scoped_lock lock(attempt_->mutex);
  for (const auto& [name, record] : attempt_->events) merge_into(records_, name, record);
  for (const auto& [name, record] : attempt_->kept) merge_into(records_, name, record);
  attempt_->events.clear();
  attempt_->kept.clear();
}

void EventLedger::reject_step() {
  const std::scoped_lock lock(attempt_->mutex);
  attempt_->events.clear();
  for (const auto& [name, record] : attempt_->kept) merge_into(records_, name, record);
  attempt_->kept.clear();
}

std::int64_t EventLedger::total() const {
  std::int64_t sum = 0;
  for (const auto& [name, record] : records_) sum += record.count;
  return sum;
}

EventLedger EventLedger::merge_ranks(Communicator& ranks) const {
  EventLedger result;
  const std::vector<std::string> texts = ranks.gather(to_json().dump());
  for (std::size_t rank = 0; rank < texts.size(); ++rank) {
    const EventLedger part = from_json(Json::parse(texts[rank]));
    for (const auto& [name, record] : part.records_) {
      if (record.common && rank > 0) continue;  // rank 0 has told it already
      merge_into(result.records_, name, record);
    }
  }
  return result;
}

Json EventLedger::to_json() const {
  Json json = Json::object();
  for (const auto& [name, record] : records_) {
    json[name] = {{"count", record.count},
                  {"first", place_json(record.first)},
                  {"last", place_json(record.last)}};
    if (record.common) json[name]["common"] = true;
  }
  return json;
}

EventLedger EventLedger::from_json(const Json& json) {
  EventLedger ledger;
  for (const auto& [name, entry] : json.members()) {
    EventRecord record;
    record.count = entry.at("count").get<std::int64_t>();
    record.first = place_from_json(entry.at("first"));
    record.last = place_from_json(entry.at("last"));
    record.common = entry.value("common", false);
    ledger.records_[name] = record;
  }
  return ledger;
}

std::string EventLedger::table() const {
  if (empty()) return "no events: every step was accepted as computed\n";
  TextTable table({{"event"}, {"count", TextTable::Align::right}, {"first"}, {"last"}});
  for (const auto& [name, record] : records_) {
    table.row({name, human_count(record.count), to_string(record.first), to_string(record.last)});
  }
  return table.text();
}

}  // namespace sluice

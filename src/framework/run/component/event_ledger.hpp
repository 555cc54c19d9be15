// What went wrong on the way and was dealt with: counted by name, with where it was first and last.
//
// Retries, first-order faces, solver fallbacks: every one is an event; a smooth case has none.
// An attempt at a step collects its events apart: they count when the step is accepted and are
// dropped when it is rejected, so that the ledger tells of the solution that was kept. What must
// be told in any case (the retry itself) is recorded with keep().
//
// First and last are by (step, level, k, j, i, material, task, value), never by time of arrival,
// and counts are integers: the ledger is the same on any number of threads, boxes and ranks, when
// each cell's event is recorded once, by the box that owns the cell.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "framework/base/vec3.hpp"

namespace sluice {

class Json;
class Communicator;

struct EventPlace {
  int step = 0;
  int level = 0;
  std::optional<IntVec3> cell;
  int material = -1;  // -1: none in particular
  std::string task;
  double value = 0;  // what was found, in the unit of what the event is about

  // A total order: NaN above all numbers.
  friend bool operator<(const EventPlace& a, const EventPlace& b);
};
std::string to_string(const EventPlace& place);

struct EventRecord {
  std::int64_t count = 0;
  EventPlace first, last;
  // Known to all ranks alike (a rejected step): counted once, not once a rank.
  bool common = false;

  void merge(const EventRecord& other);
};

class EventLedger {
 public:
  EventLedger();
  ~EventLedger();
  EventLedger(EventLedger&&) noexcept;
  EventLedger& operator=(EventLedger&&) noexcept;

  // The step that is attempted: of what is recorded without a number of its own.
  void begin_step(int step) { step_ = step; }
  // Something in this attempt at the step. May be called by several threads at once.
  void record(std::string_view name, const EventPlace& place, std::int64_t count = 1);
  // Something that all ranks know and that counts although the attempt may be rejected.
  void keep(std::string_view name, const EventPlace& place);

  // The attempt is over: count what it recorded, or forget it.
  void accept_step();
  void reject_step();

  // Events of accepted steps, by name. After merge_ranks() those of all ranks, on rank 0.
  const std::map<std::string, EventRecord>& records() const { return records_; }
  std::int64_t total() const;
  bool empty() const { return records_.empty(); }

  // Collective: the ledger of the whole run, on rank 0; empty elsewhere. This one stays as it is.
  EventLedger merge_ranks(Communicator& ranks) const;

  // {name: {count, first: {step, level, cell, material, task, value}, last: {...}}}
  Json to_json() const;
  static EventLedger from_json(const Json& json);
  // A table of one line an event, or one sentence that there was none.
  std::string table() const;

 private:
  struct Attempt;
  std::map<std::string, EventRecord> records_;
  int step_ = 0;
  std::unique_ptr<Attempt> attempt_;  // guarded: events come from many threads
};

}  // namespace sluice

// Adding up counts of messages; the communicator counts.
#include "framework/base/message_counts.hpp"

namespace sluice {
namespace {

constexpr MessageCount MessageCounts::*kinds[] = {
    &MessageCounts::reductions,     &MessageCounts::sums,       &MessageCounts::gathers,
    &MessageCounts::gathers_to_all, &MessageCounts::broadcasts, &MessageCounts::barriers,
    &MessageCounts::sends};

}  // namespace

MessageCounts& MessageCounts::operator+=(const MessageCounts& other) {
  for (const auto kind : kinds) {
    (this->*kind).calls += (other.*kind).calls;
    (this->*kind).bytes += (other.*kind).bytes;
  }
  return *this;
}

MessageCounts operator-(const MessageCounts& now, const MessageCounts& before) {
  MessageCounts between = now;
  for (const auto kind : kinds) {
    (between.*kind).calls -= (before.*kind).calls;
    (between.*kind).bytes -= (before.*kind).bytes;
  }
  return between;
}

MessageCount MessageCounts::collectives() const {
  MessageCount all;
  for (const auto kind : kinds) {
    if (kind == &MessageCounts::sends) continue;
    all.calls += (this->*kind).calls;
    all.bytes += (this->*kind).bytes;
  }
  return all;
}

}  // namespace sluice

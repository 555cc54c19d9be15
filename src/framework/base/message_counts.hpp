// How often this process has called MPI through the communicator, and with how many bytes.
//
// Always counted; a serial run calls MPI for nothing and counts nothing. What a library (hypre)
// sends by itself is not counted.
#pragma once
#include <cstdint>

namespace sluice {

// Bytes: of a reduction or a broadcast its data; of a gather what this rank gives; of a gather to
// all what this rank receives; of a message what this rank sends.
struct MessageCount {
  std::int64_t calls = 0, bytes = 0;

  void add(std::uint64_t size) {
    ++calls;
    bytes += static_cast<std::int64_t>(size);
  }
  bool operator==(const MessageCount&) const = default;
};

// Texts are gathered and broadcast in two calls: their lengths, then what they say.
struct MessageCounts {
  MessageCount reductions;  // exact sums, minima, maxima, counts
  MessageCount sums;        // of arrays of whole numbers
  MessageCount gathers, gathers_to_all, broadcasts, barriers;
  MessageCount sends;  // to single ranks; each is received once

  MessageCounts& operator+=(const MessageCounts& other);
  bool operator==(const MessageCounts&) const = default;

  MessageCount collectives() const;  // all but sends
  // act(name, count) for each kind, in the order above.
  template <class F>
  void for_each(F&& act) const {
    act("reductions", reductions);
    act("sums", sums);
    act("gathers", gathers);
    act("gathers_to_all", gathers_to_all);
    act("broadcasts", broadcasts);
    act("barriers", barriers);
    act("sends", sends);
  }
};

MessageCounts operator-(const MessageCounts& now, const MessageCounts& before);

// Since the start of the process or the last reset.
const MessageCounts& message_counts();
void reset_message_counts();

}  // namespace sluice

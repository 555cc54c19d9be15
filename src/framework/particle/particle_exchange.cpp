// Numbers of particles first, then the particles.
#include "framework/particle/particle_exchange.hpp"

#include <algorithm>
#include <cstring>

#include "framework/base/reduction.hpp"

namespace sluice {
namespace {

constexpr int tag = 41, count_tag = 42;  // of messages with particles, with their number

// Does any rank send particles beyond its neighbours.
bool any_goes_far(const std::vector<ParticleSet>& leaving, const std::vector<int>& neighbours,
                  Communicator& communicator) {
  bool far = false;
  for (int r = 0; r < communicator.size(); ++r)
    far = far || (r != communicator.rank() && !leaving[r].empty() &&
                  !std::binary_search(neighbours.begin(), neighbours.end(), r));
  Reduction all;
  const auto slot = all.add_any(far);
  communicator.reduce(all);
  return all.any(slot);
}

// counts[r]: particles that rank r has for this one, where only neighbours have some.
std::vector<std::size_t> counts_of_neighbours(const std::vector<ParticleSet>& leaving,
                                              const std::vector<int>& neighbours) {
  std::vector<double> in(neighbours.size()), out(neighbours.size());
  Messages messages;
  for (std::size_t n = 0; n < neighbours.size(); ++n)
    messages.post_receive(&in[n], 1, neighbours[n], count_tag);
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    out[n] = static_cast<double>(leaving[neighbours[n]].size());
    messages.post_send(&out[n], 1, neighbours[n], count_tag);
  }
  messages.wait_all();
  std::vector<std::size_t> counts(leaving.size());
  for (std::size_t n = 0; n < neighbours.size(); ++n)
    counts[neighbours[n]] = static_cast<std::size_t>(in[n]);
  return counts;
}

// The same, whoever has some.
std::vector<std::size_t> counts_of_all(const std::vector<ParticleSet>& leaving,
                                       Communicator& communicator) {
  std::vector<std::uint64_t> mine;
  for (const ParticleSet& set : leaving) mine.push_back(set.size());
  const std::string text(reinterpret_cast<const char*>(mine.data()),
                         mine.size() * sizeof(std::uint64_t));
  std::vector<std::size_t> counts;
  for (const std::string& of_rank : communicator.gather_to_all(text)) {
    std::uint64_t count = 0;
    std::memcpy(&count, of_rank.data() + communicator.rank() * sizeof count, sizeof count);
    counts.push_back(count);
  }
  return counts;
}

}  // namespace

ParticleSet exchange_particles(const std::vector<ParticleSet>& leaving,
                               const std::vector<int>& neighbours, Communicator& communicator) {
  const std::size_t rank = communicator.rank();
  ParticleSet arrived = leaving[rank];
  if (communicator.size() == 1) return arrived;
  const std::vector<std::size_t> counts = any_goes_far(leaving, neighbours, communicator)
                                              ? counts_of_all(leaving, communicator)
                                              : counts_of_neighbours(leaving, neighbours);
  const std::size_t size = arrived.packed_size(), ranks = leaving.size();
  std::vector<std::vector<double>> in(ranks), out(ranks);
  Messages messages;
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == rank || counts[r] == 0) continue;
    in[r].resize(counts[r] * size);
    messages.post_receive(in[r].data(), in[r].size(), static_cast<int>(r), tag);
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == rank || leaving[r].empty()) continue;
    out[r].resize(leaving[r].size() * size);
    for (std::size_t n = 0; n < leaving[r].size(); ++n)
      leaving[r].pack(n, out[r].data() + n * size);
    messages.post_send(out[r].data(), out[r].size(), static_cast<int>(r), tag);
  }
  messages.wait_all();
  for (const std::vector<double>& from : in)
    for (std::size_t at = 0; at < from.size(); at += size) arrived.add_packed(from.data() + at);
  return arrived;
}

}  // namespace sluice

#include "mpmice/fields/thread_ranges.hpp"

#include <algorithm>
#include <vector>

namespace sluice::mpmice {
namespace {

constexpr std::size_t least = 512;      // numbers in a range
constexpr std::size_t ranges_each = 4;  // of a thread, so that none waits long for another

}  // namespace

std::size_t range_count(const ThreadTeam& team, std::size_t count) {
  if (team.size() == 1) return 1;
  const std::size_t most = ranges_each * static_cast<std::size_t>(team.size());
  return std::clamp<std::size_t>(count / least, 1, most);
}

void for_each_range(const ThreadTeam& team, std::size_t count, const RangeWork& work) {
  const std::size_t ranges = range_count(team, count);
  team.for_each(ranges, [&](std::size_t n, int thread) {
    work(count * n / ranges, count * (n + 1) / ranges, n, thread);
  });
}

template <int D>
void add_in_ranges(const ThreadTeam& team, std::size_t count, CellSums<D>& to,
                   const AddRange<D>& add) {
  if (range_count(team, count) == 1) return add(0, count, 0, to);
  // Of the threads but the first, which adds to the whole at once.
  std::vector<CellSums<D>> own(static_cast<std::size_t>(team.size() - 1));
  std::vector<std::uint8_t> begun(own.size(), 0);
  for_each_range(team, count,
                 [&](std::size_t begin, std::size_t end, std::size_t range, int thread) {
                   if (thread == 0) return add(begin, end, range, to);
                   const auto k = static_cast<std::size_t>(thread - 1);
                   if (begun[k] == 0) own[k].begin(to.cells(), to.lanes());
                   begun[k] = 1;
                   add(begin, end, range, own[k]);
                 });
  for (std::size_t k = 0; k < own.size(); ++k)
    if (begun[k] != 0) to.merge(own[k]);
}

template void add_in_ranges<1>(const ThreadTeam&, std::size_t, CellSums<1>&, const AddRange<1>&);
template void add_in_ranges<2>(const ThreadTeam&, std::size_t, CellSums<2>&, const AddRange<2>&);
template void add_in_ranges<3>(const ThreadTeam&, std::size_t, CellSums<3>&, const AddRange<3>&);

}  // namespace sluice::mpmice

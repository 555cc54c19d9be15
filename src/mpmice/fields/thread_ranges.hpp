// Loops of a rank's threads over particles, pieces or cells: ranges of their numbers, and sums in
// cells that each thread has of its own. Sums are exact integers: no bit depends on threads.
#pragma once
#include <functional>

#include "framework/task/thread_team.hpp"
#include "mpmice/geometry/cell_sums.hpp"

namespace sluice::mpmice {

// How many ranges for_each_range makes of so many numbers.
std::size_t range_count(const ThreadTeam& team, std::size_t count);

// work(begin, end, range, thread) for ranges that cover 0 to count - 1 in order; each once.
using RangeWork = std::function<void(std::size_t begin, std::size_t end, std::size_t range, int)>;
void for_each_range(const ThreadTeam& team, std::size_t count, const RangeWork& work);

// add(begin, end, range, sums) for these ranges, with sums of the thread; then all are in `to`,
// which has begun.
template <int D>
using AddRange =
    std::function<void(std::size_t begin, std::size_t end, std::size_t range, CellSums<D>& sums)>;
template <int D>
void add_in_ranges(const ThreadTeam& team, std::size_t count, CellSums<D>& to,
                   const AddRange<D>& add);

}  // namespace sluice::mpmice

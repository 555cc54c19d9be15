// Start, errors and slabs.
#include "framework/solve/hypre_tools.hpp"

#include <fmt/format.h>

#include <cstring>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"

namespace sluice::solve {
namespace {

Slab slab_of_rank(const DenseShape& shape, int rank) {
  const int direction = shape.deep() ? 2 : 1;
  const std::int64_t n = shape.count[direction];
  const int ranks = world().size();
  return {direction, static_cast<int>(n * rank / ranks), static_cast<int>(n * (rank + 1) / ranks),
          shape};
}

std::string words_of(HYPRE_Int code) {
  char text[2048] = {};  // far more than any of its descriptions
  HYPRE_DescribeError(code, text);
  std::string words(text);
  while (!words.empty() && (words.back() == '\n' || words.back() == ' ')) words.pop_back();
  return words;
}

}  // namespace

void start_hypre() {
  static const bool started = [] {
    world().start_mpi();
    check_hypre(HYPRE_Init(), "HYPRE_Init");
    return true;
  }();
  static_cast<void>(started);
  HYPRE_ClearAllErrors();
}

void check_hypre(HYPRE_Int code, const char* call) {
  if (code == 0) return;
  HYPRE_ClearAllErrors();
  throw SystemError(fmt::format("hypre: {} failed with code {}: {}", call, code, words_of(code)));
}

std::string take_hypre_failure() {
  const HYPRE_Int code = HYPRE_GetError();
  HYPRE_ClearAllErrors();
  if (code == 0 || code == HYPRE_ERROR_CONV) return {};
  return fmt::format("hypre's code {}: {}", code, words_of(code));
}

std::array<int, 3> Slab::lower() const {
  std::array<int, 3> cell{};
  cell[direction] = begin;
  return cell;
}

std::array<int, 3> Slab::upper() const {
  std::array<int, 3> cell{shape.count[0] - 1, shape.count[1] - 1, shape.count[2] - 1};
  cell[direction] = end - 1;
  return cell;
}

std::size_t Slab::cells() const {
  const std::size_t all = shape.cells();
  const int slices = shape.count[direction];
  return all / slices * (end - begin);
}

std::int64_t Slab::first_row() const {
  const int slices = shape.count[direction];
  return static_cast<std::int64_t>(shape.cells()) / slices * begin;
}

Slab slab_of(const DenseSystem& system) {
  Slab slab = slab_of_rank(system.shape(), world().rank());
  if (system.slabs().shared()) {
    slab.begin = system.slabs().begin();
    slab.end = system.slabs().end();
  }
  return slab;
}

void take_solution(const DenseSystem& system, const Slab& slab, const std::vector<double>& own,
                   DenseVector& v) {
  const auto put = [&v](const Slab& from, const char* bytes) {
    from.for_cells([&](std::ptrdiff_t c) {
      std::memcpy(&v[c], bytes, sizeof(double));
      bytes += sizeof(double);
    });
  };
  const auto* raw = reinterpret_cast<const char*>(own.data());
  if (world().size() == 1 || system.slabs().shared()) return put(slab, raw);
  const auto all = world().gather_to_all(std::string(raw, own.size() * sizeof(double)));
  for (int rank = 0; rank < world().size(); ++rank)
    put(slab_of_rank(slab.shape, rank), all[rank].data());
}

}  // namespace sluice::solve

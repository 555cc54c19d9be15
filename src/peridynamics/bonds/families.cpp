#include "peridynamics/bonds/families.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>

#include "peridynamics/bonds/family_search.hpp"

namespace sluice::peridynamics {
namespace {

constexpr int chunks_of_tile = 32;
// Rows in which neighbours stand side by side may be more than the longest family by this share.
constexpr double aligned_excess = 1.25;

std::vector<BondChunk> chunks_of(const PointTable& points) {
  std::vector<BondChunk> chunks;
  for (int i = PointTable::margin; i + PointTable::margin < points.size(); ++i) {
    if (!points.is_own(i)) continue;
    if (chunks.empty() || chunks.back().lanes == 8 ||
        chunks.back().first + chunks.back().lanes != i)
      chunks.push_back({i, 1});
    else
      ++chunks.back().lanes;
  }
  return chunks;
}

// The rows of a tile as they are made.
struct RowsInWork {
  std::vector<std::int32_t> base, index;
  std::vector<double> r;
  std::vector<float> w;

  void clear() {
    base.clear();
    index.clear();
    r.clear();
    w.clear();
  }
};

// Lists of neighbours of the points of a chunk become rows.
class RowWriter {
 public:
  RowWriter(RowsInWork& rows, const PointTable& points) : rows_(&rows), points_(&points) {}

  void write(BondChunk& chunk, const std::vector<Neighbour> (&lists)[8]) {
    chunk.begin = static_cast<std::uint32_t>(rows_->base.size());
    std::size_t longest = 0;
    for (int l = 0; l < chunk.lanes; ++l) {
      longest = std::max(longest, lists[l].size());
      for (const Neighbour& n : lists[l])
        chunk.meets_ghosts = chunk.meets_ghosts || !points_->is_own(n.entry);
    }
    join_offsets(chunk, lists);
    if (static_cast<double>(offsets_.size()) <= aligned_excess * static_cast<double>(longest))
      write_aligned(chunk, lists);
    else
      write_gathered(chunk, lists, longest);
    chunk.end = static_cast<std::uint32_t>(rows_->base.size());
  }

 private:
  // All offsets of neighbours from their points, rising, each once.
  void join_offsets(const BondChunk& chunk, const std::vector<Neighbour> (&lists)[8]) {
    constexpr int none = std::numeric_limits<int>::max();
    std::size_t next[8] = {};
    int heads[8];
    const auto head = [&](int l) {
      const std::size_t n = static_cast<std::size_t>(l);
      return l < chunk.lanes && next[n] < lists[n].size()
                 ? lists[n][next[n]].entry - chunk.first - l
                 : none;
    };
    for (int l = 0; l < 8; ++l) heads[l] = head(l);
    offsets_.clear();
    for (;;) {
      int least = none;
      for (const int h : heads) least = std::min(least, h);
      if (least == none) return;
      offsets_.push_back(least);
      for (int l = 0; l < 8; ++l)
        if (heads[l] == least) {
          ++next[static_cast<std::size_t>(l)];
          heads[l] = head(l);
        }
    }
  }
  // A row for each offset of an entry, which rises as the neighbours of each point do.
  void write_aligned(const BondChunk& chunk, const std::vector<Neighbour> (&lists)[8]) {
    std::size_t next[8] = {};
    for (const int offset : offsets_) {
      rows_->base.push_back(chunk.first + offset);
      add_row();
      for (std::size_t l = 0; l < static_cast<std::size_t>(chunk.lanes); ++l)
        if (next[l] < lists[l].size() &&
            lists[l][next[l]].entry == chunk.first + offset + static_cast<int>(l))
          put(l, lists[l][next[l]++]);
    }
  }
  void write_gathered(const BondChunk& chunk, const std::vector<Neighbour> (&lists)[8],
                      std::size_t longest) {
    for (std::size_t k = 0; k < longest; ++k) {
      rows_->base.push_back(~static_cast<std::int32_t>(rows_->index.size() / 8));
      add_row();
      for (std::size_t l = 0; l < 8; ++l) {
        const bool has = static_cast<int>(l) < chunk.lanes && k < lists[l].size();
        rows_->index.push_back(has ? lists[l][k].entry : chunk.first);
        if (has) put(l, lists[l][k]);
      }
    }
  }
  void add_row() {
    rows_->r.insert(rows_->r.end(), 8, 1.0);
    rows_->w.insert(rows_->w.end(), 8, 0.0f);
  }
  void put(std::size_t lane, const Neighbour& n) {
    rows_->r[rows_->r.size() - 8 + lane] = n.r;
    if (!n.cut) rows_->w[rows_->w.size() - 8 + lane] = n.w;
  }

  RowsInWork* rows_;
  const PointTable* points_;
  std::vector<int> offsets_;
};

// What threads find wrong; the first is thrown.
class FirstFault {
 public:
  void keep() {
    const std::lock_guard lock(mutex_);
    if (!fault_) fault_ = std::current_exception();
  }
  void rethrow() const {
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr fault_;
};

}  // namespace

std::size_t Families::bytes() const {
  std::size_t sum = 0;
  for (const BondMemory& part : memory) sum += part.bytes();
  return sum;
}

Families find_families(const PointTable& points, const PeriScene& scene, const ThreadTeam* team) {
  const PointRows rows(points);
  const std::vector<BondChunk> chunks = chunks_of(points);
  Families all;
  const std::size_t size = static_cast<std::size_t>(points.size());
  for (Column* column : {&all.sums.m, &all.sums.s, &all.sums.volume, &all.sums.intact})
    column->assign(size, 0.0);
  all.sums.neighbours.assign(size, 0);
  all.tiles.resize((chunks.size() + chunks_of_tile - 1) / chunks_of_tile);
  struct Count {
    std::int64_t bonds = 0, cut = 0;
    int largest = 0;
  };
  std::vector<Count> counts(all.tiles.size());
  FirstFault fault;
  // Of a thread; its memory serves one tile after the other.
  struct Bench {
    RowsInWork rows;
    std::vector<Neighbour> lists[8];
  };
  const std::size_t threads = static_cast<std::size_t>(team != nullptr ? team->size() : 1);
  std::vector<Bench> benches(threads);
  all.memory.resize(threads);
  const auto work = [&](std::size_t t, int thread) {
    FamilySearch search(points, rows, scene);
    auto& [made, lists] = benches[static_cast<std::size_t>(thread)];
    made.clear();
    BondTile& tile = all.tiles[t];
    RowWriter writer(made, points);
    const std::size_t begin = t * chunks_of_tile;
    for (std::size_t c = begin; c < std::min(chunks.size(), begin + chunks_of_tile); ++c) {
      BondChunk& chunk = tile.chunks.emplace_back(chunks[c]);
      for (int l = 0; l < chunk.lanes; ++l) {
        search.find(chunk.first + l, lists[l]);
        const std::size_t i = static_cast<std::size_t>(chunk.first + l);
        // m = sum w r^2 V, S = sum w r V.
        for (const Neighbour& n : lists[l]) {
          const double V = points.V[static_cast<std::size_t>(n.entry)], w = n.w;
          all.sums.m[i] += w * n.r * n.r * V;
          all.sums.s[i] += w * n.r * V;
          all.sums.volume[i] += n.beta * V;
          if (!n.cut) all.sums.intact[i] += n.beta * V;
          all.sums.neighbours[i] += n.cut ? 0 : 1;
          counts[t].cut += n.cut ? 1 : 0;
        }
        counts[t].bonds += static_cast<std::int64_t>(lists[l].size());
        counts[t].largest = std::max(counts[t].largest, static_cast<int>(lists[l].size()));
      }
      writer.write(chunk, lists);
    }
    BondMemory& memory = all.memory[static_cast<std::size_t>(thread)];
    tile.base = memory.keep(made.base);
    tile.index = memory.keep(made.index);
    tile.r = memory.keep(made.r);
    tile.w = memory.keep(made.w);
  };
  const auto guarded = [&](std::size_t t, int thread) {
    try {
      work(t, thread);
    } catch (...) {
      fault.keep();
    }
  };
  if (team != nullptr)
    team->for_each(all.tiles.size(), guarded);
  else
    for (std::size_t t = 0; t < all.tiles.size(); ++t) guarded(t, 0);
  fault.rethrow();
  for (const Count& c : counts) {
    all.bonds += c.bonds;
    all.cut += c.cut;
    all.largest = std::max(all.largest, c.largest);
  }
  return all;
}

}  // namespace sluice::peridynamics

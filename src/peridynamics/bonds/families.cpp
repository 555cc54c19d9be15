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

namespace {

// Finds the families of one tile after the other; one a thread, whose memory serves all its tiles.
class TileMaker {
 public:
  TileMaker(const PointTable& points, const PointRows& rows, const PeriScene& scene)
      : points_(&points), rows_(&rows), scene_(&scene) {}

  // The next chunks of a tile, bonds to `memory`, sums to `all`.
  void make(std::span<const BondChunk> chunks, Families& all, BondTile& tile, BondMemory& memory) {
    FamilySearch search(*points_, *rows_, *scene_);
    made_.clear();
    RowWriter writer(made_, *points_);
    for (const BondChunk& from : chunks) {
      BondChunk& chunk = tile.chunks.emplace_back(from);
      for (int l = 0; l < chunk.lanes; ++l) {
        search.find(chunk.first + l, lists_[l]);
        add(static_cast<std::size_t>(chunk.first + l), lists_[l], all.sums);
      }
      writer.write(chunk, lists_);
    }
    tile.base = memory.keep(made_.base);
    tile.index = memory.keep(made_.index);
    tile.r = memory.keep(made_.r);
    tile.w = memory.keep(made_.w);
  }

  std::int64_t bonds = 0, cut = 0;
  int largest = 0;

 private:
  // m = sum w r^2 V, S = sum w r V.
  void add(std::size_t i, const std::vector<Neighbour>& list, FamilySums& sums) {
    for (const Neighbour& n : list) {
      const double V = points_->V[static_cast<std::size_t>(n.entry)], w = n.w;
      sums.m[i] += w * n.r * n.r * V;
      sums.s[i] += w * n.r * V;
      sums.volume[i] += n.beta * V;
      if (!n.cut) sums.intact[i] += n.beta * V;
      sums.neighbours[i] += n.cut ? 0 : 1;
      cut += n.cut ? 1 : 0;
    }
    bonds += static_cast<std::int64_t>(list.size());
    largest = std::max(largest, static_cast<int>(list.size()));
  }

  const PointTable* points_;
  const PointRows* rows_;
  const PeriScene* scene_;
  RowsInWork made_;
  std::vector<Neighbour> lists_[8];
};

void make_room(std::size_t size, FamilySums& sums) {
  for (Column* column : {&sums.m, &sums.s, &sums.volume, &sums.intact}) column->assign(size, 0.0);
  sums.neighbours.assign(size, 0);
}

}  // namespace

Families find_families(const PointTable& points, const PeriScene& scene, const ThreadTeam* team) {
  const PointRows rows(points);
  const std::vector<BondChunk> chunks = chunks_of(points);
  Families all;
  make_room(static_cast<std::size_t>(points.size()), all.sums);
  all.tiles.resize((chunks.size() + chunks_of_tile - 1) / chunks_of_tile);
  const std::size_t threads = static_cast<std::size_t>(team != nullptr ? team->size() : 1);
  std::vector<TileMaker> makers(threads, TileMaker(points, rows, scene));
  all.memory.resize(threads);
  FirstFault fault;
  const auto work = [&](std::size_t t, int thread) {
    const std::size_t begin = t * chunks_of_tile, n = static_cast<std::size_t>(thread);
    const std::size_t end = std::min(chunks.size(), begin + chunks_of_tile);
    try {
      makers[n].make(std::span(chunks).subspan(begin, end - begin), all, all.tiles[t],
                     all.memory[n]);
    } catch (...) {
      fault.keep();
    }
  };
  if (team != nullptr)
    team->for_each(all.tiles.size(), work);
  else
    for (std::size_t t = 0; t < all.tiles.size(); ++t) work(t, 0);
  fault.rethrow();
  for (const TileMaker& maker : makers) {
    all.bonds += maker.bonds;
    all.cut += maker.cut;
    all.largest = std::max(all.largest, maker.largest);
  }
  return all;
}

}  // namespace sluice::peridynamics

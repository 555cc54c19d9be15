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
  explicit RowWriter(RowsInWork& rows) : rows_(&rows) {}

  void write(BondChunk& chunk, const std::vector<Neighbour> (&lists)[8]) {
    chunk.begin = static_cast<std::uint32_t>(rows_->base.size());
    std::size_t longest = 0;
    for (int l = 0; l < chunk.lanes; ++l) longest = std::max(longest, lists[l].size());
    if (!write_aligned(chunk, lists, longest)) write_gathered(chunk, lists, longest);
    chunk.end = static_cast<std::uint32_t>(rows_->base.size());
  }

 private:
  // A row for each offset of neighbours from their points, rising as the neighbours of each point
  // do. False, and nothing is written, where there are too many.
  bool write_aligned(const BondChunk& chunk, const std::vector<Neighbour> (&lists)[8],
                     std::size_t longest) {
    constexpr int none = std::numeric_limits<int>::max();
    const std::size_t before = rows_->base.size();
    const auto most = static_cast<std::size_t>(aligned_excess * static_cast<double>(longest));
    const Neighbour *next[8] = {}, *end[8] = {};
    int heads[8], entry[8];
    for (int l = 0; l < 8; ++l) {
      const bool has = l < chunk.lanes && !lists[l].empty();
      entry[l] = chunk.first + l;
      heads[l] = has ? lists[l].front().entry - entry[l] : none;
      if (has) next[l] = lists[l].data();
      if (has) end[l] = next[l] + lists[l].size();
    }
    for (std::size_t rows = 0;; ++rows) {
      int least = none;
      for (const int h : heads) least = std::min(least, h);
      if (least == none) return true;
      if (rows == most) break;
      double r[8];
      float w[8];
      for (int l = 0; l < 8; ++l) {
        const bool has = heads[l] == least;
        r[l] = has ? next[l]->r : 1.0;
        w[l] = has && !next[l]->cut ? next[l]->w : 0.0f;
        if (has) ++next[l];
        if (has) heads[l] = next[l] < end[l] ? next[l]->entry - entry[l] : none;
      }
      rows_->base.push_back(chunk.first + least);
      rows_->r.insert(rows_->r.end(), r, r + 8);
      rows_->w.insert(rows_->w.end(), w, w + 8);
    }
    rows_->base.resize(before);
    rows_->r.resize(8 * before);
    rows_->w.resize(8 * before);
    return false;
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
    RowWriter writer(made_);
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
    double m = 0, S = 0, volume = 0, intact = 0;
    int whole = 0;
    for (const Neighbour& n : list) {
      const double V = points_->V[static_cast<std::size_t>(n.entry)], w = n.w;
      m += w * n.r * n.r * V;
      S += w * n.r * V;
      volume += n.beta * V;
      intact += n.cut ? 0 : n.beta * V;
      whole += n.cut ? 0 : 1;
    }
    sums.m[i] = m;
    sums.s[i] = S;
    sums.volume[i] = volume;
    sums.intact[i] = intact;
    sums.neighbours[i] = whole;
    cut += static_cast<std::int64_t>(list.size()) - whole;
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

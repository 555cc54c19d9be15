// Control volumes: corners, and a surface that is counted once whatever levels and boxes hold it.
#include "framework/refine/volume_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "framework/grid/box_list.hpp"

namespace sluice::volume_faces_test {
namespace {

// 8 x 6 cells of 1/4 x 1/2 from (-1, 0) on, one layer.
Level plane(bool periodic = false) {
  Level level;
  level.anchor = {-1, 0, 0};
  level.spacing = {0.25, 0.5, 1};
  level.domain = {{0, 0, 0}, {8, 6, 1}};
  level.active = {true, true, false};
  level.periodic = {periodic, periodic, false};
  level.boxes = {{{{0, 0, 0}, {4, 6, 1}}, 0, 0}, {{{4, 0, 0}, {8, 6, 1}}, 1, 1}};
  return level;
}

Level finer(const Level& coarse, const std::vector<IndexBox>& coarse_boxes) {
  Level fine = coarse;
  fine.index = coarse.index + 1;
  fine.ratio = {2, 2, 1};
  fine.spacing = {0.5 * coarse.spacing.x, 0.5 * coarse.spacing.y, 1};
  fine.domain = refine(coarse.domain, fine.ratio);
  fine.boxes.clear();
  for (const IndexBox& b : coarse_boxes)
    fine.boxes.push_back({refine(b, fine.ratio), static_cast<int>(fine.boxes.size()) % 2,
                          static_cast<int>(fine.boxes.size())});
  return fine;
}

ControlVolume box(Vec3 low, Vec3 high) {
  ControlVolume v;
  v.whole = false;
  v.low = low;
  v.high = high;
  for (VolumeSide& s : v.sides) s.counts = true;
  return v;
}

// Where the faces of a side lie, in half cells of the finest level, and how often they count.
using Faces = std::map<std::pair<int, int>, int>;

void collect(const VolumeFaces& faces, const Level& level, int rank, int finest, int side,
             Faces& found) {
  const int scale = 1 << (finest - level.index), d = side / 2;
  int local = 0;
  for (const GridBox& b : level.boxes) {
    if (b.owner != rank) continue;
    for (int j = b.cells.lower.y; j < b.cells.upper.y; ++j)
      for (const FaceTable::Segment& s : faces.segments(local, d, {b.cells.lower.x, j, 0})) {
        if (faces.side_of(s) != side) continue;
        for (int n = 0; n < s.count; ++n) {
          IntVec3 cell{s.first + n, j, 0};
          cell[d] += s.high ? 1 : 0;
          for (int part = 0; part < scale; ++part) {  // of a coarse face
            IntVec3 at{scale * cell.x, scale * cell.y, 0};
            at[1 - d] += part;
            ++found[{at.x, at.y}];
          }
        }
      }
    ++local;
  }
}

Faces surface(const VolumeCells& v, const std::vector<Level>& levels, int side) {
  Faces found;
  for (std::size_t l = 0; l < levels.size(); ++l)
    for (int rank = 0; rank < 2; ++rank) {
      const Level* next = l + 1 < levels.size() ? &levels[l + 1] : nullptr;
      collect(VolumeFaces({v}, levels[0], levels[l], next, rank), levels[l], rank,
              static_cast<int>(levels.size()) - 1, side, found);
    }
  return found;
}

TEST(VolumeCells, CornersGoToTheNearestFaces) {
  const Level level = plane();
  const VolumeCells v = cells_of(box({-0.6, 0.4, 5}, {0.1, 0.6, 6}), level);
  EXPECT_EQ(v.cells, (IndexBox{{2, 1, 0}, {4, 2, 1}})) << "at least one cell";
  EXPECT_FALSE(v.clipped);
  EXPECT_EQ(v.sides[0], (IndexBox{{2, 1, 0}, {3, 2, 1}}));
  EXPECT_EQ(v.sides[1], (IndexBox{{3, 1, 0}, {4, 2, 1}}));
  EXPECT_TRUE(v.sides[4].empty()) << "z is no dimension of this run";
  EXPECT_TRUE(cells_of(box({-3, 0, 0}, {0, 9, 1}), level).clipped);
  EXPECT_TRUE(cells_of(box({2, 0, 0}, {3, 1, 1}), level).cells.empty());
  ControlVolume part;
  part.sides[3].counts = true;
  part.sides[3].whole = false;
  part.sides[3].start = {-0.5, 3, 0};
  part.sides[3].end = {0, 3, 1};
  const VolumeCells p = cells_of(part, level);
  EXPECT_EQ(p.sides[3], (IndexBox{{2, 5, 0}, {4, 6, 1}}));
  EXPECT_TRUE(p.sides[0].empty());
}

// A rectangle across a direction.
ControlVolume rectangle(int across, Vec3 low, Vec3 high) {
  ControlVolume v = box(low, high);
  v.flat = across;
  return v;
}

TEST(VolumeCells, ARectangleIsOneSideOfTheCellsNextToIt) {
  const Level level = plane();
  const auto side = [&](int s, const ControlVolume& v) {
    const VolumeCells found = cells_of(v, level);
    for (std::size_t other = 0; other < 6; ++other)
      EXPECT_EQ(found.sides[other].empty(), static_cast<int>(other) != s) << other;
    return found.sides[s];
  };
  EXPECT_EQ(side(0, rectangle(0, {-1, -9, 0}, {-1, 9, 1})), (IndexBox{{0, 0, 0}, {1, 6, 1}}));
  EXPECT_EQ(side(0, rectangle(0, {0.1, 1, 0}, {0.1, 2, 1})), (IndexBox{{4, 2, 0}, {5, 4, 1}}));
  EXPECT_EQ(side(1, rectangle(0, {1, 1, 0}, {1, 2, 1})), (IndexBox{{7, 2, 0}, {8, 4, 1}}))
      << "at the high end";
  EXPECT_EQ(side(3, rectangle(1, {-9, 3, 0}, {9, 3, 1})), (IndexBox{{0, 5, 0}, {8, 6, 1}}));
  EXPECT_TRUE(cells_of(rectangle(0, {-1, -9, 0}, {-1, 9, 1}), level).clipped);
  for (const double outside : {-1.2, 1.2})
    EXPECT_TRUE(cells_of(rectangle(0, {outside, 0, 0}, {outside, 3, 1}), level).cells.empty());
  EXPECT_TRUE(cells_of(rectangle(0, {0, 4, 0}, {0, 5, 1}), level).cells.empty());
}

TEST(VolumeFaces, EveryPartOfASurfaceCountsOnce) {
  const Level coarse = plane();
  const VolumeCells v = cells_of(box({-0.5, 1, 0}, {0.5, 2.5, 1}), coarse);  // 2..6 x 2..5
  // Finer boxes across, inside, outside and along the surface; a third level within.
  const std::vector<std::vector<IndexBox>> layouts = {
      {},
      {{{1, 1, 0}, {3, 3, 1}}},
      {{{2, 2, 0}, {6, 5, 1}}},
      {{{0, 2, 0}, {2, 5, 1}}, {{6, 0, 0}, {8, 6, 1}}},
      {{{2, 2, 0}, {4, 4, 1}}, {{4, 1, 0}, {6, 3, 1}}, {{0, 4, 0}, {8, 6, 1}}}};
  for (const auto& boxes : layouts) {
    std::vector<Level> levels = {coarse, finer(coarse, boxes)};
    levels.push_back(finer(
        levels[1], boxes.empty()
                       ? boxes
                       : std::vector<IndexBox>{refine(
                             {boxes[0].lower, boxes[0].lower + IntVec3{1, 1, 1}}, {2, 2, 1})}));
    for (int side = 0; side < 4; ++side) {
      const Faces found = surface(v, levels, side);
      EXPECT_EQ(found.size(), side < 2 ? 4u * 3 : 4u * 4);
      for (const auto& [place, count] : found) {
        EXPECT_EQ(count, 1);
        const int at = side < 2 ? place.first : place.second;
        const int planes[] = {2, 6, 2, 5};
        EXPECT_EQ(at, 4 * planes[side]);
      }
    }
  }
}

TEST(VolumeFaces, AnEndOfAPeriodicDomainCountsInBothSidesTheSameFaces) {
  const Level coarse = plane(true);
  const VolumeCells v = cells_of(ControlVolume{"all",
                                               true,
                                               {},
                                               {},
                                               [] {
                                                 std::array<VolumeSide, 6> sides;
                                                 for (VolumeSide& s : sides) s.counts = true;
                                                 return sides;
                                               }(),
                                               {}},
                                 coarse);
  const std::vector<Level> levels = {coarse, finer(coarse, {{{6, 1, 0}, {8, 4, 1}}})};
  const auto modulo = [&](int side) {
    Faces found;
    for (const auto& [place, count] : surface(v, levels, side))
      found[{place.first % 16, place.second}] += count;
    return found;
  };
  EXPECT_EQ(modulo(0), modulo(1));
  EXPECT_EQ(modulo(0).size(), 12u);
  for (const auto& [place, count] : modulo(0)) EXPECT_EQ(count, 1);
}

TEST(VolumeSums, SlotsFollowEachOther) {
  const VolumeSums slots(8, 2);
  EXPECT_EQ(slots.mass(0, 0, 0), 8);
  EXPECT_EQ(slots.momentum(0, 0), 10);
  EXPECT_EQ(slots.viscous(0, 0), 13);
  EXPECT_EQ(slots.pressure(0, 0), 16);
  EXPECT_EQ(slots.energy(0, 0), 17);
  EXPECT_EQ(slots.heat(0, 0), 18);
  EXPECT_EQ(slots.mass(0, 1, 0), 19);
  EXPECT_EQ(slots.work(0) + 1, slots.mass(1, 0, 0));
  EXPECT_EQ(slots.mass(2, 0, 0), 8 + slots.count(2));
}

}  // namespace
}  // namespace sluice::volume_faces_test

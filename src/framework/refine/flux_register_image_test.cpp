// Mirrored scenes give mirrored bits at interfaces, and exchanged axes the same bits.
//
// Registered once more on three ranks (CMakeLists.txt).
#include <gtest/gtest.h>

#include "framework/refine/flux_test_scenes.hpp"

namespace sluice::flux_register_image_test {
namespace {

using namespace flux_test;

class FluxRegisterImages : public FluxRegisters {};

// A scene seen in a mirror, or with two axes exchanged.
struct Image {
  std::function<IntVec3(IntVec3 cell, IntVec3 cells)> cell;  // its own inverse
  std::function<int(int)> direction;
  int mirrored = -1;  // direction that turns round
};

IntVec3 image_of_face(const Image& image, int d, IntVec3 face, const Level& level) {
  // The face below a cell becomes the one above its image.
  IntVec3 cell = face;
  if (d == image.mirrored) --cell[d];
  return image.cell(wrapped(cell, level), level.domain.size());
}

void expect_image(const Scene& scene, const Image& image, const Start& start) {
  Scene turned = scene;
  turned.refined.clear();
  for (int d = 0; d < 3; ++d) {
    const std::size_t from = image.direction(d);
    turned.cells[d] = scene.cells[image.direction(d)];
    turned.ratio[d] = scene.ratio[image.direction(d)];
    turned.periodic[d] = scene.periodic[from];
  }
  for (const IndexBox& r : scene.refined) {
    const IntVec3 a = image.cell(r.lower, scene.cells);
    const IntVec3 b = image.cell(r.upper - IntVec3::all(1), scene.cells);
    turned.refined.push_back({min(a, b), max(a, b) + IntVec3::all(1)});
  }
  TwoLevels one(scene, Cut{}, world()), other(turned, Cut{}, world());
  one.only_correct = other.only_correct = true;
  const auto level = [&](int l) -> const Level& {
    return l == 0 ? other.levels().coarse : other.levels().fine;
  };
  const CorrectionReport report = one.step(start, any_flux, 2);
  const CorrectionReport turned_report = other.step(
      [&](int q, IntVec3 c, int l) { return start(q, image.cell(c, level(l).domain.size()), l); },
      [&](int q, int d, IntVec3 c, int l, int step) {
        const double sign = d == image.mirrored ? -1 : 1;
        return sign *
               any_flux(q, image.direction(d), image_of_face(image, d, c, level(l)), l, step);
      },
      2);
  EXPECT_EQ(report.limited, turned_report.limited);
  for (const int l : {0, 1}) {
    const auto wanted = values_of(one, l == 0 ? one.coarse() : one.fine());
    other.each(l == 0 ? other.coarse() : other.fine(), [&](int q, IntVec3 c, double& v) {
      const IntVec3 from = image.cell(c, level(l).domain.size());
      ASSERT_EQ(v, wanted.at({q, from.z, from.y, from.x}))
          << "level " << l << " at " << c.x << ' ' << c.y << ' ' << c.z;
    });
  }
}

TEST_P(FluxRegisterImages, GiveMirroredBitsInMirroredScenes) {
  for (int d = 0; d < 3; ++d)
    for (const Start& start : {Start(any_start), Start(poor_start)}) {
      Image image;
      image.cell = [d](IntVec3 c, IntVec3 cells) {
        c[d] = cells[d] - 1 - c[d];
        return c;
      };
      image.direction = [](int e) { return e; };
      image.mirrored = d;
      expect_image(scene(), image, start);
    }
}

TEST_P(FluxRegisterImages, GiveTheSameBitsWithAxesExchanged) {
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    // Three faces of a cell are added axis by axis: only the first two commute.
    if (b == 2 && scene().refined.size() > 1 && scene().cells.z > 1) continue;
    Image image;
    image.cell = [a = a, b = b](IntVec3 c, IntVec3) {
      std::swap(c[a], c[b]);
      return c;
    };
    image.direction = [a = a, b = b](int d) { return d == a ? b : d == b ? a : d; };
    expect_image(scene(), image, any_start);
  }
}

INSTANTIATE_TEST_SUITE_P(FluxRegister, FluxRegisterImages,
                         testing::Range(std::size_t{0}, cases().size()), name_of_case);

}  // namespace
}  // namespace sluice::flux_register_image_test

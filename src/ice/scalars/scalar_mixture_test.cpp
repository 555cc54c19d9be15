// A scalar of one material where several meet: it stays with its material.
#include <gtest/gtest.h>

#include "ice/test_support/mixture.hpp"
#include "ice/test_support/scalars.hpp"

namespace sluice::ice::scalar_mixture_test {
namespace {

Fluid light() {
  return {eos::IdealGas{1.4, 700}, std::nullopt, 1.4, 700};
}

// A ball of the first material in the second, or a slab in a tube, both moving and at first under
// different pressures.
struct ContactNode {
  GasBox box;
  explicit ContactNode(IntVec3 cells, const std::string& inside = {}) {
    box.cells = cells;
    box.scheme = "conservative";
    box.models = scalar_model("f", "", inside) + scalar_model("u", "", inside);
  }
  MixtureCell operator()(Vec3 x) const {
    const double y = box.cells.y > 1 ? x.y - 0.5 : 0.0;
    const double r = std::sqrt((x.x - 0.5) * (x.x - 0.5) + y * y);
    const double width = 1.0 / box.cells.x;
    const double share = std::clamp(0.5 + (0.25 - r) / width, 0.0, 1.0);
    return {{share, 1 - share}, {1.0, 0.2}, {1.5, 1.0}, {0.6, 0.3, 0}};
  }
};

std::unique_ptr<MixtureBox> make(const ContactNode& m, const SolverOptions& options = {}) {
  auto run = std::make_unique<MixtureBox>(
      m.box, std::vector<Fluid>{light(), stiffened_gas(1.6, 0.5)}, m, options);
  const Vec3 low = m.box.low;
  for_each_cell(run->domain(), [&](IntVec3 c) {
    if (run->mass(0, c) == 0) return;
    const Vec3 x = run->level().centre(c) - low;
    run->view(scalar_state("f"), 0, 0, c)(c) = x.x < 0.5 ? 1.0 : 0.0;
    run->view(scalar_state("u"), 0, 0, c)(c) = 0.7;
  });
  run->solver().mark_modified();
  return run;
}

TEST(ScalarInMixtures, NeverLeavesItsMaterial) {
  for (const IntVec3 cells : {IntVec3{80, 1, 1}, IntVec3{32, 32, 1}}) {
    const auto run = make(ContactNode(cells));
    const double before = run->totals().amounts[0].sum.value();
    run->steps(120);
    int without = 0;
    for_each_cell(run->domain(), [&](IntVec3 c) {
      const double f = run->view(scalar_state("f"), 0, 0, c)(c);
      ASSERT_GE(f, 0.0);
      ASSERT_LE(f, 1.0);
      ASSERT_EQ(run->view(scalar_state("u"), 0, 0, c)(c), run->mass(0, c) > 0 ? 0.7 : 0.0);
      without += run->mass(0, c) == 0;
    });
    EXPECT_GT(without, 0);
    EXPECT_NEAR(run->totals().amounts[0].sum.value() / before, 1.0, 1e-14);
  }
}

// Nothing spreads into cells without the material.
TEST(ScalarInMixtures, SpreadsInsideItsMaterialOnly) {
  const auto run =
      make(ContactNode({32, 32, 1}, "<constants><diffusivity>0.01</diffusivity></constants>"));
  const double before = run->totals().amounts[0].sum.value();
  run->steps(100);
  for_each_cell(run->domain(), [&](IntVec3 c) {
    const double f = run->view(scalar_state("f"), 0, 0, c)(c);
    ASSERT_GE(f, -1e-15);
    ASSERT_LE(f, 1.0 + 1e-15);
    if (run->mass(0, c) == 0) {
      ASSERT_EQ(f, 0.0);
    }
  });
  EXPECT_NEAR(run->totals().amounts[0].sum.value() / before, 1.0, 1e-14);
}

// Blocks of one material run another graph: the same bits.
TEST(ScalarInMixtures, DoesNotDependOnTheKindsOfBlocks) {
  SolverOptions all;
  all.force_all = true;
  const ContactNode m({32, 32, 1}, "<constants><diffusivity>0.001</diffusivity></constants>");
  const auto a = make(m), b = make(m, all);
  a->steps(60);
  b->steps(60);
  for_each_cell(a->domain(), [&](IntVec3 c) {
    ASSERT_EQ(a->view(scalar_state("f"), 0, 0, c)(c), b->view(scalar_state("f"), 0, 0, c)(c));
  });
}

}  // namespace
}  // namespace sluice::ice::scalar_mixture_test

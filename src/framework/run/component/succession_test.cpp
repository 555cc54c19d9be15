// What passes from the particles of one component to those of the next.
#include "framework/run/component/succession.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sluice::succession_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

Label label(const std::string& name, ValueType type) {
  return declare_label({name, type, Centring::particle, "1", "Of a test."});
}
const Label speed = label("test.speed", ValueType::vector);
const Label push = label("test.push", ValueType::vector);
const Label stress = label("test.stress", ValueType::tensor);
const Label memory = label("test.memory", ValueType::real);

using Kind = std::vector<ParticleAttribute>;
using Kinds = std::vector<Kind>;

class Method final : public ParticleMethod {
 public:
  explicit Method(const Kinds& kinds) {
    for (const Kind& attributes : kinds) {
      ParticleKind& kind = kinds_.emplace_back();
      kind.name = "kind";
      kind.material = static_cast<int>(kinds_.size()) - 1;
      kind.attributes = attributes;
    }
  }
  const std::vector<ParticleKind>& kinds() const override { return kinds_; }
  void start(int, const Level&, const IndexBox&, ParticleSet&) const override {}
  bool reflects(int, int, Side, IntVec3) const override { return false; }
  bool starts_at_zero(int, Label of) const override { return of == push; }

 private:
  std::vector<ParticleKind> kinds_;
};

TEST(Succession, SortsWhatIsCarriedZeroLackingAndDropped) {
  const Method from(Kinds{Kind{speed, memory}}), to(Kinds{Kind{push, speed, stress}});
  const std::vector<PassedOn> passed = passed_on(from, to);
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_THAT(passed[0].carried, ElementsAre("test.speed"));
  EXPECT_THAT(passed[0].at_start, ElementsAre("test.push"));
  EXPECT_THAT(passed[0].lacking, ElementsAre("test.stress"));
  EXPECT_THAT(passed[0].dropped, ElementsAre("test.memory"));
  EXPECT_THAT(common_columns(from.kinds()[0], to.kinds()[0]),
              ElementsAre(Pair(0, 3), Pair(1, 4), Pair(2, 5)));
}

// Six columns are no nine.
TEST(Succession, TakesNoTensorForASymmetricOne) {
  const ParticleAttribute six(stress, true, true), nine(stress, true);
  const Method from(Kinds{Kind{six}}), to(Kinds{Kind{nine}});
  EXPECT_THAT(passed_on(from, to)[0].lacking, ElementsAre("test.stress"));
  EXPECT_THAT(common_columns(from.kinds()[0], to.kinds()[0]), IsEmpty());
}

TEST(Succession, ComparesMaterials) {
  const Method one(Kinds{Kind{speed}}), two(Kinds{Kind{speed}, Kind{speed}});
  EXPECT_EQ(succession_obstacle(one, one), "");
  EXPECT_EQ(succession_obstacle(one, two), "2 materials, but 1 before");
}

}  // namespace
}  // namespace sluice::succession_test

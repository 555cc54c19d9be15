// Which labels are stored when, and what an archive holds of them.
#include "framework/run/simulation/output_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::output_writer_test {
namespace {

using namespace run_test;
using testing::ElementsAre;
using testing::HasSubstr;

class OutputWriterTest : public testing::Test {
 protected:
  OutputWriterTest()
      : scene_(tube(2)),
        component_(scene_.grid.levels.front()),
        hierarchy_(scene_, component_, world(), {}) {
    mock_labels();
    component_.state().initialise(hierarchy_.level(0).state());
  }

  void save(const char* label, const char* compression = "") {
    SaveRequest request;
    request.label = label;
    request.compression = compression;
    scene_.output.saves.push_back(request);
  }
  OutputWriter writer() {
    ArchiveSetup setup;
    setup.parent = folder_.path();
    setup.filebase = "tube.uda";
    setup.deck_xml = "<Uintah_specification/>";
    return OutputWriter(scene_, component_, hierarchy_, ArchiveWriter::create(setup));
  }

  Scene scene_;
  MockComponent component_;
  Hierarchy hierarchy_;
  TemporaryFolder folder_;
};

TEST_F(OutputWriterTest, SortsSavesByHowTheyAreMade) {
  for (const char* label : {"mock_flux", "MockTotal", "mock_square", "mock_flux"}) save(label);
  const SavedLabels saved = sort_saves(scene_.output, hierarchy_);
  EXPECT_THAT(saved.step, ElementsAre(mock_labels().flux));  // once, though asked for twice
  EXPECT_THAT(saved.diagnostic, ElementsAre(mock_labels().square));
  EXPECT_THAT(saved.histories, ElementsAre(mock_labels().total));
}

TEST_F(OutputWriterTest, RefusesUnknownLabelsWithTheNearestOne) {
  save("mock_squar");
  try {
    sort_saves(scene_.output, hierarchy_);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("mock_square"));
  }
}

TEST_F(OutputWriterTest, TheInitialOutputHoldsDiagnosticsOnlyAndAllBoxes) {
  save("mock_flux");
  save("mock_square", "gzip");
  OutputWriter w = writer();
  w.write_output({}, true);
  w.finish("{}");
  const Archive archive = Archive::open(w.archive_folder());
  ASSERT_EQ(archive.outputs().size(), 1u);
  const ArchiveStep step = archive.read_output(archive.outputs().front());
  EXPECT_EQ(step.find("mock_flux", 0, 0), nullptr);
  const DenseField square = step.read(*step.find("mock_square", 0, 0));
  for (int i = 0; i < 40; ++i)
    EXPECT_EQ(square.at({i, 0, 0}), MockComponent::start(i) * MockComponent::start(i));
}

TEST_F(OutputWriterTest, ACheckpointHoldsTheStateToTheBit) {
  OutputWriter w = writer();
  StepInfo info;
  info.step = 3;
  w.write_checkpoint(info);
  w.finish("{}");
  const Archive archive = Archive::open(w.archive_folder());
  const ArchiveStep step = archive.read_checkpoint(archive.select_checkpoint(3));
  const DenseField q = step.read(*step.find("mock.q", 0, 0));
  for (int i = 0; i < 40; ++i) EXPECT_EQ(q.at({i, 0, 0}), MockComponent::start(i));
}

}  // namespace
}  // namespace sluice::output_writer_test

// Statistics over time: moments to the last digits, regrids, checkpoints, refusals.
#include "framework/run/analysis/analysis_statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/archive/archive.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/analysis/analysis_history.hpp"
#include "framework/run/analysis/analysis_recorder.hpp"
#include "framework/run/simulation/output_writer.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::analysis_statistics_test {
namespace {

using namespace run_test;
using testing::HasSubstr;

AnalysisModule statistics_of(const char* label, bool higher = true) {
  AnalysisModule m;
  m.name = "statistics";
  m.time_stop = 100;
  m.higher_order = higher;
  AnalysedVariable v;
  v.label = label;
  m.variables = {v};
  return m;
}

class OverTime : public testing::Test {
 protected:
  OverTime() : scene_(tube(2)), component_(scene_.grid.levels.front()) {
    scene_.analysis.modules = {statistics_of("mock_square")};
    mock_labels();
  }
  void start() {
    hierarchy_ = std::make_unique<Hierarchy>(scene_, component_, world(), SolverOptions());
    component_.state().initialise(hierarchy_->level(0).state());
    recorder_ = std::make_unique<AnalysisRecorder>(scene_, *hierarchy_, world());
  }
  // All cells hold q, so that the variable is q squared, plus their number.
  void sample(double q) {
    Warehouse& state = hierarchy_->level(0).state();
    for (int b = 0; b < 2; ++b)
      for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) { state.view(0, 0, b)(c) = q; });
    hierarchy_->level(0).mark_modified();
    ++step_;
    recorder_->sample(step_, 0.125 * step_);
  }
  double value(const char* name, int c = 0) {
    recorder_->store_fields({*find_label(name)}, 0);
    const Warehouse& outputs = hierarchy_->level(0).outputs();
    return outputs.view(outputs.find(*find_label(name), 0), c, 1)({30, 0, 0});
  }

  Scene scene_;
  MockComponent component_;
  std::unique_ptr<Hierarchy> hierarchy_;
  std::unique_ptr<AnalysisRecorder> recorder_;
  int step_ = 0;
};

TEST_F(OverTime, MomentsOfFourSamples) {
  start();
  EXPECT_EQ(value("mean_mock_square"), 0.0) << "no sample yet";
  for (const double q : {1.0, 2.0, 3.0, 2.0}) sample(q);  // 1, 4, 9, 4
  EXPECT_EQ(value("sum_mock_square"), 18.0);
  EXPECT_EQ(value("mean_mock_square"), 4.5);
  // Deviations -3.5, -0.5, 4.5, -0.5.
  EXPECT_DOUBLE_EQ(value("variance_mock_square"), (12.25 + 0.25 + 20.25 + 0.25) / 4);
  EXPECT_DOUBLE_EQ(value("skewness_mock_square"), (-42.875 - 0.125 + 91.125 - 0.125) / 4);
  EXPECT_DOUBLE_EQ(value("kurtosis_mock_square"), (150.0625 + 0.0625 + 410.0625 + 0.0625) / 4);
}

// Squares of 4096 (1 +- 2^-30): 2^24 +- 2^-5, whose squares no double can tell apart.
TEST_F(OverTime, SmallFluctuationsAboutALargeMeanAreKept) {
  start();
  for (const double sign : {1.0, -1.0, 1.0, -1.0})
    sample(std::sqrt(std::ldexp(1.0, 24) + sign * std::ldexp(1.0, -5)));
  const double q1 = std::sqrt(std::ldexp(1.0, 24) + std::ldexp(1.0, -5));
  const double q2 = std::sqrt(std::ldexp(1.0, 24) - std::ldexp(1.0, -5));
  const double half = 0.5 * (q1 * q1 - q2 * q2);
  EXPECT_NEAR(value("variance_mock_square"), half * half, 1e-12 * half * half);
}

TEST_F(OverTime, ACheckpointContinuesToTheLastBit) {
  TemporaryFolder folder;
  scene_.output.filebase = "tube.uda";
  start();
  for (const double q : {1.25, 1.5, 0.75}) sample(q);
  ArchiveSetup setup;
  setup.parent = folder.path();
  setup.filebase = "tube.uda";
  setup.deck_xml = "<Uintah_specification/>";
  OutputWriter writer(scene_, component_, *hierarchy_, ArchiveWriter::create(setup),
                      recorder_.get());
  StepInfo info;
  info.step = 3;
  info.time = 0.375;
  info.state["analysis"] = recorder_->state();
  writer.write_checkpoint(info);
  sample(3.5);
  const double skewness = value("skewness_mock_square");
  const std::string state = recorder_->state();

  start();
  step_ = 3;
  const Archive archive = Archive::open(writer.archive_folder());
  const ArchiveStep checkpoint = archive.read_checkpoint(archive.select_checkpoint(3));
  recorder_->restore(checkpoint.info().state.at("analysis"), &checkpoint);
  sample(3.5);
  EXPECT_EQ(value("skewness_mock_square"), skewness);
  EXPECT_EQ(recorder_->state(), state);
}

TEST_F(OverTime, WhatCannotBeIsRefusedByName) {
  const auto refusal = [&]() -> std::string {
    try {
      start();
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  scene_.analysis.modules = {statistics_of("mock_flux")};
  EXPECT_THAT(refusal(), HasSubstr("'mock_flux' is on faces"));
  scene_.analysis.modules = {statistics_of("mock_square"), statistics_of("mock_square")};
  EXPECT_THAT(refusal(), HasSubstr("another module already computes sum_mock_square"));
  scene_.analysis.modules = {statistics_of("mock_squar")};
  EXPECT_THAT(refusal(), HasSubstr("did you mean 'mock_square'"));
  scene_.analysis.modules = {statistics_of("mock_square")};
  scene_.analysis.modules[0].variables[0].reynolds_stress = true;
  EXPECT_THAT(refusal(), HasSubstr("it has no Reynolds stress"));
}

}  // namespace
}  // namespace sluice::analysis_statistics_test

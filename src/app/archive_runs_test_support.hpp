// Whole runs of the command and their archives: on ranks, again, compared.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice {

class ArchiveRuns : public testing::Test {
 protected:
  // The archive of `sluice run` with these words of a shell, into a folder of this name.
  std::filesystem::path run(const std::string& name, const std::string& arguments,
                            int ranks = 1) const {
    const std::filesystem::path folder = folder_ / name;
    std::filesystem::create_directories(folder);
    std::string command =
        std::string(SLUICE_COMMAND) + " run -o " + folder.string() + " " + arguments;
    if (ranks > 1) command = on_ranks(ranks) + command;
    const Outcome outcome = run_in_shell(command);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_directory() && !entry.is_symlink()) return entry.path();
    ADD_FAILURE() << "no archive";
    return {};
  }
  // All outputs and the last checkpoints, at the times that both have.
  static void expect_same(const std::filesystem::path& a, const std::filesystem::path& b) {
    const Outcome outcome = run_in_shell(std::string(SLUICE_COMMAND) + " compare --common-times " +
                                         a.string() + " " + b.string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
  }

  TemporaryFolder folder_;
};

}  // namespace sluice

// Lists of tests as the public suite's regression tester has them: Python files with entries
//   ("name", "deck.ups", ranks, "OS", ["no_restart", "abs_tolerance=1e-5", "exactComparison"])
// of which the numbers of ranks, the tolerances and no_restart are taken; no Python is run.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/regress/regress_case.hpp"

namespace sluice {

struct SuiteTest {
  std::string name, deck;  // the name of a file
  int ranks = 1;
  std::vector<std::string> flags;

  // Where this is the test of the case's deck.
  void apply(RegressCase& c) const;
};

// Entries in which something else stands are left out. InputError names file and flag where a
// tolerance is no number.
std::vector<SuiteTest> read_suite_list(const std::filesystem::path& file);

}  // namespace sluice

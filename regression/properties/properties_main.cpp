// Tests, or (with --runs FILE, under the launcher) the runs that tests compare with.
#include <gtest/gtest.h>

#include <cstring>

#include "framework/base/communicator.hpp"
#include "properties/deck_run.hpp"

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--runs") == 0)
    return sluice::properties::serve_runs(argv[2]);
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  sluice::world().finalize();
  return status;
}

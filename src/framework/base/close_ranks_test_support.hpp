// In a test that is run on several ranks too: MPI must be closed before the executable ends.
#pragma once
#include <gtest/gtest.h>

#include "framework/base/communicator.hpp"

namespace sluice {

class CloseRanks : public testing::Environment {
 public:
  void TearDown() override { world().finalize(); }
};
// Owned by googletest; one an executable, however many of its tests say so.
inline const testing::Environment* const close_ranks =
    testing::AddGlobalTestEnvironment(new CloseRanks);

}  // namespace sluice

// The state of a regridder survives its text.
#include "framework/refine/regrid_state.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"

namespace sluice::regrid_state_test {
namespace {

TEST(RegridState, comes_back_from_its_text) {
  RegridState state;
  state.last_step = 17;
  state.tiles = {{}, {{{0, 1, 0}, {3, 1, 0}}}};
  state.idle = {{}, {0, 4}};
  EXPECT_EQ(regrid_state_from_json_text(to_json_text(state)), state);
}

TEST(RegridState, refuses_what_it_did_not_write) {
  EXPECT_THROW(regrid_state_from_json_text("{"), InputError);
  EXPECT_THROW(
      regrid_state_from_json_text(R"({"last_step":1,"levels":[{"tiles":[[0,0,0]],"idle":[]}]})"),
      InputError);
}

}  // namespace
}  // namespace sluice::regrid_state_test

// A disk in gas under gravity, semi-implicit steps, from rest: the gas that it carries along.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::rising_disk_test {
namespace {

constexpr double gas = 1.1614401858304297, g = 9.81;

struct Disk {
  double ratio;      // of its density to that of the gas
  const char* bulk;  // a softer one where it is light, which spares steps
};

class RisingDisk : public testing::TestWithParam<Disk> {};

// Upward, and when.
std::pair<double, double> velocity(const CaseRun& run, const std::string& at) {
  const std::vector<double> v = run.particles("p.velocity", at)[1];
  return {std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()), run.time(at)};
}

// Sound crosses the disk in .3 ms; in 2.5 ms it moves by a hundredth of a cell. Its radius is eight
// cells.
TEST_P(RisingDisk, CarriesAsMuchGasAlongAsItDisplaces) {
  const auto [ratio, bulk] = GetParam();
  const std::string solid = "MaterialProperties/MPM/material/";
  const CaseRun run(SLUICE_SOURCE_DIR "/inputs/mpmice/light_disk_in_gas.ups",
                    {solid + fmt::format("density={:.17g}", ratio * gas),
                     solid + "constitutive_model/bulk_modulus=" + bulk});
  const auto [v0, t0] = velocity(run, "#2");
  const auto [v1, t1] = velocity(run, "last");
  const double found = (v1 - v0) / (t1 - t0), wanted = g * (1 - ratio) / (1 + ratio);
  record("acceleration", found);
  EXPECT_NEAR(found, wanted, 0.1 * std::fabs(wanted)) << "from " << t0 << " to " << t1;
}

INSTANTIATE_TEST_SUITE_P(Heavy, RisingDisk, testing::Values(Disk{2, "2e5"}));
// Ten and six seconds.
INSTANTIATE_TEST_SUITE_P(FullLight, RisingDisk,
                         testing::Values(Disk{0.1, "2e4"}, Disk{0.5, "2e5"}));

}  // namespace
}  // namespace sluice::verification::rising_disk_test

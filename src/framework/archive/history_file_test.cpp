// Histories: format, choice of steps, cutting back.
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/history_file.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice::history_file_test {
namespace {

std::string written(const std::filesystem::path& path, const HistoryControl& control) {
  HistoryFile file(path, control);
  for (int step = 1; step <= 6; ++step) file.append(step, 0.1 * step, 1.0 / step);
  EXPECT_FALSE(std::filesystem::exists(path));  // nothing before the flush
  file.write();
  return read_text(path);
}

TEST(HistoryFile, Columns) {
  const TemporaryFolder folder;
  EXPECT_EQ(written(folder.path() / "a.dat", {3, 0, false, true}),
            "0.30000000000000004\t0.33333333333333331\n"
            "0.60000000000000009\t0.16666666666666666\n");
  EXPECT_EQ(written(folder.path() / "b.dat", {3, 2, true, true}),
            "         2\t0.20000000000000001\t0.5\n"
            "         5\t0.5\t0.20000000000000001\n");
  EXPECT_EQ(written(folder.path() / "c.dat", {5, 1, true, false}),
            "         1\t1\n         6\t0.16666666666666666\n");
  HistoryFile vectors(folder.path() / "v.dat", {});
  vectors.append(1, 0.5, Vec3{0.1, -2, 3e-300});
  vectors.write();
  EXPECT_EQ(read_text(folder.path() / "v.dat"),
            "0.5\t0.10000000000000001 -2 3.0000000000000002e-300\n");
}

TEST(HistoryFile, CutBackToARestart) {
  const TemporaryFolder folder;
  int n = 0;
  for (const HistoryControl control : {HistoryControl{1, 0, false, true},
                                       {1, 0, true, true},
                                       {2, 0, true, false},
                                       {2, 1, false, false}}) {
    const auto path = folder.path() / (std::to_string(n++) + ".dat");
    const std::string all = written(path, control);
    std::ofstream(path, std::ios::app) << "0.7";  // cut short by a kill
    cut_history(path, control, 4, 0.1 * 4);
    const std::string kept = read_text(path);
    EXPECT_TRUE(all.starts_with(kept));
    const int lines = control.frequency == 1 ? 4 : 2;
    EXPECT_EQ(std::count(kept.begin(), kept.end(), '\n'), lines);
    HistoryFile file(path, control);
    for (int step = 5; step <= 6; ++step) file.append(step, 0.1 * step, 1.0 / step);
    file.write();
    EXPECT_EQ(read_text(path), all);
  }
}

}  // namespace
}  // namespace sluice::history_file_test

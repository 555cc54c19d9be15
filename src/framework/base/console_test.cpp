// Sizes, times and tables as a person reads them; colour only where asked for.
#include "framework/base/console.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <stdexcept>

#include "framework/base/launcher.hpp"
#include "framework/base/test_support/with_variable.hpp"

namespace sluice::console_test {
namespace {

TEST(Console, bytes) {
  EXPECT_EQ(human_bytes(0), "0 B");
  EXPECT_EQ(human_bytes(1023), "1023 B");
  EXPECT_EQ(human_bytes(1536), "1.5 KiB");
  EXPECT_EQ(human_bytes(1024.0 * 1024.0 - 1), "1.0 MiB");
  EXPECT_EQ(human_bytes(2.3 * 1024 * 1024 * 1024), "2.3 GiB");
}

TEST(Console, durations) {
  EXPECT_EQ(human_duration(0), "0 s");
  EXPECT_EQ(human_duration(3.5e-4), "350 us");
  EXPECT_EQ(human_duration(0.0121), "12.1 ms");
  EXPECT_EQ(human_duration(12.34), "12.3 s");
  EXPECT_EQ(human_duration(59.97), "1 min 00 s");
  EXPECT_EQ(human_duration(245.0), "4 min 05 s");
  EXPECT_EQ(human_duration(3 * 3600 + 12 * 60 + 31), "3 h 12 min");
  EXPECT_EQ(human_duration(2 * 86400 + 3 * 3600), "2 d 03 h");
  EXPECT_EQ(human_duration(std::numeric_limits<double>::infinity()), "unknown");
  EXPECT_EQ(human_duration(-1.5), "-1.5 s");
}

TEST(Console, counts) {
  EXPECT_EQ(human_count(0), "0");
  EXPECT_EQ(human_count(999), "999");
  EXPECT_EQ(human_count(1000), "1,000");
  EXPECT_EQ(human_count(-1234567), "-1,234,567");
  EXPECT_EQ(human_percent(0.000424), "0.042 %");
  EXPECT_EQ(human_percent(0.994), "99 %");
  EXPECT_EQ(human_percent(0.996), "100 %");
  EXPECT_EQ(human_percent(1.141), "114 %");
}

TEST(Console, colour_only_when_wanted) {
  EXPECT_EQ(styled("bad", Style::red, false), "bad");
  EXPECT_EQ(styled("bad", Style::red, true), "\033[31mbad\033[0m");
  EXPECT_EQ(styled("as is", Style::plain, true), "as is");
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  EXPECT_FALSE(is_terminal(file));
  EXPECT_FALSE(wants_colour(file));
  EXPECT_EQ(terminal_width(file), 80);
  std::fclose(file);
}

TEST(Console, a_launcher_of_ranks_is_no_terminal) {
  const int descriptor = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (descriptor < 0 || ::isatty(descriptor) == 0)
    GTEST_SKIP() << "the system gives no pseudo-terminal (/dev/pts is not there)";
  std::FILE* terminal = ::fdopen(descriptor, "r+");
  ASSERT_NE(terminal, nullptr);
  EXPECT_EQ(is_terminal(terminal), !has_launcher());
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK"}) {
    const WithVariable launched(name, "1");  // one rank is launched as several are
    EXPECT_FALSE(is_terminal(terminal));
    EXPECT_FALSE(wants_colour(terminal));
  }
  std::fclose(terminal);
}

TEST(Console, table_aligns_columns) {
  TextTable table({{"event"}, {"count", TextTable::Align::right}, {"where"}});
  EXPECT_TRUE(table.empty());
  table.row({"retry", "12", ""});
  table.row({"\xce\xb8 < 0", "3", "cell [1, 2, 3]"});  // one Greek letter, two bytes
  EXPECT_EQ(table.text("  "),
            "  event  count  where\n"
            "  retry     12\n"
            "  \xce\xb8 < 0      3  cell [1, 2, 3]\n");
  EXPECT_THROW(table.row({"too few"}), std::logic_error);
}

}  // namespace
}  // namespace sluice::console_test

// Progress lines: the prefix that scripts grep, how often they come, and the estimate of the end.
#include "framework/run/simulation/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace sluice::progress_test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

// A file instead of a terminal.
class File {
 public:
  File() : stream_(std::tmpfile()) {}
  ~File() { std::fclose(stream_); }
  std::FILE* stream() { return stream_; }
  std::string text() {
    std::fflush(stream_);
    std::rewind(stream_);
    std::string all;
    for (int c = std::fgetc(stream_); c != EOF; c = std::fgetc(stream_)) {
      all += static_cast<char>(c);
    }
    return all;
  }
  std::vector<std::string> lines() {
    std::vector<std::string> result;
    std::string line;
    for (const char c : text()) {
      if (c == '\n') {
        result.push_back(line);
        line.clear();
      } else {
        line += c;
      }
    }
    return result;
  }

 private:
  std::FILE* stream_;
};

// Steps of 0.01 in time and so many seconds of wall clock.
void run(Progress& progress, int steps, double seconds) {
  progress.begin(0, 0.0, 1.0);
  for (int step = 1; step <= steps; ++step) {
    progress.step({step, 0.01 * step, 0.01, 1.0 + seconds * step});
  }
  progress.end();
}

TEST(Progress, plain_lines_have_the_prefix_that_scripts_grep) {
  File file;
  ProgressOptions options;
  options.stream = file.stream();
  options.max_time = 1.0;
  Progress progress(options);  // automatic, and a file is no terminal
  run(progress, 1, 0.5);
  ASSERT_EQ(file.lines().size(), 1U);
  EXPECT_THAT(file.lines()[0],
              MatchesRegex("Timestep 1  +Time=0\\.01  +Next delT=0\\.01  +Wall Time=1\\.5  +"
                           "EMA=0\\.5  +ETC=00:00:49  Memory Used=.*"));
  EXPECT_THAT(file.text(), Not(HasSubstr("\033")));
}

TEST(Progress, long_numbers_are_not_glued) {
  File file;
  ProgressOptions options;
  options.stream = file.stream();
  Progress progress(options);
  progress.begin(0, 0, 0);
  progress.step({123456789, 1.234567e-100, -1.234567e-100, 1234567890.0});
  EXPECT_THAT(progress.plain_line(),
              StartsWith("Timestep 123456789 Time=1.23457e-100 Next delT=-1.23457e-100 Wall Time="
                         "1.23457e+09 EMA="));
}

TEST(Progress, plain_lines_come_every_few_seconds_first_and_last_always) {
  File file;
  ProgressOptions options;
  options.mode = ProgressMode::plain;
  options.stream = file.stream();
  options.plain_interval = 2.0;
  Progress progress(options);
  run(progress, 101, 0.25);
  const std::vector<std::string> lines = file.lines();
  // Steps 1, 9, 17, ..., 97 and the last one.
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_THAT(lines[0], StartsWith("Timestep 1 "));
  EXPECT_THAT(lines[1], StartsWith("Timestep 9 "));
  EXPECT_THAT(lines[13], StartsWith("Timestep 101 "));
}

TEST(Progress, every_step_and_none) {
  File file;
  ProgressOptions options;
  options.mode = ProgressMode::plain;
  options.every_step = true;
  options.stream = file.stream();
  {
    Progress progress(options);
    run(progress, 30, 1e-6);
  }
  EXPECT_EQ(file.lines().size(), 30U);
  File silent;
  options.mode = ProgressMode::none;
  options.stream = silent.stream();
  Progress progress(options);
  run(progress, 30, 10);
  EXPECT_EQ(silent.text(), "");
  EXPECT_NEAR(progress.seconds_per_step(), 10, 1e-9);
  progress.note("a message is told all the same");
  EXPECT_EQ(silent.text(), "a message is told all the same\n");
}

TEST(Progress, estimates_the_end_by_whatever_comes_first) {
  ProgressOptions options;
  options.mode = ProgressMode::none;
  options.max_time = 1.0;
  options.cells = 1000;
  Progress by_time(options);
  EXPECT_LT(by_time.seconds_left(), 0) << "nothing known before the first step";
  run(by_time, 20, 0.5);  // t = 0.2: eighty steps to go
  EXPECT_NEAR(by_time.seconds_left(), 40, 0.51);
  options.max_steps = 30;
  Progress by_steps(options);
  run(by_steps, 20, 0.5);
  EXPECT_NEAR(by_steps.seconds_left(), 5, 1e-9);
  options.wall_limit = 12;
  Progress by_clock(options);
  run(by_clock, 20, 0.5);
  EXPECT_NEAR(by_clock.seconds_left(), 1, 1e-9);
  EXPECT_THAT(by_clock.live_line(),
              HasSubstr("step 20  t = 0.2 (20 %)  dt = 0.01  5e+05 ns/cell/step  1.0 s left"));
}

TEST(Progress, a_terminal_gets_one_live_line) {
  int terminal = 0;
  int other_end = 0;
  winsize size{};
  size.ws_col = 200;
  size.ws_row = 24;
  if (openpty(&terminal, &other_end, nullptr, nullptr, &size) != 0)
    GTEST_SKIP() << "the system gives no pseudo-terminal (/dev/pts is not there)";
  std::FILE* stream = fdopen(other_end, "w");
  ASSERT_NE(stream, nullptr);
  ProgressOptions options;
  options.stream = stream;
  options.max_time = 1;
  {
    Progress progress(options);
    progress.begin(0, 0, 0);
    progress.step({1, 0.5, 0.25, 1});
    progress.note("a warning");
    progress.step({2, 0.75, 0.25, 2});
    progress.end();
  }
  std::fclose(stream);
  std::string text;
  std::array<char, 256> part;
  for (ssize_t n = 0; (n = read(terminal, part.data(), part.size())) > 0;) {
    text.append(part.data(), n);
  }
  close(terminal);
  EXPECT_THAT(text, StartsWith("\rstep 1  t = 0.5 (50 %)"));
  EXPECT_THAT(text, HasSubstr("\r\033[Ka warning\r\n\rstep 1 "));
  EXPECT_THAT(text, HasSubstr("\rstep 2  t = 0.75 (75 %)"));
  EXPECT_EQ(text.back(), '\n');
}

TEST(Progress, modes_have_names) {
  EXPECT_EQ(progress_mode_from("auto"), ProgressMode::automatic);
  EXPECT_EQ(progress_mode_from("plain"), ProgressMode::plain);
  EXPECT_EQ(progress_mode_from("none"), ProgressMode::none);
  EXPECT_THROW(progress_mode_from("fancy"), InputError);
}

}  // namespace
}  // namespace sluice::progress_test

// Averages over about the last twenty steps; the clock is the caller's, so that tests need none.
#include "framework/run/simulation/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/memory.hpp"

namespace sluice {
namespace {

constexpr double averaging_weight = 0.1;  // of the newest step

std::string hours_minutes_seconds(double seconds) {
  if (seconds < 0 || !(seconds < 3.6e9)) return "unknown";
  const auto whole = static_cast<long long>(seconds);
  return fmt::format("{:02}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// Left-aligned, and never glued to what follows.
template <class T>
std::string entry(std::string_view name, T value, int width) {
  std::string text = fmt::format("{}{:<{}}", name, value, width);
  if (text.back() != ' ') text += ' ';
  return text;
}

std::string entry_of(std::string_view name, double value, int width) {
  return entry(name, fmt::format("{:.6g}", value), width);
}

}  // namespace

ProgressMode progress_mode_from(std::string_view text) {
  if (text == "auto") return ProgressMode::automatic;
  if (text == "plain") return ProgressMode::plain;
  if (text == "none") return ProgressMode::none;
  throw InputError(
      fmt::format("--progress is '{}'; it may be auto, plain or none", std::string(text)));
}

Progress::Progress(const ProgressOptions& options) : options_(options) {
  live_ = options_.mode == ProgressMode::automatic && is_terminal(options_.stream);
}

Progress::~Progress() {
  clear_live();
}

void Progress::begin(int step, double time, double wall_seconds) {
  begun_ = true;
  start_time_ = time;
  last_ = {step, time, 0, wall_seconds};
  last_printed_step_ = step;
  last_printed_wall_ = wall_seconds - options_.plain_interval;  // the first step is told
}

void Progress::step(const StepReport& report) {
  const double seconds = report.wall_seconds - last_.wall_seconds;
  const double dt = report.time - last_.time;
  const bool first = average_step_ == 0;
  average_step_ += (first ? 1.0 : averaging_weight) * (seconds - average_step_);
  average_dt_ += (first ? 1.0 : averaging_weight) * (dt - average_dt_);
  last_ = report;
  if (options_.mode == ProgressMode::none) return;
  const double waited = report.wall_seconds - last_printed_wall_;
  if (live_) {
    if (waited >= options_.live_interval) print_live();
  } else if (options_.every_step || waited >= options_.plain_interval) {
    print_plain();
  }
}

double Progress::seconds_left() const {
  if (average_step_ <= 0) return -1;
  double steps = -1;
  if (average_dt_ > 0 && options_.max_time > last_.time) {
    steps = std::ceil((options_.max_time - last_.time) / average_dt_);
  } else if (options_.max_time <= last_.time) {
    steps = 0;
  }
  if (options_.max_steps > 0) {
    const double allowed = std::max(options_.max_steps - last_.step, 0);
    steps = steps < 0 ? allowed : std::min(steps, allowed);
  }
  if (steps < 0) return -1;
  double seconds = steps * average_step_;
  if (options_.wall_limit > 0) {
    seconds = std::min(seconds, std::max(options_.wall_limit - last_.wall_seconds, 0.0));
  }
  return seconds;
}

std::string Progress::plain_line() const {
  return entry("Timestep ", last_.step, 8) + entry_of("Time=", last_.time, 12) +
         entry_of("Next delT=", last_.next_dt, 12) +
         entry_of("Wall Time=", last_.wall_seconds, 10) + entry_of("EMA=", average_step_, 12) +
         fmt::format("ETC={}  Memory Used={}", hours_minutes_seconds(seconds_left()),
                     human_bytes(static_cast<double>(resident_bytes())));
}

std::string Progress::live_line() const {
  std::string line = fmt::format("step {}  t = {:.4g}", last_.step, last_.time);
  const double whole = options_.max_time - start_time_;
  if (whole > 0) {
    const double percent = 100 * (last_.time - start_time_) / whole;
    line += fmt::format(" ({:.0f} %)", std::clamp(percent, 0.0, 100.0));
  }
  line += fmt::format("  dt = {:.3g}", last_.next_dt);
  if (options_.cells > 0) {
    line += fmt::format("  {:.3g} ns/cell/step",
                        1e9 * average_step_ / static_cast<double>(options_.cells));
  }
  const double left = seconds_left();
  return line + "  " + (left < 0 ? "end unknown" : human_duration(left) + " left");
}

void Progress::print_plain() {
  std::fputs((plain_line() + "\n").c_str(), options_.stream);
  std::fflush(options_.stream);
  last_printed_step_ = last_.step;
  last_printed_wall_ = last_.wall_seconds;
}

void Progress::print_live() {
  std::string line = live_line();
  const std::size_t width = std::max(terminal_width(options_.stream) - 1, 1);
  if (line.size() > width) line.resize(width);  // a wrapped line could not be taken back
  std::fputs(("\r" + line + "\033[K").c_str(), options_.stream);
  std::fflush(options_.stream);
  live_line_shown_ = true;
  last_printed_step_ = last_.step;
  last_printed_wall_ = last_.wall_seconds;
}

void Progress::clear_live() {
  if (!live_line_shown_) return;
  std::fputs("\r\033[K", options_.stream);
  std::fflush(options_.stream);
  live_line_shown_ = false;
}

void Progress::note(const std::string& message) {
  const bool shown = live_line_shown_;
  clear_live();
  std::FILE* stream = options_.stream;
  if (options_.mode == ProgressMode::none && stream == stdout) stream = stderr;
  std::fputs((message + "\n").c_str(), stream);
  std::fflush(stream);
  if (shown) print_live();
}

void Progress::end() {
  if (!begun_ || options_.mode == ProgressMode::none) return;
  if (live_) {
    if (last_printed_step_ >= 0) print_live();
    std::fputs("\n", options_.stream);
    std::fflush(options_.stream);
    live_line_shown_ = false;
  } else if (last_printed_step_ != last_.step) {
    print_plain();
  }
  begun_ = false;
}

}  // namespace sluice

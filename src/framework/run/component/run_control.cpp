// A handler may only set a flag; the step loop looks at it.
#include "framework/run/component/run_control.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <string>

namespace sluice {
namespace {

constexpr std::array handled = {SIGTERM, SIGINT, SIGUSR1, SIGUSR2};

std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait");
std::array<struct sigaction, handled.size()> former;
std::atomic<bool> installed = false;

extern "C" void note_signal(int signal) {
  received.store(signal);
}

}  // namespace

RunControl::RunControl() : start_(std::chrono::steady_clock::now()) {
  if (installed.exchange(true)) throw std::logic_error("a second RunControl in one process");
  received.store(0);
  for (std::size_t i = 0; i < handled.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = note_signal;
    sigemptyset(&action.sa_mask);
    // Reads and writes under way go on; an impatient second signal has its usual effect.
    const bool ends_at_once_next = handled[i] == SIGTERM || handled[i] == SIGINT;
    action.sa_flags = SA_RESTART | (ends_at_once_next ? static_cast<int>(SA_RESETHAND) : 0);
    sigaction(handled[i], &action, &former[i]);
  }
}

RunControl::~RunControl() {
  for (std::size_t i = 0; i < handled.size(); ++i) sigaction(handled[i], &former[i], nullptr);
  installed.store(false);
}

double RunControl::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

RunControl::Question RunControl::ask(Reduction& reduction) const {
  return {reduction.add_maximum(wall_seconds()), reduction.add_maximum(received.load())};
}

RunControl::Answer RunControl::read(const Reduction& reduction, const Question& question) const {
  return {reduction.maximum(question.wall), static_cast<int>(reduction.maximum(question.signal))};
}

std::string RunControl::signal_name(int signal) {
  switch (signal) {
    case SIGTERM:
      return "SIGTERM";
    case SIGINT:
      return "SIGINT";
    case SIGUSR1:
      return "SIGUSR1";
    case SIGUSR2:
      return "SIGUSR2";
    default:
      return "signal " + std::to_string(signal);
  }
}

}  // namespace sluice

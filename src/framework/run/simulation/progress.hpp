// What a running step loop tells: one live line on a terminal, or plain lines that scripts grep.
//
//   live   step 1200  t = 0.0034 (68 %)  dt = 2.1e-06  28.4 ns/cell/step  12.3 s left
//   plain  Timestep 1200    Time=0.0034      Next delT=2.1e-06     Wall Time=41.2      EMA=...
//
// Plain lines keep the order and the prefix that existing scripts look for; EMA is the moving
// average of a step's wall seconds, ETC the time left as h:m:s.
#pragma once
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace sluice {

// automatic: live on a terminal, else plain.
enum class ProgressMode { automatic, plain, none };
// InputError for anything but auto, plain, none.
ProgressMode progress_mode_from(std::string_view text);

struct ProgressOptions {
  ProgressMode mode = ProgressMode::automatic;
  std::FILE* stream = stdout;
  double max_time = 0;         // of the deck, s
  int max_steps = 0;           // step number of the end; 0: none
  double wall_limit = 0;       // seconds; 0: none
  std::int64_t cells = 0;      // advanced in a step, for ns/cell/step; 0: not told
  double plain_interval = 2;   // seconds between plain lines
  double live_interval = 0.1;  // seconds between changes of the live line
  bool every_step = false;     // a plain line each step, as classic scripts expect
};

// What is told after a step.
struct StepReport {
  int step = 0;
  double time = 0;          // s
  double next_dt = 0;       // s
  double wall_seconds = 0;  // since the start of the run
};

class Progress {
 public:
  explicit Progress(const ProgressOptions& options);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Where the loop starts; wall seconds so far belong to the start-up.
  void begin(int step, double time, double wall_seconds);
  // After each accepted step; prints when it is time to.
  void step(const StepReport& report);
  // A message of its own line; a live line moves out of its way. Never suppressed;
  // where no progress is told, standard output stays empty and it goes to standard error.
  void note(const std::string& message);
  // Tells the last step if it was not told; leaves the cursor on a fresh line.
  void end();

  // Moving average of the wall seconds of a step.
  double seconds_per_step() const { return average_step_; }
  // Estimated wall seconds to the end; negative when unknown.
  double seconds_left() const;
  // The texts, for whoever prints elsewhere.
  std::string plain_line() const;
  std::string live_line() const;

 private:
  void print_plain();
  void print_live();
  void clear_live();

  ProgressOptions options_;
  bool live_ = false;
  bool live_line_shown_ = false;
  bool begun_ = false;
  double start_time_ = 0;
  StepReport last_;
  double average_step_ = 0;  // wall seconds a step
  double average_dt_ = 0;    // simulated time a step
  double last_printed_wall_ = 0;
  int last_printed_step_ = -1;
};

}  // namespace sluice

#include "app/loading/last_output.hpp"

#include <fmt/format.h>

#include <fstream>

#include "framework/archive/archive.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

std::string step_text(int step, double time) {
  return fmt::format("step {} (t = {:g})", step, time);
}

}  // namespace

std::optional<RunEnd> run_end(const Archive& archive) {
  std::ifstream in(archive.folder() / "run.json");
  const Json report = Json::parse_or_null({std::istreambuf_iterator<char>(in), {}});
  if (!report.is_object() || !report.contains("last_step") || !report.at("last_step").is_whole() ||
      !report.contains("time") || !report.at("time").is_number())
    return std::nullopt;
  const std::string status = report.value("status", std::string());
  return RunEnd{report.at("last_step").get<int>(), report.at("time").get<double>(),
                status == "done" || status == "max_steps"};
}

std::string last_output_note(const std::filesystem::path& folder) {
  const Archive archive = Archive::open(folder);
  const StepEntry* output = archive.outputs().empty() ? nullptr : &archive.outputs().back();
  const StepEntry* checkpoint =
      archive.checkpoints().empty() ? nullptr : &archive.checkpoints().back();
  const int shown = output == nullptr ? -1 : output->step;
  const bool later_checkpoint = checkpoint != nullptr && checkpoint->step > shown;
  const std::optional<RunEnd> end = run_end(archive);
  std::string ended;
  if (end && end->step > shown)
    ended = "the run ended at " + step_text(end->step, end->time);
  else if (!end && later_checkpoint)
    ended = "a checkpoint is of " + step_text(checkpoint->step, checkpoint->time);
  if (ended.empty()) return {};
  std::string text = (output == nullptr ? std::string("no output")
                                        : "output of " + step_text(shown, output->time)) +
                     "; " + ended;
  if (end && end->in_full) text += "; sluice run --output-at-end saves its end";
  if (later_checkpoint)
    text += fmt::format("; --checkpoint shows the checkpoint of step {}", checkpoint->step);
  return text;
}

}  // namespace sluice

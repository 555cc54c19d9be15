#include "app/process/deck_process.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "app/process/study_process.hpp"
#include "framework/base/error.hpp"

namespace sluice {

std::vector<std::string> run_words(const DeckRequest& request) {
  std::vector<std::string> words = {request.executable.string(), "run", request.deck};
  for (const std::string& one : request.overrides) {
    words.emplace_back("--set");
    words.push_back(one);
  }
  return words;
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string out = "sluice";
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool plain = words[i].find_first_of(" []*?$'\"@=") == std::string::npos;
    out += plain ? " " + words[i] : " '" + words[i] + "'";
  }
  return out;
}

std::string DeckOutcome::status() const {
  return report.is_object() ? report.value("status", std::string("failed")) : "failed";
}

std::string DeckOutcome::archive() const {
  const bool named =
      report.is_object() && report.contains("archive") && report.at("archive").is_text();
  return named ? report.at("archive").get<std::string>() : std::string{};
}

double lost_energy(const Json& report) {
  const Json& account = report.at("energy_account");
  if (account.empty())
    throw InputError("the run has no energy budget: no solids deform in explicit steps");
  const auto number = [](const Json& value) {
    return value.is_number() ? value.get<double>() : NAN;
  };
  double lost = 0;  // J
  for (const auto& [name, value] : account.members())
    if (name != "within particles" && name != "within cells") lost += number(value);
  const double scale = number(report.at("conservation").at("total energy").at("scale"));
  return scale == 0 ? 0 : std::fabs(lost) / scale;
}

DeckOutcome run_deck(const DeckRequest& asked) {
  namespace fs = std::filesystem;
  fs::remove_all(asked.folder);
  fs::create_directories(asked.folder);
  const fs::path json = asked.folder / "run.json", log = asked.folder / "run.log";
  ProcessRequest process;
  process.words = run_words(asked);
  for (const std::string& word : {std::string("-o"), asked.folder.string(), std::string("--json"),
                                  json.string(), std::string("--progress"), std::string("none")})
    process.words.push_back(word);
  process.words.insert(process.words.end(), asked.options.begin(), asked.options.end());
  process.output = log;
  DeckOutcome outcome;
  outcome.exit_status = run_process(process);
  if (outcome.exit_status == static_cast<int>(ExitStatus::bad_input))
    throw InputError(
        fmt::format("{} does not run:\n{}", shell_text(run_words(asked)), last_lines(log, 20)));
  std::ifstream in(json);
  outcome.report = Json::parse_or_null({std::istreambuf_iterator<char>(in), {}});
  if (!outcome.report.is_object())
    outcome.message = fmt::format("exit status {}: {}", outcome.exit_status, last_lines(log, 5));
  else if (outcome.status() != "done")
    outcome.message = last_lines(log, 5);
  return outcome;
}

}  // namespace sluice

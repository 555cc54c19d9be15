// A deck of solids of a few parts, run in this process; what its archive holds at the end.
#pragma once
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

#include "framework/archive/archive.hpp"
#include "framework/base/communicator.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "mpm/mpm.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm {

// The state at the end, and histories of every step.
inline std::string saves(const std::vector<std::string>& labels) {
  std::string text =
      "<outputTimestepInterval>1000000</outputTimestepInterval>"
      "<outputLastTimestep>true</outputLastTimestep>";
  for (const std::string& l : labels) text += "<save label='" + l + "'/>";
  return text;
}

class TextRun {
 public:
  // `rewrite` is applied to the text of the deck: (from, to), each once; throws where not found.
  using Rewrites = std::vector<std::pair<std::string, std::string>>;

  // The component, where it is not Mpm itself.
  using Make = std::function<std::unique_ptr<Mpm>(const Scene&, const MpmScene&)>;

  TextRun(const SolidDeck& deck, const Rewrites& rewrites, const std::string& name, int threads = 1,
          const Make& make = std::make_unique<Mpm, const Scene&, const MpmScene&>)
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("sluice_{}_{}", name, ::getpid())) {
    std::filesystem::create_directories(folder_);
    std::string text = text_of(deck);
    for (const auto& [from, to] : rewrites) {
      const std::size_t at = text.find(from);
      if (at == std::string::npos) throw std::logic_error("the deck has no " + from);
      text.replace(at, from.size(), to);
    }
    ReadDeck read;
    read.deck = load_deck_text(text, name + ".ups", {}, solid_schema());
    finish_reading(read);
    if (any_error(read.faults)) throw std::runtime_error(read.text);
    const std::unique_ptr<Mpm> solids = make(read.scene, read.solids);
    RunOptions run;
    run.parent = folder_;
    run.progress = ProgressMode::none;
    run.threads = threads;
    run.deck_xml = text;
    report_ = Simulation(read.scene, *solids, world(), run).run();
    if (report_.status == RunStatus::failed) throw std::runtime_error(report_.message);
  }
  ~TextRun() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TextRun(const TextRun&) = delete;
  TextRun& operator=(const TextRun&) = delete;

  const RunReport& report() const { return report_; }
  // Columns of a label of particles at an output ("last", "#0"), by component; level after level.
  std::vector<std::vector<double>> particles(const std::string& name, int material = 0,
                                             const std::string& which = "last") const {
    const Archive a = Archive::open(*report_.archive);
    const ArchiveStep step = a.read_output(a.select_output(which));
    std::vector<std::vector<double>> all;
    for (int level = 0; level < 2; ++level) {
      const FieldInfo* info = step.find_particles(name, material, level);
      if (info == nullptr) continue;
      const std::vector<std::vector<double>> own = step.read_particles(*info);
      all.resize(own.size());
      for (std::size_t c = 0; c < own.size(); ++c)
        all[c].insert(all[c].end(), own[c].begin(), own[c].end());
    }
    if (all.empty()) throw std::runtime_error("no particles have " + name);
    return all;
  }
  double time(const std::string& which = "last") const {
    const Archive a = Archive::open(*report_.archive);
    return a.select_output(which).time;
  }
  // Lines of a history: time and values.
  std::vector<std::vector<double>> history(const std::string& label) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*report_.archive))
      if (entry.path().filename().string().starts_with(label)) {
        std::ifstream in(entry.path());
        std::vector<std::vector<double>> rows;
        std::string line;
        while (std::getline(in, line)) {
          for (char& c : line)
            if (c == '[' || c == ']' || c == ',' || c == '\t') c = ' ';
          std::istringstream words(line);
          std::vector<double> row;
          for (double v; words >> v;) row.push_back(v);
          if (!row.empty()) rows.push_back(row);
        }
        return rows;
      }
    throw std::runtime_error("no history " + label);
  }

 private:
  std::filesystem::path folder_;
  RunReport report_;
};

}  // namespace sluice::mpm

// particleExtract: histories of single particles, a file each.
//
//   particleExtract/L-<level>/<particleID>    time x y z values
//
// of the particles of one material with p.color above colorThreshold, on the level on which they
// live at the time; components of vectors .x .y .z, of tensors .xx to .zz, row after row. Nothing
// depends on ranks and boxes. A file is open only while lines are appended, so that there may be
// any number of them.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "framework/analysis/sample_file.hpp"
#include "framework/particle/particle_map.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

// Does a module follow particles.
bool follows_particles(const AnalysisModule& module);

class ParticleHistories {
 public:
  // Keeps a reference to the module. DeckError at its line when the material has no particles, when
  // they carry no p.color, or when an entry names nothing that they carry. `method` may be null.
  ParticleHistories(const AnalysisModule& module, const ParticleMethod* method);

  // Takes a sample on all ranks, into memory of rank 0. Collective.
  void sample(const ParticleCloud& particles, double time, Communicator& communicator);
  // How many lines the last sample gave; the same on all ranks.
  std::size_t lines() const { return lines_; }

  // As AnalysisFile, for all files; on rank 0.
  void flush(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const;

 private:
  // Components of a variable: columns of the attributes, or what `derived` computes.
  struct Source {
    std::vector<std::size_t> columns;
    const DerivedAttribute* derived = nullptr;
  };
  void add_source(const AnalysedVariable& variable, const ParticleKind& kind);
  void pack_box(const ParticleSet& set, const ParticleMap& map, int level,
                std::vector<double>& rows) const;
  AnalysisFile& file_of(int level, std::int64_t id);

  const AnalysisModule* module_;
  const ParticleMethod* method_;
  int kind_ = -1;                // number of the material's particles
  std::size_t colour_ = 0;       // column of p.color
  std::size_t components_ = 0;   // of all variables
  std::vector<Source> sources_;  // as the deck lists them
  std::string header_ = "# time x y z";
  std::map<std::pair<int, std::int64_t>, AnalysisFile> files_;  // by level, id
  std::size_t lines_ = 0;
};

}  // namespace sluice

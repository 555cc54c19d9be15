// Writing an archive: NAME.uda.NNN with index, steps, checkpoints and histories.
//
//   NAME.uda -> NAME.uda.000         link to the newest
//   NAME.uda.000/
//     index.xml  input.xml  run.json  *.dat
//     t00010/          timestep.xml  p00000.h5  p00000.xml ...   (one pair a rank)
//     checkpoints/     index.xml  t00040/ ...
//
// A step is written into tNNNNN.partial, renamed, flushed, and only then named in index.xml, which
// is itself replaced as a whole: what the index names is complete on disk, whatever kills the run.
// Where the folder, the deck or a step in it is gone when the next step is written, that is a
// SystemError that names what is gone: a run must not go on writing what nobody can read.
// All calls are collective over the ranks; a failure on one rank is thrown on all.
#pragma once
#include <functional>
#include <map>
#include <span>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/field_file.hpp"
#include "framework/archive/field_piece.hpp"
#include "framework/archive/history_file.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {

class Communicator;

// The ranks that write one archive together. The default is a serial run.
struct WriterRanks {
  int rank = 0;
  int size = 1;
  // One text a rank, in rank order, on every rank.
  std::function<std::vector<std::string>(const std::string&)> gather_to_all =
      [](const std::string& text) { return std::vector<std::string>{text}; };
};
WriterRanks writer_ranks(Communicator& communicator);

struct ArchiveSetup {
  std::filesystem::path parent = ".";  // -o DIR
  std::string filebase;                // the deck's <filebase>, e.g. "shockTube.uda"
  std::string deck_xml;                // the deck as run, includes resolved
  // Decks that it names, as files of these names beside it.
  std::map<std::string, std::string> other_decks;
  // Files that the decks name, to be copied under these names.
  std::map<std::string, std::filesystem::path> kept_files;
  std::string program;       // "sluice 0.1.0"
  StorageOptions outputs;    // never applied to checkpoints
  int checkpoint_cycle = 2;  // checkpoints kept; 0: all
  HistoryControl histories;
};

struct WriteReport {
  std::int64_t bytes = 0;            // this rank's file
  std::int64_t float_overflows = 0;  // finite doubles that became infinite floats on this rank
};

// What becomes of the earlier outputs when a run is continued in a new archive.
enum class Earlier { stamp_only, refer, copy };

class ArchiveWriter {
 public:
  // A new archive under the smallest free number. Two runs started at once get two folders.
  static ArchiveWriter create(const ArchiveSetup& setup, WriterRanks ranks = {});
  // For a new archive of a restarted run, before its first step: says where it comes from, and
  // brings in outputs (by reference or copy) and history lines up to the restart.
  void adopt(const std::filesystem::path& earlier_archive, int restart_step, Earlier mode);

  ArchiveWriter(ArchiveWriter&&) = default;
  ArchiveWriter& operator=(ArchiveWriter&&) = default;
  ~ArchiveWriter();  // writes histories as well as it can; finish() says when it cannot

  WriteReport write_output(const StepInfo& info, const Grid& grid,
                           std::span<const FieldPiece> pieces);
  WriteReport write_checkpoint(const StepInfo& info, const Grid& grid,
                               std::span<const FieldPiece> pieces);

  // Histories are written by rank 0; calls on other ranks do nothing. `time`: s; `value`: in the
  // unit of the label.
  void history(const std::string& label, int material, int step, double time, double value);
  void history(const std::string& label, int material, int step, double time, Vec3 value);

  // A text file of the archive (run.json), replaced as a whole; rank 0 writes.
  void write_text(const std::string& name, const std::string& text);
  // Histories to disk. Collective.
  void finish();

  const std::filesystem::path& folder() const { return folder_; }
  // What a user should know although the run goes on: a link that could not be made (rank 0),
  // values too large for a float (the rank that has them).
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  // Outputs or checkpoints: a folder of steps with an index.
  struct Store {
    std::filesystem::path folder;
    ArchiveIndex index;
  };

  ArchiveWriter(ArchiveSetup setup, WriterRanks ranks)
      : setup_(std::move(setup)), ranks_(std::move(ranks)) {}

  // Runs `work` on every rank; when it fails on one, every rank throws that failure.
  void together(const std::function<void()>& work);
  void on_root(const std::function<void()>& work);
  void make_archive_folder();
  void require_all_there() const;
  void link_newest(const std::filesystem::path& base);
  WriteReport write_step(Store& store, const StepInfo& info, const Grid& grid,
                         std::span<const FieldPiece> pieces, const StorageOptions& options);
  void publish(Store& store, const StepInfo& info, const Grid& grid);
  std::vector<std::filesystem::path> retire(Store& store) const;
  void warn_of_overflows(int step, std::int64_t count);
  void write_index(const Store& store);
  void write_histories();
  HistoryFile& history_file(const std::string& label, int material, const char* type);

  ArchiveSetup setup_;
  WriterRanks ranks_;
  std::filesystem::path folder_;
  FolderLock lock_;
  Store outputs_, checkpoints_;
  std::map<std::string, HistoryFile> histories_;
  std::vector<std::string> warnings_;
  bool overflow_warned_ = false;
};

}  // namespace sluice

// Ranks over MPI; without a launcher every call is answered here and MPI is never started.
#include "framework/base/communicator.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <thread>

#include "framework/base/launcher.hpp"
#include "framework/base/message_counts.hpp"
#include "framework/base/reduction.hpp"

namespace sluice {
namespace {

MessageCounts counts;

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw SystemError(fmt::format(
      "{} failed: {}\n  another rank may have died, or the ranks run different inputs; see the "
      "messages above, then try fewer ranks",
      call, std::string(text, length)));
}

int to_count(std::size_t size, const char* what) {
  if (size > static_cast<std::size_t>(INT_MAX)) {
    throw SystemError(fmt::format(
        "{} of {} items: MPI counts at most {} a message; use more ranks or smaller boxes", what,
        size, INT_MAX));
  }
  return static_cast<int>(size);
}

// The combination of two records; called by MPI, so it must not throw: a mismatch is marked in
// the record and found by reduce().
void combine_records(void* from, void* into, int* count, MPI_Datatype* type) {
  int bytes = 0;
  MPI_Type_size(*type, &bytes);
  const std::size_t words = bytes / sizeof(std::int64_t);
  for (int i = 0; i < *count; ++i) {
    Reduction::combine(static_cast<const std::int64_t*>(from) + words * i,
                       static_cast<std::int64_t*>(into) + words * i, words);
  }
}

// The operation and one datatype per record length; made when first used.
struct RecordTypes {
  MPI_Op operation = MPI_OP_NULL;
  std::map<std::size_t, MPI_Datatype> types;

  MPI_Op get_operation() {
    if (operation == MPI_OP_NULL)
      check(MPI_Op_create(combine_records, 1, &operation), "MPI_Op_create");
    return operation;
  }
  MPI_Datatype get_type(std::size_t words) {
    const auto found = types.find(words);
    if (found != types.end()) return found->second;
    MPI_Datatype type = MPI_DATATYPE_NULL;
    check(MPI_Type_contiguous(to_count(words, "a reduction"), MPI_INT64_T, &type),
          "MPI_Type_contiguous");
    check(MPI_Type_commit(&type), "MPI_Type_commit");
    types.emplace(words, type);
    return type;
  }
  void free() {
    for (auto& [words, type] : types) check(MPI_Type_free(&type), "MPI_Type_free");
    types.clear();
    if (operation != MPI_OP_NULL) check(MPI_Op_free(&operation), "MPI_Op_free");
  }
};

RecordTypes& record_types() {
  static RecordTypes types;
  return types;
}

// Ends all ranks with the status. MPI_Abort prints a banner of eight lines over the message that
// matters; the runtime below Open MPI does the same without, where it is loaded.
[[noreturn]] void end_all_ranks(ExitStatus status) {
  using AbortFunction = int (*)(int, const char*, void*, std::size_t);
  if (void* library = dlopen("libpmix.so.2", RTLD_LAZY | RTLD_NOLOAD); library != nullptr) {
    const auto abort_all = reinterpret_cast<AbortFunction>(dlsym(library, "PMIx_Abort"));
    if (abort_all != nullptr && abort_all(static_cast<int>(status), nullptr, nullptr, 0) == 0) {
      std::_Exit(static_cast<int>(status));
    }
  }
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(status));
  std::_Exit(static_cast<int>(status));
}

int environment_number(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : 0;
}

}  // namespace

const MessageCounts& message_counts() {
  return counts;
}
void reset_message_counts() {
  counts = {};
}

int launched_processes() {
  for (const char* name : rank_counts) {
    if (const int size = environment_number(name); size > 0) return size;
  }
  // PMIx alone names the rank but not the size: under srun the scheduler knows it.
  if (has_launcher()) {
    const int size = environment_number("SLURM_STEP_NUM_TASKS");
    return size > 0 ? size : INT_MAX;
  }
  return 1;
}

Communicator& world() {
  static Communicator communicator;
  return communicator;
}

Communicator::Communicator() {
  const int launched = launched_processes();
  if (launched <= 1) return;
  start_mpi();
  if (launched != INT_MAX && size_ != launched) {
    throw SystemError(fmt::format(
        "the launcher started {} processes, but MPI connects only {} of them; mpirun belongs to "
        "another MPI than this program (built with {}.{} of the standard): use its own mpirun",
        launched, size_, MPI_VERSION, MPI_SUBVERSION));
  }
}

void Communicator::start_mpi() {
  if (uses_mpi_) return;
  int provided = MPI_THREAD_SINGLE;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  if (provided < MPI_THREAD_FUNNELED) {
    throw SystemError("this MPI allows no threads (MPI_THREAD_FUNNELED); rebuild or replace it");
  }
  check(MPI_Comm_rank(MPI_COMM_WORLD, &rank_), "MPI_Comm_rank");
  check(MPI_Comm_size(MPI_COMM_WORLD, &size_), "MPI_Comm_size");
  uses_mpi_ = true;
}

void Communicator::finalize() {
  if (!uses_mpi_) return;
  record_types().free();
  check(MPI_Finalize(), "MPI_Finalize");
  uses_mpi_ = false;
  rank_ = 0;
  size_ = 1;
}

void Communicator::abort(ExitStatus status, const std::string& message) {
  // Ranks often fail together (a full disk): the lowest speaks first and ends the others.
  if (size_ > 1 && rank_ > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(50 * rank_ + 100, 1000)));
  }
  std::fflush(stdout);
  if (!message.empty()) {
    const std::string origin = size_ > 1 ? fmt::format("[rank {}] ", rank_) : std::string();
    std::fputs((origin + message + "\n").c_str(), stderr);
  }
  std::fflush(stderr);
  if (size_ > 1) end_all_ranks(status);
  std::_Exit(static_cast<int>(status));
}

void Communicator::exit_together(ExitStatus status) {
  std::fflush(stdout);
  std::fflush(stderr);
  if (size_ > 1 && status != ExitStatus::good) {
    barrier();  // nobody is cut off in the middle of a file or a line
    end_all_ranks(status);
  }
  finalize();
  std::exit(static_cast<int>(status));
}

void Communicator::barrier() {
  if (size_ == 1) return;
  counts.barriers.add(0);
  check(MPI_Barrier(MPI_COMM_WORLD), "MPI_Barrier");
}

void Communicator::reduce(Reduction& reduction) {
  std::vector<std::int64_t>& words = reduction.words();
  if (size_ == 1 || words.empty()) return;
  counts.reductions.add(words.size() * sizeof(words[0]));
  check(MPI_Allreduce(MPI_IN_PLACE, words.data(), 1, record_types().get_type(words.size()),
                      record_types().get_operation(), MPI_COMM_WORLD),
        "MPI_Allreduce");
  if (!reduction.is_consistent()) {
    throw SystemError(
        "the ranks reduced different quantities in one step: they do not run the same plan "
        "(same deck, options and binary on every rank?)");
  }
}

void Communicator::sum(std::uint64_t* numbers, std::size_t count) {
  if (size_ == 1) return;
  constexpr std::size_t most = std::size_t{1} << 24;  // 128 MiB a message; MPI counts to INT_MAX
  for (std::size_t at = 0; at < count; at += most) {
    const std::size_t here = std::min(most, count - at);
    counts.sums.add(here * sizeof *numbers);
    check(MPI_Allreduce(MPI_IN_PLACE, numbers + at, static_cast<int>(here), MPI_UINT64_T, MPI_SUM,
                        MPI_COMM_WORLD),
          "MPI_Allreduce");
  }
}

std::vector<std::string> Communicator::gather(const std::string& bytes) {
  if (size_ == 1) return {bytes};
  const int mine = to_count(bytes.size(), "a gathered text");
  std::vector<int> sizes(is_root() ? size_ : 0), starts(sizes.size());
  counts.gathers.add(sizeof mine);
  check(MPI_Gather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD), "MPI_Gather");
  std::size_t total = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    starts[i] = to_count(total, "gathered texts");
    total += sizes[i];
  }
  std::string all(total, '\0');
  counts.gathers.add(bytes.size());
  check(MPI_Gatherv(bytes.data(), mine, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE,
                    0, MPI_COMM_WORLD),
        "MPI_Gatherv");
  std::vector<std::string> result;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    result.push_back(all.substr(starts[i], sizes[i]));
  }
  return result;
}

std::vector<std::string> Communicator::gather_to_all(const std::string& bytes) {
  if (size_ == 1) return {bytes};
  const std::int64_t mine = to_count(bytes.size(), "a gathered text");
  std::vector<std::int64_t> lengths(size_);
  counts.gathers_to_all.add(lengths.size() * sizeof mine);
  check(MPI_Allgather(&mine, 1, MPI_INT64_T, lengths.data(), 1, MPI_INT64_T, MPI_COMM_WORLD),
        "MPI_Allgather");
  std::vector<int> sizes(size_), starts(size_);
  std::size_t total = 0;
  for (int i = 0; i < size_; ++i) {
    starts[i] = to_count(total, "gathered texts");
    sizes[i] = static_cast<int>(lengths[i]);
    total += lengths[i];
  }
  std::string all(total, '\0');
  counts.gathers_to_all.add(total);
  check(MPI_Allgatherv(bytes.data(), sizes[rank_], MPI_BYTE, all.data(), sizes.data(),
                       starts.data(), MPI_BYTE, MPI_COMM_WORLD),
        "MPI_Allgatherv");
  std::vector<std::string> result;
  for (int i = 0; i < size_; ++i) {
    result.push_back(all.substr(starts[i], sizes[i]));
  }
  return result;
}

void Communicator::broadcast(void* data, std::size_t size, int root) {
  if (size_ == 1 || size == 0) return;
  counts.broadcasts.add(size);
  check(MPI_Bcast(data, to_count(size, "a broadcast"), MPI_BYTE, root, MPI_COMM_WORLD),
        "MPI_Bcast");
}

std::string Communicator::broadcast(const std::string& bytes, int root) {
  std::uint64_t size = bytes.size();
  broadcast(&size, sizeof size, root);
  std::string result = rank_ == root ? bytes : std::string(size, '\0');
  broadcast(result.data(), size, root);
  return result;
}

struct Messages::Requests {
  std::vector<MPI_Request> posted;
};

Messages::Messages() : requests_(std::make_unique<Requests>()) {}
Messages::~Messages() = default;
Messages::Messages(Messages&&) noexcept = default;
Messages& Messages::operator=(Messages&&) noexcept = default;

namespace {
void need_mpi(int other_rank) {
  if (!world().uses_mpi()) {
    throw SystemError(fmt::format("message to or from rank {} in a serial run", other_rank));
  }
}
}  // namespace

void Messages::post_receive(double* buffer, std::size_t count, int source, int tag) {
  need_mpi(source);
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Irecv(buffer, to_count(count, "a receive"), MPI_DOUBLE, source, tag, MPI_COMM_WORLD,
                  &request),
        "MPI_Irecv");
  requests_->posted.push_back(request);
}

void Messages::post_send(const double* buffer, std::size_t count, int destination, int tag) {
  need_mpi(destination);
  counts.sends.add(count * sizeof *buffer);
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Isend(buffer, to_count(count, "a send"), MPI_DOUBLE, destination, tag, MPI_COMM_WORLD,
                  &request),
        "MPI_Isend");
  requests_->posted.push_back(request);
}

void Messages::wait_all() {
  if (requests_->posted.empty()) return;
  check(MPI_Waitall(to_count(requests_->posted.size(), "messages"), requests_->posted.data(),
                    MPI_STATUSES_IGNORE),
        "MPI_Waitall");
  requests_->posted.clear();
}

}  // namespace sluice

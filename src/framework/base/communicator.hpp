// The ranks of a run: who we are, reductions, packed messages, and how all end together.
//
// MPI is started only when a launcher started several of us (or when start_mpi() asks): its
// start alone takes 280 ms. A serial run answers every call without it. MPI is called from the
// main thread only (MPI_THREAD_FUNNELED); every call is checked.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace sluice {

class Reduction;

class Communicator {
 public:
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  bool uses_mpi() const { return uses_mpi_; }

  // For a library that needs MPI in a serial run as well; no effect when MPI runs already.
  // SystemError when it cannot be started.
  void start_mpi();
  // Collective, at the good end of main. After it the run is serial.
  void finalize();
  // One rank failed: prints the message once and ends all ranks with the status, now.
  [[noreturn]] void abort(ExitStatus status, const std::string& message);
  // Collective: all ranks know the status. Ends without the launcher's banners, whatever it is.
  [[noreturn]] void exit_together(ExitStatus status);

  void barrier();
  // Replaces every slot by its value over all ranks: one MPI call. All ranks hold equal slots, else
  // SystemError.
  void reduce(Reduction& reduction);
  // Replaces every number by its sum over all ranks, modulo 2^64: no order changes a bit.
  void sum(std::uint64_t* numbers, std::size_t count);
  // One entry a rank, in rank order, on rank 0; empty elsewhere.
  std::vector<std::string> gather(const std::string& bytes);
  // The same on all ranks.
  std::vector<std::string> gather_to_all(const std::string& bytes);
  void broadcast(void* data, std::size_t size, int root = 0);
  std::string broadcast(const std::string& bytes, int root = 0);

 private:
  friend Communicator& world();
  Communicator();

  int rank_ = 0;
  int size_ = 1;
  bool uses_mpi_ = false;
};

// All ranks of this run. The first call starts MPI under a launcher.
Communicator& world();

// How many processes the launcher says it started; 1 without a launcher. Starts nothing.
int launched_processes();

// Messages under way: post all receives, then all sends, then wait. Buffers must stay until
// wait_all() returns. Capacity is kept, so that a step allocates nothing after the first.
class Messages {
 public:
  Messages();
  ~Messages();
  Messages(Messages&&) noexcept;
  Messages& operator=(Messages&&) noexcept;

  void post_receive(double* buffer, std::size_t count, int source, int tag);
  void post_send(const double* buffer, std::size_t count, int destination, int tag);
  void wait_all();

 private:
  struct Requests;
  std::unique_ptr<Requests> requests_;
};

}  // namespace sluice

// Whether a launcher of ranks (mpirun, srun) has started us, by what it puts into the environment.
#pragma once
#include <array>

namespace sluice {

// How many processes there are, and which of them we are; not every launcher tells both.
inline constexpr std::array rank_counts = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"};
inline constexpr std::array rank_numbers = {"PMIX_RANK", "PMI_RANK"};

// Of one process, too.
bool has_launcher();

}  // namespace sluice

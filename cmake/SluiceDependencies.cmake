# Every library that is not ours, found once.
find_package(Threads REQUIRED)
find_package(LibXml2 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TBB REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(ZLIB REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)

add_library(sluice_hdf5 INTERFACE)
target_include_directories(sluice_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(sluice_hdf5 INTERFACE ${HDF5_C_LIBRARIES})

add_library(sluice_mpi INTERFACE)
target_compile_definitions(sluice_mpi INTERFACE OMPI_SKIP_MPICXX)
target_link_libraries(sluice_mpi INTERFACE MPI::MPI_C)

# hypre of Debian (libhypre-dev) comes without a file for CMake.
find_path(HYPRE_INCLUDE_DIR HYPRE.h PATH_SUFFIXES hypre)
find_library(HYPRE_LIBRARY NAMES HYPRE)
if(NOT HYPRE_INCLUDE_DIR OR NOT HYPRE_LIBRARY)
  message(FATAL_ERROR "hypre was not found: install libhypre-dev, or give HYPRE_INCLUDE_DIR (the "
    "folder of HYPRE.h) and HYPRE_LIBRARY (the library)")
endif()
mark_as_advanced(HYPRE_INCLUDE_DIR HYPRE_LIBRARY)
add_library(sluice_hypre INTERFACE)
target_include_directories(sluice_hypre SYSTEM INTERFACE ${HYPRE_INCLUDE_DIR})
target_link_libraries(sluice_hypre INTERFACE ${HYPRE_LIBRARY} sluice_mpi)

# CVODE and ARKODE of SUNDIALS (libsundials-dev): explicit steps, dense direct solver, in serial.
find_package(SUNDIALS REQUIRED COMPONENTS arkode cvode nvecserial sunmatrixdense sunlinsoldense)
add_library(sluice_cvode INTERFACE)
target_link_libraries(sluice_cvode INTERFACE SUNDIALS::arkode SUNDIALS::cvode SUNDIALS::nvecserial
  SUNDIALS::sunmatrixdense SUNDIALS::sunlinsoldense)

if(SLUICE_TESTS)
  find_package(GTest REQUIRED)
endif()

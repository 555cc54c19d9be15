// One data set of bytes that grows, compressed.
#include "framework/archive/xdmf/covered_file.hpp"

#include "framework/archive/drawing/covered_cells.hpp"

namespace sluice {
namespace {

Hdf5Handle create_file(Hdf5Target& target, const std::string& path) {
  silence_hdf5();
  const auto access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a list", path);
  target.attach(access.get());
  checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "set the version",
          path);
  const auto creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a list", path);
  checked(H5Pset_obj_track_times(creation.get(), false), "set the times", path);
  return checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose,
                 "create the file", path);
}

Hdf5Handle create_marks(const Hdf5Handle& file, const std::string& path) {
  const hsize_t none = 0, most = H5S_UNLIMITED, chunk = 64 * 1024;
  const auto space = checked(H5Screate_simple(1, &none, &most), H5Sclose, "make a space", path);
  const auto list = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a list", path);
  checked(H5Pset_obj_track_times(list.get(), false), "set the times", path);
  checked(H5Pset_chunk(list.get(), 1, &chunk), "set the chunk", path);
  checked(H5Pset_deflate(list.get(), 4), "set the gzip filter", path);
  return checked(H5Dcreate2(file.get(), "covered", H5T_STD_U8LE, space.get(), H5P_DEFAULT,
                            list.get(), H5P_DEFAULT),
                 H5Dclose, "create a data set", path);
}

}  // namespace

CoveredFile::CoveredFile(const std::filesystem::path& path)
    : disk_(path),
      target_(disk_.file()),
      file_(create_file(target_, disk_.file().path().string())),
      marks_(create_marks(file_, disk_.file().path().string())) {}

CoveredBoxes CoveredFile::add(const Grid& grid) {
  std::vector<std::vector<IndexBox>> boxes;
  for (const Level& level : grid.levels) {
    boxes.emplace_back();
    for (const GridBox& b : level.boxes) boxes.back().push_back(b.cells);
  }
  if (boxes == last_grid_) return last_;
  last_.clear();
  std::vector<std::uint8_t> marks;
  for (std::size_t l = 0; l < boxes.size(); ++l) {
    const CoveredCells covered(grid, l);
    for (const IndexBox& box : boxes[l]) {
      if (!covered.any(box)) continue;
      last_[key_of(static_cast<int>(l), box)] = total_ + static_cast<std::int64_t>(marks.size());
      const std::vector<std::uint8_t> types = covered.ghost_types(box);
      marks.insert(marks.end(), types.begin(), types.end());
    }
  }
  append(marks);
  last_grid_ = std::move(boxes);
  return last_;
}

void CoveredFile::append(const std::vector<std::uint8_t>& marks) {
  if (marks.empty()) return;
  const std::string path = disk_.file().path().string();
  const hsize_t start = total_, count = marks.size(), extent = start + count;
  checked(H5Dset_extent(marks_.get(), &extent), "extend a data set", path);
  const auto space = checked(H5Dget_space(marks_.get()), H5Sclose, "ask for a space", path);
  const auto memory = checked(H5Screate_simple(1, &count, nullptr), H5Sclose, "make a space", path);
  checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr),
          "select a range", path);
  checked(H5Dwrite(marks_.get(), H5T_NATIVE_UINT8, memory.get(), space.get(), H5P_DEFAULT,
                   marks.data()),
          "write the marks", path);
  total_ = static_cast<std::int64_t>(extent);
  target_.check();
}

void CoveredFile::finish() {
  const std::string path = disk_.file().path().string();
  if (!marks_.close() || !file_.close()) fail_hdf5("close the file", path);
  target_.check();
  disk_.finish();
}

}  // namespace sluice

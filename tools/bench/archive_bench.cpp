// Writing speed of the archive: a field set with checksums against a plain write of the same bytes.
//
// usage: sluice_archive_bench [FOLDER [CELLS [LABELS [REPEATS]]]]; default /dev/shm, 160^3 cells,
// 32 labels (1 GiB), 5 repeats. Prints the median of each and their ratio (goal: at most 1.3).
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/archive/archive_writer.hpp"

namespace {

namespace fs = std::filesystem;
using namespace sluice;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

// The same bytes, straight from memory.
void write_plainly(const fs::path& path, const std::vector<double>& values, int labels) {
  PosixFile file = PosixFile::create(path);
  const std::size_t bytes = values.size() * sizeof(double);
  for (int l = 0; l < labels; ++l)
    file.write_at(static_cast<std::int64_t>(bytes) * l, values.data(), bytes);
  file.flush();
  file.close();
}

int run(const fs::path& parent, int n, int labels, int repeats) {
  const fs::path folder = parent / ("archive_bench." + std::to_string(::getpid()));
  fs::create_directory(folder);
  Level level;
  level.domain = {{0, 0, 0}, {n, n, n}};
  level.boxes = {{level.domain, 0, 0}};
  const IndexBox with_ghosts = level.domain.grown({3, 3, 3});
  const IntVec3 size = with_ghosts.size();
  std::vector<double> memory(static_cast<std::size_t>(with_ghosts.volume()));
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = static_cast<double>(i) * 1e-3;
  const std::vector<double> plain(static_cast<std::size_t>(level.domain.volume()), 1.5);
  std::vector<FieldPiece> pieces;
  for (int l = 0; l < labels; ++l) {
    FieldPiece p;
    p.label = declare_label(
        {"field" + std::to_string(l), ValueType::real, Centring::cell, "1", "for the benchmark"});
    p.cells = level.domain;
    p.view.data = memory.data();
    p.view.box = with_ghosts;
    p.view.stride[1] = size.x;
    p.view.stride[2] = static_cast<std::ptrdiff_t>(size.x) * size.y;
    pieces.push_back(p);
  }
  ArchiveSetup setup;
  setup.parent = folder;
  setup.filebase = "bench.uda";
  setup.checkpoint_cycle = 1;
  std::vector<double> archive_times, plain_times;
  for (int r = 0; r < repeats; ++r) {
    plain_times.push_back(seconds_of([&] { write_plainly(folder / "plain", plain, labels); }));
    fs::remove(folder / "plain");
    ArchiveWriter writer = ArchiveWriter::create(setup);
    archive_times.push_back(seconds_of([&] {
      writer.write_output({1, 0, 0, 0, {}}, {{level}}, pieces);
    }));
    fs::remove_all(writer.folder());
  }
  fs::remove_all(folder);
  const double gib = static_cast<double>(plain.size()) * 8 * labels / (1 << 30);
  const double a = median(archive_times), b = median(plain_times);
  std::printf("%.2f GiB: plain %.3f s (%.2f GiB/s), archive %.3f s (%.2f GiB/s), ratio %.2f\n", gib,
              b, gib / b, a, gib / a, a / b);
  return a <= 1.3 * b ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  auto number = [&](int i, int fallback) { return argc > i ? std::atoi(argv[i]) : fallback; };
  return run(argc > 1 ? argv[1] : "/dev/shm", number(2, 160), number(3, 32), number(4, 5));
}

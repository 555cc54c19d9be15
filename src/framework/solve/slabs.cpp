// Bounds of slabs, and what ranks tell each other of them.
#include "framework/solve/slabs.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/base/communicator.hpp"

namespace sluice::solve {
namespace {

constexpr std::size_t min_cells = 4096;  // of a window that is dealt out: below, messages cost more
constexpr double max_uneven = 1.1;       // the largest slab over the mean
constexpr int down_tag = 61, up_tag = 62;

// Slabs begin at multiples of a power of 2, at least 2, the largest that deals them out evenly: as
// many coarser windows keep their bounds.
int even_unit(int slices, int ranks) {
  int unit = 2;
  for (int u = 4; u * ranks <= slices; u *= 2) {
    const int units = (slices + u - 1) / u, most = (units + ranks - 1) / ranks;
    if (most * u * ranks <= max_uneven * slices) unit = u;
  }
  return unit;
}

template <class T>
std::string bytes_of(const T* from, std::ptrdiff_t count) {
  return {reinterpret_cast<const char*>(from), count * sizeof(T)};
}

}  // namespace

int Slabs::begin() const {
  return shared() ? begin_of(world().rank()) : 0;
}

int Slabs::end() const {
  return shared() ? begin_of(world().rank() + 1) : bounds_.back();
}

Slabs Slabs::slabs_of_ranks(const DenseShape& shape) {
  Slabs slabs(shape);
  const int ranks = world().size(), slices = shape.count[2];
  if (ranks == 1 || slices < 2 * ranks || shape.cells() < min_cells) return slabs;
  const int unit = even_unit(slices, ranks);
  const std::int64_t units = (slices + unit - 1) / unit;
  slabs.bounds_.clear();
  for (int r = 0; r <= ranks; ++r)
    slabs.bounds_.push_back(std::min(slices, unit * static_cast<int>(units * r / ranks)));
  return slabs;
}

Slabs Slabs::grouped(const DenseShape& coarse, int ratio) const {
  Slabs slabs(coarse);
  if (!shared()) return slabs;
  slabs.bounds_ = bounds_;
  for (int& bound : slabs.bounds_) bound = (bound + ratio - 1) / ratio;
  return slabs;
}

Slabs Slabs::coarsened(const DenseShape& coarse, int ratio) const {
  Slabs slabs = grouped(coarse, ratio);
  for (std::size_t n = 1; n < slabs.bounds_.size(); ++n)
    if (slabs.bounds_[n] == slabs.bounds_[n - 1]) return Slabs(coarse);
  // The next coarser one must have its fine slices on one rank as well.
  const bool odd = std::any_of(slabs.bounds_.begin() + 1, slabs.bounds_.end() - 1,
                               [](int bound) { return bound % 2 != 0; });
  return odd || coarse.cells() < min_cells ? Slabs(coarse) : slabs;
}

template <class T>
void Slabs::exchange(const DenseShape& shape, T* x) const {
  if (!shared()) return wrap_ends(shape, x);
  const int rank = world().rank(), last = world().size() - 1;
  const bool round = shape.periodic[2];
  const int below = rank > 0 ? rank - 1 : round ? last : -1;
  const int above = rank < last ? rank + 1 : round ? 0 : -1;
  const std::size_t bytes = shape.slice() * sizeof(T);
  const std::size_t count = (bytes + sizeof(double) - 1) / sizeof(double);
  const auto slice = [&](int k) { return x + shape.at(-1, -1, k); };
  std::vector<double> from_below(count), from_above(count), to_below(count), to_above(count);
  Messages messages;
  if (below >= 0) messages.post_receive(from_below.data(), count, below, up_tag);
  if (above >= 0) messages.post_receive(from_above.data(), count, above, down_tag);
  if (below >= 0) {
    std::memcpy(to_below.data(), slice(begin()), bytes);
    messages.post_send(to_below.data(), count, below, down_tag);
  }
  if (above >= 0) {
    std::memcpy(to_above.data(), slice(end() - 1), bytes);
    messages.post_send(to_above.data(), count, above, up_tag);
  }
  messages.wait_all();
  if (below >= 0) std::memcpy(slice(begin() - 1), from_below.data(), bytes);
  if (above >= 0) std::memcpy(slice(end()), from_above.data(), bytes);
}

// `first`: of slice 0; `block`: numbers of a slice.
template <class T>
void Slabs::gather_blocks(T* first, std::ptrdiff_t block) const {
  if (!shared()) return;
  const int own = world().rank();
  const auto all =
      world().gather_to_all(bytes_of(first + block * begin(), block * (end() - begin())));
  for (int rank = 0; rank < world().size(); ++rank) {
    const std::string& bytes = all[rank];
    if (rank != own) std::memcpy(first + block * begin_of(rank), bytes.data(), bytes.size());
  }
}

template <class T>
void Slabs::gather(const DenseShape& shape, T* x) const {
  gather_blocks(x + shape.at(-1, -1, 0), shape.slice());
}

void Slabs::gather_numbers(double* of_slices) const {
  gather_blocks(of_slices, 1);
}

double total_of_ranks(const ExactSum& own) {
  ExactSum::Slots slots = own.canonical();
  // Modulo 2^64 signed numbers add as unsigned ones do.
  world().sum(reinterpret_cast<std::uint64_t*>(slots.data()), slots.size());
  return ExactSum::from_slots(slots).value();
}

double Slabs::total(const ExactSum& own) const {
  return shared() ? total_of_ranks(own) : own.value();
}

double Slabs::largest(double own) const {
  if (!shared()) return own;
  double found = own;
  for (const std::string& bytes : world().gather_to_all(bytes_of(&own, 1))) {
    double other = 0;
    std::memcpy(&other, bytes.data(), sizeof other);
    if (other > found || std::isnan(other)) found = other;
  }
  return found;
}

std::string Slabs::first(const std::string& own) const {
  if (!shared()) return own;
  for (const std::string& text : world().gather_to_all(own))
    if (!text.empty()) return text;
  return {};
}

template void Slabs::exchange(const DenseShape&, float*) const;
template void Slabs::exchange(const DenseShape&, double*) const;
template void Slabs::gather(const DenseShape&, float*) const;
template void Slabs::gather(const DenseShape&, double*) const;

}  // namespace sluice::solve

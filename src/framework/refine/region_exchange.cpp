// Views, row copies and packed messages.
#include "framework/refine/region_exchange.hpp"

#include "framework/field/region_rows.hpp"
#include "framework/grid/grid_boxes.hpp"

namespace sluice {
namespace {

constexpr int message_tag = 2;

}  // namespace

int component_count(const Warehouse& warehouse, const std::vector<int>& slots) {
  int components = 0;
  for (const int s : slots) components += warehouse.info(s).components;
  return components;
}

void view_boxes(const Warehouse& warehouse, const std::vector<int>& slots,
                std::vector<StateViews>& views) {
  views.resize(warehouse.local_boxes().size());
  for (std::size_t b = 0; b < views.size(); ++b) {
    views[b].clear();
    for (const int s : slots)
      for (int c = 0; c < warehouse.info(s).components; ++c)
        views[b].push_back(warehouse.view(s, c, static_cast<int>(b)));
  }
}

void view_array(double* data, const IndexBox& cells, const Level& level, int components,
                StateViews& views) {
  views.clear();
  for (int c = 0; c < components; ++c)
    views.push_back(lay_out(data + c * cells.volume(), cells, level));
}

Level without_boxes(const Level& level) {
  Level frame;
  frame.index = level.index;
  frame.domain = level.domain;
  frame.periodic = level.periodic;
  frame.active = level.active;
  frame.ratio = level.ratio;
  return frame;
}

std::vector<int> local_numbers(const Level& level, int rank) {
  std::vector<int> numbers;
  numbers.reserve(level.boxes.size());
  int count = 0;
  for (const GridBox& b : level.boxes) numbers.push_back(b.owner == rank ? count++ : -1);
  return numbers;
}

void copy_state(const StateViews& to, const IndexBox& region, const StateViews& from,
                IntVec3 shift) {
  for (std::size_t n = 0; n < to.size(); ++n) copy_region(to[n], region, from[n], shift);
}

void blend_state(const StateViews& to, const IndexBox& region, const StateViews& a,
                 const StateViews& b, double share, IntVec3 shift) {
  const double rest = 1 - share;
  for (std::size_t n = 0; n < to.size(); ++n) {
    const double *const first_a = a[n].data, *const first_b = b[n].data;  // of the same cells
    for_each_row(to[n], region, a[n], shift, [=](double* t, const double* p, int length) {
      const double* const q = first_b + (p - first_a);
#pragma GCC ivdep
      for (int i = 0; i < length; ++i) t[i] = rest * p[i] + share * q[i];
    });
  }
}

PackedMessages::Piece PackedMessages::add(int rank, std::int64_t cells, std::int64_t Peer::*total) {
  std::size_t n = 0;
  while (n < peers_.size() && peers_[n].rank != rank) ++n;
  if (n == peers_.size()) peers_.emplace_back().rank = rank;
  const Piece piece{static_cast<int>(n), peers_[n].*total};
  peers_[n].*total += cells;
  return piece;
}

std::int64_t PackedMessages::send_cells() const {
  std::int64_t cells = 0;
  for (const Peer& p : peers_) cells += p.send_cells;
  return cells;
}

void PackedMessages::start(int components) {
  components_ = components;
  for (Peer& p : peers_) {
    p.send_buffer.resize(p.send_cells * components);
    p.receive_buffer.resize(p.receive_cells * components);
    if (p.receive_cells > 0)
      messages_.post_receive(p.receive_buffer.data(), p.receive_buffer.size(), p.rank, message_tag);
  }
}

double* PackedMessages::outgoing(const Piece& piece) {
  return peers_[piece.peer].send_buffer.data() + piece.first * components_;
}

double* PackedMessages::incoming(const Piece& piece) {
  return peers_[piece.peer].receive_buffer.data() + piece.first * components_;
}

void PackedMessages::send() {
  for (Peer& p : peers_)
    if (p.send_cells > 0)
      messages_.post_send(p.send_buffer.data(), p.send_buffer.size(), p.rank, message_tag);
}

void PackedMessages::wait() {
  messages_.wait_all();
}

}  // namespace sluice

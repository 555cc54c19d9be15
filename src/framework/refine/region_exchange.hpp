// What all transfers share: state as views by box, copies of regions, packed messages.
//
// A piece of a message is laid out like an array of its cells, component by component: packing and
// unpacking are copies between views, and an operator may write into a message directly.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "framework/refine/transfer_operators.hpp"

namespace sluice {

// All components of the slots, as the operators see them.
int component_count(const Warehouse& warehouse, const std::vector<int>& slots);
// The same of every local box, into `views` (whose memory is kept).
void view_boxes(const Warehouse& warehouse, const std::vector<int>& slots,
                std::vector<StateViews>& views);
// Views of consecutive arrays over `cells` that start at `data`.
void view_array(double* data, const IndexBox& cells, const Level& level, int components,
                StateViews& views);
// A level without its boxes, for laying out arrays.
Level without_boxes(const Level& level);
// Local numbers of a level's boxes, as a Warehouse counts them; -1 for those of other ranks.
std::vector<int> local_numbers(const Level& level, int rank);

// to = from at the cells of `region` (indices of `to`); `shift` leads to the cells of `from`.
void copy_state(const StateViews& to, const IndexBox& region, const StateViews& from,
                IntVec3 shift);
// to = (1 - share) a + share b, share from 0 to 1.
void blend_state(const StateViews& to, const IndexBox& region, const StateViews& a,
                 const StateViews& b, double share, IntVec3 shift);

// One message to and from each neighbour rank. Pieces are added by both sides in the same order.
class PackedMessages {
 public:
  struct Piece {
    int peer = -1;
    std::int64_t first = 0;  // cells of the message before this piece
  };
  Piece add_send(int rank, std::int64_t cells) { return add(rank, cells, &Peer::send_cells); }
  Piece add_receive(int rank, std::int64_t cells) { return add(rank, cells, &Peer::receive_cells); }
  std::int64_t send_cells() const;

  void start(int components);  // posts the receives
  double* outgoing(const Piece& piece);
  void send();  // when all outgoing pieces are written
  void wait();
  double* incoming(const Piece& piece);  // after wait()

 private:
  struct Peer {
    int rank = 0;
    std::int64_t send_cells = 0, receive_cells = 0;
    std::vector<double> send_buffer, receive_buffer;
  };
  Piece add(int rank, std::int64_t cells, std::int64_t Peer::*total);
  std::vector<Peer> peers_;
  Messages messages_;
  int components_ = 0;
};

}  // namespace sluice

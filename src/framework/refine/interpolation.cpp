// Carrying out an interpolation: gather or borrow coarse cells, then the component's operator.
#include <algorithm>
#include <array>
#include <stdexcept>

#include "framework/refine/interpolation_plan.hpp"
#include "framework/refine/level_transfer.hpp"

namespace sluice {
namespace {

// Fewer fine cells than this are not worth another thread.
constexpr std::int64_t cells_per_chunk = 2048;

// Targets that the component gets at a time: enough to fill vectors, few enough for the cache.
constexpr std::size_t group = 64;
constexpr std::int64_t group_cells = 2048;  // coarse ones that are gathered, of several targets

// Coarse values at a time between two states.
class CoarseState {
 public:
  void view(const Warehouse* before, const Warehouse* after, double share,
            const std::vector<int>& slots) {
    if (!(share >= 0 && share <= 1) || (share < 1 && before == nullptr) ||
        (share > 0 && after == nullptr))
      throw std::logic_error("interpolation in time lacks a state, or lies outside of 0 to 1");
    share_ = share;
    if (share < 1) view_boxes(*before, slots, before_);
    if (share > 0) view_boxes(*after, slots, after_);
  }
  bool blends() const { return share_ > 0 && share_ < 1; }
  double share() const { return share_; }
  // The state that is read first: the only one where nothing is to be blended.
  const StateViews& of(int box) const { return (share_ < 1 ? before_ : after_)[box]; }
  const StateViews& later(int box) const { return after_[box]; }
  void write(const StateViews& to, const IndexBox& region, int box, IntVec3 shift) const {
    if (blends())
      blend_state(to, region, before_[box], after_[box], share_, shift);
    else
      copy_state(to, region, of(box), shift);
  }

 private:
  double share_ = 0;
  std::vector<StateViews> before_, after_;
};

// What one thread needs to gather the coarse cells of a group of targets.
struct Gather {
  AlignedArray memory;
  std::ptrdiff_t used = 0;                     // of the memory
  std::array<StateViews, group> views, later;  // by target of the group
  StateViews piece;
  std::vector<Prolongation> regions;
};

// Views of a box in the indices of a target; `room` holds them where they are shifted.
const StateViews& in_indices_of(const InterpolationPlan::Target& target, const StateViews& box,
                                StateViews& room) {
  if (target.shift == IntVec3{}) return box;
  room = box;
  for (RealView& v : room) v.box = v.box.shifted(IntVec3{} - target.shift);
  return room;
}

}  // namespace

struct Interpolation::Plan : InterpolationPlan {
  using InterpolationPlan::InterpolationPlan;

  CoarseState state;
  std::vector<StateViews> fine_views;
  std::vector<Gather> gathers;  // by thread
  StateViews packed;
  int components = 0;

  void prepare(int threads);
  void send_parts();
  void interpolate(std::size_t first, std::size_t last, const TransferOperators& operators,
                   int order, const ThreadTeam* team);
  Prolongation coarse_cells(const Target& target, Gather& gather, bool blends);
  void prolong(std::span<const Target> some, Gather& gather, const TransferOperators& operators,
               int order);
};

void Interpolation::Plan::prepare(int threads) {
  gathers.resize(std::max(gathers.size(), static_cast<std::size_t>(threads)));
  const std::int64_t cells = std::max(max_coarse_cells, std::min(coarse_cells_of_all, group_cells));
  const std::size_t count = cells * components;
  for (Gather& g : gathers)
    if (g.memory.size() < count) g.memory = AlignedArray(count, Contents::undefined);
}

void Interpolation::Plan::send_parts() {
  messages.start(components);
  for (const Send& s : sends) {
    view_array(messages.outgoing(s.piece), s.cells, coarse, components, packed);
    state.write(packed, s.cells, s.box, {});
  }
  messages.send();
}

// A target with its coarse cells. Where one box holds all of them they are read there, also between
// two states if the operator `blends` them.
Prolongation Interpolation::Plan::coarse_cells(const Target& target, Gather& gather, bool blends) {
  StateViews& views = gather.views[gather.regions.size()];
  StateViews& later = gather.later[gather.regions.size()];
  Prolongation region;
  region.fine = &fine_views[target.box];
  region.cells = target.cells;
  if (target.direct >= 0 && (blends || !state.blends())) {
    region.coarse = &in_indices_of(target, state.of(target.direct), views);
    if (!state.blends()) return region;
    region.later = &in_indices_of(target, state.later(target.direct), later);
    region.share = state.share();
    return region;
  }
  region.coarse = &views;
  view_array(gather.memory.data() + gather.used, target.coarse, coarse, components, views);
  gather.used += target.coarse.volume() * components;
  if (target.direct >= 0) state.write(views, target.coarse, target.direct, target.shift);
  for (std::size_t n = target.first_source; n < target.last_source; ++n) {
    const Source& s = sources[n];
    if (s.box >= 0) {
      state.write(views, s.cells, s.box, s.shift);
    } else {
      view_array(messages.incoming(s.piece), s.cells, coarse, components, gather.piece);
      copy_state(views, s.cells, gather.piece, {});
    }
  }
  return region;
}

// In groups whose coarse cells fit the memory.
void Interpolation::Plan::prolong(std::span<const Target> some, Gather& gather,
                                  const TransferOperators& operators, int order) {
  const auto flush = [&] {
    if (gather.regions.empty()) return;
    operators.prolong_all(gather.regions, geometry, order);
    gather.regions.clear();
    gather.used = 0;
  };
  for (const Target& t : some) {
    const bool full = gather.used + t.coarse.volume() * components >
                      static_cast<std::ptrdiff_t>(gather.memory.size());
    if (gather.regions.size() == group || full) flush();
    gather.regions.push_back(coarse_cells(t, gather, operators.blends()));
  }
  flush();
}

void Interpolation::Plan::interpolate(std::size_t first, std::size_t last,
                                      const TransferOperators& operators, int order,
                                      const ThreadTeam* team) {
  const auto some = [&](std::size_t from, std::size_t to, int thread) {
    prolong(std::span(targets).subspan(from, to - from), gathers[thread], operators, order);
  };
  const std::size_t wanted = fine_cells / cells_per_chunk;
  const std::size_t chunks = std::min(wanted, last - first);
  if (team == nullptr || team->size() == 1 || chunks < 2) return some(first, last, 0);
  team->for_each(chunks, [&](std::size_t n, int thread) {
    some(first + (last - first) * n / chunks, first + (last - first) * (n + 1) / chunks, thread);
  });
}

Interpolation::Interpolation(std::unique_ptr<Plan> plan) : plan_(std::move(plan)) {}
Interpolation::Interpolation(Interpolation&&) noexcept = default;
Interpolation& Interpolation::operator=(Interpolation&&) noexcept = default;
Interpolation::~Interpolation() = default;

Interpolation Interpolation::for_ghosts(const Level& coarse, int coarse_ghosts, const Level& fine,
                                        int width, int rank, Arrays arrays) {
  return Interpolation(std::make_unique<Plan>(coarse, coarse_ghosts, fine,
                                              interface_ghosts(fine, width, arrays), rank));
}

Interpolation Interpolation::for_new_cells(const Level& coarse, int coarse_ghosts,
                                           const Level& fine, const std::vector<GridBox>& earlier,
                                           int rank) {
  return Interpolation(
      std::make_unique<Plan>(coarse, coarse_ghosts, fine, new_cells(fine, earlier), rank));
}

void Interpolation::run(const Warehouse* before, const Warehouse* after, double share,
                        Warehouse& fine, const std::vector<int>& slots,
                        const TransferOperators& operators, int order, const ThreadTeam* team) {
  Plan& p = *plan_;
  p.components = component_count(fine, slots);
  p.state.view(before, after, share, slots);
  view_boxes(fine, slots, p.fine_views);
  p.prepare(team != nullptr ? team->size() : 1);
  p.send_parts();
  p.interpolate(0, p.without_messages, operators, order, team);
  p.messages.wait();
  p.interpolate(p.without_messages, p.targets.size(), operators, order, team);
}

std::int64_t Interpolation::cells() const {
  return plan_->fine_cells;
}

std::size_t Interpolation::message_bytes(int components) const {
  return static_cast<std::size_t>(plan_->messages.send_cells()) * components * sizeof(double);
}

}  // namespace sluice

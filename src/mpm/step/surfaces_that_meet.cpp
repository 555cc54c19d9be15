// Surfaces of bodies where contact acts: mpm_scheme, section 6.
//
// What all ranks agree upon of masses tells at which nodes two bodies meet; only the particles
// around these are asked for volumes and gradients. Alone a body costs what it costs without rules.
#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// With several ranks each that has a block of one body must learn of all bodies there.
void SolidStep::unite_blocks() {
  std::vector<IntVec3> all;
  for (std::size_t m = 0; m < bodies_.size(); ++m)
    for (int b = 0; b < bodies_[m].table.count() && contact_->takes(static_cast<int>(m)); ++b)
      all.push_back(bodies_[m].table.block(b));
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    Body& body = bodies_[m];
    if (!contact_->takes(static_cast<int>(m))) continue;
    for (const IntVec3 block : all) body.table.find_or_add(block);
    body.nodes.fit(body.table);
  }
}

bool SolidStep::share_a_node(const BlockMember& one, const BlockMember& other) const {
  const auto counts = [&](const BlockMember& of) {
    return bodies_[static_cast<std::size_t>(of.body)].nodes.sums(of.block) + count_lane;
  };
  const std::int64_t *a = counts(one), *b = counts(other);
  for (int n = 0; n < block_lanes; n += lanes)
    if (a[n] != 0 && b[n] != 0) return true;
  return false;
}

// Blocks with a node at which several bodies have mass, or one whose rule acts on it alone.
void SolidStep::find_meetings() {
  any_meets_ = false;
  const int count = static_cast<int>(bodies_.size());
  for (Body& of : bodies_) of.meets.assign(static_cast<std::size_t>(of.table.count()), 0);
  const auto mark = [&](const BlockMember& of) {
    body(of.body).meets[static_cast<std::size_t>(of.block)] = 1;
    any_meets_ = true;
  };
  for (int m = 0; m < count; ++m)
    for (int b = 0; b < body(m).table.count() && contact_->takes(m); ++b) {
      const BlockMember own{m, b};
      if (contact_->leads(m) && share_a_node(own, own)) mark(own);
      for (int k = m + 1; k < count; ++k) {
        if (!contact_->takes(k)) continue;
        const BlockMember other{k, body(k).table.find(body(m).table.block(b))};
        if (other.block < 0 || !share_a_node(own, other)) continue;
        mark(own);
        mark(other);
      }
    }
}

// By block: those where a body meets others, and those with images of nodes there.
std::vector<char> SolidStep::blocks_of_surfaces(int m) const {
  const Body& body = bodies_[static_cast<std::size_t>(m)];
  std::vector<char> wanted = body.meets;
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = shape_.lower(body.table.block(b));
    if (!boundary_->has_images(low, shape_.edge, m)) continue;
    for_each_node(shape_, low, [&](int, IntVec3 node) {
      if (!boundary_->is_image(node, m)) return;
      const int of = body.table.find(shape_.block_of(boundary_->image(node, m).of));
      if (of >= 0 && body.meets[static_cast<std::size_t>(of)] != 0)
        wanted[static_cast<std::size_t>(b)] = 1;
    });
  }
  return wanted;
}

void SolidStep::gather_surfaces(const StageScope& scope, std::span<const SharedBlocks> shared) {
  std::vector<std::vector<char>> wanted;
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    wanted.push_back(blocks_of_surfaces(static_cast<int>(m)));
    bodies_[m].surfaces.fit(bodies_[m].table);
  }
  const auto reaches = [&](const BlockWork& w) {
    const BlockTable& table = bodies_[static_cast<std::size_t>(w.kind)].table;
    const std::vector<char>& of_body = wanted[static_cast<std::size_t>(w.kind)];
    const IntVec3 by{shape_.edge.x > 1, shape_.edge.y > 1, shape_.edge.z > 1};
    for (int k = -by.z; k <= by.z; ++k)
      for (int j = -by.y; j <= by.y; ++j)
        for (int i = -by.x; i <= by.x; ++i) {
          const int b = table.find(w.run.block + IntVec3{i, j, k});
          if (b >= 0 && of_body[static_cast<std::size_t>(b)] != 0) return true;
        }
    return false;
  };
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(shape_, 1));
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    if (contact_->takes(work_[n].kind) && reaches(work_[n]))
      add_surfaces_of(work_[n], windows[static_cast<std::size_t>(thread)], team.size() > 1);
  });
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    Body& body = bodies_[m];
    boundary_->fold(static_cast<int>(m), body.table, body.surfaces);
    exchange_->share_some(body.table, body.surfaces, shared[m], body.meets);
  }
}

void SolidStep::add_surfaces_of(const BlockWork& w, Window& window, bool shared) {
  Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  TransferGrid grid = body.grid;
  grid.half = contact_->half(w.kind);
  std::array<const double*, 3> x;
  for (int d = 0; d < 3; ++d) x[static_cast<std::size_t>(d)] = w.set->coordinate(d);
  window.begin(w.run.block);
  add_surfaces(grid, x, w.set->column(static_cast<std::size_t>(body.carried->columns.volume)),
               static_cast<int>(w.run.begin), static_cast<int>(w.run.end), surface_units_, window);
  window.add_to(body.table, body.surfaces, shared);
}

}  // namespace sluice::mpm

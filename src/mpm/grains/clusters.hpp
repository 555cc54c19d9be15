// Clusters of grains: which boxes overlap, directly or by others between.
//
// A cluster is named by the smallest id in it: neither the order of particles nor boxes, blocks or
// ranks have a part in it.
#pragma once
#include <functional>
#include <unordered_map>
#include <vector>

#include "framework/base/communicator.hpp"
#include "mpm/grains/grain_box.hpp"

namespace sluice::mpm {

// Do two boxes overlap or touch; through periodic sides too.
bool overlap(const GrainBox& a, const GrainBox& b, const Level& level);

// Sets the labels of boxes that are all known here: boxes with one label are of one cluster
// already.
void label_clusters(std::vector<GrainBox>& boxes, const Level& level);

// Boxes near others as each rank has labelled its own: what their clusters are called when all are
// known, by the labels that they had.
std::unordered_map<std::int64_t, std::int64_t> join_rims(const std::vector<GrainBox>& rims,
                                                         const Level& level);

// The same over all ranks. `near_others`: may a box overlap one of another rank. Collective.
void label_clusters(std::vector<GrainBox>& boxes, const Level& level,
                    const std::function<bool(const GrainBox&)>& near_others, Communicator& ranks);

}  // namespace sluice::mpm

// Passes 2 to 4 of the graph compiler: check, prune, order.
#include <algorithm>
#include <stdexcept>

#include "framework/task/graph.hpp"

namespace sluice {
namespace {

std::string describe(const TaskList& list, const EffectList& effects, std::size_t task) {
  const Task& t = list.tasks()[task];
  const Effect& e = effects[t.effect];
  std::string text = "task '" + t.name + "' of effect '" + e.name + "'";
  if (!e.line.file.empty()) text += " (called for at " + to_string(e.line) + ")";
  return text;
}

// Task that writes each variable, or -1.
std::vector<int> writers(const TaskList& list) {
  std::vector<int> writer(list.variables().size(), -1);
  for (std::size_t t = 0; t < list.tasks().size(); ++t)
    for (VariableId v : list.tasks()[t].writes) writer[v.index] = static_cast<int>(t);
  return writer;
}

}  // namespace

void check(const TaskList& list, const EffectList& effects) {
  std::vector<int> writer(list.variables().size(), -1);
  for (std::size_t t = 0; t < list.tasks().size(); ++t) {
    if (!list.tasks()[t].kernel)
      throw std::logic_error(describe(list, effects, t) + " has no kernel");
    if (list.tasks()[t].part && !list.tasks()[t].writes.empty())
      throw std::logic_error(describe(list, effects, t) +
                             " is for parts of blocks only, yet writes: the rest would be missing");
    for (VariableId v : list.tasks()[t].writes) {
      int& w = writer[v.index];
      if (w >= 0)
        throw std::logic_error(describe(list, effects, t) + " writes '" + list[v].name +
                               "', which " + describe(list, effects, w) + " writes already");
      if (list[v].storage == Storage::old_state)
        throw std::logic_error(describe(list, effects, t) + " writes '" + list[v].name +
                               "', which is the old state and read only");
      w = static_cast<int>(t);
    }
  }
  for (std::size_t t = 0; t < list.tasks().size(); ++t)
    for (const Access& a : list.tasks()[t].reads) {
      if (list[a.variable].storage == Storage::old_state) continue;
      if (writer[a.variable.index] < 0)
        throw std::logic_error(describe(list, effects, t) + " reads '" + list[a.variable].name +
                               "', which no task writes");
      if (list[a.variable].storage == Storage::output)
        throw std::logic_error(describe(list, effects, t) + " reads the output '" +
                               list[a.variable].name + "'; outputs are for archives only");
    }
  // A cycle shows as tasks that never become ready.
  order(list, std::vector<bool>(list.tasks().size(), true));
}

std::vector<bool> prune(const TaskList& list, const std::vector<VariableId>& wanted, bool reduces) {
  const std::vector<int> writer = writers(list);
  std::vector<bool> keep(list.tasks().size(), false);
  std::vector<int> todo;
  auto want = [&](int task) {
    if (task >= 0 && !keep[task]) {
      keep[task] = true;
      todo.push_back(task);
    }
  };
  for (VariableId v : wanted) want(writer[v.index]);
  for (std::size_t t = 0; t < list.tasks().size(); ++t)
    if (reduces && list.tasks()[t].always) want(static_cast<int>(t));
  while (!todo.empty()) {
    const Task& t = list.tasks()[todo.back()];
    todo.pop_back();
    for (const Access& a : t.reads) want(writer[a.variable.index]);
  }
  return keep;
}

std::vector<int> order(const TaskList& list, const std::vector<bool>& keep) {
  const std::vector<int> writer = writers(list);
  std::vector<int> result;
  std::vector<bool> done(list.tasks().size(), false);
  auto ready = [&](std::size_t t) {
    return std::all_of(list.tasks()[t].reads.begin(), list.tasks()[t].reads.end(),
                       [&](const Access& a) {
                         const int w = writer[a.variable.index];
                         return w < 0 || done[w];
                       });
  };
  const std::size_t wanted = std::count(keep.begin(), keep.end(), true);
  while (result.size() < wanted) {
    bool progressed = false;
    for (std::size_t t = 0; t < list.tasks().size(); ++t) {
      if (!keep[t] || done[t] || !ready(t)) continue;
      done[t] = true;
      result.push_back(static_cast<int>(t));
      progressed = true;
      break;  // restart from the first declared, so that declaration order breaks ties
    }
    if (progressed) continue;
    std::string names;
    for (std::size_t t = 0; t < list.tasks().size(); ++t)
      if (keep[t] && !done[t]) names += (names.empty() ? "'" : ", '") + list.tasks()[t].name + "'";
    throw std::logic_error("tasks wait for each other in a circle: " + names);
  }
  return result;
}

}  // namespace sluice

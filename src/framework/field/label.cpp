// The table of all labels of this process.
#include "framework/field/label.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>

namespace sluice {
namespace {

struct Registry {
  std::mutex mutex;
  std::deque<LabelInfo> infos;
  std::map<std::string, int, std::less<>> by_name;
};

Registry& registry() {
  static Registry r;
  return r;
}

}  // namespace

std::string_view name_of(Centring c) {
  constexpr std::string_view names[] = {"cell",   "node",     "x face",   "y face",
                                        "z face", "particle", "reduction"};
  return names[static_cast<int>(c)];
}

std::string_view name_of(ValueType t) {
  constexpr std::string_view names[] = {"real", "vector", "integer", "long integer"};
  return names[static_cast<int>(t)];
}

const LabelInfo& Label::info() const {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  if (id_ < 0 || id_ >= static_cast<int>(r.infos.size()))
    throw std::logic_error("label used before it was declared");
  return r.infos[static_cast<std::size_t>(id_)];
}

Label declare_label(LabelInfo info) {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  if (auto it = r.by_name.find(info.name); it != r.by_name.end()) {
    const LabelInfo& old = r.infos[static_cast<std::size_t>(it->second)];
    if (old.type != info.type || old.centring != info.centring)
      throw std::logic_error("label " + info.name + " declared twice with different types");
    return Label(it->second);
  }
  const int id = static_cast<int>(r.infos.size());
  r.by_name.emplace(info.name, id);
  r.infos.push_back(std::move(info));
  return Label(id);
}

std::optional<Label> find_label(std::string_view name) {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  auto it = r.by_name.find(name);
  if (it == r.by_name.end()) return std::nullopt;
  return Label(it->second);
}

int label_count() {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  return static_cast<int>(r.infos.size());
}

std::vector<Label> all_labels() {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  std::vector<Label> labels;
  for (const auto& [name, id] : r.by_name) labels.emplace_back(id);
  return labels;
}

}  // namespace sluice

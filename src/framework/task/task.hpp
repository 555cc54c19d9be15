// Declaring tasks: name, effect, what is read (with its stencil), what is written, a row kernel.
//
// A row kernel computes one contiguous row of cells (or of low faces of cells) of everything that
// the task writes. It asks the Row for pointers by the handles it got when it declared its reads
// and writes, and loops over row.count() with unit stride. It knows nothing of boxes, blocks,
// ranks, threads or files.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/field/label.hpp"
#include "framework/grid/index_box.hpp"
#include "framework/task/row.hpp"

namespace sluice {

// How far below and above a point a task reads, in cells of each level direction. A face variable
// of direction d holds at index i the face between cells i-1 and i of that direction, a node
// variable the low corner of cell i.
struct Stencil {
  IntVec3 low{}, high{};

  static Stencil point() { return {}; }
  static Stencil box(int r) { return {IntVec3::all(r), IntVec3::all(r)}; }
  static Stencil along(int direction, int low, int high) {
    Stencil s;
    s.low[direction] = low;
    s.high[direction] = high;
    return s;
  }
};

enum class Storage {
  old_state,  // the state at the start of the step: read only, ghosts filled by a halo point
  new_state,  // the state at the end of the step: written once, interior cells
  temporary,  // lives in a block's scratch memory, only as long as somebody reads it
  output      // stored for the archive or an analysis, interior cells (and closing faces)
};

struct Variable {
  std::string name;
  Storage storage = Storage::temporary;
  int components = 1;
  Label label;  // state and output
  int material = 0;
  IntVec3 closing{};  // layers of values beyond the last cell, of faces and nodes
};

struct VariableId {
  int index = -1;
  friend bool operator==(VariableId, VariableId) = default;
};

struct Access {
  VariableId variable;
  Stencil stencil;
};

using RowKernel = std::function<void(const Row&)>;
// The cells of a block of local box `box` outside of which a kernel has nothing to do.
using BlockPart = std::function<IndexBox(int box, const IndexBox& block)>;

struct Task {
  std::string name;
  int effect = 0;                             // index into the EffectList
  std::shared_ptr<const IndexOffsets> owner;  // the part that declared it
  std::vector<Access> reads;
  std::vector<VariableId> writes;
  RowKernel kernel;
  BlockPart part;          // of tasks that write nothing; none: whole blocks
  bool always = false;     // wanted for its reductions even when nobody reads what it writes
  bool needs_box = false;  // asks row.box() about its cells: they must be the box's or its ghosts
};

class TaskList;

class TaskBuilder {
 public:
  TaskBuilder(TaskList& list, std::size_t task) : list_(&list), task_(task) {}
  In read(VariableId v, Stencil s = Stencil::point());
  Out write(VariableId v);
  TaskBuilder& kernel(RowKernel k);
  TaskBuilder& always();
  TaskBuilder& needs_box();
  TaskBuilder& only_in(BlockPart part);

 private:
  TaskList* list_;
  std::size_t task_;
};

// Everything the effects of one graph declared.
class TaskList {
 public:
  // Effects, materials and reductions of what is declared from now on are counted from here.
  void begin_part(IndexOffsets part);

  VariableId old_state(Label label, int material, int components);
  VariableId new_state(Label label, int material, int components);
  VariableId output(Label label, int material);
  VariableId temporary(std::string name, int components = 1, int face_direction = -1);
  TaskBuilder task(std::string name, int effect);

  const std::vector<Variable>& variables() const { return variables_; }
  const std::vector<Task>& tasks() const { return tasks_; }
  const Variable& operator[](VariableId v) const { return variables_[v.index]; }

 private:
  friend class TaskBuilder;
  VariableId add(Variable v);
  VariableId state(Storage storage, const char* when, Label label, int material, int components);
  std::shared_ptr<const IndexOffsets> part_ = std::make_shared<const IndexOffsets>();
  std::vector<Variable> variables_;
  std::vector<Task> tasks_;
};

}  // namespace sluice

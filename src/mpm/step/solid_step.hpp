// One step of all solids of a level, stage by stage: mpm_scheme, section 2.
//
// An attempt writes beside what there is: new columns of the particles, nodes. Only the journal
// makes them the present state.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/run/component/step_shape.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/contact/surface_sums.hpp"
#include "mpm/loads/insertions.hpp"
#include "mpm/loads/prescribed_motion.hpp"
#include "mpm/nodes/node_blocks.hpp"
#include "mpm/nodes/node_exchange.hpp"
#include "mpm/step/body_energy.hpp"
#include "mpm/step/cohesive_zones.hpp"
#include "mpm/step/columns.hpp"
#include "mpm/step/heat.hpp"
#include "mpm/step/law_batch.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/parted_neighbours.hpp"
#include "mpm/step/pore_water.hpp"
#include "mpm/step/rates.hpp"
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/impulses_from_grid.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// The particles of one block of a box, as threads take them.
struct BlockWork {
  int kind = 0;
  const ParticleSet* set = nullptr;
  ParticleSet* next = nullptr;
  BlockRun run;
  int box = 0;                                // local number
  IntVec3 lowest{}, highest{};                // nodes that they reach
  IntVec3 middle_lowest{}, middle_highest{};  // at the middle of the step: midpoint transfer
};

// One material on the nodes of a level.
struct Body {
  Body(const SolidMaterial& of, const Carried& what, const BlockShape& shape)
      : material(&of), carried(&what), table(shape) {}

  const SolidMaterial* material;
  const Carried* carried;
  BlockTable table;
  NodeLanes nodes;
  std::vector<char> meets;  // by block: contact may act at one of its nodes
  NodeLanes surfaces;       // what it asks for there, see mpm/contact/surface_sums.hpp
  TransferGrid grid;
  KindRates rates;
  SumUnits units;
  EnergyUnits energy_units;
  PartedNeighbours parted;
  double most_force = 0;       // from outside on one particle, any component, N
  double pore_pull = 0;        // bound of V p of one particle, J
  NodeLanes filtered, mapped;  // velocities of XPIC; mapped back: sums, then velocities
  SumUnits mapped_units;
  std::vector<CornerForce> corners;  // loads on corners of this rank's particles, then the fluid's
  std::size_t corner_loads = 0;      // how many are loads
  NodeLanes cohesive;                // sums of cohesive points: stiffness, -, -, - | force
  NodeLanes met;       // midpoint transfer, where contact holds: its direction, v* along it
  NodeLanes friction;  // rise of temperature by friction, where it heats
  Vec3 pushed{};       // change of velocity of a body that transmits forces
};

// What a step sums for the books of a run, beside what its particles tell.
struct StepSums {
  // Impulse of boundary values; of body forces; work of both; of contact: what friction and impacts
  // took from the nodes' kinetic energy, force and torque on masters. Of nodes: what they gained of
  // kinetic energy, K* - K, and the work of the forces that particles gave them.
  enum Index {
    impulse_x,
    impulse_y,
    impulse_z,
    force_x,
    force_y,
    force_z,
    work,
    force_work,
    contact_loss,
    node_gain,
    node_work,
    // Of the midpoint transfer: what kicks gave to particles beyond that gain of nodes.
    beyond_nodes,
    inner_gain,  // what spins and affine velocities within particles got
    lost_heat,   // what of the energy lost became heat
    load_work,   // of forces from outside on particles, within node_work and force_work
    reaction_x,
    reaction_y,
    reaction_z,
    torque_x,
    torque_y,
    torque_z,
    // Beside a fluid: heat that particles exchange with it; what its forces on corners work on
    // nodes; what exchange adds to the kinetic energy of particles; what solids work on it, less
    // that of the reference pressure. J
    heat_from_fluid,
    corner_work,
    exchange_gain,
    surface_work,
    // What particles that leave the domain take along: momentum, kinetic and internal energy, the
    // work of the reference pressure on their volume. Behind `count` their mass, by material; then
    // the sums of BodyEnergySums, material by material.
    left_x,
    left_y,
    left_z,
    left_kinetic,
    left_internal,
    left_reference,
    count
  };
  static std::size_t of_body(std::size_t materials, std::size_t body) {
    return count + materials + body * BodyEnergySums::count;
  }
  static std::size_t all(std::size_t materials) { return of_body(materials, materials); }
};

// A step as nodes take it.
struct NodeStep {
  double kick = 0;  // from the middle of the step before to the middle of this one
  double dt = 0;
  Vec3 gravity{};
  double damping = 0;  // 1/s
};
// Exact sums over nodes; impulses that bodies that transmit forces gave to others, by body.
using Impulse = std::array<ExactSum, 3>;
using MassAndImpulse = std::array<ExactSum, 4>;
struct NodeBooks {
  std::array<ExactSum, StepSums::count> sums;
  std::vector<Impulse> given;
  std::vector<BodyEnergySums> bodies;

  void merge(const NodeBooks& other);
};

// The same block of nodes of a body, among all bodies that have it.
struct BlockMember {
  int body = 0, block = 0;
};
// What moves a node: its change of velocity by contact A, the impulse of its forces, and that of
// both hooks of contact.
struct NodeImpulses {
  Vec3 change{}, push{}, met{};
  bool held = false;  // by a master, or as one with another body
};
using BlockImpulses = std::array<NodeImpulses, block_nodes>;
// What one thread keeps of such a block from hook to hook; work: of contact, from outside.
struct MeetingScratch {
  ContactNode meeting;
  std::vector<BlockImpulses> impulses;  // by member
  std::array<double, block_nodes> work{};
};

struct NodeMean {
  IntVec3 node;
  double weight = 0;
  std::array<double, 6> mean{};
};

class SolidStep {
 public:
  // The kinds of particles are the materials, in their order, and then the cohesive zones.
  SolidStep(const Scene& scene, const MpmScene& solids, const std::vector<Carried>& carried,
            const std::vector<ParticleKind>& kinds);

  // The stages of a step, in order.
  Verdict begin(const StageScope& scope);
  Verdict to_grid(const StageScope& scope);
  Verdict share_sums(const StageScope& scope, NodeLanes Body::*group = &Body::nodes);
  Verdict move_nodes(const StageScope& scope);
  Verdict from_grid(const StageScope& scope);

  // Spacings of the finest and the coarsest level: bounds of sums are the same on all.
  void set_spacings(Vec3 finest, Vec3 coarsest) {
    finest_ = finest;
    coarsest_ = coarsest;
  }
  // The bound of forces from outside; the same on all levels.
  void set_most_force(int body, double force);
  // Images across sides join their nodes, and get the velocities of these.
  void fold(NodeLanes Body::*group = &Body::nodes);
  void unfold(NodeLanes Body::*group = &Body::nodes);

  // XPIC, for SolidLevels: velocities of nodes in a group of their own (their largest components by
  // material), the first term of the filter, sums of one more pass, its velocities, its term.
  std::vector<double> take_velocities();
  void begin_filter(std::span<const double> most);
  void sum_filtered(const StageScope& scope, bool first);
  void finish_filter();
  void add_filtered(double factor);
  // MUSL: particles move (bounds of their new velocities); sums of these; velocities of nodes. The
  // midpoint transfer: they have their new velocities; fault: why the step cannot go on.
  std::vector<KindRates> move_all(const StageScope& scope);
  std::vector<KindRates> kick_all(const StageScope& scope, std::string& fault);
  // Of the start of the midpoint transfer: particles as they are, with their spins or without,
  // where new ones will stand (bounds of them); spins from the velocities that they mapped.
  std::vector<KindRates> hold_start(const StageScope& scope, bool spins);
  void take_spins(const StageScope& scope);
  void sum_back(const StageScope& scope, std::span<const KindRates> bounds);
  void finish_back(const StageScope& scope);

  // Between begin() and to_grid(): further forces on corners of this rank's particles, by material;
  // they go to the nodes around their places with hats. The largest component of all is to be
  // known before, see SolidLevels::add_corner_forces.
  void add_corner_forces(int body, std::span<const CornerForce> forces);

  // After move_nodes(): mass of rigid bodies that transmit forces, and what moves them beside
  // gravity, N s; of this level and rank (step/transmitted_forces.cpp). Then their share of it.
  bool transmits(int body) const;  // and no rule prescribes its motion
  // Of a master in this step; null: no rule prescribes any.
  const MasterMotion* motion_of(int body) const {
    return contact_ != nullptr ? contact_->motion_of(body) : nullptr;
  }
  const MassAndImpulse& transmitted(int body) const;
  void push(int body, double mass, Vec3 impulse);
  // Heat of friction on nodes, where it acts, to images.
  void unfold_friction();

  Body& body(int m) { return bodies_[static_cast<std::size_t>(m)]; }
  const NodeExchange& exchange() const { return *exchange_; }
  // After from_grid() on all levels: the share of what particles of a body have lost becomes heat.
  void give_heat(int body, double share, double dt);
  // After from_grid(): velocities were changed further; bounds of those of a body (all ranks').
  void include_velocities(int body, Vec3 up, Vec3 down);
  // After from_grid(): what the next step rests on, and how far particles went.
  const std::vector<double>& new_rates() const { return new_rates_; }
  double travel() const { return travel_; }  // cells
  bool any_left() const { return left_; }    // the domain

  // After share_sums(): the materials on the nodes.
  const std::vector<Body>& bodies() const { return bodies_; }
  // Weighted means of up to six columns around nodes, sum w q S / sum w S. Collective.
  std::vector<NodeMean> mean_on_nodes(const StageScope& scope, int body, int weight, int first,
                                      int count);

 private:
  void list_work(ParticleCloud& cloud, double time);
  // Materials that do not take part (step/resting.cpp).
  bool rests(int kind, double time) const;
  void keep(int kind, ParticleStore& store) const;
  double keep_resting(const StepScope& step, std::vector<KindRates>& rates) const;
  void find_outside_forces(const StageScope& scope);
  WaterLoan lend_to_water(const StageScope& scope) {
    return {&scope, &bodies_, &work_, exchange_.get(), boundary_.get()};
  }
  // Surfaces of bodies where they meet (step/surfaces_that_meet.cpp).
  void find_meetings();
  bool share_a_node(const BlockMember& one, const BlockMember& other) const;
  std::vector<char> blocks_of_surfaces(int body) const;
  void gather_surfaces(const StageScope& scope, std::span<const SharedBlocks> shared);
  void add_surfaces_of(const BlockWork& work, Window& window, bool shared);
  void unite_blocks();
  // Nodes of a block, one after the other (step/move_nodes.cpp).
  void start_block(const NodeStep& step, int body, int block,
                   NodeBooks& books);  // sums become M, v_i | f
  void kick_block(const NodeStep& step, int body, int block,
                  BlockImpulses& impulses);  // M, v_i | v*
  void finish_block(const NodeStep& step, int body, int block, const BlockImpulses& impulses,
                    NodeBooks& books);  // v* - v_ref, M | v* - v_i
  void find_nodes_of(BlockWork& work) const;
  SumUnits units_of(const Body& body, int kind, const KindRates& rates) const;
  void hold_boundary(int body);
  double find_corners(int kind);
  void share_cohesive();
  void corners_to_grid();
  void book_corner_work(double dt, NodeBooks& books) const;
  Vec3 mean_velocity_of_corner(const Body& body, Vec3 place, double dt) const;
  void move_block(const NodeStep& step, int body, int block, MeetingScratch& scratch,
                  NodeBooks& books);
  // What mirrors give (step/mirror_books.cpp): from forces, and from changes of velocity.
  void book_mirrored_forces(const NodeStep& step, int body, int block, NodeBooks& books) const;
  void book_mirrored_changes(NodeBooks& books) const;
  void book_mirrored_changes(int body, const NodeLanes& lanes, NodeBooks& books) const;
  // Bodies that share blocks (step/meet_nodes.cpp).
  void list_groups();
  bool meets(std::span<const BlockMember> members) const;
  void move_group(const NodeStep& step, std::span<const BlockMember> members,
                  MeetingScratch& scratch, NodeBooks& books);
  bool gather(std::span<const BlockMember> members, int n, IntVec3 at, bool side, Hook hook,
              ContactNode& meeting) const;
  void meet(const NodeStep& step, std::span<const BlockMember> members, Hook hook,
            MeetingScratch& scratch, NodeBooks& books);
  void prescribe(const Matrix3& rate, int body, int block);
  // Heat of friction (step/friction_heat.cpp).
  void keep_friction_heat(std::span<const BlockMember> members, const MeetingScratch& scratch);
  void diffuse(const BlockWork& work, std::size_t at, int n, double dt) const;
  bool warms_by_friction(const Body& body) const {
    return prescribed_ == nullptr && body.material->warms_by_contact(*solids_);
  }
  // Rigid bodies that transmit forces (step/transmitted_forces.cpp).
  void sum_body(int kind, double kick, MassAndImpulse& sums) const;
  void sum_transmitted(const NodeStep& step, NodeBooks& books);
  void jump(const BlockWork& work, std::size_t at, int n, bool& left) const;
  struct ThreadReport;
  void warm_by_friction(const BlockWork& work, std::size_t at, int n, ThreadReport& report) const;
  void read_rigid(const BlockWork& work, std::size_t at, int n, bool booked,
                  ThreadReport& report) const;
  void take_outside_forces(const BlockWork& work, std::size_t at, int n,
                           const GridAtParticles& read, NodeBooks& books) const;
  // Pressure stabilisation (step/share_dilatation.cpp).
  void find_dilatations(const BlockWork& work, double dt, const Window& window,
                        GridAtParticles& read, LawBatch& columns,
                        std::vector<double>& dilatation) const;
  void take_dilatation(const BlockWork& work, std::size_t at, const Batch& batch,
                       std::span<const double> dilatation, GridAtParticles& read) const;
  void move_particles(const BlockWork& work, const StageScope& scope, std::size_t at, int n,
                      ThreadReport& report);
  // Heat of lost energy (step/lost_energy.cpp).
  void begin_losses(const BlockWork& work, std::size_t at, int n,
                    const ImpulsesAtParticles& got) const;
  void load_losses(const BlockWork& work, ThreadReport& report) const;
  void add_works(const BlockWork& work, std::size_t at, int n, ThreadReport& report) const;
  void find_inner(const BlockWork& work, std::size_t at, int n, const GridAtParticles& read,
                  double* within, double* gained) const;
  void settle_losses(const BlockWork& work, const StageScope& scope, std::size_t at, int n,
                     ThreadReport& report) const;
  void advance(const BlockWork& work, const StageScope& scope, ThreadReport& report);
  std::vector<KindRates> take_first_reports(const StageScope& scope,
                                            const std::vector<ThreadReport>& reports,
                                            std::string& fault);
  // The midpoint transfer (step/midpoint_stage.cpp).
  void kick_particles(const BlockWork& work, const StageScope& scope, std::size_t at, int n,
                      ThreadReport& report);
  void book_kick(const BlockWork& work, std::size_t at, int n, ThreadReport& report) const;
  void relax_spins(const BlockWork& work, double dt, std::size_t at, int n,
                   ThreadReport& report) const;
  double extent_of_middle(const Body& body) const;
  void find_middle_nodes(BlockWork& work, const ThreadReport& report) const;
  void add_bounds(const BlockWork& work, std::size_t at, int n, ThreadReport& report) const;
  std::array<const double*, 3> places_of_gradients(const BlockWork& work) const;
  ParticleShape shape_of_gradients(const BlockWork& work) const;
  double halve_corners(const BlockWork& work, double half, std::size_t at, int n,
                       const VelocitiesAtCorners& v) const;
  void stay(const BlockWork& work, std::size_t at, int n) const;
  void finish_motion(const BlockWork& work, double dt, std::size_t at, int n,
                     ThreadReport& report) const;
  std::vector<ThreadReport> new_reports(const StageScope& scope) const;
  Verdict conclude(const StageScope& scope, std::vector<ThreadReport>& reports);
  void book_bodies();

  const Scene* scene_;
  const MpmScene* solids_;
  const std::vector<Carried>* carried_;
  const std::vector<ParticleKind>* kinds_;
  Level level_;
  BlockShape shape_;
  std::unique_ptr<NodeBoundary> boundary_;
  std::unique_ptr<NodeExchange> exchange_;
  std::unique_ptr<OutsideForces> outside_;
  std::unique_ptr<PrescribedMotion> prescribed_;  // null: the particles are free
  std::vector<Insertion> insertions_, jumps_;     // of the run, of this step
  std::unique_ptr<Heat> heat_;                    // null: heat cannot move
  std::unique_ptr<Heat> concentration_;           // null: nothing diffuses
  std::unique_ptr<CohesiveZones> cohesive_;       // null: the deck has none
  std::unique_ptr<PoreWater> water_;              // null: no water moves through pores
  std::vector<Body> bodies_;
  std::unique_ptr<Contact> contact_;  // null: no rule acts
  bool any_meets_ = false;            // of the blocks of this rank
  SurfaceUnits surface_units_;
  std::vector<BlockMember> members_;                         // group after group
  std::vector<std::pair<std::size_t, std::size_t>> groups_;  // first member, number of them
  std::vector<BlockWork> work_;
  std::vector<double> new_rates_;
  Vec3 finest_{}, coarsest_{};
  bool left_ = false;  // a particle is out of the domain
  double travel_ = 0;  // of this step, cells
  NodeBooks books_;    // of this rank
  double kick_ = 0;
  Vec3 fall_{};                              // kick by gravity, m/s
  std::vector<MassAndImpulse> transmitted_;  // by body
};

// Axes and active directions of a level, widths of particles.
TransferGrid transfer_grid(const MpmScene& solids, const Level& level,
                           const std::array<double, 3>& half);

}  // namespace sluice::mpm

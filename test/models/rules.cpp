// SPDX-License-Identifier: MIT
#include "rules.h"

#include <algorithm>
#include <array>

#include "healing/healing.hpp"
#include "healing/hold.hpp"
#include "healing/tick.hpp"
#include "tree/census.hpp"
#include "tree/epoch.hpp"
#include "tree/label.hpp"
#include "tree/parent_selection.hpp"
#include "tree/root_selection.hpp"
#include "tree/spare_management.hpp"
#include "tree/tree_index.hpp"

namespace {

using namespace banyan;

// One root, no fragments: the newest root token, and the largest (epoch, phase).
void listen(HealingRobot& robot) {
  for (const Heard& h : robot.news_of_tree())
    if (newer(h.message->root, robot.self.root)) robot.self.root = h.message->root;
  follow_phase(robot, newest_phase(robot));
}
void advance(HealingRobot& robot, bool tree_complete) {
  advance(robot, tree_complete, true, whole(robot.params.barrier_rounds));
}

RobotId to_id(int id) { return id < 0 ? nobody : static_cast<RobotId>(id); }
signed char from_id(RobotId id) { return id == nobody ? static_cast<signed char>(-1) : static_cast<signed char>(id); }

// One robot, and whom it hears in this step. The memory is the same for all: what is left in it of another
// call would be a channel between robots, so it is wiped each time.
class Bench {
 public:
  explicit Bench(int me) {
    self() = blank();
    self().id = to_id(me);
    count_ = 0;
  }
  static HealingState& self() {
    static HealingState state;
    return state;
  }
  static HealingMessage& put(int id, Vec2 position) {
    HealingMessage& m = messages_[count_] = HealingMessage{};
    heard_[count_] = {&m, position};
    ++count_;
    m.id = to_id(id);
    return m;
  }
  // All of them are in the table and have just been heard.
  template <class Call> void step(Call call) {
    const Inputs<Heard> inputs(std::span<Heard>(heard_).first(count_), {}, platform);
    Workspace space(inputs);
    HealingRobot robot(params(), self(), inputs, space);
    begin_tick(robot, inputs);
    index_neighbors(robot);
    call(robot);
  }
  static constexpr Platform platform{.communication_range_m = 2.0F, .wheel_limit_m_s = 0.2F};
  static HealingParams& params() {
    static HealingParams p = [] {
      HealingParams short_waits;
      short_waits.liveness_rounds = 5.0F;
      short_waits.insertion_drives = 0.2F;
      short_waits.connector_rounds = 20.0F;
      return short_waits;
    }();
    return p;
  }

 private:
  static const HealingState& blank() {
    static const HealingState state;
    return state;
  }
  static inline std::array<HealingMessage, largest_swarm> messages_;
  static inline std::array<Heard, largest_swarm> heard_;
  static inline std::size_t count_;
};

// ---- order.pml ----

constexpr RobotId elsewhere = 99;

Bench order_bench(int me, const Order& self) {
  Bench bench(me);
  HealingState& s = Bench::self();
  s.epoch = self.epoch;
  s.phase = Phase::grow_tree;
  s.seqno = self.seqno;
  s.label = self.label;
  s.parent = to_id(self.parent);
  s.root = {1, self.root ? s.id : elsewhere};
  return bench;
}

HealingMessage& order_hear(int id, const Order& heard, int cm) {
  HealingMessage& m = Bench::put(id, {0.01F * static_cast<float>(cm), 0});
  m.epoch = heard.epoch;
  m.phase = Phase::grow_tree;
  m.seqno = heard.seqno;
  m.label = heard.label;
  m.parent = to_id(heard.parent);
  m.tree_hops = 0;
  m.depth = 1;
  if (heard.parent < 0) m.grant = elsewhere;  // it has a hold: anybody may be one
  return m;
}

void order_read(Order& self) {
  const HealingState& s = Bench::self();
  self.epoch = s.epoch;
  self.seqno = s.seqno;
  self.label = s.label;
  self.parent = from_id(s.parent);
}

constexpr auto never = [](auto...) { return false; };
constexpr auto always = [](auto...) { return true; };
constexpr auto none = [](auto...) {};

}  // namespace

int order_is_ahead(int me, const Order* self, int id, const Order* heard) {
  Bench bench = order_bench(me, *self);
  order_hear(id, *heard, 1);
  bool ahead = false;
  bench.step([&](HealingRobot& robot) { ahead = is_ahead(robot, 0); });
  return ahead;
}

void order_take_parent(int me, Order* self, int id, const Order* heard, int cm) {
  Bench bench = order_bench(me, *self);
  order_hear(id, *heard, cm);
  bench.step([](HealingRobot& robot) { take_parent(robot, 0); });
  order_read(*self);
}

void order_leave(int me, Order* self) {
  Bench bench = order_bench(me, *self);
  bench.step([](HealingRobot& robot) { leave_tree(robot); });
  order_read(*self);
}

void order_update(int me, Order* self, int id, const Order* heard, int cm) {
  Bench bench = order_bench(me, *self);
  if (id >= 0) order_hear(id, *heard, cm);
  HealingState& s = Bench::self();
  if (s.parent != nobody) s.role = Role::connector;  // a spare would leave
  bench.step([](HealingRobot& robot) {
    select_parent(robot, {.may_join = false, .prefers = never});
    find_hold(robot);
  });
  order_read(*self);
}

void order_take_label(int me, Order* self, int id, const Order* heard, int cm) {
  Bench bench = order_bench(me, *self);
  order_hear(id, *heard, cm);
  Bench::self().label_wait_ticks = 100;  // it has waited for nearer ones
  bench.step([](HealingRobot& robot) { update_label(robot); });
  order_read(*self);
}

void order_join_edge(int me, Order* self, int owner, const Order* owned, int above, const Order* over) {
  Bench bench = order_bench(me, *self);
  order_hear(owner, *owned, 1).grant = to_id(me);
  order_hear(above, *over, 1);
  Bench::self().request = to_id(owner);
  bench.step([](HealingRobot& robot) {
    manage_spares(robot, {.needs_spare = never, .may_call = never, .count_waiting = none, .may_insert = always});
  });
  order_read(*self);
}

void order_listen(int me, Order* self, int id, const Order* heard) {
  Bench bench = order_bench(me, *self);
  order_hear(id, *heard, 1);
  bench.step([](HealingRobot& robot) { listen(robot); });
  order_read(*self);
}

void order_open_epoch(int me, Order* self) {
  Bench bench = order_bench(me, *self);
  bench.step([](HealingRobot& robot) { enter(robot, static_cast<Serial>(robot.self.epoch + 1), Phase::start_tree); });
  order_read(*self);
}

// ---- token.pml ----

namespace {

Bench token_bench(int me, const Token& self) {
  Bench bench(me);
  HealingState& s = Bench::self();
  s.epoch = self.epoch;
  s.phase = static_cast<Phase>(self.phase);
  s.root = {self.sequence, to_id(self.root)};
  s.root_size = self.size;
  s.new_root = to_id(self.new_root);
  s.is_worker = self.worker;
  s.root_known = true;  // and it is here
  if (s.is_worker) s.serves = s.id;
  s.was_sent = s.is_worker;
  return bench;
}

void token_put(int id, const Token& heard, Vec2 position) {
  HealingMessage& m = Bench::put(id, position);
  m.epoch = heard.epoch;
  m.phase = static_cast<Phase>(heard.phase);
  m.root = {heard.sequence, to_id(heard.root)};
  m.root_size = heard.size;
  m.new_root = to_id(heard.new_root);
  m.role = heard.worker ? Role::worker : Role::connector;
}

void token_read(Token& self) {
  const HealingState& s = Bench::self();
  self.epoch = s.epoch;
  self.phase = static_cast<unsigned char>(s.phase);
  self.sequence = s.root.sequence;
  self.root = from_id(s.root.id);
  self.size = static_cast<unsigned char>(s.root_size);
  self.new_root = from_id(s.new_root);
}

// Orders are followed at every step, and would send no worker.
template <class Call> void token_step(Bench& bench, const Token& self, Call call) {
  bench.step([&](HealingRobot& robot) {
    robot.self.is_worker = self.worker;
    call(robot);
  });
}

}  // namespace

int token_is_root(int me, const Token* self) { return self->root == me; }

void token_hear(int me, Token* self, int id, const Token* heard) {
  Bench bench = token_bench(me, *self);
  token_put(id, *heard, {1, 0});
  token_step(bench, *self, [](HealingRobot& robot) {
    listen_among_fragments(robot);
    accept_offered_root(robot);
    if (!robot.is_root()) select_root(robot, never);  // an offer ends with the token
  });
  token_read(*self);
}

void token_select_root(int me, Token* self, int heir, const Token* heard, int late) {
  Bench bench = token_bench(me, *self);
  if (heir >= 0) token_put(heir, *heard, {1, 0});
  HealingState& s = Bench::self();
  s.centroid = {1, 0};
  s.centroid_known = true;
  s.offer_ticks = late ? 60000 : 0;
  token_step(bench, *self, [](HealingRobot& robot) { select_root(robot, always); });
  token_read(*self);
}

void token_claim(int me, Token* self) {
  Bench bench = token_bench(me, *self);
  Bench::self().silence_ticks = 60000;
  token_step(bench, *self, [](HealingRobot& robot) { claim_root(robot); });
  token_read(*self);
}

void token_advance(int me, Token* self, int robots) {
  Bench bench = token_bench(me, *self);
  HealingState& s = Bench::self();
  s.flood_done = true;
  s.flood_robots = static_cast<std::uint16_t>(robots);
  s.phase_ticks = 60000;
  s.done_ticks = 100;
  token_step(bench, *self, [](HealingRobot& robot) {
    const Phase before = robot.self.phase;
    advance_and_count(robot, true);
    robot.self.done_ticks = 100;
    robot.self.phase_ticks = 60000;
    if (before == Phase::start_tree) advance_and_count(robot, true);
  });
  token_read(*self);
}

// ---- takeover.pml ----

void service_step(int me, Service* self, int id, const Service* heard, int beats, int silent) {
  constexpr RobotId first = 0;
  Bench bench(me);
  HealingState& s = Bench::self();
  s.root = {1, elsewhere};
  s.is_worker = self->serving;
  s.serves = self->serving ? first : nobody;
  s.role = self->serving ? Role::worker : Role::spare;
  if (self->known) {
    s.task_count = 1;
    s.tasks[0] = {.serves = first,
                  .holder = to_id(self->holder),
                  .beat = self->beat,
                  .age_ticks = static_cast<std::uint16_t>(silent ? 30000 : 0),
                  .target = {1, 0}};
    if (self->serving) s.tasks[0].beat = static_cast<Serial>(s.tasks[0].beat + beats - 1);
  }
  if (id >= 0 && heard->known) {
    HealingMessage& m = Bench::put(id, {0.5F, 0});
    m.task_serves = first;
    m.task_holder = to_id(heard->holder);
    m.task_beat = heard->beat;
    m.told = to_id(me);
    m.task_x = Coordinate::of(0.5F);
  }
  bench.step([&](HealingRobot& robot) {
    robot.self.is_worker = self->serving;
    robot.self.serves = self->serving ? first : nobody;
    for (Heard& h : robot.heard) h.before = h.position;  // heard the tick before, too
    watch_tasks(robot);
  });
  self->known = s.task_count > 0;
  if (self->known) {
    self->beat = s.tasks[0].beat;
    self->holder = from_id(s.tasks[0].holder);
  }
  self->serving = s.is_worker;
}

int service_ahead_by(unsigned short a, unsigned short b) { return ahead_by(a, b); }

// ---- epochs.pml ----

namespace {

Bench stage_bench(int me, const Stage& self) {
  Bench bench(me);
  HealingState& s = Bench::self();
  s.epoch = self.epoch;
  s.phase = static_cast<Phase>(self.phase);
  s.root = {1, 0};
  s.label = self.label;
  s.flood_parent = to_id(self.flood_parent);
  s.flood_done = self.flood_done;
  s.flood_workers = self.flood_workers;
  s.subtree_workers = self.subtree_workers;
  s.parent = to_id(self.parent);
  s.old_parent = to_id(self.old_parent);
  s.committed = self.committed;
  s.is_worker = s.was_sent = self.worker;
  if (self.worker) s.serves = s.id;
  s.role = me == 0 ? Role::root : self.worker ? Role::worker : Role::connector;
  return bench;
}

void stage_read(Stage& self) {
  const HealingState& s = Bench::self();
  self.epoch = s.epoch;
  self.phase = static_cast<unsigned char>(s.phase);
  self.label = s.label;
  self.flood_parent = from_id(s.flood_parent);
  self.flood_done = s.flood_done;
  self.flood_workers = static_cast<unsigned char>(s.flood_workers);
  self.subtree_workers = static_cast<unsigned char>(s.subtree_workers);
  self.parent = from_id(s.parent);
  self.old_parent = from_id(s.old_parent);
  self.committed = s.committed;
}

}  // namespace

void stage_step(int me, Stage* self, const Stage* const* heard, const int* from, int count, int patient, int late) {
  Bench bench = stage_bench(me, *self);
  for (int k = 0; k < count; ++k) {
    HealingMessage& m = Bench::put(from[k], {1, 0.01F * static_cast<float>(from[k])});
    const Stage& h = *heard[k];
    m.epoch = h.epoch;
    m.phase = static_cast<Phase>(h.phase);
    m.root = {1, 0};
    m.label = h.label;
    m.flood_parent = to_id(h.flood_parent);
    m.flood_done = h.flood_done;
    m.flood_workers = h.flood_workers;
    m.subtree_workers = h.subtree_workers;
    m.parent = to_id(h.parent);
    m.old_parent = to_id(h.old_parent);
    m.committed = h.committed;
    m.role = from[k] == 0 ? Role::root : h.worker ? Role::worker : Role::connector;
    m.depth = 1;
  }
  HealingState& s = Bench::self();
  s.label_wait_ticks = patient ? 0 : 100;
  s.done_ticks = 100;  // settle_ticks are no part of the argument
  s.phase_ticks = static_cast<std::uint16_t>(late ? 1000 : 5);
  bench.step([&](HealingRobot& robot) {
    robot.self.is_worker = self->worker;
    listen(robot);
    index_neighbors(robot);
    if (late) robot.self.phase_ticks = 1000;
    else if (robot.is_root()) robot.self.done_ticks = 100, robot.self.phase_ticks = 5;
    advance(robot, robot.self.subtree_workers >= robot.self.flood_workers);
    update_label(robot);
    select_parent(robot, {.may_join = self->worker || is_named_parent(robot), .prefers = [&](int a, int b) {
                            return robot.table().message(a).label < robot.table().message(b).label;
                          }});
    take_census(robot, 0);
  });
  stage_read(*self);
}

void stage_open_epoch(int me, Stage* self) {
  Bench bench = stage_bench(me, *self);
  Bench::self().phase_ticks = 60000;
  bench.step([](HealingRobot& robot) {
    advance(robot, true);
    select_root(robot, never);
  });
  stage_read(*self);
}

// ---- insertion.pml ----

void insertion_step(int me, Insertion* self, const Insertion* const* heard, const int* from, int count, int stretched,
                    int may_insert, int ticks) {
  Bench bench(me);
  HealingState& s = Bench::self();
  const auto place = [](int id) { return static_cast<std::uint16_t>(100 * id); };  // robot 0 is root, 1 hangs on it
  const auto seqno = [](int parent, int id) {
    return static_cast<Serial>(id == 0 ? 3 : id == 1 ? 1 : parent < 0 ? 0 : 2);
  };
  s.epoch = 1;
  s.phase = Phase::grow_tree;
  s.root = {1, 0};
  s.label = place(me);
  s.seqno = seqno(self->parent, me);
  s.role = static_cast<Role>(self->role);
  s.need = static_cast<Need>(self->need);
  s.spare_state = static_cast<SpareState>(self->spare_state);
  s.parent = to_id(self->parent);
  s.grant = to_id(self->grant);
  s.request = to_id(self->request);
  s.inserted_child = to_id(self->inserted_child);
  s.grant_ticks = self->grant_ticks;
  s.request_ticks = self->request_ticks;
  s.ungranted_ticks = self->ungranted_ticks;
  s.inserted_ticks = self->inserted_ticks;
  for (int k = 0; k < count; ++k) {
    const Insertion& h = *heard[k];
    HealingMessage& m = Bench::put(from[k], {0.5F, 0.1F * static_cast<float>(from[k])});
    m.epoch = 1;
    m.phase = Phase::grow_tree;
    m.label = place(from[k]);
    m.seqno = seqno(h.parent, from[k]);
    m.role = static_cast<Role>(h.role);
    m.need = static_cast<Need>(h.need);
    m.parent = to_id(h.parent);
    m.grant = to_id(h.grant);
    m.request = to_id(h.request);
    m.inserted_child = to_id(h.inserted_child);
  }
  bench.step([&](HealingRobot& robot) {
    HealingState& r = robot.self;
    if (r.grant != nobody) r.grant_ticks = static_cast<std::uint16_t>(r.grant_ticks + ticks - 1);
    if (r.inserted_child != nobody) r.inserted_ticks = static_cast<std::uint16_t>(r.inserted_ticks + ticks - 1);
    if (r.request != nobody) {
      r.request_ticks = static_cast<std::uint16_t>(r.request_ticks + ticks - 1);
      if (r.ungranted_ticks > 0) r.ungranted_ticks = static_cast<std::uint16_t>(r.ungranted_ticks + ticks - 1);
    }
    manage_spares(robot, {.needs_spare = [&] { return stretched != 0; },
                          .may_call = never,
                          .count_waiting = none,
                          .may_insert = [&](auto...) { return may_insert != 0; }});
  });
  self->role = static_cast<unsigned char>(s.role);
  self->need = static_cast<unsigned char>(s.need);
  self->spare_state = static_cast<unsigned char>(s.spare_state);
  self->parent = from_id(s.parent);
  self->grant = from_id(s.grant);
  self->request = from_id(s.request);
  self->inserted_child = from_id(s.inserted_child);
  self->grant_ticks = static_cast<unsigned char>(s.grant == nobody ? 0 : std::min<int>(s.grant_ticks, 250));
  self->request_ticks = static_cast<unsigned char>(s.request == nobody ? 0 : std::min<int>(s.request_ticks, 250));
  self->ungranted_ticks = static_cast<unsigned char>(s.request == nobody ? 0 : std::min<int>(s.ungranted_ticks, 250));
  self->inserted_ticks =
      static_cast<unsigned char>(s.inserted_child == nobody ? 0 : std::min<int>(s.inserted_ticks, 250));
}

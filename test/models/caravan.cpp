// SPDX-License-Identifier: MIT
#include "caravan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "caravan/rules.hpp"

namespace {

using namespace banyan;
using caravan::Heard;
using caravan::Message;
using caravan::State;
using caravan::Statement;

// The numbers that stand for no robot are the last ones, so they are negative in the models.
RobotId to_id(int id) { return static_cast<RobotId>(id); }
signed char from_id(RobotId id) { return static_cast<signed char>(id); }
static_assert(static_cast<RobotId>(no_robot) == nobody && static_cast<RobotId>(is_put_off) == caravan::put_off &&
              static_cast<RobotId>(is_vacant) == caravan::vacant);

constexpr Platform platform{.communication_range_m = 1.0F, .tick_s = 0.1F, .wheel_limit_m_s = 0.1F};

const caravan::Params& params() {
  static const caravan::Params p = [] {
    caravan::Params short_waits;
    short_waits.liveness_rounds = 1.0F;
    short_waits.pursue_drives = 0.0F;
    short_waits.takeover_rounds = 4.0F;
    short_waits.retry_drives = 0.2F;
    return short_waits;
  }();
  return p;
}

// Nothing is in the clear beside an obstacle: no silence is taken for lost packets, and none is learnt.
constexpr std::array<Vec2, 1> far_wall{{{0, 5}}};
constexpr std::uint16_t not_yet = 1;  // no rounds in which what was learnt fades
constexpr std::uint16_t very_long = 20'000;
constexpr std::uint8_t within_lease = 100;  // rounds; longer than anybody waits for a holder

// One robot, and whom it hears in this round. What is left of another call would be a channel between robots, so all is
// wiped each time.
class Bench {
 public:
  explicit Bench(int me) {
    static const State blank;
    self() = blank;
    self().id = to_id(me);
    self().role = Role::connector;
    self().round = not_yet;
    count_ = 0;
  }
  static State& self() {
    static State state;
    return state;
  }
  // It remembers a neighbour. The next one is not older; this one ages by `rounds` until then.
  static void remember(int id, Vec2 position, const Statement& said, int rounds) {
    caravan::Table& table = self().neighbors;
    const int k = table.enter(to_id(id), position, true, [](int) { return true; });
    table.statements[static_cast<std::size_t>(k)] = said;
    if (rounds > 0) table.begin(rounds, 0.0F);
  }
  static Message& put(int id, Vec2 position) {
    Message& m = messages_[count_] = Message{};
    heard_[count_] = {&m, position};
    ++count_;
    m.id = to_id(id);
    return m;
  }
  static void step(const Orders& orders = {}) {
    const Inputs<Heard> inputs(std::span<Heard>(heard_).first(count_), {.orders = orders, .obstacles = far_wall},
                               platform);
    (void)caravan::step(params(), self(), inputs);
  }

 private:
  static inline std::array<Message, largest_caravan> messages_;
  static inline std::array<Heard, largest_caravan> heard_;
  static inline std::size_t count_;
};

// ---- a swarm in which nothing goes wrong ----

std::array<State, largest_caravan> swarm;
std::array<Message, largest_caravan> sent;

// All are near each other, and none beside the line between two others.
Vec2 home(int id) {
  constexpr std::array<Vec2, largest_caravan> places{{{0.0F, 0.0F},
                                                      {0.4F, 0.0F},
                                                      {0.2F, 0.35F},
                                                      {0.2F, -0.36F},
                                                      {0.7F, 0.3F},
                                                      {-0.3F, 0.3F},
                                                      {0.7F, -0.3F},
                                                      {-0.3F, -0.3F}}};
  return places[static_cast<std::size_t>(id)];
}

void place(int me) {
  swarm[static_cast<std::size_t>(me)] = Bench::self();
  sent[static_cast<std::size_t>(me)] = static_cast<const Message&>(Bench::self());
}

}  // namespace

void caravan_round(int count, int (*hears)(int, int), unsigned dead) {
  std::array<Message, largest_caravan> before = sent;
  for (int me = 0; me < count; ++me) {
    if (dead >> me & 1) continue;
    std::array<Heard, largest_caravan> heard;
    std::size_t size = 0;
    for (int k = 0; k < count; ++k)
      if (hears(me, k) && !(dead >> k & 1)) heard[size++] = {&before[static_cast<std::size_t>(k)], home(k) - home(me)};
    const Inputs<Heard> inputs(std::span<Heard>(heard).first(size), {.obstacles = far_wall}, platform);
    State& self = swarm[static_cast<std::size_t>(me)];
    self.was_sent = false;
    sent[static_cast<std::size_t>(me)] = caravan::step(params(), self, inputs).message;
  }
}

// ---- caravan_order.pml ----

namespace {

caravan::Root root_of(const Place& place) { return {place.sequence, to_id(place.root)}; }

Statement statement_of(const Place& place, int id) {
  Statement s;
  s.role = place.newest == id ? Role::root : Role::connector;
  s.parent = to_id(place.parent);
  s.root = root_of(place);
  s.beat = place.beat;
  return s;
}

void load(int me, const Place& place) {
  State& s = Bench::self();
  static_cast<Statement&>(s) = statement_of(place, me);
  s.newest = {place.newest_sequence, to_id(place.newest)};
  s.tokens[0] = {.name = caravan::root_name, .holder = s.newest.id, .beat = s.beat};
}

void read(const State& s, Place& place) {
  place.sequence = s.root.sequence, place.root = from_id(s.root.id);
  place.newest_sequence = s.newest.sequence, place.newest = from_id(s.newest.id);
  place.beat = s.beat;
  place.parent = from_id(s.parent);
}

}  // namespace

int caravan_is_ahead(const Place* self, const Place* heard) {
  State s;
  s.root = root_of(*self);
  s.beat = self->beat;
  return caravan::is_ahead(s, statement_of(*heard, no_robot));
}

int caravan_compare(const Place* a, const Place* b) {
  const caravan::Root first = root_of(*a), second = root_of(*b);
  if (first != second) return caravan::is_newer(first, second) ? 1 : -1;
  return std::clamp(ahead_by(a->beat, b->beat), -1, 1);
}

void caravan_order_step(int me, Place* self, int id, const Place* heard, const Place* parent, int likes) {
  const Bench bench(me);
  load(me, *self);
  const bool is_parent = id >= 0 && id == self->parent;
  const Vec2 near{0.1F, 0};
  if (parent != nullptr && !is_parent)
    Bench::remember(self->parent, {0, likes == cheapest ? 0.9F : 0.1F}, statement_of(*parent, self->parent),
                    likes == cheapest ? 3 : 0);
  if (id >= 0)
    static_cast<Statement&>(Bench::put(id, likes != far_away || is_parent ? near : Vec2{0.94F, 0})) =
        statement_of(*heard, id);
  Bench::step();
  read(Bench::self(), *self);
}

void caravan_order_lose(int me, Place* self) {
  const Bench bench(me);
  load(me, *self);
  Bench::step();
  read(Bench::self(), *self);
}

void caravan_order_claim(int me, Place* self) {
  const Bench bench(me);
  load(me, *self);
  Bench::self().tokens[0].age = very_long;
  Bench::self().tokens[0].located = true;
  Bench::step();
  read(Bench::self(), *self);
}

void caravan_place_order(int me, const Place* self) {
  const Bench bench(me);
  load(me, *self);
  place(me);
}

void caravan_read_order(int me, Place* self) { read(swarm[static_cast<std::size_t>(me)], *self); }

// ---- caravan_promise.pml ----

namespace {

constexpr int newest_beat = 100;
constexpr std::uint8_t forgotten = 255;

Statement statement_of(const Remembered& said, int id) {
  Statement s;
  s.role = said.root == id ? Role::root : Role::connector;
  s.parent = to_id(said.parent);
  s.other = to_id(said.other);
  s.root = {said.sequence, to_id(said.root)};
  s.beat = static_cast<Serial>(newest_beat + said.beat);
  return s;
}

Remembered said_by(const End& end) { return {0, end.sequence, end.parent, end.other, end.root, end.beat}; }

Vec2 put_near(int id, int near) { return id == near ? Vec2{0.1F, 0} : Vec2{0.8F, 0.2F * static_cast<float>(id - 1)}; }

void load(int me, const End& end, int near) {
  State& s = Bench::self();
  static_cast<Statement&>(s) = statement_of(said_by(end), end.newest == me ? me : no_robot);
  if (end.newest == me) s.role = Role::root;
  s.newest = {end.newest_sequence, to_id(end.newest)};
  s.other_rounds = end.other_rounds;
  s.assumed_silence = caravan_lease / 2;
  s.tokens[0] = {.name = caravan::root_name, .holder = s.newest.id};
  int age = 0;
  for (const Remembered& said : end.of) age = std::max<int>(age, said.age == forgotten ? 0 : said.age);
  for (; age >= 0; --age) {
    for (int id = 0; id < 4; ++id)
      if (end.of[id].age == age) Bench::remember(id, put_near(id, near), statement_of(end.of[id], id), 0);
    if (age > 0 && s.neighbors.size() > 0) s.neighbors.begin(1, 0.0F);
  }
}

signed char behind(Serial beat) { return static_cast<signed char>(std::clamp(ahead_by(beat, newest_beat), -100, 100)); }

}  // namespace

void caravan_promise_step(int me, End* self, const End* const* heard, const int* from, int count, int near) {
  const Bench bench(me);
  load(me, *self, near);
  for (int k = 0; k < count; ++k)
    static_cast<Statement&>(Bench::put(from[k], put_near(from[k], near))) =
        statement_of(said_by(*heard[k]), heard[k]->newest == from[k] ? from[k] : no_robot);
  Bench::step();
  const State& s = Bench::self();
  self->sequence = static_cast<unsigned char>(s.root.sequence), self->root = from_id(s.root.id);
  self->newest_sequence = static_cast<unsigned char>(s.newest.sequence), self->newest = from_id(s.newest.id);
  self->beat = behind(s.beat);
  self->parent = from_id(s.parent);
  self->other = from_id(s.other);
  self->other_rounds = static_cast<unsigned char>(s.other == nobody ? 0 : std::min<int>(s.other_rounds, 4));
  for (int id = 0; id < 4; ++id) {
    Remembered& said = self->of[id];
    const int k = s.neighbors.find(to_id(id));
    if (k < 0) {
      said = {forgotten, 0, no_robot, no_robot, no_robot, 0};
      continue;
    }
    const Statement& m = s.neighbors.statements[static_cast<std::size_t>(k)];
    said = {static_cast<unsigned char>(std::min(s.neighbors.age(k), caravan_lease + 2)),
            static_cast<unsigned char>(m.root.sequence),
            from_id(m.parent),
            from_id(m.other),
            from_id(m.root.id),
            behind(m.beat)};
  }
}

int caravan_is_promised(int me, const End* self, int id) {
  const Bench bench(me);
  load(me, *self, no_robot);
  State& s = Bench::self();
  caravan::Robot robot{params(), s, {}, 1, {}, {}};
  const int k = s.neighbors.find(to_id(id));
  return k >= 0 && caravan::is_promised(robot, k);
}

// ---- caravan_token.pml ----

namespace {

constexpr RobotId another = largest_caravan;  // target, whose place nobody else knows; or robot, out of reach

Vec2 target_of(int there) { return there >= 0 ? home(there) : Vec2{0.25F, 0.05F}; }

Role role_of(int id, const Holding& h) {
  return h.root == id ? Role::root : h.serving || h.busy ? Role::worker : Role::spare;
}

void load(int me, const Holding& self, int first, int there) {
  State& s = Bench::self();
  s.root = s.newest = {self.sequence, to_id(self.root)};
  s.serves = self.serving ? to_id(first) : self.busy ? another : nobody;
  s.role = role_of(me, self);
  s.unfit = self.unfit != 0;
  s.token_count = 2;
  s.tokens[0] = {.name = caravan::root_name,
                 .holder = to_id(self.root),
                 .place = self.root < 0 ? Vec2{} : home(self.root) - home(me),
                 .located = true};
  s.tokens[1] = {.name = to_id(first),
                 .holder = to_id(self.holder),
                 .beat = self.beat,
                 .place = target_of(there) - home(me),
                 .located = true,
                 .reached = self.reached != 0};
}

void read(const State& s, Holding& self) {
  self.sequence = s.newest.sequence, self.root = from_id(s.newest.id);
  self.holder = from_id(s.tokens[1].holder);
  self.beat = s.tokens[1].beat;
  self.reached = s.tokens[1].reached;
  self.serving = s.serves == s.tokens[1].name;
  self.busy = s.serves == another;
  self.unfit = s.unfit;
}

}  // namespace

void caravan_token_step(int me, Holding* self, int id, const Holding* heard, Events events, int first, int there) {
  const Bench bench(me);
  load(me, *self, first, there);
  State& s = Bench::self();
  if (self->serving) s.tokens[1].beat = advanced(s.tokens[1].beat, events.beats - 1);
  if (events.root_silent) s.tokens[0].age = very_long;
  if (events.holder_silent) s.tokens[1].age = very_long;
  if (events.child_silent) {
    if (s.role == Role::spare) s.role = Role::connector;
    s.tokens[1].age = within_lease;
    s.assumed_silence = within_lease;
    Statement said;
    said.role = Role::worker, said.parent = to_id(me);
    Bench::remember(self->holder, home(self->holder) - home(me), said, within_lease);
  }
  if (events.waits_in_vain || events.drives_in_vain) s.nearest = 0.0F;
  if (events.waits_in_vain) s.stuck_rounds = very_long, s.call = {.source = another, .hops = 1};
  if (events.drives_in_vain) s.effort = 2.0F;  // C
  s.leaving = events.leaving;
  if (id >= 0) {
    // One that is to take over a target is there.
    Message& m = Bench::put(id, events.leaving && self->serving ? s.tokens[1].place : Vec2{0.1F, 0});
    m.root = {heard->sequence, to_id(heard->root)};
    m.role = role_of(id, *heard);
    m.token = {
        .name = to_id(first), .holder = to_id(heard->holder), .beat = heard->beat, .reached = heard->reached != 0};
    if (events.offered) m.token = {.name = caravan::root_name, .holder = to_id(me), .beat = 0};
  }
  Bench::step({.given_up = events.gives_up && self->serving ? to_id(first) : nobody});
  read(s, *self);
}

int caravan_ahead_by(unsigned short a, unsigned short b) { return ahead_by(a, b); }

void caravan_place_token(int me, const Holding* self, int first, int there) {
  const Bench bench(me);
  load(me, *self, first, there);
  place(me);
}

void caravan_read_token(int me, Holding* self, int first) {
  const State& s = swarm[static_cast<std::size_t>(me)];
  read(s, *self);
  if (s.tokens[1].name != to_id(first)) self->holder = no_robot;
}

int caravan_is_spare(int me) { return swarm[static_cast<std::size_t>(me)].role == Role::spare; }

// ---- caravan_post.pml ----

void caravan_post_step(int me, Post* self, const Post* const* heard, const int* from, int count) {
  const Bench bench(me);
  State& s = Bench::self();
  s.call = {to_id(self->source), self->count, self->hops};
  s.call_silence = self->silence;
  s.ended = {to_id(self->ended_source), self->ended_count, 0};
  s.post_count = self->own_count;
  s.leaving = self->calls != 0;  // one of the reasons for a post
  for (int k = 0; k < count; ++k)
    Bench::put(from[k], {0.3F, 0.1F * static_cast<float>(k)}).call = {to_id(heard[k]->source), heard[k]->count,
                                                                      heard[k]->hops};
  Bench::step();
  self->source = from_id(s.call.source);
  self->count = s.call.count;
  self->hops = s.call.hops;
  self->silence = static_cast<unsigned char>(s.call.source == nobody ? 0 : std::min<int>(s.call_silence, 250));
  self->ended_source = from_id(s.ended.source);
  self->ended_count = s.ended.count;
  self->own_count = s.post_count;
}

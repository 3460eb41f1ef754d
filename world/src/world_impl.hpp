// SPDX-License-Identifier: MIT
// What a world is made of, shared by the files that make it tick: world.cpp, events.cpp, clocks.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "banyan/world/bodies.hpp"
#include "banyan/world/radio.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/tree_parts.hpp"
#include "banyan/world/world.hpp"
#include "batteries.hpp"
#include "event_queue.hpp"
#include "losses.hpp"
#include "proximity.hpp"

namespace banyan::world {

// Packets of one tick with latency above one: held back until they are heard.
struct Flight {
  std::vector<std::uint32_t> offsets, count;
  std::vector<Packet> packets;
};

// The motion of a target, and the distance that its worker had to it.
struct TargetMotion {
  double start_m = 0.0;     // how far its worker was from it at the start
  std::uint64_t until = 0;  // of a visit: the tick from which on another place is tried
  int tried = 0;            // and how often it has been in vain
  Vec2 goal{};              // where it drives
  double speed_m_s = 0.0;   // 0: it stands
};

// A place that a robot has to reach once, and how often one has been sent there in vain.
struct Visit {
  Vec2 place{};
  int tried = 0;
};

// Robots with clocks of their own (clocks.cpp).
struct Waiting {  // a packet that has been sent to a robot and waits for its next step
  std::uint32_t sender = 0;
  std::uint64_t composed = 0;  // the substep in which its sender stepped
  Vec2 position{};             // of the sender, in the receiver's frame at its last step before the measurement, m
  std::uint64_t heard = 0;     // the substep in which it arrives
};
struct Clocked {
  double phase = 0.0;  // of its clock at the start, in periods
  double rate = 1.0;
  bool told = false;             // it stepped in the last substep: its message travels in this one
  Vec2 shift{};                  // odometry since its last step, in the frame of that step, m
  double turn = 0.0;             // rad
  std::vector<Waiting> waiting;  // ascending by `heard`
};

struct World::Impl {
  Impl(const Scenario& s, const Algorithm& algorithm);
  Impl(const Impl& o);

  // The phases of a tick, in order.
  void happen();  // events.cpp
  void act();
  void move_stations();
  void fill_stations() noexcept;
  void run_down(double seconds);
  void broadcast(Executor& executor);
  void find_links(Executor& executor);
  void think(Executor& executor);
  void carry_waiting(std::size_t i, const Flight& fresh) noexcept;

  std::size_t receive(std::size_t i, std::span<Packet> packets) const noexcept;
  template <class P> std::size_t keep_slots(std::size_t i, std::span<P> packets, std::size_t count) const noexcept;
  [[nodiscard]] bool lost(std::size_t i, std::uint32_t sender) const noexcept;
  void make_inboxes(const Executor& executor);
  std::size_t gather(std::size_t i, std::span<Packet> room, Flight* flight, bool silence);
  [[nodiscard]] banyan::Vec2 measure(std::size_t i, std::uint32_t sender) const noexcept;
  [[nodiscard]] banyan::Vec2 blurred(std::size_t i, std::uint32_t sender, Vec2 d) const noexcept;
  void sense(std::size_t i, const Odometry& moved, Proximity::Seen& seen, Senses& senses) noexcept;

  // A tick of robots with clocks of their own (clocks.cpp)
  void set_clocks();
  void step_by_clocks(Executor& executor);
  void count_wheel_turns();
  void deliver(Executor& executor);
  void wake(Executor& executor);
  void collect(std::size_t i, std::vector<Packet>& packets);
  [[nodiscard]] bool strikes(std::size_t i) const noexcept;
  void add_clocks(Digest& digest) const noexcept;

  // Events (events.cpp)
  void drive_targets();
  void send_to_visits();
  void watch_for_moments(double now_s);
  void apply(const EventQueue::Entry& entry);
  void kill(const Kill& event, EventQueue::Entry entry);
  void draw_victim(Kill::Of of, const EventQueue::Entry& entry);
  [[nodiscard]] bool among(Kill::Of of, std::size_t i) const noexcept;
  [[nodiscard]] std::size_t count_among(Kill::Of of) const noexcept;
  void die(std::size_t i);
  void join(std::size_t i, Vec2 position);
  [[nodiscard]] std::uint64_t tick_after(double duration_s) const noexcept;
  void move_target(std::size_t target, Vec2 position, double speed_m_s);
  void assign_target(Vec2 position);
  void send(std::size_t i, Vec2 position);
  void give_up(std::size_t target);
  [[nodiscard]] const Station* station_of(std::size_t i) const noexcept {
    return i >= free_robots && i - free_robots < scenario.stations.size() ? &scenario.stations[i - free_robots]
                                                                          : nullptr;
  }
  void set_line_of_sight(bool on);
  void change_obstacles(const Action& action);
  [[nodiscard]] Scenario with(const Event& event) const;  // the scenario, and this happening now
  [[nodiscard]] double remaining_m(std::size_t target) const noexcept;
  [[nodiscard]] bool half_way() const noexcept;
  [[nodiscard]] bool complete();

  void add_events(Digest& digest) const noexcept;  // what is hashed of all this

  // Between two motions of the bodies.
  [[nodiscard]] double part_s() const noexcept {
    return scenario.clocks.asynchronous ? scenario.tick_s / scenario.clocks.substeps : scenario.tick_s;
  }
  [[nodiscard]] std::optional<Charge> charge_of(std::size_t i) const noexcept;
  [[nodiscard]] bool is_worker(std::size_t i) const noexcept {
    return reports[i].serves != nobody && given_up[i] == nobody;
  }
  [[nodiscard]] std::optional<std::size_t> holder(std::size_t target) const noexcept;

  Scenario scenario;
  const Algorithm* algorithm;
  Losses losses;
  double loss;                      // radio.loss, now
  bool line_of_sight;               // now, and so are
  std::vector<Obstacle> obstacles;  // these; radio, proximity and bodies have copies
  std::uint64_t tick = 0;
  std::uint64_t moment = 0;  // what is drawn now is drawn for: the tick, or the substep

  Poses poses;
  std::unique_ptr<Bodies> bodies;
  Radio radio;
  Proximity proximity;
  Batteries batteries;
  std::vector<Target> targets;
  std::vector<TargetMotion> courses;  // one per target
  std::size_t arrived = 0;            // robots from here on have not joined yet: they are not alive, and far outside
  std::vector<std::string> names;
  std::vector<std::uint8_t> alive;
  std::vector<std::uint8_t> raised;         // antennas; empty unless sight leaks
  std::vector<std::uint64_t> frozen_until;  // tick; 0: not frozen
  std::vector<std::int32_t> target_of;      // per robot, -1: none
  std::vector<RobotId> given_up;            // per robot: the target that it is told to serve no more, until it steps
  std::unique_ptr<Swarm> swarm;
  std::vector<Report> reports;             // of the last step
  TreeParts tree_parts;                    // workspace
  std::vector<Velocity> commands, moving;  // as ordered, and as the bodies get them
  std::vector<Odometry> odometry;
  EventQueue event_queue;
  std::uint64_t silent_until = 0;  // tick; no packet is heard before
  std::size_t deaths = 0;
  std::size_t emptied = 0;                  // of these, for want of charge
  std::size_t mission_target_count = 0;     // of the start; the charging places come after them
  std::size_t charging_count = 0;           // of those that robots hold; the places of the stations come after them
  std::size_t free_robots = 0;              // of the start; the stations come after them
  bool tracked = false;                     // somebody else moves the bodies, stations included
  std::vector<Visit> visits;                // places to which nobody is sent at present
  std::size_t visited = 0;                  // places at which somebody has been
  std::optional<std::uint64_t> last_death;  // tick
  std::vector<Flight> flights;              // ring of latency_ticks - 1
  Flight arriving;                          // taken out of the ring: heard this tick
  std::vector<Clocked> clocked;             // one per robot; none if they step together
  // What the robots of one batch receive and sense. They step together.
  struct Inbox {
    static constexpr std::size_t batch_size = 16;
    std::vector<Packet> packets;
    std::array<std::size_t, batch_size + 1> begin{};
    std::array<Proximity::Seen, batch_size> seen;
    std::array<Sensed, batch_size> sensed;
  };
  void step_batch(std::size_t first, std::size_t count, Inbox& inbox);
  std::vector<Inbox> inboxes;              // one per thread
  std::vector<std::uint64_t> received_by;  // packets, per thread
  std::uint64_t received = 0, sent = 0;
};

// More packets than slots: every one has the same chance to be kept; the order stays.
template <class P>
std::size_t World::Impl::keep_slots(std::size_t i, std::span<P> packets, std::size_t count) const noexcept {
  std::size_t wanted = static_cast<std::size_t>(scenario.radio.slots);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count && wanted > 0; ++k) {
    const double u = to_uniform(bits(scenario.seed, Purpose::slots, i, k, moment));
    if (u * static_cast<double>(count - k) >= static_cast<double>(wanted)) continue;  // Knuth's algorithm S
    packets[kept++] = packets[k];
    --wanted;
  }
  return kept;
}

}  // namespace banyan::world

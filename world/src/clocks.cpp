// SPDX-License-Identifier: MIT
// A tick in which each robot steps when its own clock says so. Bodies move and packets travel in equal
// parts of the tick; a robot's message, composed when it steps, travels in the next part.
#include <algorithm>
#include <cmath>

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/world/threads.hpp"
#include "world_impl.hpp"

namespace banyan::world {

void World::Impl::set_clocks() {
  clocked.resize(alive.size());
  for (std::size_t i = 0; i < clocked.size(); ++i) {
    clocked[i].phase = to_uniform(bits(scenario.seed, Purpose::clock_phase, i));
    clocked[i].rate =
        1.0 + scenario.clocks.drift * (2.0 * to_uniform(bits(scenario.seed, Purpose::clock_rate, i)) - 1.0);
  }
}

void World::Impl::step_by_clocks(Executor& executor) {
  const auto parts = static_cast<std::uint64_t>(scenario.clocks.substeps);
  make_inboxes(executor);
  for (std::uint64_t part = 0; part < parts; ++part) {
    moment = tick * parts + part;
    act();
    count_wheel_turns();
    find_links(executor);
    proximity.update(poses.position, alive, deaths);
    deliver(executor);
    wake(executor);
    swarm->decide(commands, reports);
    swarm->advance();
  }
  for (const std::uint64_t r : received_by) received += r;
}

// Each increment is in the frame in which it starts; the sum is in that of the robot's last step.
void World::Impl::count_wheel_turns() {
  for (std::size_t i = 0; i < clocked.size(); ++i) {
    Clocked& robot = clocked[i];
    const Vec2 increment{static_cast<double>(odometry[i].forward_m), static_cast<double>(odometry[i].sideways_m)};
    robot.shift += rotate(unit_vector(robot.turn), increment);
    robot.turn += static_cast<double>(odometry[i].turn_rad);
  }
}

// Messages of the last substep travel. As with robots that step together, everything about a packet
// is decided when it is sent; with a latency of L ticks it arrives L - 1 whole ticks later.
void World::Impl::deliver(Executor& executor) {
  for (std::size_t i = 0; i < clocked.size(); ++i) sent += clocked[i].told && alive[i] != 0 ? 1 : 0;
  const bool blackout = tick < silent_until;
  const std::uint64_t arrival = moment + static_cast<std::uint64_t>(scenario.radio.latency_ticks - 1) *
                                             static_cast<std::uint64_t>(scenario.clocks.substeps);
  executor.parallel_for(clocked.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Clocked& robot = clocked[i];
      if (blackout) {
        std::erase_if(robot.waiting, [&](const Waiting& w) { return w.heard == moment; });
        continue;
      }
      for (const std::uint32_t sender : radio.links(i)) {
        if (!clocked[sender].told || lost(i, sender)) continue;
        const banyan::Vec2 seen = measure(i, sender);
        const Vec2 now{static_cast<double>(seen.x), static_cast<double>(seen.y)};
        robot.waiting.push_back({sender, moment - 1, robot.shift + rotate(unit_vector(robot.turn), now), arrival});
      }
    }
  });
}

void World::Impl::wake(Executor& executor) {
  executor.parallel_for(clocked.size(), [&](std::size_t begin, std::size_t end, int worker) {
    Inbox& inbox = inboxes[static_cast<std::size_t>(worker)];
    for (std::size_t first = begin; first < end; first += Inbox::batch_size) {
      const std::size_t count = std::min(Inbox::batch_size, end - first);
      inbox.packets.clear();
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = first + k;
        inbox.begin[k] = inbox.packets.size();
        clocked[i].told = alive[i] != 0 && strikes(i);
        inbox.sensed[k].steps = clocked[i].told;
        if (clocked[i].told) {
          const Clocked& robot = clocked[i];
          sense(i,
                {static_cast<float>(robot.shift.x), static_cast<float>(robot.shift.y), static_cast<float>(robot.turn)},
                inbox.seen[k], inbox.sensed[k].senses);
          collect(i, inbox.packets);
        }
        if (alive[i] == 0) clocked[i].waiting.clear();
      }
      inbox.begin[count] = inbox.packets.size();
      received_by[static_cast<std::size_t>(worker)] += inbox.packets.size();
      step_batch(first, count, inbox);
    }
  });
}

// Whether robot i's clock passes a whole period within this substep. A function of the moment, so
// that nothing has to be remembered and nothing adds up.
bool World::Impl::strikes(std::size_t i) const noexcept {
  const double per_part = clocked[i].rate / static_cast<double>(scenario.clocks.substeps);
  const auto periods = [&](std::uint64_t parts) {
    return std::floor(clocked[i].phase + per_part * static_cast<double>(parts));
  };
  return periods(moment + 1) > periods(moment);
}

// What has arrived since its last step is carried along by its odometry to where it is now. The odometry is
// then reset.
void World::Impl::collect(std::size_t i, std::vector<Packet>& packets) {
  Clocked& robot = clocked[i];
  const auto arrived =
      std::find_if(robot.waiting.begin(), robot.waiting.end(), [&](const Waiting& w) { return w.heard > moment; });
  const Vec2 turned = unit_vector(robot.turn);
  const std::size_t begin = packets.size();
  for (auto packet = robot.waiting.begin(); packet != arrived; ++packet) {
    const Vec2 now = rotate_back(turned, packet->position - robot.shift);
    packets.push_back({.sender = packet->sender,
                       .age_ticks = static_cast<std::uint32_t>(moment - packet->composed),
                       .position = {static_cast<float>(now.x), static_cast<float>(now.y)}});
  }
  const auto slots = static_cast<std::size_t>(scenario.radio.slots);
  const std::size_t count = packets.size() - begin;
  if (slots > 0 && count > slots) packets.resize(begin + keep_slots(i, std::span(packets).subspan(begin), count));
  robot.waiting.erase(robot.waiting.begin(), arrived);
  robot.shift = {};
  robot.turn = 0.0;
}

void World::Impl::add_clocks(Digest& digest) const noexcept {
  for (const Clocked& robot : clocked) {
    digest.add(robot.told);
    digest.add(robot.shift);
    digest.add(robot.turn);
    for (const Waiting& packet : robot.waiting) {
      digest.add(packet.heard);
      digest.add(packet.position);
      digest.add(packet.sender);
      digest.add(packet.composed);
    }
  }
}

}  // namespace banyan::world

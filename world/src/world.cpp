// SPDX-License-Identifier: MIT
#include "banyan/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "antennas.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/stations.hpp"
#include "banyan/world/threads.hpp"
#include "world_impl.hpp"

namespace banyan::world {
namespace {

constexpr double least_measured = 0.005;  // of the range: no sensor measures a distance of nothing

std::unique_ptr<Bodies> make_bodies(Scenario scenario, const Poses& poses) {
  if (scenario.clocks.asynchronous) scenario.tick_s /= scenario.clocks.substeps;  // the part moved by clocks.cpp
  switch (scenario.robot.body) {
    case BodyModel::box2d: return make_box2d(scenario, poses);
    case BodyModel::linear: return make_linear(scenario, poses.position.size());
    default: return make_disks(scenario, poses.position.size());
  }
}

void refuse(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults)
    if (!fault.warning) text += (text.empty() ? "" : "; ") + fault.key + ": " + fault.text;
  if (!text.empty()) throw std::invalid_argument(text);
}

Scenario checked(const Scenario& scenario) {
  refuse(faults(scenario));
  return scenario;
}

// With a custom algorithm: it checks its parameters itself, and keys that it does not know are ignored.
Scenario checked(Scenario scenario, const Algorithm& own) {
  const AlgorithmList only{&own};
  scenario.mission.algorithm = own.name();
  Scenario without_parameters = scenario;
  without_parameters.algorithms = &only;
  without_parameters.mission.parameters.clear();
  refuse(faults(without_parameters));
  if (const std::string text = own.fault(setup_of(scenario)); !text.empty())
    throw std::invalid_argument(std::string(own.name()) + ": " + text);
  return scenario;
}

std::vector<Member> members_of(const Assignment& assignment, std::size_t n) {
  std::vector<Member> members(n);
  for (std::size_t i = 0; i < n; ++i)
    members[i] = {.id = static_cast<RobotId>(i), .worker = false, .root = i == assignment.root};
  for (const std::size_t worker : assignment.worker) members[worker].worker = true;
  return members;
}

}  // namespace

World::Impl::Impl(const Scenario& s, const Algorithm& algorithm_)
    : scenario(s),
      algorithm(&algorithm_),
      losses(s),
      loss(s.radio.loss),
      line_of_sight(s.radio.line_of_sight),
      obstacles(s.obstacles),
      poses(place_all(s)),
      bodies(make_bodies(s, poses)),
      radio(s, poses.position.size()),
      proximity(s),
      batteries(s, poses.position.size()),
      tree_parts(poses.position.size()),
      event_queue(s.events) {
  const std::size_t n = poses.position.size();
  const std::vector<Vec2> positions = target_positions(s);
  mission_target_count = mission_targets(s).size();
  charging_count = held_charging_places(s).size();
  free_robots = free_robot_count(s);
  arrived = robot_count(s);
  for (const Vec2 place : s.visits.places()) visits.push_back({place, 0});
  if (!s.stations.empty()) names.resize(free_robots);
  for (const Station& station : s.stations) names.push_back(station.name);
  fill_stations();
  const Assignment assignment = assign(s, poses, positions);
  alive.assign(n, 0);
  std::fill_n(alive.begin(), arrived, std::uint8_t{1});
  if (s.radio.sight_leak > 0.0) raised.assign(n, 0);
  frozen_until.assign(n, 0);
  target_of.assign(n, -1);
  given_up.assign(n, nobody);
  for (std::size_t t = 0; t < positions.size(); ++t) {
    targets.push_back({.position = positions[t], .worker = assignment.worker[t]});
    courses.push_back({.start_m = distance(poses.position[assignment.worker[t]], positions[t])});
    target_of[assignment.worker[t]] = static_cast<std::int32_t>(t);
  }
  swarm = algorithm->make(setup_of(s), members_of(assignment, n));
  for (std::size_t i = 0; i < n; ++i) reports.push_back(swarm->report(i));
  commands.resize(n);
  moving.resize(n);
  odometry.resize(n);
  if (s.clocks.asynchronous) set_clocks();
  else flights.resize(static_cast<std::size_t>(std::max(1, s.radio.latency_ticks) - 1));
  Executor alone(1);
  find_links(alone);
}

World::Impl::Impl(const Impl& o)
    : scenario(o.scenario),
      algorithm(o.algorithm),
      losses(o.losses),
      loss(o.loss),
      line_of_sight(o.line_of_sight),
      obstacles(o.obstacles),
      tick(o.tick),
      poses(o.poses),
      bodies(o.bodies->clone()),
      radio(o.radio),
      proximity(o.proximity),
      batteries(o.batteries),
      targets(o.targets),
      courses(o.courses),
      arrived(o.arrived),
      names(o.names),
      alive(o.alive),
      raised(o.raised),
      frozen_until(o.frozen_until),
      target_of(o.target_of),
      given_up(o.given_up),
      swarm(o.swarm->clone()),
      reports(o.reports),
      tree_parts(o.tree_parts),
      commands(o.commands),
      moving(o.moving),
      odometry(o.odometry),
      event_queue(o.event_queue),
      silent_until(o.silent_until),
      deaths(o.deaths),
      emptied(o.emptied),
      mission_target_count(o.mission_target_count),
      charging_count(o.charging_count),
      free_robots(o.free_robots),
      tracked(o.tracked),
      visits(o.visits),
      visited(o.visited),
      last_death(o.last_death),
      flights(o.flights),
      arriving(o.arriving),
      clocked(o.clocked),
      received(o.received),
      sent(o.sent) {}

// ---- One tick ----

void World::step(Executor& executor) {
  impl_->happen();  // events of the scenario
  if (impl_->scenario.clocks.asynchronous) {
    impl_->step_by_clocks(executor);
  } else {
    impl_->moment = impl_->tick;
    impl_->act();                // commands of the last tick become motion
    impl_->broadcast(executor);  // messages of the last tick travel: links, losses, delays
    impl_->think(executor);      // each robot's controller gets what is sensed and heard
  }
  ++impl_->tick;
}

void World::Impl::act() {
  for (std::size_t i = 0; i < commands.size(); ++i)
    moving[i] = alive[i] != 0 && frozen_until[i] <= tick ? commands[i] : Velocity{};
  for (std::size_t s = 0; s < scenario.stations.size(); ++s) moving[free_robots + s] = {};
  bodies->step(moving, radio.near(), tick, poses, odometry);
  move_stations();
  if (batteries.on()) run_down(part_s());
}

// They are where their course says, and measure how they have moved; they keep their heading. A dead one stays.
void World::Impl::move_stations() {
  if (scenario.stations.empty()) return;
  const double now_s = static_cast<double>(moment + 1) * part_s();
  std::size_t place = mission_target_count + charging_count;
  for (std::size_t s = 0; s < scenario.stations.size(); ++s) {
    const std::size_t i = free_robots + s;
    Target* held = scenario.stations[s].root ? nullptr : &targets[place++];
    if (alive[i] == 0) continue;
    if (!tracked) {
      const Vec2 from = station_at(scenario.stations[s], static_cast<double>(moment) * part_s());
      poses.position[i] = station_at(scenario.stations[s], now_s);
      const Vec2 moved = rotate_back(poses.heading[i], poses.position[i] - from);
      odometry[i] = {static_cast<float>(moved.x), static_cast<float>(moved.y), 0.0F};
      bodies->arrive(i);  // without what has pushed it
    }
    if (held != nullptr) held->position = poses.position[i];
  }
}

void World::Impl::fill_stations() noexcept {
  for (std::size_t s = 0; s < scenario.stations.size(); ++s) batteries.fill(free_robots + s);
}

// A robot without charge is dead where it stands. Stations have power of their own.
void World::Impl::run_down(double seconds) {
  const std::size_t empty = batteries.pass(seconds, moving, poses.position, alive);
  fill_stations();
  if (empty == 0) return;
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i] == 0 || batteries.levels()[i] > 0.0) continue;
    die(i);
    ++emptied;
  }
}

// As its sensor measures it.
std::optional<Charge> World::Impl::charge_of(std::size_t i) const noexcept {
  if (!batteries.on() || station_of(i) != nullptr) return std::nullopt;
  double level = batteries.levels()[i];
  if (const double noise = scenario.battery.noise; noise > 0.0)
    level = std::clamp(level + noise * to_normal(bits(scenario.seed, Purpose::charge_noise, i, moment)), 0.0, 1.0);
  return Charge{static_cast<float>(level), batteries.places()[i] >= 0};
}

void World::Impl::broadcast(Executor& executor) {
  find_links(executor);
  proximity.update(poses.position, alive, deaths);
  const auto living = static_cast<std::uint64_t>(std::count(alive.begin(), alive.end(), 1));
  if (tick > 0) sent += living;
}

// Who hears whom at the poses of this moment.
void World::Impl::find_links(Executor& executor) {
  for (std::size_t i = 0; i < raised.size(); ++i) raised[i] = is_raised(scenario, i, poses.heading[i]) ? 1 : 0;
  radio.update(poses.position, alive, raised, executor);
}

void World::Impl::make_inboxes(const Executor& executor) {
  inboxes.resize(std::max<std::size_t>(inboxes.size(), static_cast<std::size_t>(executor.threads())));
  received_by.assign(inboxes.size(), 0);
}

// A packet's range and bearing were measured when it was sent; while it waits, the receiver's own
// odometry carries them along. Those of `fresh` were measured just now.
void World::Impl::carry_waiting(std::size_t i, const Flight& fresh) noexcept {
  const Carry carry(odometry[i]);
  const auto take_along = [&](Flight& flight) {
    if (i >= flight.count.size()) return;
    for (std::uint32_t k = 0; k < flight.count[i]; ++k) {
      Packet& packet = flight.packets[flight.offsets[i] + k];
      packet.position = carry.point(packet.position);
    }
  };
  take_along(arriving);
  for (Flight& flight : flights)
    if (&flight != &fresh) take_along(flight);
}

void World::Impl::think(Executor& executor) {
  const std::size_t n = alive.size();
  make_inboxes(executor);
  Flight* flight = flights.empty() ? nullptr : &flights[tick % flights.size()];
  if (flight != nullptr) {
    // This slot's packets were sent latency - 1 ticks ago: they are heard now, and the slot is free
    // for those sent now.
    std::swap(arriving, *flight);
    flight->offsets.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i)
      flight->offsets.push_back(flight->offsets.back() + static_cast<std::uint32_t>(radio.links(i).size()));
    flight->count.assign(n, 0);
    flight->packets.resize(flight->offsets.back());
  }
  const bool silence = tick == 0 || tick < silent_until;  // nothing has been sent yet, or a blackout

  executor.parallel_for(n, [&](std::size_t begin, std::size_t end, int worker) {
    Inbox& inbox = inboxes[static_cast<std::size_t>(worker)];
    for (std::size_t first = begin; first < end; first += Inbox::batch_size) {
      const std::size_t count = std::min(Inbox::batch_size, end - first);
      std::size_t room = 0;
      for (std::size_t i = first; i < first + count; ++i)
        room += std::max<std::size_t>(radio.links(i).size(), arriving.count.empty() ? 0 : arriving.count[i]);
      if (inbox.packets.size() < room) inbox.packets.resize(room + room / 4);
      std::size_t size = 0;
      for (std::size_t k = 0; k < count; ++k) {
        inbox.begin[k] = size;
        if (alive[first + k] != 0) size += gather(first + k, std::span(inbox.packets).subspan(size), flight, silence);
      }
      inbox.begin[count] = size;
      received_by[static_cast<std::size_t>(worker)] += size;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = first + k;
        inbox.sensed[k].steps = alive[i] != 0;
        if (alive[i] != 0) sense(i, odometry[i], inbox.seen[k], inbox.sensed[k].senses);
      }
      step_batch(first, count, inbox);
    }
  });
  swarm->decide(commands, reports);
  swarm->advance();
  for (const std::uint64_t r : received_by) received += r;
}

// Collects what robot i hears in this tick. Returns how many packets.
std::size_t World::Impl::gather(std::size_t i, std::span<Packet> room, Flight* flight, bool silence) {
  if (flight == nullptr) return silence ? 0 : receive(i, room);
  // Drawn now, heard later: what was sent latency - 1 ticks ago arrives.
  carry_waiting(i, *flight);
  const std::size_t sent_now = silence ? 0 : receive(i, std::span(flight->packets).subspan(flight->offsets[i]));
  flight->count[i] = static_cast<std::uint32_t>(sent_now);
  if (silence || arriving.count.empty()) return 0;
  const auto latency = static_cast<std::uint32_t>(scenario.radio.latency_ticks);
  for (std::uint32_t k = 0; k < arriving.count[i]; ++k) {
    room[k] = arriving.packets[arriving.offsets[i] + k];
    room[k].age_ticks = latency;
  }
  return arriving.count[i];
}

void World::Impl::step_batch(std::size_t first, std::size_t count, Inbox& inbox) {
  for (std::size_t k = 0; k < count; ++k)
    inbox.sensed[k].packets =
        std::span<const Packet>(inbox.packets).subspan(inbox.begin[k], inbox.begin[k + 1] - inbox.begin[k]);
  swarm->step(first, std::span<const Sensed>(inbox.sensed).first(count), std::span(commands).subspan(first, count),
              std::span(reports).subspan(first, count));
}

// What robot i's own sensors and the mission give it for its next step.
void World::Impl::sense(std::size_t i, const Odometry& moved, Proximity::Seen& seen, Senses& senses) noexcept {
  senses.odometry = moved;
  senses.orders = {.sent = target_of[i] >= 0, .target = {}, .given_up = std::exchange(given_up[i], nobody)};
  senses.charge = charge_of(i);
  if (target_of[i] >= 0) {
    // Wraps for the mission's targets.
    const auto place = static_cast<std::size_t>(target_of[i]) - mission_target_count;
    senses.orders.charging_place = place < charging_count;
    const Vec2 d =
        rotate_back(poses.heading[i], targets[static_cast<std::size_t>(target_of[i])].position - poses.position[i]);
    senses.orders.target = {static_cast<float>(d.x), static_cast<float>(d.y)};
  }
  if (const Station* station = station_of(i)) {
    senses.orders.station = true;
    senses.orders.charging_place = charges(scenario, *station);
    senses.orders.target.reset();
    if (station->announce_s > 0.0 && senses.orders.sent && !tracked) {
      const double then_s = static_cast<double>(moment + 1) * part_s() + station->announce_s;
      const Vec2 d = rotate_back(poses.heading[i], station_at(*station, then_s) - poses.position[i]);
      senses.orders.target = {static_cast<float>(d.x), static_cast<float>(d.y)};
    }
  }
  senses.obstacles = std::span<const banyan::Vec2>(seen).first(proximity.sense(poses, i, seen));
}

// ---- The way of a packet ----

bool World::Impl::lost(std::size_t i, std::uint32_t sender) const noexcept {
  return losses.lost(i, sender, moment, poses.position[sender] - poses.position[i], loss);
}

// Draws at transmission which packets reach robot i, and what its sensor makes of their origin.
std::size_t World::Impl::receive(std::size_t i, std::span<Packet> packets) const noexcept {
  const RadioModel& model = scenario.radio;
  const bool exact = !(model.range_noise_m > 0.0 || model.bearing_noise_rad > 0.0);
  const bool lossless = losses.none(loss);
  const Vec2* const position = poses.position.data();
  const Vec2 here = position[i];
  const Vec2 heading = poses.heading[i];
  const auto exactly = [](Vec2 d) { return banyan::Vec2{static_cast<float>(d.x), static_cast<float>(d.y)}; };
  Packet* to = packets.data();
  for (const std::uint32_t sender : radio.links(i)) {
    if (!lossless && lost(i, sender)) continue;
    const Vec2 d = rotate_back(heading, position[sender] - here);
    *to++ = {.sender = sender, .age_ticks = 1, .position = exact ? exactly(d) : blurred(i, sender, d)};
  }
  const auto count = static_cast<std::size_t>(to - packets.data());
  const auto slots = static_cast<std::size_t>(scenario.radio.slots);
  return slots > 0 && count > slots ? keep_slots(i, packets, count) : count;
}

// Range and bearing of the sender in the receiver's body frame, with the sensor's noise.
banyan::Vec2 World::Impl::measure(std::size_t i, std::uint32_t sender) const noexcept {
  return blurred(i, sender, rotate_back(poses.heading[i], poses.position[sender] - poses.position[i]));
}

// What the sensor measures of a sender at `d`.
banyan::Vec2 World::Impl::blurred(std::size_t i, std::uint32_t sender, Vec2 d) const noexcept {
  const RadioModel& model = scenario.radio;
  if (model.range_noise_m > 0.0) {
    const double range = norm(d);
    const double noisy =
        std::max(least_measured * model.range_m,
                 range + model.range_noise_m * to_normal(bits(scenario.seed, Purpose::range_noise, i, sender, moment)));
    d *= range > 0.0 ? noisy / range : 0.0;
  }
  if (model.bearing_noise_rad > 0.0)
    d = rotate(unit_vector(model.bearing_noise_rad *
                           to_normal(bits(scenario.seed, Purpose::bearing_noise, i, sender, moment))),
               d);
  return {static_cast<float>(d.x), static_cast<float>(d.y)};
}

// ---- The view from outside ----

World::World(const Scenario& scenario) {
  const Scenario sound = checked(scenario);  // before its algorithm is looked up
  impl_ = std::make_unique<Impl>(sound, algorithm_of(sound));
}
World::World(const Scenario& scenario, const Algorithm& algorithm)
    : impl_(std::make_unique<Impl>(checked(scenario, algorithm), algorithm)) {}
World::World(const Scenario& scenario, const Algorithm& algorithm, std::unique_ptr<Bodies> bodies)
    : World(scenario, algorithm) {
  impl_->bodies = std::move(bodies);
  impl_->tracked = true;
}
World::World(const World& o) : impl_(std::make_unique<Impl>(*o.impl_)) {}
World::World(World&&) noexcept = default;
World& World::operator=(const World& o) {
  if (this != &o) impl_ = std::make_unique<Impl>(*o.impl_);
  return *this;
}
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

void World::step() {
  Executor alone(1);
  step(alone);
}

void World::decide() { impl_->swarm->decide(impl_->commands, impl_->reports); }

std::vector<Fault> World::faults_now(const Event& event) const {
  Present present{impl_->targets.size(), impl_->obstacles, impl_->arrived, size()};
  impl_->event_queue.each_due(time_s() + time_rounding_s(scenario()), [&](const Event& sooner) {
    change(present.obstacles, sooner.action);
    if (const auto* join = std::get_if<Join>(&sooner.action))
      present.robots = std::max(present.robots, join->robot + 1);
  });
  std::vector<Fault> found = event_faults(impl_->with(event), &present);
  std::erase_if(found, [](const Fault& fault) { return fault.warning; });
  return found;
}

void World::intervene(const Event& event) {
  refuse(faults_now(event));
  impl_->scenario = impl_->with(event);
  impl_->event_queue.add(impl_->scenario.events.back());
}

const Scenario& World::scenario() const noexcept { return impl_->scenario; }
const Algorithm& World::algorithm() const noexcept { return *impl_->algorithm; }
const Swarm& World::swarm() const noexcept { return *impl_->swarm; }
std::uint64_t World::tick() const noexcept { return impl_->tick; }
double World::time_s() const noexcept { return static_cast<double>(impl_->tick) * impl_->scenario.tick_s; }
std::size_t World::size() const noexcept { return impl_->alive.size(); }
std::span<const Vec2> World::positions() const noexcept { return impl_->poses.position; }
std::span<const Vec2> World::headings() const noexcept { return impl_->poses.heading; }
std::span<const Report> World::reports() const noexcept { return impl_->reports; }
std::span<const std::uint8_t> World::alive() const noexcept { return impl_->alive; }
std::size_t World::arrived() const noexcept { return impl_->arrived; }
std::span<const std::string> World::names() const noexcept { return impl_->names; }

void World::call(std::size_t robot, const std::string& name) {
  if (impl_->names.size() <= robot) impl_->names.resize(robot + 1);
  impl_->names[robot] = name;
}
std::span<const Target> World::targets() const noexcept { return impl_->targets; }
std::span<const Obstacle> World::obstacles() const noexcept { return impl_->obstacles; }
bool World::line_of_sight() const noexcept { return impl_->line_of_sight; }
const Station* World::station(std::size_t i) const noexcept { return impl_->station_of(i); }
std::size_t World::visited() const noexcept { return impl_->visited; }
std::optional<std::size_t> World::holder(std::size_t target) const noexcept { return impl_->holder(target); }
std::size_t World::deaths() const noexcept { return impl_->deaths; }
std::span<const double> World::charge() const noexcept { return impl_->batteries.levels(); }
std::span<const std::int32_t> World::charged_at() const noexcept { return impl_->batteries.places(); }
std::size_t World::emptied() const noexcept { return impl_->emptied; }
std::optional<std::uint64_t> World::last_death_tick() const noexcept { return impl_->last_death; }
bool World::pending_kills() const noexcept { return impl_->event_queue.deaths_to_come(); }
std::span<const std::uint32_t> World::links(std::size_t i) const noexcept { return impl_->radio.links(i); }
bool World::is_deaf(std::size_t receiver, std::size_t sender) const noexcept {
  return impl_->losses.is_deaf(receiver, sender);
}
std::span<const std::uint8_t> World::raised() const noexcept { return impl_->raised; }
std::vector<std::pair<std::uint32_t, std::uint32_t>> World::blocked() const { return impl_->radio.blocked(); }
std::uint64_t World::packets_received() const noexcept { return impl_->received; }
std::uint64_t World::packets_sent() const noexcept { return impl_->sent; }

std::uint64_t World::hash() const noexcept {
  const Impl& w = *impl_;
  Digest d;
  d.add(w.tick);
  d.add(w.loss);
  w.event_queue.add_to(d);
  for (std::size_t i = 0; i < w.alive.size(); ++i) {
    d.add(w.poses.position[i]);
    d.add(w.poses.heading[i]);
    d.add(w.alive[i]);
    d.add(w.frozen_until[i]);
    w.swarm->add_to(d, i);
    d.add(w.given_up[i]);
    d.add(w.commands[i].forward_m_s);
    d.add(w.commands[i].sideways_m_s);
    d.add(w.commands[i].turn_rad_s);
  }
  for (const Target& target : w.targets) {
    d.add(target.position);
    d.add(target.worker);
  }
  w.add_events(d);
  for (const Flight& flight : w.flights)
    for (std::size_t i = 0; i < flight.count.size(); ++i)
      for (std::uint32_t k = 0; k < flight.count[i]; ++k) {
        d.add(flight.packets[flight.offsets[i] + k].sender);
        d.add(flight.packets[flight.offsets[i] + k].position);
      }
  w.add_clocks(d);
  w.batteries.add_to(d);
  return w.bodies->hash(d.value());
}

std::size_t World::memory_bytes() const noexcept {
  const Impl& w = *impl_;
  const std::size_t per_robot = sizeof(Report) + sizeof(RobotId) + 2 * sizeof(Velocity) + sizeof(Odometry) +
                                2 * sizeof(Vec2) + sizeof(std::uint8_t) + sizeof(std::uint64_t) + sizeof(std::int32_t);
  std::size_t total = sizeof(Impl) + w.swarm->memory_bytes() + w.raised.capacity() + w.alive.size() * per_robot +
                      w.radio.memory_bytes();
  for (const Flight& flight : w.flights)
    total += flight.packets.capacity() * sizeof(Packet) +
             (flight.offsets.capacity() + flight.count.capacity()) * sizeof(std::uint32_t);
  for (const Clocked& robot : w.clocked) total += sizeof(Clocked) + robot.waiting.capacity() * sizeof(Waiting);
  for (const auto& inbox : w.inboxes) total += sizeof inbox + inbox.packets.capacity() * sizeof(Packet);
  return total;
}

}  // namespace banyan::world

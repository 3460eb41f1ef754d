// SPDX-License-Identifier: MIT
// The hub over real sockets, with robots that say what a test wants them to.
#include "banyan/hosts/udp/hub.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace banyan::udp {
namespace {

KeyRing fleet_keys(std::uint8_t secret = 1) {
  SecretKey key{1, {}};
  key.secret.fill(secret);
  return KeyRing({key});
}

const Address anywhere = parse_address("127.0.0.1:0");
const auto never = [] { return false; };

struct FakeRobot {
  FakeRobot(NodeId id, const Hub& hub, std::uint64_t session = 1000)
      : channel(id, hub_node, session), to(hub.local()) {}
  // Two calls, between which the hub must have answered.
  void greet() { socket.send(channel.ask(0.0, keys), to); }
  void answer() { EXPECT_TRUE(hear().empty()); }
  Bytes say(EnvelopeKind kind, const Bytes& payload = {}) {
    Bytes datagram = channel.seal(kind, payload, keys);
    socket.send(datagram, to);
    return datagram;
  }
  Bytes tell(float forward_m_s) {
    Status status;
    status.velocity.forward_m_s = forward_m_s;
    status.period_us = 100000;
    status.message = {1};
    return say(EnvelopeKind::status, encode(status));
  }
  // Everything that has come, authenticated.
  std::vector<std::pair<EnvelopeKind, Bytes>> hear() {
    std::vector<std::pair<EnvelopeKind, Bytes>> heard;
    std::array<std::uint8_t, 2000> room;
    Address from;
    while (const auto datagram = socket.receive(room, from)) {
      EXPECT_LE(datagram->size(), largest_datagram);
      Drop reason{};
      const auto envelope = authenticate(*datagram, keys, reason);
      if (!envelope) continue;
      const auto taken = channel.take(*envelope, 0.0, keys);
      if (!taken.reply.empty()) socket.send(taken.reply, to);
      if (taken.counts) heard.emplace_back(envelope->kind, Bytes(envelope->payload.begin(), envelope->payload.end()));
    }
    return heard;
  }
  KeyRing keys = fleet_keys();
  Socket socket{anywhere};
  SecureChannel channel;
  Address to;
};

class HubAndRobots : public ::testing::Test {
 protected:
  static HubSettings options() {
    return {.listen = anywhere, .tick_s = 0.1, .speed = 20.0, .dead_after_s = 1.0, .bundle = 1};
  }
  [[nodiscard]] std::uint64_t dropped(Drop reason) const {
    return hub_.counts().dropped[static_cast<std::size_t>(reason)];
  }
  // Both have been greeted and have answered; the next tick is 1.
  void greet() {
    join(hub_, {&a_, &b_});
    ASSERT_TRUE(hub_.wait_for(0, never).empty());
    hub_.deliver(0, {}, {});
    hub_.deliver(1, {}, {});
    ASSERT_EQ(a_.hear().size(), 1U);
    ASSERT_EQ(b_.hear().size(), 1U);
  }
  static void join(Hub& hub, std::vector<FakeRobot*> robots) {
    for (FakeRobot* robot : robots) robot->greet();
    EXPECT_EQ(hub.gather(0.05, never).size(), robots.size());
    for (FakeRobot* robot : robots) robot->answer();
    ASSERT_TRUE(hub.gather(5.0, never).empty());
  }
  [[nodiscard]] std::optional<float> velocity(std::size_t i) {
    const auto status = hub_.take(i);
    return status ? std::optional(status->velocity.forward_m_s) : std::nullopt;
  }
  Roster roster_{2};
  Hub hub_{options(), roster_, fleet_keys(), nullptr};
  FakeRobot a_{0, hub_}, b_{1, hub_};
};

TEST_F(HubAndRobots, WaitsForAllAndNamesThoseThatAreMissing) {
  a_.greet();
  EXPECT_EQ(hub_.gather(0.05, never), (std::vector<std::size_t>{0, 1}));  // nobody is believed by a hello alone
  a_.answer();
  EXPECT_EQ(hub_.gather(0.05, never), (std::vector<std::size_t>{1}));
  b_.greet();
  static_cast<void>(hub_.gather(0.05, never));
  b_.answer();
  EXPECT_TRUE(hub_.gather(5.0, never).empty());
}

TEST_F(HubAndRobots, TakesTheNewestStatusOnce) {
  greet();
  const Bytes older = a_.tell(0.1F);
  a_.tell(0.2F);
  ASSERT_TRUE(hub_.wait_for(1, never).empty());
  EXPECT_EQ(velocity(0), 0.2F);
  EXPECT_EQ(velocity(0), std::nullopt);
  EXPECT_EQ(velocity(1), std::nullopt);
  EXPECT_EQ(hub_.counts().periods.count(), 2U);
}

TEST_F(HubAndRobots, ForgedReplayedTruncatedAndForeignPacketsAreDroppedAndCounted) {
  greet();
  const Bytes good = a_.tell(0.1F);
  static_cast<void>(hub_.wait_for(1, never));
  EXPECT_EQ(velocity(0), 0.1F);
  std::vector<std::string> told;
  hub_.tell_refusals([&](const std::string& text) { told.push_back(text); });
  const Socket attacker(anywhere);
  attacker.send(good, hub_.local());  // replayed, from elsewhere
  Bytes changed = good;
  changed[40] = static_cast<std::uint8_t>(changed[40] ^ 1U);
  attacker.send(changed, hub_.local());                                // forged
  attacker.send(ByteView(good).first(good.size() - 5), hub_.local());  // truncated: forged, too
  attacker.send(ByteView(good).first(20), hub_.local());               // truncated: foreign
  attacker.send(Bytes(100, 0x55), hub_.local());                       // foreign
  attacker.send(Bytes(5000, 0x55), hub_.local());                      // longer than any
  SecureChannel unknown(7, hub_node, 5000);
  attacker.send(unknown.ask(0.0, fleet_keys()), hub_.local());  // no robot of this mission
  attacker.send(SecureChannel(0, hub_node, 999).seal(EnvelopeKind::status, {}, fleet_keys()),
                hub_.local());              // from another session, which has said nothing lately
  a_.say(EnvelopeKind::status, {1, 2, 3});  // authentic nonsense
  static_cast<void>(hub_.wait_for(2, never));
  EXPECT_EQ(velocity(0), std::nullopt);
  EXPECT_EQ(dropped(Drop::replayed), 1U);
  EXPECT_EQ(dropped(Drop::forged), 2U);
  EXPECT_EQ(dropped(Drop::foreign), 3U);
  EXPECT_EQ(dropped(Drop::misaddressed), 1U);
  EXPECT_EQ(dropped(Drop::in_use), 1U);
  EXPECT_EQ(dropped(Drop::malformed), 1U);
  // Each is named at once, and only once.
  const auto times = [&](const std::string& words) {
    return std::ranges::count_if(told, [&](const std::string& text) { return text.find(words) != std::string::npos; });
  };
  EXPECT_EQ(times("refused 127.0.0.1:" + std::to_string(attacker.local().port()) + ": its datagrams are another"), 1);
  EXPECT_EQ(times("its key file has another key of the same number"), 1);
  EXPECT_EQ(times("refused robot 7 at 127.0.0.1:"), 1);
  EXPECT_EQ(times("refused robot 0 at 127.0.0.1:"), 1);
  EXPECT_EQ(told.size(), 4U);
  // Nor has the hub been misled about where the robot is.
  hub_.deliver(0, {}, {});
  EXPECT_EQ(a_.hear().size(), 1U);
}

TEST_F(HubAndRobots, ARobotThatStartsAgainHasTakenPart) {
  greet();
  a_.tell(0.1F);
  static_cast<void>(hub_.wait_for(1, never));
  ASSERT_TRUE(hub_.take(0));
  const Bytes held_back = a_.channel.seal(EnvelopeKind::status, encode(Status{}), a_.keys);
  // The clock of a computer without a battery says that it is earlier; sessions are random.
  FakeRobot again(0, hub_, 20);
  for (std::uint32_t tick = 2; tick < 9; ++tick) static_cast<void>(hub_.wait_for(tick, never));
  again.greet();
  for (std::uint32_t tick = 9; tick < 13; ++tick) static_cast<void>(hub_.wait_for(tick, never));
  again.answer();
  again.greet();
  static_cast<void>(hub_.wait_for(13, never));
  again.answer();
  static_cast<void>(hub_.wait_for(14, never));
  hub_.deliver(0, {}, {});
  const auto heard = again.hear();
  ASSERT_EQ(heard.size(), 1U);
  const auto frame = decode_frame(heard[0].second);
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->begun);
  again.tell(0.3F);
  again.socket.send(held_back, hub_.local());
  static_cast<void>(hub_.wait_for(15, never));
  EXPECT_EQ(velocity(0), 0.3F);
  EXPECT_EQ(dropped(Drop::in_use), 2U);  // its first hello came too early
}

TEST_F(HubAndRobots, WhatIsHeardTravelsInAsManyDatagramsAsWanted) {
  greet();
  const std::vector<Hearing> heard(20, Hearing{1, {1.0F, 0.0F}, Bytes(96, 1)});
  hub_.deliver(0, {}, heard);
  EXPECT_EQ(a_.hear().size(), 21U);
  HubSettings bundled = options();
  bundled.bundle = 64;
  Roster one(1);
  Hub hub(bundled, one, fleet_keys(), nullptr);
  FakeRobot robot(0, hub);
  join(hub, {&robot});
  hub.deliver(0, {}, heard);
  std::size_t packets = 0;
  const auto datagrams = robot.hear();
  for (const auto& [kind, payload] : datagrams)
    if (kind == EnvelopeKind::heard) packets += decode_heard(payload)->packets.size();
  EXPECT_EQ(packets, 20U);
  EXPECT_EQ(datagrams.size(), 3U);  // as many as fit into an Ethernet frame: 13
}

TEST_F(HubAndRobots, ARobotThatIsSilentCountsAsDeadOnce) {
  greet();
  std::vector<std::size_t> dead;
  for (std::uint32_t tick = 1; tick < 30; ++tick) {
    a_.tell(0.1F);
    for (const std::size_t robot : hub_.wait_for(tick, never).dead) {
      dead.push_back(robot);
      EXPECT_EQ(tick, 11U);  // dead_after_s
    }
  }
  EXPECT_EQ(dead, (std::vector<std::size_t>{1}));
}

TEST_F(HubAndRobots, AStopIsRepeatedUntilItIsAnswered) {
  greet();
  EXPECT_EQ(hub_.stop_all(), 2U);
  std::size_t stops = 0;
  for (const auto& [kind, payload] : a_.hear()) stops += kind == EnvelopeKind::stop ? 1 : 0;
  EXPECT_GT(stops, 10U);
  a_.say(EnvelopeKind::stopped);
  b_.say(EnvelopeKind::stopped);
  EXPECT_EQ(hub_.stop_all(), 0U);
}

TEST_F(HubAndRobots, AHubPlaysItsTapeAndGoesOn) {
  const std::string path = ::testing::TempDir() + "banyan-hub-journal-" + std::to_string(::getpid());
  {
    HubJournal journal(path, 1, 2);
    Roster one(1);
    Hub hub(options(), one, fleet_keys(), &journal);
    FakeRobot robot(0, hub);
    join(hub, {&robot});
    for (std::uint32_t tick = 0; tick < 5; ++tick) {
      static_cast<void>(hub.wait_for(tick, never));
      hub.deliver(0, {}, {});
      static_cast<void>(robot.hear());
      robot.tell(static_cast<float>(tick));
    }
  }
  HubJournal journal(path, 1);
  Roster one(1);
  Hub hub(options(), one, fleet_keys(), &journal);
  FakeRobot robot(0, hub);
  for (std::uint32_t tick = 0; tick < 5; ++tick) {
    EXPECT_TRUE(hub.is_replaying(tick));
    static_cast<void>(hub.wait_for(tick, never));
    const auto status = hub.take(0);
    if (tick > 0) {
      ASSERT_TRUE(status);
      EXPECT_EQ(status->velocity.forward_m_s, static_cast<float>(tick - 1));
    }
    hub.deliver(0, {}, {});
  }
  EXPECT_EQ(hub.counts().sent, 0U);
  robot.greet();
  static_cast<void>(hub.wait_for(5, never));
  robot.answer();
  static_cast<void>(hub.wait_for(6, never));
  hub.deliver(0, {}, {});
  const auto heard = robot.hear();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_TRUE(decode_frame(heard[0].second)->begun);
  std::filesystem::remove(path);
}

// ---- Who comes and goes ----

using Indices = std::vector<std::size_t>;

// A hub of two robots with ids 4 and 9 that has room for one more.
class HubWithRoom : public ::testing::Test {
 protected:
  void begin() {
    a_.greet();
    b_.greet();
    EXPECT_EQ(hub_.gather(0.05, never), (Indices{0, 1}));
    a_.answer();
    b_.answer();
    ASSERT_TRUE(hub_.gather(5.0, never).empty());
    ASSERT_TRUE(tick().empty());
  }
  // Those who take part say something in every tick, so that nobody counts as dead.
  FleetChanges tick() {
    if (a_talks_) a_.tell(0.1F);
    b_.tell(0.1F);
    return hub_.wait_for(tick_++, never);
  }
  // The ticks that a greeting takes.
  FleetChanges meet(FakeRobot& robot) {
    robot.greet();
    EXPECT_TRUE(tick().empty());
    robot.answer();
    return tick();
  }
  static HubSettings settings() {
    return {.listen = anywhere, .tick_s = 0.1, .speed = 20.0, .dead_after_s = 1.0, .bundle = 1};
  }
  std::vector<EnvelopeKind> heard_by(FakeRobot& robot) {
    std::vector<EnvelopeKind> kinds;
    for (const auto& [kind, payload] : robot.hear()) kinds.push_back(kind);
    return kinds;
  }
  Roster roster_{"cf_4,cf_9", 1};
  Hub hub_{settings(), roster_, fleet_keys(), nullptr};
  FakeRobot a_{4, hub_}, b_{9, hub_}, late_{17, hub_};
  std::uint32_t tick_ = 0;
  bool a_talks_ = true;
};

TEST_F(HubWithRoom, WhoeverHasAKeyAndAnUnusedIdJoins) {
  begin();
  EXPECT_EQ(meet(late_).joined, (Indices{2}));
  EXPECT_EQ(roster_.id(2), 17);
  EXPECT_EQ(roster_.name(2), "cf_17");
  EXPECT_TRUE(tick().empty());  // once
  hub_.dismiss(2);              // its world does not have it yet
  EXPECT_TRUE(heard_by(late_).empty());
  hub_.deliver(2, {}, {});
  EXPECT_EQ(heard_by(late_), (std::vector<EnvelopeKind>{EnvelopeKind::frame}));
  late_.tell(0.4F);
  static_cast<void>(tick());
  EXPECT_EQ(hub_.take(2)->velocity.forward_m_s, 0.4F);
}

TEST_F(HubWithRoom, NobodyJoinsByAHelloAloneOrBeyondTheRoom) {
  begin();
  std::vector<std::string> told;
  hub_.tell_refusals([&](const std::string& text) { told.push_back(text); });
  for (NodeId id = 100; id < 300; ++id)
    late_.socket.send(SecureChannel(id, hub_node, 5).ask(0.0, fleet_keys()), hub_.local());
  EXPECT_TRUE(tick().empty());
  static_cast<void>(late_.hear());
  EXPECT_EQ(meet(late_).joined, (Indices{2}));
  EXPECT_TRUE(told.empty());
  FakeRobot other(18, hub_);
  EXPECT_TRUE(meet(other).empty());
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].starts_with("refused robot cf_18 at 127.0.0.1:")) << told[0];
}

TEST_F(HubWithRoom, WithATrackerNobodyJoinsUnseen) {
  PoseStream tracker(anywhere, roster_);
  hub_.watch(tracker, [&] { tracker.listen(); });
  const Socket camera(anywhere);
  const auto see = [&](const std::string& text) {
    camera.send({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, tracker.local());
  };
  begin();
  EXPECT_TRUE(meet(late_).empty());
  see("cf_4 0 0 0\nsomebody 1 1 0\ncf_17 1 2 0.5\n");
  EXPECT_EQ(tick().joined, (Indices{2}));
  EXPECT_EQ(tracker.poses()[2], (TrackedPose{{1.0, 2.0}, 0.5}));
  EXPECT_EQ(tracker.lines(), "cf_4 0 0 0\ncf_17 1 2 0.5\n");
}

TEST_F(HubWithRoom, WhoSaysThatItLeavesIsGoneAtOnce) {
  begin();
  a_.say(EnvelopeKind::stopped);
  a_talks_ = false;
  EXPECT_EQ(tick().dead, (Indices{0}));
  EXPECT_TRUE(hub_.has_left(0));
  EXPECT_TRUE(tick().empty());
}

TEST_F(HubWithRoom, WhoCountsAsDeadMayJoinAgainAsAnotherProgramOnly) {
  begin();
  a_talks_ = false;
  FleetChanges changes;
  while (changes.empty() && tick_ < 100) changes = tick();
  EXPECT_EQ(changes.dead, (Indices{0}));
  a_.tell(0.1F);  // it was only cut off
  EXPECT_TRUE(tick().empty());
  static_cast<void>(a_.hear());
  hub_.dismiss(0);
  EXPECT_EQ(heard_by(a_), (std::vector<EnvelopeKind>{EnvelopeKind::stop}));
  for (int k = 0; k < 25; ++k) static_cast<void>(tick());  // its id is free after a second of silence
  FakeRobot again(4, hub_, 77);
  again.greet();
  static_cast<void>(tick());
  again.answer();
  again.greet();
  FleetChanges back = tick();
  again.answer();
  for (int k = 0; k < 5 && back.empty(); ++k) back = tick();
  EXPECT_EQ(back.joined, (Indices{0}));
  static_cast<void>(again.hear());
  hub_.dismiss(0);
  EXPECT_TRUE(heard_by(again).empty());
  hub_.deliver(0, {}, {});
  EXPECT_EQ(heard_by(again), (std::vector<EnvelopeKind>{EnvelopeKind::frame}));
}

TEST_F(HubAndRobots, ItsTapeHasWhoJoined) {
  const std::string path = ::testing::TempDir() + "banyan-hub-joins-" + std::to_string(::getpid());
  std::vector<Indices> live, played;
  {
    HubJournal journal(path, 1, 2);
    Roster roster(1, 1);
    Hub hub(options(), roster, fleet_keys(), &journal);
    FakeRobot first(0, hub), late(7, hub);
    join(hub, {&first});
    for (std::uint32_t tick = 0; tick < 6; ++tick) {
      if (tick == 2) late.greet();
      if (tick == 3) late.answer();
      live.push_back(hub.wait_for(tick, never).joined);
      if (roster.size() > 1) late.tell(static_cast<float>(tick));
    }
  }
  HubJournal journal(path, 1);
  Roster roster(1, 1);
  Hub hub(options(), roster, fleet_keys(), &journal);
  for (std::uint32_t tick = 0; tick < 6; ++tick) {
    played.push_back(hub.wait_for(tick, never).joined);
    const auto status = hub.take(1);
    EXPECT_EQ(status.has_value(), tick > 3) << tick;
  }
  EXPECT_EQ(played, live);
  EXPECT_EQ(live[3], (Indices{1}));
  EXPECT_EQ(roster.id(1), 7);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace banyan::udp

// SPDX-License-Identifier: MIT
// Who is let in: an attacker who can record, change, cut and send again, but does not have the key.
#include "banyan/hosts/udp/envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace banyan::udp {
namespace {

KeyRing ring(std::initializer_list<std::uint8_t> numbers) {
  std::vector<SecretKey> keys;
  for (const std::uint8_t number : numbers) {
    SecretKey key{number, {}};
    key.secret.fill(number);
    keys.push_back(key);
  }
  return KeyRing(keys);
}

const Bytes payload = {1, 2, 3};

SecureChannel::Taken give(SecureChannel& channel, const Bytes& datagram, const KeyRing& keys, double now_s = 0.0) {
  Drop reason{};
  const auto envelope = authenticate(datagram, keys, reason);
  return envelope ? channel.take(*envelope, now_s, keys) : SecureChannel::Taken{.drop = reason};
}

std::optional<Drop> dropped(SecureChannel& channel, const Bytes& datagram, const KeyRing& keys, double now_s = 0.0) {
  const SecureChannel::Taken taken = give(channel, datagram, keys, now_s);
  EXPECT_FALSE(taken.counts && taken.drop);
  return taken.drop;
}

// Hello, answer, answer: each believes the other.
void meet(SecureChannel& robot, SecureChannel& hub, const KeyRing& keys, double now_s = 0.0) {
  const auto greeted = give(hub, robot.ask(now_s, keys), keys, now_s);
  const auto answered = give(robot, greeted.reply, keys, now_s);
  EXPECT_FALSE(answered.drop);
  EXPECT_TRUE(answered.reply.empty() || give(hub, answered.reply, keys, now_s).is_met);
}

// Two that have greeted each other.
struct Pair {
  KeyRing keys = ring({1});
  SecureChannel robot{3, hub_node, 100};
  SecureChannel hub{hub_node, 3, 200};
  Pair() { meet(robot, hub, keys); }
};

TEST(Envelope, CarriesEverything) {
  const KeyRing keys = ring({9});
  const Bytes datagram =
      seal({EnvelopeKind::heard, 0x1234, 0x5678, 0x1122334455667788, 0x99AABBCCDDEEFF00, 0xCAFEBABE, payload},
           keys.signing());
  EXPECT_EQ(datagram.size(), header_bytes + payload.size() + mac_bytes);
  // As the header's table says, so that others can write it, too.
  const Bytes begin(datagram.begin(), datagram.begin() + 12);
  EXPECT_EQ(begin, (Bytes{0xBA, 2, 3, 9, 0x34, 0x12, 0x78, 0x56, 0x88, 0x77, 0x66, 0x55}));
  Drop reason{};
  const auto envelope = authenticate(datagram, keys, reason);
  ASSERT_TRUE(envelope);
  EXPECT_EQ(envelope->kind, EnvelopeKind::heard);
  EXPECT_EQ(envelope->sender, 0x1234);
  EXPECT_EQ(envelope->receiver, 0x5678);
  EXPECT_EQ(envelope->session, 0x1122334455667788U);
  EXPECT_EQ(envelope->echo, 0x99AABBCCDDEEFF00U);
  EXPECT_EQ(envelope->counter, 0xCAFEBABE);
  EXPECT_TRUE(std::ranges::equal(envelope->payload, payload));
}

TEST(Envelope, EveryChangedBitAndEveryCutIsNoticed) {
  Pair pair;
  const Bytes datagram = pair.robot.seal(EnvelopeKind::status, payload, pair.keys);
  for (std::size_t bit = 0; bit < 8 * datagram.size(); ++bit) {
    Bytes changed = datagram;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ 1U << bit % 8);
    const auto reason = dropped(pair.hub, changed, pair.keys);
    EXPECT_TRUE(reason == Drop::forged || (reason == Drop::foreign && bit < 32)) << bit;
  }
  for (std::size_t size = 0; size < datagram.size(); ++size)
    EXPECT_TRUE(
        dropped(pair.hub, Bytes(datagram.begin(), datagram.begin() + static_cast<std::ptrdiff_t>(size)), pair.keys))
        << size;
  Bytes longer = datagram;
  longer.push_back(0);
  EXPECT_EQ(dropped(pair.hub, longer, pair.keys), Drop::forged);
  EXPECT_EQ(dropped(pair.hub, datagram, pair.keys), std::nullopt);  // and it was good
}

TEST(Envelope, AnotherFleetIsForeign) {
  Pair pair;
  EXPECT_EQ(dropped(pair.hub, pair.robot.seal(EnvelopeKind::status, payload, ring({2})), pair.keys), Drop::foreign);
  KeyRing same_number({SecretKey{1, {}}});
  EXPECT_EQ(dropped(pair.hub, pair.robot.seal(EnvelopeKind::status, payload, same_number), pair.keys), Drop::forged);
}

TEST(Envelope, KeysChangeWithoutAPause) {
  Pair pair;
  const KeyRing begun = ring({1, 2}), changed = ring({2, 1}), done = ring({2});
  for (const auto& [robot, hub] : {std::pair{begun, ring({1})},
                                   {begun, begun},
                                   {changed, begun},
                                   {changed, changed},
                                   {done, changed},
                                   {done, done}}) {
    EXPECT_EQ(dropped(pair.hub, pair.robot.seal(EnvelopeKind::status, payload, robot), hub), std::nullopt);
    EXPECT_EQ(dropped(pair.robot, pair.hub.seal(EnvelopeKind::frame, payload, hub), robot), std::nullopt);
  }
  EXPECT_EQ(dropped(pair.hub, pair.robot.seal(EnvelopeKind::status, payload, ring({1})), done), Drop::foreign);
}

TEST(Envelope, APacketCountsOnceAndForItsReceiverOnly) {
  Pair pair;
  const Bytes status = pair.robot.seal(EnvelopeKind::status, payload, pair.keys);
  EXPECT_EQ(dropped(pair.hub, status, pair.keys), std::nullopt);
  EXPECT_EQ(dropped(pair.hub, status, pair.keys), Drop::replayed);
  EXPECT_EQ(dropped(pair.robot, status, pair.keys), Drop::misaddressed);  // reflected
  SecureChannel another(4, hub_node, 100);
  EXPECT_EQ(dropped(another, pair.hub.seal(EnvelopeKind::frame, payload, pair.keys), pair.keys), Drop::misaddressed);
}

TEST(Envelope, ARobotThatHasStartedAgainIsAcceptedAndItsOldPacketsAreNot) {
  Pair pair;
  const Bytes held_back = pair.robot.seal(EnvelopeKind::status, payload, pair.keys);
  const Bytes old_hello = pair.robot.ask(0.0, pair.keys);
  SecureChannel again(3, hub_node, 7);
  EXPECT_EQ(give(pair.hub, again.ask(0.5, pair.keys), pair.keys, 0.5).drop, Drop::in_use);
  meet(again, pair.hub, pair.keys, 1.5);
  EXPECT_EQ(dropped(again, pair.hub.seal(EnvelopeKind::frame, payload, pair.keys), pair.keys, 1.5), std::nullopt);
  EXPECT_EQ(dropped(pair.hub, again.seal(EnvelopeKind::status, payload, pair.keys), pair.keys, 1.5), std::nullopt);
  EXPECT_EQ(dropped(pair.hub, held_back, pair.keys, 1.6), Drop::in_use);
  EXPECT_EQ(dropped(pair.hub, held_back, pair.keys, 9.0), Drop::stale);
  EXPECT_FALSE(give(pair.hub, old_hello, pair.keys, 9.0).is_met);
  EXPECT_EQ(pair.hub.peer_session(), 7U);
}

TEST(Envelope, AHubThatHasStartedAgainTakesNothingFromBefore) {
  Pair pair;
  const Bytes recorded = pair.robot.seal(EnvelopeKind::status, payload, pair.keys);
  const Bytes frame = pair.hub.seal(EnvelopeKind::frame, payload, pair.keys);
  SecureChannel hub(hub_node, 3, 8);
  EXPECT_FALSE(give(hub, recorded, pair.keys, 2.0).counts);
  meet(pair.robot, hub, pair.keys, 2.5);
  EXPECT_EQ(dropped(pair.robot, hub.seal(EnvelopeKind::frame, payload, pair.keys), pair.keys, 2.5), std::nullopt);
  EXPECT_EQ(dropped(pair.robot, frame, pair.keys, 2.6), Drop::in_use);
  EXPECT_EQ(dropped(hub, recorded, pair.keys, 2.6), Drop::stale);
  EXPECT_EQ(dropped(hub, pair.robot.seal(EnvelopeKind::status, payload, pair.keys), pair.keys, 2.6), std::nullopt);
}

// Whoever has recorded everything, in whatever order it is sent, and however often: never is a session believed that
// does not run any more, nor does a packet count twice.
TEST(Envelope, NoRecordingMakesAnybodyBelieve) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  const KeyRing keys = ring({1});
  SecureChannel robot{3, hub_node, 1000}, hub{hub_node, 3, 1};
  std::vector<Bytes> recorded;
  std::set<std::pair<std::uint64_t, std::uint32_t>> counted;
  std::uint64_t session = 1000;
  double now_s = 0.0;
  int statuses = 0;
  const auto to_hub = [&](const Bytes& datagram) {
    recorded.push_back(datagram);
    Drop reason{};
    const auto envelope = authenticate(datagram, keys, reason);
    auto taken = hub.take(*envelope, now_s, keys);
    if (taken.counts) {
      ++statuses;
      EXPECT_EQ(envelope->session, session);
      EXPECT_TRUE(counted.emplace(envelope->session, envelope->counter).second);
    }
    if (!taken.reply.empty()) recorded.push_back(taken.reply);
    return taken.reply;
  };
  for (int k = 0; k < 20000; ++k) {
    now_s += 0.05;
    if (random() % 500 == 0) {
      robot = SecureChannel(3, hub_node, session = 1 + random());
      now_s += 1.5;
    }
    const Bytes said =
        robot.peer_session() == 0 ? robot.ask(now_s, keys) : robot.seal(EnvelopeKind::status, payload, keys);
    Bytes reply = to_hub(said);
    for (int turn = 0; turn < 3 && !reply.empty(); ++turn) {
      const Bytes back = give(robot, reply, keys, now_s).reply;
      reply = back.empty() ? Bytes() : to_hub(back);
    }
    for (int old = 0; old < 3; ++old) static_cast<void>(to_hub(Bytes(recorded[random() % recorded.size()])));
    const auto to_robot = give(robot, recorded[random() % recorded.size()], keys, now_s);
    EXPECT_FALSE(to_robot.is_met);
    EXPECT_LE(robot.peer_session(), 1U);
  }
  EXPECT_GT(statuses, 15000);
}

// Against a set of everything that was ever accepted.
// A hello that is sent again and again gets its answers, and takes nothing from who is there.
TEST(Envelope, NoRecordingKeepsAnybodyFromBeingBelieved) {
  const KeyRing keys = ring({1});
  SecureChannel before{3, hub_node, 100}, robot{3, hub_node, 101}, hub{hub_node, 3, 200};
  const Bytes recorded = before.ask(0.0, keys);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(give(hub, recorded, keys, 0.3 + 0.001 * k).reply.empty());
  meet(robot, hub, keys, 0.4);
  EXPECT_EQ(hub.peer_session(), 101U);
}

TEST(ReplayWindow, AcceptsEachOnceWhateverTheOrder) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  for (int round = 0; round < 200; ++round) {
    ReplayWindow window;
    std::set<std::uint32_t> accepted;
    std::uint32_t highest = 0;
    for (int k = 0; k < 500; ++k) {
      const auto counter = static_cast<std::uint32_t>(1 + random() % (round % 2 == 0 ? 300U : 5000U));
      const bool too_old = counter + ReplayWindow::reach <= highest;
      const bool is_new = !too_old && accepted.insert(counter).second;
      EXPECT_EQ(!window.admit(counter), is_new) << round << " " << counter << " " << highest;
      highest = std::max(highest, counter);
    }
  }
}

TEST(ReplayWindow, NothingHasCounterZero) {
  ReplayWindow window;
  EXPECT_EQ(window.admit(0), Drop::malformed);
  EXPECT_EQ(window.admit(0xFFFFFFFF), std::nullopt);
  EXPECT_EQ(window.admit(1), Drop::replayed);
}

}  // namespace
}  // namespace banyan::udp

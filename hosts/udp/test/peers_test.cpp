// SPDX-License-Identifier: MIT
// What two robots without a hub accept of each other, and of what somebody has recorded.
#include "banyan/hosts/udp/peers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

namespace banyan::udp {
namespace {

using What = Peers::Taken::What;

class PeersTest : public testing::Test {
 protected:
  Peers::Taken give(Peers& to, const Bytes& datagram, double now_s = 0.0) const {
    Drop reason{};
    const auto envelope = authenticate(datagram, keys_, reason);
    EXPECT_TRUE(envelope);
    return envelope ? to.take(*envelope, now_s, keys_) : Peers::Taken{};
  }
  // What `from` says, until `to` knows that it is running.
  void introduce(Peers& from, Peers& to, double now_s = 0.0) {
    const auto asked = give(to, from.speak(word_, keys_), now_s);
    ASSERT_FALSE(asked.reply.empty());
    const auto answered = give(from, asked.reply, now_s);
    ASSERT_FALSE(answered.reply.empty());
    const auto met = give(to, answered.reply, now_s);
    EXPECT_FALSE(met.drop);
    if (!met.reply.empty()) static_cast<void>(give(from, met.reply, now_s));
  }
  KeyRing keys_{{SecretKey{1, {7}}}};
  Bytes word_{1, 2, 3};
  Peers a_{1, 1000};
  Peers b_{2, 2000};
};

TEST_F(PeersTest, WhoHasAnsweredIsHeardOnce) {
  introduce(a_, b_);
  const Bytes said = a_.speak(word_, keys_);
  EXPECT_EQ(give(b_, said).what, What::message);
  EXPECT_EQ(give(b_, said).drop, Drop::replayed);
  EXPECT_EQ(give(b_, a_.speak(word_, keys_)).what, What::message);
}

TEST_F(PeersTest, WhatWasRecordedCountsForNothing) {
  introduce(a_, b_);
  const Bytes said = a_.speak(word_, keys_);
  Peers later(2, 3000);  // b has started again, and a is off
  const auto again = give(later, said);
  EXPECT_EQ(again.what, What::nothing);
  EXPECT_FALSE(again.reply.empty());
  // A recorded hello of a is answered, and proves nothing; nor does what a has answered others, or an earlier b.
  Peers first_b(2, 2500);
  const Bytes hello = give(a_, first_b.speak(word_, keys_), 1.5).reply;
  const Bytes asked = give(first_b, a_.speak(word_, keys_), 1.0).reply;
  const Bytes answer = give(a_, asked).reply;
  static_cast<void>(give(later, hello));
  EXPECT_EQ(give(later, answer).drop, Drop::stale);
  EXPECT_EQ(give(later, said, 0.05).what, What::nothing);
  EXPECT_FALSE(give(first_b, answer, 1.0).drop);
  EXPECT_EQ(give(first_b, answer).drop, Drop::stale);
}

TEST_F(PeersTest, AnAnswerThatComesTooLateIsNone) {
  const Bytes asked = give(b_, a_.speak(word_, keys_)).reply;
  const Bytes answer = give(a_, asked).reply;
  EXPECT_EQ(give(b_, answer, 10.5).drop, Drop::stale);
  introduce(a_, b_, 11.0);
}

// Whatever its clock says: the numbers of sessions mean nothing.
TEST_F(PeersTest, WhoStartsAgainIsAskedAgainAndItsOldPacketsCountForNothing) {
  introduce(a_, b_);
  double now_s = 0.0;
  for (const std::uint64_t session : {5000U, 900U, 70U}) {
    const Bytes old = a_.speak(word_, keys_);
    a_ = Peers(1, session);
    introduce(a_, b_, now_s += 1.5);
    EXPECT_EQ(give(b_, a_.speak(word_, keys_), now_s).what, What::message);
    EXPECT_EQ(give(b_, old, now_s + 0.1).what, What::nothing);
    EXPECT_EQ(give(b_, a_.speak(word_, keys_), now_s + 0.2).what, What::message);
  }
}

TEST_F(PeersTest, AnIdBelongsToWhoHasItAndASecondOneIsNoticed) {
  introduce(a_, b_);
  Peers second(1, 5000);
  double now_s = 0.0, noticed_s = 0.0;
  for (; now_s < 2.0; now_s += 0.1) {
    const auto refused = give(b_, second.speak(word_, keys_), now_s);
    EXPECT_EQ(refused.drop, Drop::in_use);
    EXPECT_TRUE(refused.reply.empty());
    const auto heard = give(b_, a_.speak(word_, keys_), now_s + 0.05);
    EXPECT_EQ(heard.what, What::message);
    if (heard.is_contested && noticed_s == 0.0) noticed_s = now_s;
  }
  EXPECT_NEAR(noticed_s, 0.3, 0.11);  // until then it may have been under way when the first one ended
  EXPECT_TRUE(give(a_, second.speak(word_, keys_), now_s).is_contested);
  // The first one ends, and the second takes its place.
  EXPECT_EQ(give(b_, second.speak(word_, keys_), now_s + 0.5).drop, Drop::in_use);
  introduce(second, b_, now_s + 1.5);
  EXPECT_EQ(give(b_, second.speak(word_, keys_), now_s + 1.6).what, What::message);
}

// Datagrams that are lost, late and out of order delay it; whoever starts again is met again.
TEST_F(PeersTest, WhateverIsLostTheyMeet) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  const auto share = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
  for (int round = 0; round < 200; ++round) {
    const double loss = 0.6 * share(), latest_s = 0.5 * share();
    std::array<Peers, 2> peers{Peers(1, 1 + random()), Peers(2, 1 + random())};
    std::multimap<double, std::pair<std::size_t, Bytes>> under_way;  // when, to whom
    std::array<double, 2> heard_s{-1.0, -1.0};
    const auto send = [&](std::size_t to, const Bytes& datagram, double now_s) {
      if (!datagram.empty() && share() >= loss) under_way.emplace(now_s + latest_s * share(), std::pair(to, datagram));
    };
    const double again_s = 5.0 + 10.0 * share();
    bool has_started_again = false;
    for (double now_s = 0.0; now_s < 30.0; now_s += 0.05) {
      if (!has_started_again && now_s >= again_s) {
        peers[0] = Peers(1, 1 + random());
        heard_s = {-1.0, -1.0};
        has_started_again = true;
      }
      for (std::size_t i = 0; i < 2; ++i) send(1 - i, peers.at(i).speak(word_, keys_), now_s);
      while (!under_way.empty() && under_way.begin()->first <= now_s) {
        const auto [to, datagram] = under_way.extract(under_way.begin()).mapped();
        const auto taken = give(peers.at(to), datagram, now_s);
        send(1 - to, taken.reply, now_s);
        if (taken.what == What::message && heard_s.at(to) < 0.0) heard_s.at(to) = now_s;
      }
    }
    for (const double heard : heard_s) {
      EXPECT_GE(heard, again_s) << round;
      EXPECT_LE(heard, again_s + 10.0) << round;
    }
  }
}

TEST_F(PeersTest, AsksFiveTimesASecond) {
  int asked = 0;
  for (int k = 0; k < 100; ++k) asked += give(b_, a_.speak(word_, keys_), 0.01 * k).reply.empty() ? 0 : 1;
  EXPECT_EQ(asked, 5);
}

TEST_F(PeersTest, ItsOwnBroadcastIsNothing) {
  const auto taken = give(a_, a_.speak(word_, keys_));
  EXPECT_EQ(taken.what, What::nothing);
  EXPECT_FALSE(taken.drop);
  EXPECT_TRUE(taken.reply.empty());
}

TEST_F(PeersTest, StopsForAStopperThatIsThereNow) {
  Stopper stopper(4000);
  const auto open = [&](const Bytes& datagram) {
    Drop reason{};
    return stopper.take(*authenticate(datagram, keys_, reason), keys_);
  };
  const auto replies = open(give(a_, stopper.call(keys_)).reply);
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_FALSE(stopper.robots().at(1));
  const Bytes& stop = replies[1];
  EXPECT_EQ(give(a_, stop).what, What::nothing);  // nobody is believed before it has answered
  EXPECT_FALSE(give(a_, replies[0]).drop);
  const auto taken = give(a_, stop);
  EXPECT_EQ(taken.what, What::stop);
  static_cast<void>(open(taken.reply));
  EXPECT_TRUE(stopper.robots().at(1));
  EXPECT_EQ(give(a_, stop).drop, Drop::replayed);
  Peers restarted(1, 6000);
  EXPECT_EQ(give(restarted, stop).what, What::nothing);
  // No robot can stop another one.
  EXPECT_EQ(give(b_, seal({EnvelopeKind::stop, 1, 2, 1000, 2000, 1, {}}, keys_.signing())).what, What::nothing);
}

TEST_F(PeersTest, WhatIsForOthersIsMisaddressed) {
  EXPECT_EQ(give(b_, seal({EnvelopeKind::spoken, 1, 2, 1000, 0, 1, word_}, keys_.signing())).drop, Drop::misaddressed);
  EXPECT_EQ(give(b_, seal({EnvelopeKind::spoken, hub_node, everybody, 1000, 0, 1, word_}, keys_.signing())).drop,
            Drop::misaddressed);
  EXPECT_EQ(give(b_, seal({EnvelopeKind::hello, 1, everybody, 1000, 0, 1, word_}, keys_.signing())).drop,
            Drop::misaddressed);
  EXPECT_EQ(give(b_, seal({EnvelopeKind::frame, hub_node, 2, 1000, 2000, 1, word_}, keys_.signing())).drop,
            Drop::malformed);
}

TEST_F(PeersTest, OnlyWhoListensTakesAccountsAndOnlyOfWhoIsRunning) {
  Peers listener(hub_node, 5000);
  const Bytes first = a_.tell(word_, keys_);
  EXPECT_EQ(give(b_, first).drop, Drop::misaddressed);
  const auto asked = give(listener, first);
  EXPECT_EQ(asked.what, What::nothing);
  const auto answered = give(a_, asked.reply);
  EXPECT_EQ(answered.what, What::nothing);  // and nobody stops
  const auto met = give(listener, answered.reply);
  EXPECT_FALSE(met.drop);
  EXPECT_FALSE(give(a_, met.reply).drop);
  const Bytes told = a_.tell(word_, keys_);
  EXPECT_EQ(give(listener, told).what, What::account);
  EXPECT_EQ(give(listener, told).drop, Drop::replayed);
  EXPECT_EQ(give(listener, a_.speak(word_, keys_)).what, What::message);
}

}  // namespace
}  // namespace banyan::udp

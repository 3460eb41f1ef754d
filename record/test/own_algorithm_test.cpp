// SPDX-License-Identifier: MIT
// An algorithm that is no tree, with a state and a message of its own, in all that the house has: a world
// runs it, whatever the number of threads; an observer watches it and a recorder keeps what it says.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/core/swarm_of.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "sample.hpp"

namespace shy {

using namespace banyan;

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  std::uint16_t fled_ticks = 0;  // so long somebody has been too near
};
template <class Visitor, class M> constexpr void visit_fields(Visitor& visit, M& m) noexcept {
  visit.robot("id", "of the sender", m.id);
  visit.number("fled_ticks", "so long somebody was too near", m.fled_ticks);
}

struct Shy {
  using Params = Machine;
  struct State {
    RobotId id = nobody;
    std::uint16_t fled_ticks = 0;
  };
  using Message = shy::Message;
  struct Heard {
    const Message* message;
    Vec2 position;
    float age_s;
  };
  static State initial(RobotId id, bool, bool) { return {id, 0}; }
  // Away from the nearest neighbour.
  static Output<Message> step(const Params&, State& self, const Inputs<Heard>& inputs) {
    Output<Message> output;
    Vec2 nearest{1.0F, 0.0F};
    for (const Heard& h : inputs.heard())
      if (squared_norm(h.position) < squared_norm(nearest)) nearest = h.position;
    if (norm(nearest) < 0.9F) {
      ++self.fled_ticks;
      output.motion = {nearest.x > 0.0F ? -0.5F : 0.5F, 0.0F, nearest.y * nearest.x > 0.0F ? 5.0F : -5.0F};
    }
    output.message.id = self.id;
    output.message.fled_ticks = self.fled_ticks;
    return output;
  }
  static Report report(const State& self) {
    Report report;
    report.role = self.id == 0 ? Role::root : Role::spare;
    return report;
  }
  static void add_to(Digest& digest, const State& self) { digest.add(self.id), digest.add(self.fled_ticks); }
};

class ShyAlgorithm final : public Algorithm {
 public:
  std::string_view name() const noexcept override { return "shy"; }
  std::string_view summary() const noexcept override { return "drives away from the nearest robot"; }
  std::vector<const ParameterInfo*> parameters() const override { return {}; }
  std::vector<float> values(const Setup&) const override { return {}; }
  std::string fault(const Setup&) const override { return {}; }
  std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<SwarmOf<Shy>>(machine_of(setup.platform), setup.platform, members, setup.history);
  }
};
const ShyAlgorithm algorithm;

}  // namespace shy

namespace banyan::record {
namespace {

using nlohmann::json;

world::Scenario crowd() {
  world::Scenario s;
  s.swarm.robots = 40;
  s.radio.line_of_sight = true;
  s.radio.loss = 0.2;
  s.radio.latency_ticks = 2;
  s.events = {{.time_s = 3.0, .action = world::Die{7}}};
  return s;
}

const SwarmOf<shy::Shy>& robots_of(const world::World& world) {
  return dynamic_cast<const SwarmOf<shy::Shy>&>(world.swarm());
}

TEST(OwnAlgorithm, KeepsApartWhateverTheNumberOfThreads) {
  std::optional<std::uint64_t> hash;
  for (const int threads : {1, 2, 4}) {
    world::Executor executor(threads);
    world::World world(crowd(), shy::algorithm);
    const double before = distance(world.positions()[1], world.positions()[39]);
    for (int t = 0; t < 100; ++t) world.step(executor);
    EXPECT_GT(distance(world.positions()[1], world.positions()[39]), before) << "they spread";
    EXPECT_EQ(hash.value_or(world.hash()), world.hash()) << threads << " threads";
    hash = world.hash();
  }
}

TEST(OwnAlgorithm, IsWholeInACopyAndInTheHash) {
  world::World world(crowd(), shy::algorithm);
  for (int t = 0; t < 20; ++t) world.step();
  world::World copy(world);
  EXPECT_EQ(copy.hash(), world.hash());
  for (int t = 0; t < 20; ++t) world.step();
  EXPECT_NE(copy.hash(), world.hash());
  for (int t = 0; t < 20; ++t) copy.step();
  EXPECT_EQ(copy.hash(), world.hash());
}

TEST(OwnAlgorithm, ItsMessagesTravelAsBytes) {
  world::World world(crowd(), shy::algorithm);
  for (int t = 0; t < 20; ++t) world.step();
  ASSERT_EQ(world.swarm().message_bytes(), 1U + 2U + 2U);
  std::vector<std::uint8_t> bytes(5);
  ASSERT_EQ(world.swarm().send(3, bytes), bytes.size());
  const auto message = decode_fields<shy::Message>(bytes);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->id, 3);
  EXPECT_EQ(message->fled_ticks, robots_of(world).state(3).fled_ticks);
  EXPECT_GT(message->fled_ticks, 10);
}

TEST(OwnAlgorithm, IsObservedAndRecorded) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("shy.mcap");
  world::World world(crowd(), shy::algorithm);
  measure::Observer observer(world);
  std::vector<int> fled;
  {
    Recorder recorder(path, {}, {.every_ticks = 50});
    for (int t = 0; t < 50; ++t) {
      world.step();
      recorder.frame(world, observer.observe(world));
    }
    recorder.finish(observer.result(world));
  }
  for (std::size_t i = 0; i < world.size(); ++i) fled.push_back(robots_of(world).state(i).fled_ticks);
  EXPECT_EQ(observer.last().alive, 39U);
  EXPECT_EQ(observer.last().roots, 1U);
  const measure::Run run = observer.result(world);
  EXPECT_FALSE(run.complete) << "nobody goes to a target";
  EXPECT_EQ(run.hash, world.hash());
  // The first of its packets are sent in the second tick.
  EXPECT_NEAR(run.bytes_per_robot_s, static_cast<double>(world.packets_sent()) * 5.0 / (40 * 5.0), 1e-9);

  mcap::Reader reader(path);
  EXPECT_EQ(Recording(path).setting().algorithm, "shy");
  json messages;
  reader.messages(reader.find_channel("/banyan/messages")->id, [&](const mcap::LoggedMessage& m) {
    messages = json::parse(m.data);
    return messages["tick"] != 50;
  });
  EXPECT_EQ(messages.size(), 3U) << "tick, time_s and what only the message has";
  EXPECT_EQ(messages["fled_ticks"].get<std::vector<int>>(), fled);
}

}  // namespace
}  // namespace banyan::record

// SPDX-License-Identifier: MIT
// The loop of a tick: what is lost, late, noisy or crowded out on the way from robot to robot, and
// the world as a value.
#include "banyan/world/world.hpp"
#include "banyan/world/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "banyan/world/threads.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

// Nobody moves: all robots are frozen from the start.
Scenario statue(std::size_t robots, std::uint64_t seed = 1) {
  Scenario s = ring("outwards", robots, 2, 3.0, seed);
  for (std::size_t i = 0; i < robots; ++i) { s.events.push_back({.action = Freeze{i}}); }
  return s;
}

Vec2 truth(const World& world, std::size_t receiver, std::size_t sender) {
  return rotate_back(world.headings()[receiver], world.positions()[sender] - world.positions()[receiver]);
}

// Calls visit(receiver, k) for every entry that was heard in the last tick.
template <class Visit> void for_each_heard(const World& world, Visit visit) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Neighbors& table = neighbors_of(world.swarm(), i);
    for (int k = 0; k < table.size(); ++k)
      if (table.age(k) == 0) visit(i, k);
  }
}

TEST(World, WithoutLossEverybodyHearsExactlyItsLinksWhereTheyAre) {
  World world(hostile("outwards", 30, 3));
  Scenario s = hostile("outwards", 30, 3);
  s.radio.loss = s.radio.range_noise_m = s.radio.bearing_noise_rad = 0.0;
  world = World(s);
  world.step();
  for (int t = 0; t < 100; ++t) {
    world.step();
    std::size_t heard = 0;
    for_each_heard(world, [&](std::size_t i, int k) {
      ++heard;
      const Neighbors& table = neighbors_of(world.swarm(), i);
      const std::size_t sender = table.id(k);
      const auto links = world.links(i);
      ASSERT_TRUE(std::binary_search(links.begin(), links.end(), static_cast<std::uint32_t>(sender)));
      const Vec2 d = truth(world, i, sender);
      EXPECT_NEAR(d.x, believed_m(world, table, k).x, 1e-6);
      EXPECT_NEAR(d.y, believed_m(world, table, k).y, 1e-6);
    });
    std::size_t links = 0;
    for (std::size_t i = 0; i < world.size(); ++i) links += world.links(i).size();
    ASSERT_EQ(heard, links);
  }
}

TEST(World, NobodyHearsAnythingInTheFirstTick) {
  World world(ring("inwards", 12, 2, 3.0, 1));
  world.step();
  EXPECT_EQ(world.packets_received(), 0U);
  EXPECT_EQ(world.packets_sent(), 0U);
  world.step();
  EXPECT_EQ(world.packets_sent(), 12U);
  std::size_t links = 0;
  for (std::size_t i = 0; i < world.size(); ++i) links += world.links(i).size();
  EXPECT_EQ(world.packets_received(), links);
}

TEST(World, LossIsDrawnForEveryPacketAndReceiver) {
  for (const double loss : {0.1, 0.3, 0.6}) {
    Scenario s = statue(40);
    s.radio.loss = loss;
    World world(s);
    double links = 0;
    double both = 0;
    double one_way = 0;
    for (int t = 0; t < 200; ++t) {
      world.step();
      if (t == 0) continue;
      for (std::size_t i = 0; i < world.size(); ++i) {
        links += static_cast<double>(world.links(i).size());
        for (const std::uint32_t j : world.links(i)) {
          const auto heard = [&](std::size_t a, std::size_t b) {
            const Neighbors& table = neighbors_of(world.swarm(), a);
            const int k = table.find(static_cast<RobotId>(b));
            return k >= 0 && table.age(k) == 0;
          };
          one_way += heard(i, j) ? 1 : 0;
          both += heard(i, j) && heard(j, i) ? 1 : 0;
        }
      }
    }
    const double kept = static_cast<double>(world.packets_received()) / links;
    EXPECT_NEAR(kept, 1 - loss, 5 * std::sqrt(loss * (1 - loss) / links));
    EXPECT_EQ(one_way, static_cast<double>(world.packets_received()));
    EXPECT_NEAR(both / links, (1 - loss) * (1 - loss), 0.01) << "the two directions are independent";
  }
}

// A message composed in tick t is heard in tick t + latency, with the positions of its transmission.
TEST(World, LatencyIsExact) {
  for (int latency = 1; latency <= 4; ++latency) {
    Scenario s = ring("outwards", 14, 2, 3.0, 5);
    s.radio.latency_ticks = latency;
    s.radio.loss = 0.2;
    World world(s);
    const auto swarm = [&]() -> const auto& {
      return swarm_as<PaperSwarm<paper::outwards, paper::corrected>>(world.swarm());
    };
    std::vector<std::vector<paper::Message>> said;  // [tick][robot]
    std::vector<std::vector<Vec2>> positions, headings;
    const auto note = [&] {
      said.emplace_back();
      for (std::size_t i = 0; i < world.size(); ++i) said.back().push_back(swarm().message(i));
      positions.emplace_back(world.positions().begin(), world.positions().end());
      headings.emplace_back(world.headings().begin(), world.headings().end());
    };
    note();
    std::size_t heard = 0;
    for (int t = 1; t <= 60; ++t) {
      world.step();
      note();
      for_each_heard(world, [&](std::size_t i, int k) {
        ++heard;
        ASSERT_GT(t, latency);
        const auto sent = static_cast<std::size_t>(t - latency);
        const paper::Neighborhood& table = swarm().state(i).neighbors;
        const std::size_t sender = table.id(k);
        EXPECT_EQ(table.messages[static_cast<std::size_t>(k)], said[sent][sender]) << latency << " at " << t;
        // Where the sender was then, seen from where the receiver is now: its odometry carried it along.
        const auto now = static_cast<std::size_t>(t);
        const Vec2 d = rotate_back(headings[now][i], positions[sent + 1][sender] - positions[now][i]);
        EXPECT_NEAR(d.x, believed_m(world, table, k).x, 1e-5);
        EXPECT_NEAR(d.y, believed_m(world, table, k).y, 1e-5);
      });
    }
    EXPECT_GT(heard, 1000U);
  }
}

TEST(World, SlotsLimitWhatARobotHearsAndTreatAllSendersAlike) {
  Scenario s = statue(30);
  s.radio.slots = 5;
  World world(s);
  std::vector<std::vector<int>> heard(30, std::vector<int>(30, 0));
  constexpr int ticks = 1500;
  world.step();
  for (int t = 0; t < ticks; ++t) {
    world.step();
    std::vector<int> count(30, 0);
    for_each_heard(world, [&](std::size_t i, int k) {
      ++count[i];
      ++heard[i][neighbors_of(world.swarm(), i).id(k)];
    });
    for (std::size_t i = 0; i < 30; ++i) ASSERT_EQ(count[i], std::min<int>(5, static_cast<int>(world.links(i).size())));
  }
  for (std::size_t i = 0; i < 30; ++i) {
    const auto links = world.links(i);
    ASSERT_GT(links.size(), 5U);
    const double share = 5.0 / static_cast<double>(links.size());
    for (const std::uint32_t j : links)
      EXPECT_NEAR(heard[i][j] / double{ticks}, share, 5 * std::sqrt(share / ticks)) << i << " hears " << j;
  }
}

TEST(World, RangeAndBearingNoiseHaveTheirSigma) {
  Scenario s = statue(20);
  s.mission.reading = "literal";  // `corrected` filters what it measures
  s.radio.range_noise_m = 0.05;
  s.radio.bearing_noise_rad = 0.1;
  World world(s);
  double n = 0, range_sum = 0, range_squares = 0, bearing_sum = 0, bearing_squares = 0, product = 0;
  for (int t = 0; t < 100; ++t) {
    world.step();
    for_each_heard(world, [&](std::size_t i, int k) {
      const Neighbors& table = neighbors_of(world.swarm(), i);
      const Vec2 d = truth(world, i, table.id(k));
      const Vec2 measured = believed_m(world, table, k);
      const double range = norm(measured) - norm(d);
      const double bearing = std::atan2(cross(d, measured), dot(d, measured));
      ++n;
      range_sum += range;
      range_squares += range * range;
      bearing_sum += bearing;
      bearing_squares += bearing * bearing;
      product += range * bearing;
    });
  }
  ASSERT_GT(n, 20'000);
  EXPECT_NEAR(range_sum / n, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(range_squares / n), 0.05, 0.001);
  EXPECT_NEAR(bearing_sum / n, 0.0, 0.004);
  EXPECT_NEAR(std::sqrt(bearing_squares / n), 0.1, 0.002);
  EXPECT_NEAR(product / n / (0.05 * 0.1), 0.0, 0.04) << "the two are independent";
}

TEST(World, ACopyGoesOnAsTheOriginal) {
  for (const BodyModel body : {BodyModel::disks, BodyModel::linear, BodyModel::box2d}) {
    if (body == BodyModel::box2d && !has_box2d()) continue;
    Scenario s = hostile("inwards", 20, 4);
    s.robot.body = body;
    s.radio.latency_ticks = 3;
    World world(s);
    for (int t = 0; t < 50; ++t) world.step();
    World copy(world);
    World assigned(ring("outwards", 8, 2, 2.0, 1));
    assigned = world;
    const std::uint64_t before = world.hash();
    for (int t = 0; t < 100; ++t) copy.step();
    EXPECT_EQ(world.hash(), before) << "stepping a copy must not touch the original";
    for (int t = 0; t < 100; ++t) {
      world.step();
      assigned.step();
    }
    EXPECT_EQ(world.hash(), copy.hash());
    EXPECT_EQ(world.hash(), assigned.hash());
    const World& self = world;
    world = self;
    EXPECT_EQ(world.hash(), copy.hash());
  }
}

TEST(World, CanBeMoved) {
  World a(hostile("outwards", 15, 2));
  World b(hostile("outwards", 15, 2));
  a.step();
  b.step();
  World c(std::move(a));
  EXPECT_EQ(c.hash(), b.hash());
  a = std::move(c);
  a.step();
  b.step();
  EXPECT_EQ(a.hash(), b.hash());
}

TEST(World, TheSeedDecides) {
  const auto hash_after = [](std::uint64_t seed) {
    World world(ring("outwards", 15, 2, 3.0, seed));
    for (int t = 0; t < 20; ++t) world.step();
    return world.hash();
  };
  EXPECT_EQ(hash_after(1), hash_after(1));
  EXPECT_NE(hash_after(1), hash_after(2));
}

TEST(World, EveryTickChangesTheHash) {
  World world(ring("outwards", 10, 2, 3.0, 1));
  std::vector<std::uint64_t> seen{world.hash()};
  for (int t = 0; t < 50; ++t) {
    world.step();
    EXPECT_EQ(std::count(seen.begin(), seen.end(), world.hash()), 0);
    seen.push_back(world.hash());
  }
}

TEST(World, StartsAsTheScenarioSays) {
  Scenario s = ring("inwards", 16, 3, 4.0, 7);
  s.swarm.root = 4;
  const World world(s);
  EXPECT_EQ(world.size(), 16U);
  EXPECT_EQ(world.tick(), 0U);
  EXPECT_EQ(world.time_s(), 0.0);
  EXPECT_EQ(world.algorithm().name(), "inwards");
  ASSERT_EQ(world.targets().size(), 3U);
  for (const Target& target : world.targets()) {
    EXPECT_NEAR(norm(target.position), 4.0, 1e-9);
    EXPECT_TRUE(is_worker(world.swarm(), target.worker));
  }
  for (std::size_t i = 0; i < 16; ++i) {
    inside(world.swarm(), [i](const auto& swarm) { EXPECT_EQ(swarm.state(i).id, i); });
    EXPECT_EQ(world.reports()[i].role == Role::root, i == 4);
    EXPECT_EQ(world.alive()[i], 1);
    EXPECT_NEAR(norm(world.headings()[i]), 1.0, 1e-9);
  }
}

TEST(World, TheScenarioSetsTheParameters) {
  Scenario s = ring("inwards", 10, 2, 3.0, 1);
  s.mission.reading = "literal";
  s.mission.parameters = {{"target_gain", 0.4}};
  s.radio.range_m = 2.5;
  s.robot.wheel_limit_m_s = 0.1;
  const World world(s);
  const paper::Params& params = swarm_as<PaperSwarm<paper::inwards, paper::literal>>(world.swarm()).params();
  EXPECT_FLOAT_EQ(params.target_gain, 0.4F);
  EXPECT_FLOAT_EQ(params.rounds_per_drive, 250.0F);
  EXPECT_FLOAT_EQ(params.body_radius, 0.02816F);
  EXPECT_FLOAT_EQ(params.ideal_distance, 0.7704205F);
}

TEST(World, AnImpossibleScenarioIsRefusedWithAllItsFaults) {
  Scenario s = ring("sideways", 10, 2, 3.0, 1);
  s.radio.loss = 2.0;
  try {
    const World world(s);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("radio.loss"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("mission.algorithm"), std::string::npos) << e.what();
  }
}

TEST(World, NeedsAtMostNineAndAHalfKilobytesPerRobot) {
  for (const auto& [algorithm, reading, most] :
       {std::tuple{"outwards", "literal", 8'832U}, {"inwards", "corrected", 8'832U}, {"convoy", "corrected", 9'728U}})
    for (const std::size_t robots : {94U, 1000U}) {
      Scenario s = ring(algorithm, robots, 4, 9.0, 1);
      s.mission.reading = reading;
      s.radio.line_of_sight = true;
      s.swarm.start.pitch_m = 1.3;
      World world(s);
      for (int t = 0; t < 5; ++t) world.step();
      EXPECT_LE(world.memory_bytes(), robots * most) << algorithm << ", " << reading << ", " << robots << " robots";
    }
}

TEST(World, WheelNoiseShowsInTheMotionButNotInTheOdometryOfIt) {
  // Odometry measures what the wheels did, noise included: dead reckoning stays exact without
  // odometry noise. A silent neighbour is remembered where it is, as long as it does not move.
  Scenario s = ring("outwards", 12, 2, 3.0, 2);
  s.robot.wheel_noise = 0.3;
  s.swarm.start.pitch_m = 0.6;
  World world(s);
  for (int t = 0; t < 60; ++t) world.step();
  const std::size_t lost = (world.targets()[0].worker + 1) % 12;
  Scenario dying = s;
  dying.events.push_back({.time_s = 6.0, .action = Die{lost}});
  World without(dying);
  for (int t = 0; t < 70; ++t) without.step();
  int remembered = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const Neighbors& table = neighbors_of(without.swarm(), i);
    const int k = table.find(static_cast<RobotId>(lost));
    if (i == lost || k < 0) continue;
    ++remembered;
    const Vec2 d = truth(without, i, lost);
    EXPECT_NEAR(d.x, believed_m(world, table, k).x, 2e-3);
    EXPECT_NEAR(d.y, believed_m(world, table, k).y, 2e-3);
  }
  EXPECT_GT(remembered, 0);
}

// Who holds a target, from the public view alone: the nearest living worker that serves it.
std::optional<std::size_t> holder_by_hand(const World& world, std::size_t t) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Report& said = world.reports()[i];
    const double away = distance(world.positions()[i], world.targets()[t].position);
    if (world.alive()[i] == 0 || said.role != Role::worker || said.serves != world.targets()[t].worker) continue;
    if (away > target_tolerance_m(world.scenario())) continue;
    if (!best || away < distance(world.positions()[*best], world.targets()[t].position)) best = i;
  }
  return best;
}

TEST(Holder, IsTheWorkerOnceItHasArrived) {
  World world(ring("inwards", 14, 2, 2.0, 1));
  EXPECT_FALSE(world.holder(0));
  std::size_t held = 0;
  for (int t = 0; t < 600; ++t) {
    world.step();
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(world.holder(k), holder_by_hand(world, k)) << world.tick();
      if (!world.holder(k)) continue;
      ASSERT_EQ(*world.holder(k), world.targets()[k].worker);
      ++held;
    }
  }
  EXPECT_GT(held, 100U);
  EXPECT_FALSE(world.holder(2)) << "there is no such target";
}

TEST(Holder, IsNoneOnceTheWorkerIsDead) {
  Scenario s = ring("inwards", 14, 2, 2.0, 1);
  s.events = {{.time_s = 60.0, .action = Die{World(s).targets()[1].worker}}};
  World world(s);
  while (world.tick() < 600) world.step();
  ASSERT_TRUE(world.holder(1));
  world.step();
  EXPECT_FALSE(world.holder(1));
}

}  // namespace
}  // namespace banyan::world

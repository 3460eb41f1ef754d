// SPDX-License-Identifier: MIT
// Robots that are decided for from outside, without Python: the same by a mind and between ticks, with any team, in
// copies; and the arrays that they fill.
#include "banyan/hosts/python/outside_swarm.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"

namespace banyan::python {
namespace {

// Some rule without a memory: drives by what it hears, and says where it was driven.
void rule(Block& block, std::size_t swarm) {
  const Exchange at = block.exchange(swarm);
  const Shape& shape = block.shape();
  for (std::size_t i = 0; i < shape.robots; ++i) {
    Vec2 sum{at.of<float>(Field::target)[2 * i], at.of<float>(Field::target)[2 * i + 1]};
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.of<std::int32_t>(Field::heard)[i]); ++k) {
      const std::size_t row = i * shape.neighbours + k;
      float told[2];
      std::memcpy(told, at.of<std::uint8_t>(Field::message) + row * shape.payload, sizeof told);
      sum += Vec2{at.of<float>(Field::position)[2 * row], at.of<float>(Field::position)[2 * row + 1]} * 0.1F +
             Vec2{told[0], told[1]};
    }
    const Vec2 way = norm(sum) > 0.0F ? unit(sum) * 0.1F : sum;
    at.of<float>(Field::velocity)[3 * i] = way.x;
    at.of<float>(Field::velocity)[3 * i + 2] = 5.0F * way.y;
    const float said[2] = {way.x, way.y};
    std::memcpy(at.of<std::uint8_t>(Field::broadcast) + i * shape.payload, said, sizeof said);
    at.of<std::int32_t>(Field::parent)[i] = static_cast<std::int32_t>(i) - 1;
  }
}

struct Ruled final : Mind {
  void decide(const std::shared_ptr<Block>& block) override { rule(*block, 0); }
  [[nodiscard]] std::unique_ptr<Mind> clone() const override { return std::make_unique<Ruled>(); }
};

Outside described() {
  Outside outside;
  outside.name = "ruled";
  outside.neighbours = 5;
  outside.payload = 2 * sizeof(float);
  return outside;
}
Outside with_mind() {
  Outside outside = described();
  outside.mind = [](const Setup&, std::span<const Member>, const std::shared_ptr<Block>&) {
    return std::make_unique<Ruled>();
  };
  return outside;
}

world::Scenario scenario(std::uint64_t seed = 1) {
  world::Scenario s;
  s.seed = seed;
  s.swarm.robots = 40;
  s.radio.loss = 0.2;
  return s;
}

TEST(OutsideSwarm, BetweenTicksIsAsWithinThem) {
  const OutsideAlgorithm within(with_mind());
  const auto block = std::make_shared<Block>(Shape{40, 5, 2 * sizeof(float)}, 3);
  for (std::size_t place = 0; place < 3; ++place) {
    Outside outside = described();
    outside.block = block;
    outside.place = place;
    const OutsideAlgorithm between(outside);
    world::World a(scenario(place), within), b(scenario(place), between);
    for (int tick = 0; tick < 40; ++tick) {
      a.step();
      b.step();
      rule(*block, place);
      block->decided(place) = 1;
      b.decide();
      ASSERT_EQ(a.hash(), b.hash()) << place << ", " << tick;
    }
    EXPECT_EQ(a.reports()[7].parent, 6);
    EXPECT_GT(distance(a.positions()[0], world::World(scenario(place), within).positions()[0]), 0.01);
  }
}

TEST(OutsideSwarm, AnyTeamGivesTheSameBits) {
  const OutsideAlgorithm algorithm(with_mind());
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4}) {
    world::Executor team(threads);
    world::World w(scenario(), algorithm);
    for (int tick = 0; tick < 30; ++tick) w.step(team);
    hashes.push_back(w.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(OutsideSwarm, CopiesGoOnAlikeAndApart) {
  const OutsideAlgorithm algorithm(with_mind());
  world::World w(scenario(), algorithm);
  for (int tick = 0; tick < 10; ++tick) w.step();
  world::World twin = w;
  const std::uint64_t before = twin.hash();
  for (int tick = 0; tick < 10; ++tick) w.step();
  EXPECT_EQ(twin.hash(), before);
  for (int tick = 0; tick < 10; ++tick) twin.step();
  EXPECT_EQ(twin.hash(), w.hash());
}

TEST(OutsideSwarm, NonsenseStandsStill) {
  auto block = std::make_shared<Block>(Shape{40, 5, 0});
  Outside outside = described();
  outside.payload = 0;
  outside.block = block;
  const OutsideAlgorithm algorithm(outside);
  world::World w(scenario(), algorithm);
  w.step();
  const world::Vec2 before = w.positions()[3];
  const Exchange at = block->exchange(0);
  std::fill_n(at.of<float>(Field::velocity), 120, std::numeric_limits<float>::quiet_NaN());
  std::fill_n(at.of<std::int32_t>(Field::parent), 40, 1000);
  std::fill_n(at.of<std::int8_t>(Field::role), 40, std::int8_t{77});
  block->decided(0) = 1;
  w.decide();
  w.step();
  EXPECT_EQ(w.positions()[3].x, before.x);
  EXPECT_EQ(w.reports()[3].parent, nobody);
  EXPECT_LE(w.reports()[3].role, Role::root);
}

TEST(Block, FieldsLieApartAndAreBlank) {
  Block block(Shape{3, 2, 5}, 2);
  std::size_t names = 0;
  for (const FieldInfoOf& info : fields()) {
    EXPECT_EQ(static_cast<std::size_t>(info.field), names++) << info.name;  // in the order of Field
    std::memset(block.exchange(1).of<std::byte>(info.field), static_cast<int>(names),
                block.bytes_per_swarm(info.field));
  }
  for (const FieldInfoOf& info : fields())
    for (std::size_t k = 0; k < block.bytes_per_swarm(info.field); ++k)
      EXPECT_EQ(block.exchange(1).of<std::uint8_t>(info.field)[k], static_cast<std::size_t>(info.field) + 1)
          << info.name;
  EXPECT_EQ(block.exchange(0).of<std::int32_t>(Field::sender)[5], -1);
  EXPECT_EQ(block.exchange(0).of<std::int32_t>(Field::serves)[2], -2);
  EXPECT_EQ(block.exchange(0).of<std::int32_t>(Field::heard)[2], 0);
  EXPECT_EQ(length(FieldAxis::payload, block.shape()), 5U);
}

}  // namespace
}  // namespace banyan::python

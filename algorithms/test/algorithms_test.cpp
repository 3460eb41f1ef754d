// SPDX-License-Identifier: MIT
// Algorithms as a host meets them: by name, with a table of parameters, defaults and faults.
#include "banyan/algorithms/algorithms.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>

#include "banyan/algorithms/inside.hpp"

namespace banyan {
namespace {

float value_of(const Algorithm& algorithm, const Setup& setup, std::string_view key) {
  const auto rows = algorithm.parameters();
  const auto values = algorithm.values(setup);
  EXPECT_EQ(rows.size(), values.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k]->key == key) return values[k];
  ADD_FAILURE() << key;
  return 0.0F;
}

TEST(Algorithms, AreFoundByName) {
  for (const Algorithm* algorithm : algorithms()) {
    EXPECT_EQ(algorithms().find(algorithm->name()), algorithm);
    EXPECT_FALSE(algorithm->summary().empty());
    EXPECT_EQ(algorithm->fault({}), "");
  }
  EXPECT_EQ(algorithms().find("sideways"), nullptr);
  EXPECT_EQ(AlgorithmList({&outwards()}).find("inwards"), nullptr);
}

TEST(Algorithms, TheUsualOneIsTheFirstUnlessTheListSaysOtherwise) {
  EXPECT_EQ(algorithms().usual(), "convoy");
  EXPECT_EQ(AlgorithmList({&outwards(), &inwards()}).usual(), "outwards");
  EXPECT_EQ(AlgorithmList({&outwards(), &inwards()}, "inwards").usual(), "inwards");
  EXPECT_EQ(AlgorithmList({}).usual(), "");
}

TEST(Algorithms, TheTableHasEveryKeyOnce) {
  std::set<std::string_view> keys;
  for (const ParameterInfo& row : algorithms().parameters()) EXPECT_TRUE(keys.insert(row.key).second) << row.key;
  for (const Algorithm* algorithm : algorithms())
    for (const ParameterInfo* row : algorithm->parameters()) EXPECT_EQ(keys.count(row->key), 1U) << row->key;
}

TEST(Algorithms, EveryParameterIsCheckedAgainstItsRange) {
  for (const Algorithm* algorithm : algorithms()) {
    const auto rows = algorithm->parameters();
    const auto defaults = algorithm->values({});
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const ParameterInfo& row = *rows[k];
      EXPECT_GE(defaults[k], row.minimum) << row.key;
      EXPECT_LE(defaults[k], row.maximum) << row.key;
      for (const float bad : {row.minimum - 1.0F, row.maximum * 2.0F, std::numeric_limits<float>::quiet_NaN()}) {
        banyan::Setup setup;
        setup.parameters = {{std::string(row.key), static_cast<double>(bad)}};
        EXPECT_NE(algorithm->fault(setup), "") << row.key << " = " << bad;
      }
    }
  }
}

TEST(Algorithms, ValuesOfTheSetupCountAndUnknownKeysDoNot) {
  banyan::Setup setup;
  setup.parameters = {{"target_gain", 0.25}, {"nonsense", 7.0}};
  setup.arrival_distance_m = 0.3;
  for (const Algorithm* algorithm : algorithms()) {
    EXPECT_EQ(value_of(*algorithm, setup, "target_gain"), 0.25F);
    EXPECT_EQ(value_of(*algorithm, setup, "arrival_distance_m"), 0.3F);
    EXPECT_EQ(algorithm->fault(setup), "");
  }
}

TEST(Algorithms, TableIsLengthsAreAbsoluteAndConvoysGrowWithTheRadio) {
  banyan::Setup wide;
  wide.platform.communication_range_m = 4.0F;
  EXPECT_FLOAT_EQ(value_of(outwards(), wide, "ideal_distance_m"), 1.90F);
  EXPECT_FLOAT_EQ(value_of(inwards(), wide, "ideal_distance_m"), 1.540841F);
  EXPECT_FLOAT_EQ(value_of(convoy(), wide, "ideal_distance_m"), 3.80F);
  EXPECT_FLOAT_EQ(value_of(convoy(), wide, "communication_range_m"), 4.0F);
}

// What a swarm is given: metres, whatever the unit of the table.
TEST(Algorithms, LengthsInUnitsOfTheRadiosRangeAreResolvedToMetres) {
  banyan::Setup setup;
  setup.platform.communication_range_m = 3.0F;
  setup.parameters = {{"clearance", 0.11}};
  EXPECT_EQ(value_of(convoy(), setup, "clearance"), 0.11F) << "as the table has it";
  EXPECT_EQ(value_of(convoy(), setup, "corridor_width"), 0.35F);
  const auto swarm = convoy().make(setup, std::array<Member, 1>{{{.id = 0, .worker = false, .root = true}}});
  const ConvoyParams& params = swarm_as<ConvoySwarm>(*swarm).params();
  EXPECT_EQ(params.clearance_m, 0.11F * 3.0F);
  EXPECT_EQ(params.corridor_width_m, 0.35F * 3.0F);
  EXPECT_EQ(params.claim_radius_m, 0.45F * 3.0F);
  EXPECT_FLOAT_EQ(params.ideal_distance_m, 2.85F) << "grows with the range, once";
  setup.parameters = {{"pull_start", 0.96}};  // delta is 0.95 C
  EXPECT_NE(convoy().fault(setup), "");
}

// Bodies do not shrink with the radio: how far to keep from them follows C only upwards from where C is 2 m.
TEST(Algorithms, RoomForBodiesDoesNotShrinkWithTheRadio) {
  const auto params = [](float range_m, float wheels) {
    banyan::Setup setup;
    setup.platform.communication_range_m = range_m;
    setup.platform.wheel_distance_m *= wheels;
    const auto swarm = convoy().make(setup, std::array<Member, 1>{{{.id = 0, .worker = false, .root = true}}});
    return swarm_as<ConvoySwarm>(*swarm).params();
  };
  const float clearance_m = params(2.0F, 1.0F).clearance_m;
  EXPECT_FLOAT_EQ(params(0.6F, 1.0F).clearance_m, clearance_m);
  EXPECT_FLOAT_EQ(params(4.0F, 1.0F).clearance_m, 2.0F * clearance_m);
  EXPECT_FLOAT_EQ(params(1.0F, 0.5F).clearance_m, 0.5F * clearance_m) << "everything half as large";
  EXPECT_FLOAT_EQ(params(0.6F, 1.0F).spare_avoidance_m, params(2.0F, 1.0F).spare_avoidance_m);
  EXPECT_FLOAT_EQ(params(0.6F, 1.0F).corridor_width_m, 0.3F * params(2.0F, 1.0F).corridor_width_m)
      << "a width of the chain's";
}

TEST(Algorithms, ConvoyRefusesARadioThatReachesHardlyBeyondABody) {
  banyan::Setup setup;
  setup.platform.communication_range_m = 0.47F;
  EXPECT_NE(convoy().fault(setup).find("distance between the wheels"), std::string::npos);
  setup.platform.communication_range_m = 0.48F;
  EXPECT_EQ(convoy().fault(setup), "");
}

TEST(Algorithms, TheScaleOfAMissionActsOnTheLengthsOfTableI) {
  banyan::Setup half;
  half.scale = 0.5;
  EXPECT_FLOAT_EQ(value_of(outwards(), half, "ideal_distance_m"), 0.95F);
  EXPECT_FLOAT_EQ(value_of(outwards(), half, "insertion_distance_m"), 0.04895F);
  EXPECT_FLOAT_EQ(value_of(outwards(), half, "parent_margin_m"), 0.02F) << "no row of Table I";
  EXPECT_FLOAT_EQ(value_of(outwards(), half, "target_gain"), 0.49F) << "no length";
}

TEST(Algorithms, DistancesOutOfOrderAreAFault) {
  banyan::Setup setup;
  setup.parameters = {{"safe_range_m", 1.95}};
  for (const Algorithm* algorithm : {&outwards(), &inwards()})
    EXPECT_NE(algorithm->fault(setup).find("safe_range_m"), std::string::npos);
}

}  // namespace
}  // namespace banyan

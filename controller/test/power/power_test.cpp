// SPDX-License-Identifier: MIT
// Batteries as robots know them: what passes the gate, what is sent, and that a swarm without them says nothing of them.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <limits>
#include <vector>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/power/power.hpp"

namespace banyan {
namespace {

PoweredConvoyMessage arbitrary_powered() {
  PoweredConvoyMessage m;
  m.id = *rc::gen::inRange<RobotId>(0, nobody);
  m.leaving = *rc::gen::arbitrary<bool>();
  m.in_place = *rc::gen::arbitrary<bool>();
  m.level = *rc::gen::arbitrary<std::uint8_t>();
  m.place_hops = *rc::gen::arbitrary<std::uint8_t>();
  m.relieves = *rc::gen::arbitrary<RobotId>();
  m.heir = *rc::gen::arbitrary<RobotId>();
  m.warned = *rc::gen::arbitrary<RobotId>();
  return m;
}

TEST(Power, AMessageTravelsAndTakesNoMoreThanSixteenBytes) {
  static_assert(wire_size<PoweredConvoyMessage>() <= wire_size<ConvoyMessage>() + 16);
  static_assert(wire_size<PoweredConvoyMessage>() <= largest_wire);
  EXPECT_TRUE(rc::check([] {
    const PoweredConvoyMessage m = arbitrary_powered();
    std::array<std::uint8_t, wire_size<PoweredConvoyMessage>()> bytes{};
    RC_ASSERT(encode_fields(m, bytes) == bytes.size());
    RC_ASSERT(decode_fields<PoweredConvoyMessage>(bytes) == m);
  }));
}

TEST(Power, RobotsWithAndWithoutBatteriesDoNotTakeEachOthersMessages) {
  std::array<std::uint8_t, wire_size<PoweredConvoyMessage>()> powered{};
  PoweredConvoyMessage m;
  m.id = 3;
  encode_fields(m, powered);
  EXPECT_EQ(powered[0] & 0x0F, further_wire_version);
  EXPECT_EQ(powered[1], block::power);
  EXPECT_FALSE(decode_fields<ConvoyMessage>(powered).has_value());
  EXPECT_FALSE(decode_fields<ConvoyMessage>(std::span(powered).first(wire_size<ConvoyMessage>())).has_value());
  powered[1] = 0;  // no blocks
  EXPECT_FALSE(decode_fields<PoweredConvoyMessage>(powered).has_value());
  powered[1] = block::power | 2;  // an unknown one
  EXPECT_FALSE(decode_fields<PoweredConvoyMessage>(powered).has_value());
}

TEST(Power, AChargeThatCannotBeDoesNotPassTheGate) {
  for (const float level : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.01F, 1.01F}) {
    Senses senses;
    senses.charge = Charge{level, true};
    const Gate gate(senses, Platform{});
    EXPECT_FALSE(gate.senses().charge.has_value()) << level;
    EXPECT_EQ(gate.rejected(), 1U);
  }
  Senses senses;
  senses.charge = Charge{0.5F, true};
  const Gate gate(senses, Platform{});
  EXPECT_EQ(gate.senses().charge->level, 0.5F);
  EXPECT_EQ(gate.rejected(), 0U);
}

// A lone robot of that role with this much charge.
struct LoneRobot {
  ConvoyParams params = convoy_defaults();
  PoweredConvoyState state;
  explicit LoneRobot(bool worker, bool root) { static_cast<ConvoyState&>(state) = initial_convoy_state(1, worker, root); }
  PoweredConvoyMessage step(float level, bool charging = false) {
    Senses senses;
    senses.charge = Charge{level, charging};
    std::vector<Heard> heard;
    return powered_convoy_step(params, state, heard, senses).message;
  }
};

TEST(Power, ARobotOfTheTreeAsksToBeRelievedWhenItRunsLowAndASpareSeeksAPlace) {
  LoneRobot root(false, true);
  EXPECT_FALSE(root.step(0.9F).leaving);
  for (int t = 0; t < 60; ++t) root.step(0.2F);
  EXPECT_TRUE(root.step(0.2F).leaving);
  EXPECT_TRUE(powered_report(root.state).leaves);
  // Charged where it stands, it stays.
  for (int t = 0; t < 100; ++t) root.step(1.0F, true);
  EXPECT_FALSE(root.step(1.0F, true).leaving);

  LoneRobot spare(false, false);
  for (int t = 0; t < 60; ++t) spare.step(0.2F);
  EXPECT_FALSE(spare.step(0.2F).leaving);
  EXPECT_TRUE(powered_report(spare.state).seeks_charge);
}

TEST(Power, WithoutAMeasuredChargeNothingIsDecided) {
  LoneRobot root(false, true);
  std::vector<Heard> heard;
  PoweredConvoyMessage said;
  for (int t = 0; t < 50; ++t) said = powered_convoy_step(root.params, root.state, heard, Senses{}).message;
  EXPECT_FALSE(said.leaving);
  EXPECT_EQ(said.level, 0xFF);
}

TEST(Power, ThresholdsThatContradictEachOtherAreFaults) {
  ConvoyParams p = convoy_defaults();
  EXPECT_EQ(convoy_fault(p), "");
  p.relieve_below = p.ready_above;
  EXPECT_NE(convoy_fault(p).find("relieve_below"), std::string_view::npos);
  p = convoy_defaults();
  p.charge_below = p.ready_above - 0.1F;
  EXPECT_NE(convoy_fault(p).find("charge_below"), std::string_view::npos);
}

}  // namespace
}  // namespace banyan

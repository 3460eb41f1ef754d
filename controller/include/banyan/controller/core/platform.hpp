// SPDX-License-Identifier: MIT
// What a host knows of its robots, and what is left of that behind the gate (gate.hpp). An algorithm has no metre, no
// second and no m/s: its lengths are in C, the radio range, its speeds in v_max, the wheels' limit, and its times are
// rounds, one per control period, or drives, C / v_max each: the one is what communication takes, the other what motion
// takes. So a swarm of Kilobots and one of drones are the same problem with two other numbers (docs/architecture.md).
#pragma once

#include <string_view>

namespace banyan {

// What the wheels allow. A holonomic robot moves in any direction without turning.
enum class Drive : unsigned char { differential, holonomic };

struct Platform {
  float communication_range_m = 2.0F;  // C
  float tick_s = 0.1F;                 // control period
  float wheel_limit_m_s = 0.2F;        // v_max: largest speed of a wheel, or of a holonomic base
  float wheel_distance_m = 0.1054F;    // between the wheels
  float body_radius_m = 0.0704F;       // Khepera IV
  bool line_of_sight = true;           // the radio does not go through obstacles and bodies
  Drive drive = Drive::differential;
  bool battery = false;  // it may run down; Senses::charge says how far
};

// A platform as an algorithm sees it. The defaults are those of Platform.
struct Machine {
  float rounds_per_drive = 100.0F;
  float body_radius = 0.0352F;     // C
  float wheel_distance = 0.0527F;  // C
  bool line_of_sight = true;
  Drive drive = Drive::differential;
  bool battery = false;

  // How far a robot drives in a round at most, C.
  [[nodiscard]] float way_in_a_round() const noexcept { return 1.0F / rounds_per_drive; }
  // The nearest number of whole rounds. In fifty places the product would take more of a robot's memory than a call.
  [[nodiscard, gnu::noinline]] int rounds(float drives) const noexcept {
    return static_cast<int>(drives * rounds_per_drive + 0.5F);
  }
};

// A parameter in rounds, as it is counted.
[[nodiscard]] constexpr int whole(float rounds) noexcept { return static_cast<int>(rounds + 0.5F); }

[[nodiscard]] constexpr Machine machine_of(const Platform& platform) noexcept {
  const float per_metre = 1.0F / platform.communication_range_m;
  return {.rounds_per_drive = platform.communication_range_m / (platform.wheel_limit_m_s * platform.tick_s),
          .body_radius = platform.body_radius_m * per_metre,
          .wheel_distance = platform.wheel_distance_m * per_metre,
          .line_of_sight = platform.line_of_sight,
          .drive = platform.drive,
          .battery = platform.battery};
}

// What algorithms are made for, and tested with: bodies that the radio range has room for, and robots neither so fast
// that a neighbour is gone before it is heard twice nor so slow that counts of rounds overflow.
inline constexpr float least_rounds_per_drive = 25.0F;
inline constexpr float most_rounds_per_drive = 2000.0F;
inline constexpr float least_body_radius = 0.001F;  // C
inline constexpr float most_body_radius = 0.17F;
inline constexpr float farthest_target = 200.0F;  // C, from where the swarm starts

// What is outside, in words; nothing if all is well.
[[nodiscard]] constexpr std::string_view machine_fault(const Machine& machine) noexcept {
  constexpr float rounding = 1e-4F;
  const float rounds = machine.rounds_per_drive;
  if (!(rounds >= least_rounds_per_drive * (1.0F - rounding) && rounds <= most_rounds_per_drive * (1.0F + rounding)))
    return "the radio range C divided by the wheels' limit must be 25 to 2,000 control periods: neighbours would be "
           "gone before they are heard twice, or get nowhere";
  const float radius = machine.body_radius;
  if (!(radius >= least_body_radius * (1.0F - rounding) && radius <= most_body_radius * (1.0F + rounding)))
    return "the body's radius must be 0.001 to 0.17 of the radio range C: larger bodies block each other's way";
  return {};
}

}  // namespace banyan

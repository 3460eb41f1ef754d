// SPDX-License-Identifier: MIT
// The command line of banyan-robot, read and written: the hub prints it, the fleet starts robots with it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/hosts/udp/option_error.hpp"

namespace banyan::udp {

struct RobotOptions {
  RobotId id = nobody;
  std::string hub;     // ADDRESS:PORT; "": there is none, it has peers
  std::string peers;   // ADDRESS:PORT[,ADDRESS:PORT...] of the other robots, or a broadcast address
  std::string listen;  // ADDRESS:PORT where its peers find it
  std::string tell;    // ADDRESS:PORT of who listens (banyan listen); "": nobody
  bool root = false;   // without a hub: how it begins
  bool worker = false;
  std::string key_file;
  std::string algorithm = "convoy";
  Setup setup;
  std::size_t max_payload = 0;  // bytes of a message that its radio carries; 0: any
  std::string base;             // "": simulated wheels; tcp:ADDRESS:PORT, a serial device or mavlink:... of these
  double proximity_m = 0.0;     // as far as a base sees obstacles; 0: any distance
  double stop_after_s = 0.5;    // without a frame from the hub; without a hub, without a pose of its base
  double delay_s = 0.0;         // from a measurement of the tracker to its arrival here; with a base only
  double speed = 1.0;           // of its clock
  // With an autopilot as its base (mavlink_base.hpp):
  int system = 0;          // its MAVLink system id; 0: id + 1
  double height_m = -1.0;  // to be kept; negative: not given
  std::string home;        // where its local frame begins
  std::string poses;       // ADDRESS:PORT of the hub's --poses, to be told where it is
  [[nodiscard]] std::uint8_t mavlink_system() const noexcept {
    return static_cast<std::uint8_t>(system > 0 ? system : id + 1);
  }
};

[[nodiscard]] std::string robot_usage();
// Throws OptionError, also for values that are out of range or missing.
[[nodiscard]] RobotOptions parse_robot_options(std::span<const std::string> arguments);
// The arguments that stand for these options; what is as by default is left out.
[[nodiscard]] std::vector<std::string> to_arguments(const RobotOptions& wanted);

}  // namespace banyan::udp

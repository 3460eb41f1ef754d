// SPDX-License-Identifier: MIT
// A base that is a vehicle with an autopilot, over MAVLink. Set-points go out at least five times a second, and end
// with the process. It can be the hub's tracker of its own vehicle, too.
#pragma once

#include <memory>

#include "banyan/hosts/udp/autopilot.hpp"
#include "banyan/hosts/udp/driver.hpp"
#include "banyan/hosts/udp/robot_options.hpp"

namespace banyan::udp {

// Whether --base names an autopilot: "mavlink:udp:ADDRESS:PORT", where the vehicle's packets arrive;
// "mavlink:tcp:ADDRESS:PORT"; or "mavlink:DEVICE", a serial device, also "mavlink:DEVICE@BAUD".
[[nodiscard]] bool is_mavlink(const std::string& base) noexcept;

// What --home says for that robot: "tracker"; LATITUDE,LONGITUDE of the scenario's origin, in degrees; or a file with a
// line `ROBOT EAST NORTH` for each robot, in m, and comments after #. Throws BaseError.
[[nodiscard]] AutopilotSetup autopilot_setup(const RobotOptions& options);

// Throws BaseError and SocketError.
[[nodiscard]] std::unique_ptr<Driver> open_mavlink_base(const RobotOptions& options);

}  // namespace banyan::udp

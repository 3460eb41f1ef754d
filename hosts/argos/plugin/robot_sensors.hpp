// SPDX-License-Identifier: MIT
// Sensors that every kind of robot has under a name and a type of its own. Those of a plugin whose headers were not
// there when this was built are unknown.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>

#include <functional>
#include <optional>

#include "banyan/hosts/argos/robot.hpp"

namespace banyan::argos {

// Shows a robot what the proximity sensor of `controller` sees; none if it has none.
[[nodiscard]] std::function<void(ArgosRobot&)> eyes_of(::argos::CCI_Controller& controller);
// Where its light sensor sees the only light; none if it has none. `intensity_m` is looked at in every call.
[[nodiscard]] std::function<std::optional<Vec2>()> light_of(::argos::CCI_Controller& controller,
                                                            const double& intensity_m);

}  // namespace banyan::argos

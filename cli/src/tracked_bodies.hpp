// SPDX-License-Identifier: MIT
// Bodies of real robots in a world: where they are, a tracker says.
#pragma once

#include <memory>

#include "banyan/hosts/udp/pose_stream.hpp"
#include "banyan/world/bodies.hpp"

namespace banyan::cli {

// In each tick robots are where they were seen last; commands move them outside. `stream` must outlive them.
[[nodiscard]] std::unique_ptr<world::Bodies> tracked_bodies(const udp::PoseStream& stream);

// The scenario with robots that start where they are. Each of them must have been seen.
[[nodiscard]] world::Scenario started_where_seen(world::Scenario scenario, const udp::PoseStream& stream);

}  // namespace banyan::cli

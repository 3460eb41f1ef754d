// SPDX-License-Identifier: MIT
// Bodies of real robots in a world: where they are, a tracker says, or they themselves.
#pragma once

#include <memory>

#include "banyan/hosts/udp/pose_stream.hpp"
#include "banyan/world/bodies.hpp"

namespace banyan::cli {

// Of a tracker or a chart, which renews them in place.
using SeenPoses = std::span<const std::optional<udp::TrackedPose>>;

// In each tick robots are where they were seen last; commands move them outside. What `seen` refers to must outlive
// them.
[[nodiscard]] std::unique_ptr<world::Bodies> tracked_bodies(SeenPoses seen);

// The scenario with robots that start where they are. Of `seen`, each must have been.
[[nodiscard]] world::Scenario started_where_seen(world::Scenario scenario, SeenPoses seen);

}  // namespace banyan::cli

// SPDX-License-Identifier: MIT
// A frame as foxglove.SceneUpdate: what the 3D panels of Foxglove and Lichtblick show.
#pragma once

#include "banyan/record/frame.hpp"
#include "text.hpp"

namespace banyan::record {

// Every message is complete (obstacles too), so a viewer may jump to any of them.
void write_scene(Text& out, const Setting& setting, const Frame& frame);

}  // namespace banyan::record

// SPDX-License-Identifier: MIT
// Draws what ARGoS' own view does not show: roles as coloured discs, the edges of the tree, targets. The colours of all
// of Banyan's pictures. Only built where ARGoS was built with Qt.
#pragma once

#include "loop_functions.hpp"

// After ours: Qt makes a macro of the word slots.
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

namespace banyan::argos {

class TreeView final : public ::argos::CQTOpenGLUserFunctions {
 public:
  void Init(::argos::TConfigurationNode& node) override;
  void DrawInWorld() override;

 private:
  void draw_edge(const world::World& world, std::size_t from, RobotId to, const ::argos::CColor& color);

  const LoopFunctions* loop_functions_ = nullptr;
};

}  // namespace banyan::argos

// SPDX-License-Identifier: MIT
#include "view.hpp"

#include <argos3/core/simulator/simulator.h>

#include "banyan/record/palette.hpp"

namespace banyan::argos {

using namespace ::argos;

namespace {

constexpr double floor_m = 0.005, roof_m = 0.07;  // above the ground, so that nothing flickers; above the robots

CColor color(const record::Color& c) { return CColor(c.red, c.green, c.blue); }
CVector3 at(world::Vec2 p, double z_m) { return CVector3(p.x, p.y, z_m); }

}  // namespace

void TreeView::Init(TConfigurationNode& /*node*/) {
  loop_functions_ = dynamic_cast<const LoopFunctions*>(&CSimulator::GetInstance().GetLoopFunctions());
  if (loop_functions_ == nullptr)
    THROW_ARGOSEXCEPTION(
        "banyan_qt_user_functions draw a mission of banyan_loop_functions, but this experiment has other loop "
        "functions");
}

void TreeView::draw_edge(const world::World& world, std::size_t from, RobotId to, const CColor& edge) {
  if (to >= world.size()) return;
  DrawRay(CRay3(at(world.positions()[from], roof_m), at(world.positions()[to], roof_m)), edge, 3.0F);
}

void TreeView::DrawInWorld() {
  const world::World& world = loop_functions_->mission()->world();
  const double radius_m = world.scenario().robot.radius_m;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Report& report = world.reports()[i];
    const bool lives = world.alive()[i] != 0;
    DrawCircle(at(world.positions()[i], roof_m), CQuaternion(), radius_m, color(record::color_of(report.role, lives)),
               true, 24);
    if (!lives || report.role == Role::spare) continue;
    draw_edge(world, i, report.old_parent, color(record::palette::old_tree));
    draw_edge(world, i, report.parent, color(record::palette::tree));
    for (const RobotId other : report.kept) draw_edge(world, i, other, color(record::palette::tree));
  }
  for (const world::Target& target : world.targets())
    if (target.active)
      DrawCircle(at(target.position, floor_m), CQuaternion(), world::target_tolerance_m(world.scenario()),
                 color(record::palette::target), true, 32);
}

}  // namespace banyan::argos

using BanyanQtUserFunctions = banyan::argos::TreeView;
REGISTER_QTOPENGL_USER_FUNCTIONS(BanyanQtUserFunctions, "banyan_qt_user_functions")

// SPDX-License-Identifier: MIT
// Rigid discs with mass, inertia, friction and bounded motors, by Debian's Box2D 2.4.1: the check
// that results of `disks` are realistic. Numbers as in ARGoS for a Khepera IV: 0.4 kg, 1.5 N,
// 1.5 Nm, friction 0.7, no restitution, and the inertia of a disc of twice the body's radius.
//
// A Box2D world remembers the order in which contacts began and their impulses, and cannot be
// copied. So it is rebuilt every tick from poses and velocities, which are then its whole state: a
// clone continues bit by bit like its original. That costs 5 % of a tick with 94 robots and 12 %
// with 1,000. The price: the impulses of lasting contacts are found again in the first sub-step of
// each tick instead of being carried over.
//
// Lengths are scaled by 8 inside: Box2D keeps a slop of 5 mm and a skin of 10 mm, which would
// show on a robot of 70 mm. A power of two, so that poses are converted without rounding. These
// metres stay, and so do masses, forces and the length of a sub-step: a world with this body has a scale.
#include <box2d/box2d.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/wheels.hpp"

namespace banyan::world {
namespace {

constexpr double scale = 8.0;
constexpr float friction = 0.7F;
constexpr double longest_substep_s = 0.01;
constexpr int velocity_iterations = 10;
constexpr int position_iterations = 4;

b2Vec2 to_box2d(Vec2 v) noexcept { return {static_cast<float>(v.x * scale), static_cast<float>(v.y * scale)}; }
Vec2 from_box2d(b2Vec2 v) noexcept { return {static_cast<double>(v.x) / scale, static_cast<double>(v.y) / scale}; }

struct AddFixture {
  b2Body& ground;
  void fix(const b2Shape& shape) const {
    b2FixtureDef def;
    def.shape = &shape;
    def.friction = friction;
    ground.CreateFixture(&def);
  }
  void operator()(const Disc& disc) const {
    b2CircleShape shape;
    shape.m_p = to_box2d(disc.center);
    shape.m_radius = static_cast<float>(disc.radius_m * scale);
    fix(shape);
  }
  void operator()(const Box& box) const {
    const Vec2 turn = unit_vector(box.angle_rad);  // b2Rot would ask the C library for a sine
    const Vec2 half = box.size * 0.5;
    b2Vec2 corners[4];
    const Vec2 signs[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; ++k)
      corners[k] = to_box2d(box.center + rotate(turn, Vec2{signs[k].x * half.x, signs[k].y * half.y}));
    b2PolygonShape shape;
    shape.Set(corners, 4);
    fix(shape);
  }
  void operator()(const Wall& wall) const {
    b2EdgeShape shape;
    shape.SetTwoSided(to_box2d(wall.from), to_box2d(wall.to));
    fix(shape);
  }
  void operator()(const FloorMap& /*map*/) const {}  // only what is near robots: Outline
};

// The edge of a map's occupied area near robots, as straight pieces as long as they are there: a robot that slides
// along a wall would catch on seams.
class Outline {
 public:
  explicit Outline(const CellGrid& cells) : cells_{cells} {}
  // Everything no farther from p than `reach`, in cells.
  void add_near(Vec2 p, double reach) {
    if (cells_.least_clearance(p) > reach) return;
    const auto from = [reach](double x) { return static_cast<std::int64_t>(std::floor(x - reach)); };
    const auto to = [reach](double x) { return static_cast<std::int64_t>(std::floor(x + reach)); };
    for (std::int64_t row = from(p.y); row <= to(p.y); ++row)
      for (std::int64_t column = from(p.x); column <= to(p.x); ++column) {
        const bool here = cells_.occupied(column, row);
        if (here != cells_.occupied(column - 1, row)) sides_.push_back({true, column, row});
        if (here != cells_.occupied(column, row - 1)) sides_.push_back({false, row, column});
      }
  }
  // piece(from, to) for each, in cells.
  template <class Piece> void each_piece(const Piece& piece) {
    std::sort(sides_.begin(), sides_.end());
    sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
    for (std::size_t first = 0, next = 0; first < sides_.size(); first = next) {
      const auto [upright, line, begin] = sides_[first];
      std::int64_t end = begin;
      for (next = first; next < sides_.size() && sides_[next] == Side{upright, line, end}; ++next) ++end;
      const auto across = static_cast<double>(line), a = static_cast<double>(begin), b = static_cast<double>(end);
      if (upright) piece(Vec2{across, a}, Vec2{across, b});
      else piece(Vec2{a, across}, Vec2{b, across});
    }
  }

 private:
  // Of a cell: upright or level, on which line, and where along it.
  using Side = std::tuple<bool, std::int64_t, std::int64_t>;
  const CellGrid& cells_;
  std::vector<Side> sides_;
};

// Beside the poses: velocities, in Box2D's units. The heading is a unit vector carried by turn
// steps; Box2D's own angle stays zero at the start of a tick and is never read, because a disc
// looks the same from all sides.
struct Momentum {
  b2Vec2 linear{0.0F, 0.0F};
  float angular = 0.0F;
};

class Box2d final : public Bodies {
 public:
  Box2d(const Scenario& scenario, std::size_t robots)
      : robot_{scenario.robot},
        wheel_distance_m_{wheel_distance_m(scenario)},
        obstacles_{scenario.obstacles},
        seed_{scenario.seed},
        momentum_(robots),
        body_(robots),
        path_(robots),
        gone_(robots, 0) {
    substeps_ = std::max(1, static_cast<int>(std::ceil(scenario.tick_s / longest_substep_s - 1e-9)));
    h_ = scenario.tick_s / substeps_;
    mass_.mass = static_cast<float>(robot_.mass_kg);
    mass_.center = {0.0F, 0.0F};
    mass_.I = static_cast<float>(2.0 * robot_.mass_kg * robot_.radius_m * robot_.radius_m * scale * scale);
    force_step_ = static_cast<float>(robot_.max_force_n * scale * h_);
    torque_step_ = static_cast<float>(robot_.max_torque_nm * scale * scale * h_);
  }

  [[nodiscard]] std::unique_ptr<Bodies> clone() const override { return std::make_unique<Box2d>(*this); }

  void step(std::span<const Velocity> command, NearPairs, std::uint64_t tick, Poses& poses,
            std::span<Odometry> odometry) override {
    b2World world({0.0F, 0.0F});
    build(world, poses);
    const std::span<Path> path(path_);
    for (std::size_t i = 0; i < path.size(); ++i)
      path[i] = {wheel_twist(robot_, wheel_distance_m_, command[i], seed_, i, tick)};
    for (int s = 0; s < substeps_; ++s) {
      for (std::size_t i = 0; i < path.size(); ++i)
        if (gone_[i] == 0) drive(*body_[i], path[i].wheels, poses.heading[i]);
      world.Step(static_cast<float>(h_), velocity_iterations, position_iterations);
      for (std::size_t i = 0; i < path.size(); ++i)
        if (gone_[i] == 0) roll(*body_[i], path[i], poses.heading[i]);
    }
    for (std::size_t i = 0; i < path.size(); ++i) {
      odometry[i] = {};
      if (gone_[i] != 0) continue;
      poses.position[i] = from_box2d(body_[i]->GetPosition());
      momentum_[i] = {body_[i]->GetLinearVelocity(), body_[i]->GetAngularVelocity()};
      odometry[i] = measured_odometry(robot_, path[i].shift_m, path[i].turn_rad, seed_, i, tick);
    }
  }

  void remove(std::size_t i) override { gone_[i] = 1; }
  void arrive(std::size_t i) override {
    gone_[i] = 0;
    momentum_[i] = {};
  }

  void set_obstacles(std::span<const Obstacle> obstacles) override {
    obstacles_.assign(obstacles.begin(), obstacles.end());
  }

  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override {
    const auto add = [&h](float x) { h = mix(h ^ std::bit_cast<std::uint32_t>(x)); };
    for (const Momentum& m : momentum_) {
      add(m.linear.x);
      add(m.linear.y);
      add(m.angular);
    }
    return h;
  }

 private:
  // The commands of a robot's wheels, and how far they have rolled within this tick, in the body
  // frame of its start.
  struct Path {
    Twist wheels;
    Vec2 shift_m{};
    Vec2 rotation{1.0, 0.0};
    double turn_rad = 0.0;
  };

  void build(b2World& world, const Poses& poses) {
    world.SetAllowSleeping(false);
    world.SetContinuousPhysics(false);  // 2 mm a sub-step cannot jump over anything
    b2BodyDef ground;
    for (const Obstacle& obstacle : obstacles_) {
      b2Body& body = *world.CreateBody(&ground);
      std::visit(AddFixture{body}, obstacle);
      if (const auto* map = std::get_if<FloorMap>(&obstacle)) add_outline(body, *map, poses);
    }
    b2CircleShape disc;
    disc.m_radius = static_cast<float>(robot_.radius_m * scale);
    b2FixtureDef fixture;
    fixture.shape = &disc;
    fixture.density = 1.0F;
    fixture.friction = friction;
    for (std::size_t i = 0; i < body_.size(); ++i) {
      if (gone_[i] != 0) continue;
      b2BodyDef def;
      def.type = b2_dynamicBody;
      def.position = to_box2d(poses.position[i]);
      def.linearVelocity = momentum_[i].linear;
      def.angularVelocity = momentum_[i].angular;
      body_[i] = world.CreateBody(&def);
      body_[i]->CreateFixture(&fixture);
      body_[i]->SetMassData(&mass_);
    }
  }

  void add_outline(b2Body& ground, const FloorMap& map, const Poses& poses) const {
    const CellFrame frame(map);
    const double reach_m = 1.5 * robot_.radius_m + 2.0 * robot_.wheel_limit_m_s * h_ * substeps_;
    Outline outline(*map.cells);
    for (std::size_t i = 0; i < body_.size(); ++i)
      if (gone_[i] == 0) outline.add_near(frame.in_cells(poses.position[i]), reach_m / map.cell_m);
    outline.each_piece([&](Vec2 from, Vec2 to) {
      b2EdgeShape shape;
      shape.SetTwoSided(to_box2d(frame.in_metres(from)), to_box2d(frame.in_metres(to)));
      AddFixture{ground}.fix(shape);
    });
  }

  // Wheels push the body towards the commanded velocity, against sideways slip, too, as hard as they can.
  void drive(b2Body& body, const Twist& wheels, Vec2 heading) const {
    const b2Vec2 wanted = to_box2d(heading * wheels.forward_m_s);
    b2Vec2 impulse = mass_.mass * (wanted - body.GetLinearVelocity());
    const float size = std::sqrt(impulse.x * impulse.x + impulse.y * impulse.y);
    if (size > force_step_) impulse *= force_step_ / size;
    body.ApplyLinearImpulseToCenter(impulse, true);
    const float twist = mass_.I * (static_cast<float>(wheels.turn_rad_s) - body.GetAngularVelocity());
    body.ApplyAngularImpulse(std::clamp(twist, -torque_step_, torque_step_), true);
  }

  // Encoders see how far the wheels have rolled: what the body did along its heading and its turn.
  // A shove from the side is lost on them.
  void roll(const b2Body& body, Path& path, Vec2& heading) const {
    path.shift_m += path.rotation * (dot(from_box2d(body.GetLinearVelocity()), heading) * h_);
    const double turn = static_cast<double>(body.GetAngularVelocity()) * h_;
    if (turn == 0.0) return;
    path.turn_rad += turn;
    const Vec2 step = unit_vector(turn);
    path.rotation = rotate(path.rotation, step);
    heading = unit(rotate(heading, step));
  }

  RobotModel robot_;
  double wheel_distance_m_;
  std::vector<Obstacle> obstacles_;
  std::uint64_t seed_;
  int substeps_ = 1;
  double h_ = 0.01;
  b2MassData mass_{};
  float force_step_ = 0.0F;  // largest impulse of the motors in a sub-step
  float torque_step_ = 0.0F;
  std::vector<Momentum> momentum_;
  std::vector<b2Body*> body_;  // of the tick under way
  std::vector<Path> path_;
  std::vector<std::uint8_t> gone_;  // 1: no body any more; follows from which robots are alive, so not in the hash
};

}  // namespace

bool has_box2d() noexcept { return true; }

// Corners nearer to each other than half a slop, 0.31 mm with our scale, are one to Box2D. It stores them in single
// precision, to 0.06 millionths of their coordinates, and computes from these on which side of an edge the others
// lie. A shape may then be left without area, and an assertion of the library ends the program.
double least_side_in_box2d_m(const Box& box) noexcept {
  constexpr double welded_m = 0.0004, rounding = 1e-6;
  const double reach_m = std::max(std::abs(box.center.x), std::abs(box.center.y)) + 0.5 * norm(box.size);
  return welded_m + rounding * reach_m;
}

std::unique_ptr<Bodies> make_box2d(const Scenario& scenario, const Poses& poses) {
  return std::make_unique<Box2d>(scenario, poses.position.size());
}

}  // namespace banyan::world

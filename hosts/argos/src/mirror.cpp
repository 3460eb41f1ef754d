// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/mirror.hpp"

#include <algorithm>

#include "banyan/controller/core/trig.hpp"

namespace banyan::argos {
namespace {

class MirroredBodies final : public world::Bodies {
 public:
  explicit MirroredBodies(const MirroredRobots& robots) noexcept : robots_(robots) {}
  [[nodiscard]] std::unique_ptr<world::Bodies> clone() const override {
    return std::make_unique<MirroredBodies>(robots_);
  }
  void step(std::span<const Velocity> /*command*/, world::NearPairs /*near*/, std::uint64_t /*tick*/,
            world::Poses& poses, std::span<Odometry> odometry) override {
    for (std::size_t i = 0; i < odometry.size(); ++i) {
      const Pose now = robots_.pose(i);
      const world::Vec2 heading = unit_vector(now.heading_rad);
      const world::Vec2 shift = rotate_back(poses.heading[i], now.position - poses.position[i]);
      odometry[i] = {static_cast<float>(shift.x), static_cast<float>(shift.y),
                     static_cast<float>(angle_of(rotate_back(poses.heading[i], heading)))};
      poses.position[i] = now.position;
      poses.heading[i] = heading;
    }
  }
  void set_obstacles(std::span<const world::Obstacle> /*obstacles*/) override {}
  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override { return h; }

 private:
  const MirroredRobots& robots_;
};

class MirrorSwarm final : public Swarm {
 public:
  MirrorSwarm(std::unique_ptr<Swarm> local, MirroredRobots& robots) : local_(std::move(local)), robots_(&robots) {
    for (std::size_t i = 0; i < local_->size(); ++i) {
      Mirror& mirror = mirrors_.emplace_back();
      mirror.report = local_->report(i);
      mirror.message.resize(local_->message_bytes());
      local_->send(i, mirror.message);
      mirror.numbers.resize(local_->message_fields().size());
      local_->message_numbers(i, mirror.numbers);
    }
  }
  MirrorSwarm(const MirrorSwarm& other) : local_(other.local_->clone()), mirrors_(other.mirrors_) {}
  MirrorSwarm& operator=(const MirrorSwarm&) = delete;
  // A clone stays as it is: nobody lives in it.
  [[nodiscard]] std::unique_ptr<Swarm> clone() const override { return std::make_unique<MirrorSwarm>(*this); }
  [[nodiscard]] std::size_t size() const noexcept override { return mirrors_.size(); }

  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override {
    for (std::size_t k = 0; k < sensed.size(); ++k) {
      const Orders& orders = sensed[k].senses.orders;
      Told told;
      told.alive = sensed[k].steps;
      if (told.alive) {
        take(first + k, commands[k]);
        reports[k] = mirrors_[first + k].report;
        told.sent = orders.sent;
        told.given_up = orders.given_up;
        told.obstacles = sensed[k].senses.obstacles;
      }
      if (robots_ != nullptr) robots_->tell(first + k, told);
    }
  }
  void advance() noexcept override { local_->advance(); }

  std::size_t send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept override {
    std::copy(mirrors_[i].message.begin(), mirrors_[i].message.end(), bytes.begin());
    return mirrors_[i].message.size();
  }
  [[nodiscard]] std::size_t message_bytes() const noexcept override { return local_->message_bytes(); }
  // Nobody hears other swarms through a mirror.
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> /*bytes*/) override { return std::nullopt; }
  [[nodiscard]] Report report(std::size_t i) const noexcept override { return mirrors_[i].report; }
  void add_to(Digest& digest, std::size_t i) const noexcept override {
    for (const std::uint8_t byte : mirrors_[i].message) digest.add(byte);
  }
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override { return local_->message_fields(); }
  void message_numbers(std::size_t i, std::span<double> numbers) const noexcept override {
    std::copy(mirrors_[i].numbers.begin(), mirrors_[i].numbers.end(), numbers.begin());
  }
  void set_line_of_sight(bool /*on*/) noexcept override {}
  [[nodiscard]] std::size_t memory_bytes() const noexcept override {
    return sizeof(*this) + local_->memory_bytes() + mirrors_.size() * (sizeof(Mirror) + local_->message_bytes());
  }

 private:
  struct Mirror {
    Report report;
    std::vector<std::uint8_t> message;
    std::vector<double> numbers;  // of that
  };

  void take(std::size_t i, Velocity& command) {
    if (robots_ == nullptr) return;
    const Said said = robots_->said(i);
    Mirror& mirror = mirrors_[i];
    command = said.velocity;
    mirror.report = said.report;
    const auto place = local_->receive(said.message);
    if (!place) return;  // it has not stepped yet
    mirror.message.assign(said.message.begin(), said.message.end());
    local_->message_numbers(*place, mirror.numbers);
  }

  std::unique_ptr<Swarm> local_;      // knows the messages
  MirroredRobots* robots_ = nullptr;  // null: a clone
  std::vector<Mirror> mirrors_;
};

}  // namespace

std::unique_ptr<world::Bodies> mirrored_bodies(const MirroredRobots& robots) {
  return std::make_unique<MirroredBodies>(robots);
}

std::unique_ptr<Swarm> MirrorAlgorithm::make(const Setup& setup, std::span<const Member> members) const {
  members_.assign(members.begin(), members.end());
  return std::make_unique<MirrorSwarm>(real().make(setup, members), robots_);
}

}  // namespace banyan::argos

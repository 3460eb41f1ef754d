// SPDX-License-Identifier: MIT
// Robots that are elsewhere, in processes of their own or in another simulator, as an algorithm and its swarm: a world,
// and all that observes it, sees no difference. How they are told what they sense, and heard, is the host's.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"

namespace banyan {

// Has of each robot what it has said last.
class SwarmElsewhere : public Swarm {
 public:
  SwarmElsewhere& operator=(const SwarmElsewhere&) = delete;
  [[nodiscard]] std::size_t size() const noexcept override { return robots_.size(); }
  std::size_t send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept override {
    std::copy(robots_[i].message.begin(), robots_[i].message.end(), bytes.begin());
    return robots_[i].message.size();
  }
  [[nodiscard]] std::size_t message_bytes() const noexcept override { return local_->message_bytes(); }
  void restart(std::size_t i) override {
    local_->restart(i);
    begin(i);
  }
  // Nobody hears other swarms through it.
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> /*bytes*/) override { return std::nullopt; }
  [[nodiscard]] Report report(std::size_t i) const noexcept override { return robots_[i].report; }
  void add_to(Digest& digest, std::size_t i) const noexcept override {
    for (const std::uint8_t byte : robots_[i].message) digest.add(byte);
  }
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override { return local_->message_fields(); }
  void message_numbers(std::size_t i, std::span<double> numbers) const noexcept override {
    std::copy(robots_[i].numbers.begin(), robots_[i].numbers.end(), numbers.begin());
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override {
    return sizeof(*this) + local_->memory_bytes() + robots_.size() * (sizeof(Robot) + local_->message_bytes());
  }

 protected:
  // `local`: a swarm of the algorithm, which knows its messages and how robots begin.
  explicit SwarmElsewhere(std::unique_ptr<Swarm> local) : local_(std::move(local)), robots_(local_->size()) {
    for (std::size_t i = 0; i < robots_.size(); ++i) begin(i);
  }
  SwarmElsewhere(const SwarmElsewhere& other) : local_(other.local_->clone()), robots_(other.robots_) {}

  // False for bytes that are no message of the algorithm: they change nothing.
  bool take(std::size_t i, std::span<const std::uint8_t> message) {
    const auto place = local_->receive(message);
    if (!place) return false;
    robots_[i].message.assign(message.begin(), message.end());
    local_->message_numbers(*place, robots_[i].numbers);
    return true;
  }
  void take(std::size_t i, const Report& report) noexcept { robots_[i].report = report; }
  // When the messages of a tick have been taken.
  void end_taking() noexcept { local_->advance(); }

 private:
  struct Robot {
    Report report;
    std::vector<std::uint8_t> message;
    std::vector<double> numbers;  // of that
  };
  void begin(std::size_t i) {
    robots_[i].report = local_->report(i);
    robots_[i].message.resize(local_->message_bytes());
    robots_[i].message.resize(local_->send(i, robots_[i].message));
    robots_[i].numbers.resize(local_->message_fields().size());
    local_->message_numbers(i, robots_[i].numbers);
  }
  std::unique_ptr<Swarm> local_;
  std::vector<Robot> robots_;
};

// An algorithm as another one: only its swarms differ. The real one must outlive it.
class AlgorithmElsewhere : public Algorithm {
 public:
  // Of a swarm of the real one, the swarm of those who are elsewhere.
  using Make =
      std::function<std::unique_ptr<Swarm>(std::unique_ptr<Swarm> local, const Setup&, std::span<const Member>)>;
  AlgorithmElsewhere(const Algorithm& real, Make make) : real_(real), make_(std::move(make)) {}

  [[nodiscard]] std::string_view name() const noexcept override { return real_.name(); }
  [[nodiscard]] std::string_view summary() const noexcept override { return real_.summary(); }
  [[nodiscard]] std::string_view fingerprint() const noexcept override { return real_.fingerprint(); }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override { return real_.parameters(); }
  [[nodiscard]] std::vector<float> values(const Setup& setup) const override { return real_.values(setup); }
  [[nodiscard]] std::string fault(const Setup& setup) const override { return real_.fault(setup); }
  [[nodiscard]] bool knows_redundancy() const noexcept override { return real_.knows_redundancy(); }
  [[nodiscard]] bool knows_readings() const noexcept override { return real_.knows_readings(); }
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return make_(real_.make(setup, members), setup, members);
  }

 private:
  const Algorithm& real_;
  Make make_;
};

}  // namespace banyan

// SPDX-License-Identifier: MIT
// Robots that are decided for all at once, by something outside: a Swarm that turns what its robots sense into arrays
// (block.hpp) and arrays into what they do. World, observers, sinks and studies meet it like any other algorithm.
// Knows no Python: a Mind decides, or whoever has the arrays and calls World::decide.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/hosts/python/block.hpp"

namespace banyan::python {

// Decides within the tick.
class Mind {
 public:
  virtual ~Mind() = default;
  // Reads the sensed fields of the block's only swarm and writes the decided ones; those that it does not write
  // keep what they had. May throw.
  virtual void decide(const std::shared_ptr<Block>& block) = 0;
  [[nodiscard]] virtual std::unique_ptr<Mind> clone() const = 0;

 protected:
  Mind() = default;
};

class OutsideSwarm final : public Swarm {
 public:
  // `beneath`: an algorithm that runs all along, with its own messages and reports; what is decided are velocities
  // instead of those that it suggests. Null: there is none. `mind` null: the arrays are written between ticks.
  OutsideSwarm(std::span<const Member> members, const Setup& setup, std::shared_ptr<Block> block, std::size_t place,
               std::unique_ptr<Swarm> beneath, std::unique_ptr<Mind> mind, std::span<const FieldInfo> names);

  [[nodiscard]] std::unique_ptr<Swarm> clone() const override;
  [[nodiscard]] std::size_t size() const noexcept override { return members_.size(); }
  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override;
  void decide(std::span<Velocity> commands, std::span<Report> reports) override;
  void advance() noexcept override;
  std::size_t send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept override;
  [[nodiscard]] std::size_t message_bytes() const noexcept override;
  // Nobody outside speaks this language.
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> /*bytes*/) override { return std::nullopt; }
  [[nodiscard]] Report report(std::size_t i) const noexcept override {
    return beneath_ ? beneath_->report(i) : reports_[i];
  }
  void add_to(Digest& digest, std::size_t i) const noexcept override;
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override;
  void message_numbers(std::size_t i, std::span<double> numbers) const noexcept override;
  void set_line_of_sight(bool on) noexcept override {
    if (beneath_) beneath_->set_line_of_sight(on);
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override;

 private:
  OutsideSwarm(const OutsideSwarm& other);
  void sense(std::size_t i, const Senses& senses) noexcept;
  void hear(std::size_t i, std::span<const Packet> packets);
  void suggest(std::span<const Velocity> commands, std::span<const Report> reports) noexcept;
  [[nodiscard]] Velocity velocity_of(std::size_t i) const noexcept;
  void report_of(std::size_t i, Report& report) const noexcept;
  // Where the messages of `age` ticks ago begin; those of this tick are written to slot_.
  [[nodiscard]] std::size_t slot_of(std::size_t age) const noexcept {
    return (slot_ + slots_.size() - age) % slots_.size();
  }
  [[nodiscard]] const std::uint8_t* said(std::size_t slot, std::size_t i) const noexcept {
    return slots_[slot].data() + i * payload_;
  }

  Platform platform_;
  std::vector<Member> members_;
  std::vector<Report> reports_;  // without an algorithm beneath
  std::size_t payload_, neighbours_;
  std::vector<std::vector<std::uint8_t>> slots_;  // a ring: what each robot sent, tick by tick
  std::size_t slot_ = 0;
  bool in_tick_ = false;  // it has stepped and not advanced yet
  std::shared_ptr<Block> block_;
  std::size_t place_ = 0;  // in the block
  std::unique_ptr<Swarm> beneath_;
  std::unique_ptr<Mind> mind_;
  std::span<const FieldInfo> names_;  // of the payload's bytes or floats
  Exchange exchange_;                 // its arrays
};

// How such an algorithm is described.
struct Outside {
  std::string name, summary, fingerprint;
  std::size_t neighbours = 32;
  std::size_t payload = 0;             // bytes
  bool floats = true;                  // the payload is a list of floats
  const Algorithm* beneath = nullptr;  // must outlive the algorithm
  // Makes the mind of a swarm; it may throw. Nothing: the arrays are written between ticks.
  std::function<std::unique_ptr<Mind>(const Setup&, std::span<const Member>, const std::shared_ptr<Block>&)> mind;
  // For many swarms in one block: where the next swarm's arrays are. Null: in a block of its own.
  std::shared_ptr<Block> block;
  std::size_t place = 0;
};

class OutsideAlgorithm final : public Algorithm {
 public:
  explicit OutsideAlgorithm(Outside outside);
  [[nodiscard]] std::string_view name() const noexcept override { return outside_.name; }
  [[nodiscard]] std::string_view summary() const noexcept override { return outside_.summary; }
  [[nodiscard]] std::string_view fingerprint() const noexcept override { return outside_.fingerprint; }
  [[nodiscard]] std::vector<const ParameterInfo*> parameters() const override;
  [[nodiscard]] std::vector<float> values(const Setup& setup) const override;
  [[nodiscard]] std::string fault(const Setup& setup) const override;
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override;
  [[nodiscard]] const Outside& outside() const noexcept { return outside_; }

 private:
  Outside outside_;
  std::vector<std::string> texts_;
  std::vector<FieldInfo> names_;
};

}  // namespace banyan::python

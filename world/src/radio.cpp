// SPDX-License-Identifier: MIT
#include "banyan/world/radio.hpp"

#include "radio_fast.hpp"

namespace banyan::world {

Radio::Radio(const Scenario& scenario, std::size_t robots) : fast_(std::make_unique<Fast>(scenario, robots)) {}
Radio::Radio(const Radio& other) : fast_(std::make_unique<Fast>(*other.fast_)) {}
Radio::~Radio() = default;

void Radio::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive,
                   std::span<const std::uint8_t> raised, Executor& executor) {
  fast_->update(positions, alive, raised, executor);
}
void Radio::occlude(bool on, std::span<const Obstacle> obstacles) { fast_->occlude(on, obstacles); }
void Radio::forget(std::uint32_t i) { fast_->forget(i); }

std::span<const std::uint32_t> Radio::links(std::size_t i) const noexcept { return fast_->links(i); }
NearPairs Radio::near() const noexcept { return fast_->near(); }
std::vector<std::pair<std::uint32_t, std::uint32_t>> Radio::blocked() const { return fast_->blocked(); }
std::size_t Radio::memory_bytes() const noexcept { return fast_->memory_bytes(); }

}  // namespace banyan::world

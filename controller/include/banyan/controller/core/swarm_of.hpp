// SPDX-License-Identifier: MIT
// A Swarm of any algorithm: of its Params, State, Message and step. For hosts; firmware calls the step.
//
// An algorithm A is
//   A::Params, A::State, A::Message   values; Params are a Machine (platform.hpp), a message has `blocks` and
//                                     visit_fields() (wire.hpp)
//   A::Heard                          {const Message-or-a-base* message; Vec2 position; float age_s}
//   A::initial(id, worker, root)      a State
//   A::step(params, state, inputs)    an Output<Message>; of what hosts hand in, which may be anything, Inputs<Heard>
//                                     has what passed the gate (gate.hpp), lengths in C
//   A::report(state), A::add_to(digest, state)
#pragma once

#include <array>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/swarm.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan {

// Messages begin cache lines; large arrays lie in large pages where the system has them: states lie 9 KB
// apart, so that in small pages every robot costs address translations of its own.
template <class T> struct PageAllocator {
  using value_type = T;
  PageAllocator() = default;
  template <class U> explicit PageAllocator(const PageAllocator<U>&) noexcept {}
  static constexpr std::size_t page = 4096;
  static constexpr std::size_t alignment(std::size_t n) noexcept {
    return n * sizeof(T) >= 64 * page ? page : alignof(T) > 64 ? alignof(T) : 64;
  }
  T* allocate(std::size_t n) {
    auto* const p = static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{alignment(n)}));
#ifdef __linux__
    if (alignment(n) == page)
      madvise(p, n * sizeof(T) / page * page, MADV_HUGEPAGE);  // a hint; failure changes nothing
#endif
    return p;
  }
  void deallocate(T* p, std::size_t n) noexcept { ::operator delete (p, std::align_val_t{alignment(n)}); }
  friend bool operator==(const PageAllocator&, const PageAllocator&) noexcept { return true; }
};

namespace swarm_detail {

// Names and numbers of a message's fields.
struct FieldNames {
  std::vector<FieldInfo>& fields;
  void add(const char* name, const char* meaning, int decimals = 0) { fields.push_back({name, meaning, decimals}); }
  template <class E> void choice(const char* name, const char* meaning, const E&, int, E) { add(name, meaning); }
  void flag(const char* name, const char* meaning, bool) { add(name, meaning); }
  template <class T> void number(const char* name, const char* meaning, const T&) { add(name, meaning); }
  template <class T> void known(const char* name, const char* meaning, const T&) { add(name, meaning); }
  void robot(const char* name, const char* meaning, RobotId) { add(name, meaning); }
  void count(const char* name, const char* meaning, RobotCount) { add(name, meaning); }
  template <class T> void scaled(const char* name, const char* meaning, const T&, float) { add(name, meaning, 3); }
  void coordinate(const char* name, const char* meaning, Coordinate) { add(name, meaning, 3); }
  void real(const char* name, const char* meaning, float, float) { add(name, meaning, 3); }
};
struct Numbers {
  double* at;
  template <class E> void choice(const char*, const char*, const E& v, int, E) noexcept {
    *at++ = static_cast<double>(v);
  }
  void flag(const char*, const char*, bool v) noexcept { *at++ = v ? 1.0 : 0.0; }
  template <class T> void number(const char*, const char*, const T& v) noexcept { *at++ = static_cast<double>(v); }
  template <class T> void known(const char*, const char*, const T& v) noexcept {
    *at++ = v == static_cast<T>(~T{}) ? -1.0 : static_cast<double>(v);
  }
  void robot(const char*, const char*, RobotId v) noexcept { *at++ = v == nobody ? -1.0 : static_cast<double>(v); }
  void count(const char*, const char*, RobotCount v) noexcept { *at++ = static_cast<double>(v); }
  template <class T> void scaled(const char*, const char*, const T& v, float unit) noexcept {
    *at++ = static_cast<double>(v) / static_cast<double>(unit);
  }
  void coordinate(const char*, const char*, Coordinate v) noexcept { *at++ = static_cast<double>(v.value()); }
  void real(const char*, const char*, float v, float) noexcept { *at++ = static_cast<double>(v); }
};

}  // namespace swarm_detail

template <class A> class SwarmOf final : public Swarm {
 public:
  using Params = typename A::Params;
  using State = typename A::State;
  using Message = typename A::Message;
  using Heard = typename A::Heard;

  // `history`: packets are heard at most this many ticks after they were sent.
  template <class Members>
  SwarmOf(const Params& params, const Platform& platform, const Members& members, std::size_t history)
      : params_(params), platform_(platform), slots_(history + 1) {
    states_.reserve(members.size());
    for (const auto& member : members) {
      states_.push_back(A::initial(member.id, member.worker, member.root));
      Message first;
      first.id = member.id;
      slots_[0].push_back(first);
    }
    for (auto& slot : slots_) slot = slots_[0];
  }

  [[nodiscard]] std::unique_ptr<Swarm> clone() const override { return std::make_unique<SwarmOf>(*this); }
  [[nodiscard]] std::size_t size() const noexcept override { return states_.size(); }

  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override {
    static thread_local std::array<std::vector<Heard>, 2> of_thread;
    std::array<std::vector<Heard>, 2>& heard = of_thread;  // of this robot and of the next; looked up once
    auto& now = slots_[slot_];
    const auto& last = slots_[slot_of(1)];
    if (!sensed.empty()) fetch(first, sensed[0], heard[0]);
    for (std::size_t k = 0; k < sensed.size(); ++k) {
      const std::size_t i = first + k;
      if (k + 1 < sensed.size()) fetch(i + 1, sensed[k + 1], heard[(k + 1) % 2]);
      if (!sensed[k].steps) {
        now[i] = last[i];
        continue;
      }
      const std::span<Heard> packets = std::span<Heard>(heard[k % 2]).first(sensed[k].packets.size());
      const auto output = A::step(params_, states_[i], Inputs<Heard>(packets, sensed[k].senses, platform_));
      now[i] = output.message;
      commands[k] = velocity_of(output.motion, platform_);
      reports[k] = A::report(states_[i]);
    }
  }

  void advance() noexcept override {
    slot_ = (slot_ + 1) % slots_.size();
    foreign_.clear();
  }

  void restart(std::size_t i) override {
    Message first;
    first.id = slots_[0][i].id;
    for (auto& slot : slots_) slot[i] = first;
    states_[i] = A::initial(first.id, false, false);
  }

  std::size_t send(std::size_t i, std::span<std::uint8_t> bytes) const noexcept override {
    return encode_fields(slots_[slot_of(1)][i], bytes);
  }
  [[nodiscard]] std::size_t message_bytes() const noexcept override { return wire_size<Message>(); }
  std::optional<std::uint32_t> receive(std::span<const std::uint8_t> bytes) override {
    const std::optional<Message> message = decode_fields<Message>(bytes);
    if (!message) return std::nullopt;
    foreign_.push_back(*message);
    return static_cast<std::uint32_t>(states_.size() + foreign_.size() - 1);
  }

  [[nodiscard]] Report report(std::size_t i) const noexcept override { return A::report(states_[i]); }
  void add_to(Digest& digest, std::size_t i) const noexcept override {
    A::add_to(digest, states_[i]);
    FieldDigest visit{digest};
    for (std::size_t age = 1; age < slots_.size(); ++age) visit_fields(visit, slots_[slot_of(age)][i]);
  }
  [[nodiscard]] std::span<const FieldInfo> message_fields() const noexcept override {
    static const std::vector<FieldInfo> fields = [] {
      std::vector<FieldInfo> list;
      swarm_detail::FieldNames names{list};
      const Message message{};
      visit_fields(names, message);
      return list;
    }();
    return fields;
  }
  void message_numbers(std::size_t i, std::span<double> numbers) const noexcept override {
    swarm_detail::Numbers visit{numbers.data()};
    visit_fields(visit, i < states_.size() ? slots_[slot_of(1)][i] : foreign_[i - states_.size()]);
  }

  void set_line_of_sight(bool on) noexcept override { params_.line_of_sight = on; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override {
    return sizeof(*this) + states_.size() * (sizeof(State) + slots_.size() * sizeof(Message));
  }

  // For tests that look into one robot.
  [[nodiscard]] const Params& params() const noexcept { return params_; }
  [[nodiscard]] const State& state(std::size_t i) const noexcept { return states_[i]; }
  [[nodiscard]] const Message& message(std::size_t i) const noexcept { return slots_[slot_of(1)][i]; }

 private:
  // Where the messages of `age` ticks ago are; those of this tick are written to slot_.
  [[nodiscard]] std::size_t slot_of(std::size_t age) const noexcept {
    return (slot_ + slots_.size() - age) % slots_.size();
  }
  // Robot i is next: finds the messages that it hears, and asks for the memory that its step will touch while the
  // one before it computes. States lie too far apart for the processor to guess; in large swarms this is worth a third.
  void fetch(std::size_t i, const Sensed& sensed, std::vector<Heard>& heard) const {
    if constexpr (requires(const State& s) { s.prefetch(std::size_t{}); }) states_[i].prefetch(sensed.packets.size());
    if (heard.size() < sensed.packets.size()) heard.resize(sensed.packets.size() + sensed.packets.size() / 4);
    constexpr std::size_t line = 64;
    const std::size_t robots = states_.size();
    const Message* const last = slots_[slot_of(1)].data();
    Heard* to = heard.data();
    for (const Packet& packet : sensed.packets) {
      const Message* message = packet.sender >= robots ? &foreign_[packet.sender - robots]
                               : packet.age_ticks == 1 ? last + packet.sender
                                                       : &slots_[slot_of(packet.age_ticks)][packet.sender];
      for (std::size_t at = 0; at < sizeof(Message); at += line)
        __builtin_prefetch(reinterpret_cast<const char*>(message) + at);
      *to++ = {message, packet.position, packet.age_s};
    }
  }

  Params params_;
  Platform platform_;
  std::vector<State, PageAllocator<State>> states_;
  std::vector<std::vector<Message, PageAllocator<Message>>> slots_;  // a ring: what each robot sent, tick by tick
  std::size_t slot_ = 0;
  std::vector<Message> foreign_;  // from outside the swarm, until advance()
};

}  // namespace banyan

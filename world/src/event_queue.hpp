// SPDX-License-Identifier: MIT
// When the events of a scenario act: in order of time and, at equal times, of the file. Events that
// count from a moment of the mission wait until it comes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "banyan/controller/core/digest.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

class EventQueue {
 public:
  struct Entry {
    Event event;
    std::uint64_t number = 0;  // in the scenario's list
    double due_s = 0.0;        // when it acts next
    // A kill that is under way
    bool begun = false;
    double begin_s = 0.0;
    std::uint64_t drawn = 0;  // victims drawn so far
    std::uint64_t left = 0;   // and still to be drawn
  };

  explicit EventQueue(const std::vector<Event>& events);

  // One more event of the scenario's list, the last one so far, due at its time_s. Allocates.
  void add(const Event& event);
  // Whether an event waits for this moment of the mission.
  [[nodiscard]] bool waits_for(Event::When moment) const noexcept;
  // The moment has come: events that wait for it are due event.time_s after `now_s`.
  void come(Event::When moment, double now_s);
  // Takes out the next event that is due at `now_s`; none if there is none yet.
  [[nodiscard]] std::optional<Entry> take(double now_s);
  // What take(now_s) will return, in that order.
  template <class Visit> void each_due(double now_s, const Visit& visit) const {
    for (auto entry = due_.rbegin(); entry != due_.rend() && entry->due_s <= now_s; ++entry) visit(entry->event);
  }
  // Puts back one that was taken and acts again at its due_s. No allocation: there is room for all.
  void again(const Entry& entry);
  // Whether a robot is still to die by an event, drawn or named.
  [[nodiscard]] bool deaths_to_come() const noexcept;
  // Adds what later ticks depend on. For events at fixed times that is how many have acted.
  void add_to(Digest& digest) const noexcept;

 private:
  void insert(const Entry& entry);

  std::vector<Entry> due_;      // the next one last
  std::vector<Entry> waiting_;  // in the order of the file
  std::uint64_t size_ = 0;      // of the scenario's list
  std::uint64_t acted_ = 0;     // events that will not act again
};

}  // namespace banyan::world

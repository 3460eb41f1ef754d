// SPDX-License-Identifier: MIT
#include "event_queue.hpp"

#include <algorithm>

namespace banyan::world {
namespace {

bool later(const EventQueue::Entry& a, const EventQueue::Entry& b) noexcept {
  return a.due_s != b.due_s ? a.due_s > b.due_s : a.number > b.number;
}

bool deadly(const EventQueue::Entry& entry) noexcept {
  return std::holds_alternative<Die>(entry.event.action) || std::holds_alternative<Kill>(entry.event.action);
}

}  // namespace

EventQueue::EventQueue(const std::vector<Event>& events) {
  due_.reserve(events.size());
  waiting_.reserve(events.size());
  for (std::size_t i = 0; i < events.size(); ++i)
    (events[i].when == Event::When::time ? due_ : waiting_)
        .push_back({.event = events[i], .number = i, .due_s = events[i].time_s});
  std::sort(due_.begin(), due_.end(), later);
  size_ = events.size();
}

void EventQueue::add(const Event& event) {
  ++size_;
  due_.reserve(size_);  // again() must find room for all
  insert({.event = event, .number = size_ - 1, .due_s = event.time_s});
}

bool EventQueue::waits_for(Event::When moment) const noexcept {
  return std::any_of(waiting_.begin(), waiting_.end(), [&](const Entry& e) { return e.event.when == moment; });
}

void EventQueue::come(Event::When moment, double now_s) {
  for (Entry& entry : waiting_) {
    if (entry.event.when != moment) continue;
    entry.due_s = now_s + entry.event.time_s;
    insert(entry);
  }
  std::erase_if(waiting_, [&](const Entry& e) { return e.event.when == moment; });
}

std::optional<EventQueue::Entry> EventQueue::take(double now_s) {
  if (due_.empty() || due_.back().due_s > now_s) return std::nullopt;
  const Entry entry = due_.back();
  due_.pop_back();
  ++acted_;
  return entry;
}

void EventQueue::again(const Entry& entry) {
  insert(entry);
  --acted_;
}

void EventQueue::insert(const Entry& entry) {
  due_.insert(std::upper_bound(due_.begin(), due_.end(), entry, later), entry);
}

bool EventQueue::deaths_to_come() const noexcept {
  return std::any_of(due_.begin(), due_.end(), deadly) || std::any_of(waiting_.begin(), waiting_.end(), deadly);
}

void EventQueue::add_to(Digest& digest) const noexcept {
  digest.add(acted_);
  for (const Entry& entry : due_) {
    if (!entry.begun && entry.event.when == Event::When::time) continue;
    digest.add(entry.number);
    digest.add(entry.due_s);
    digest.add(entry.drawn);
    digest.add(entry.left);
  }
}

}  // namespace banyan::world

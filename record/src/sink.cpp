// SPDX-License-Identifier: MIT
// Sinks; a failure of one does not affect the others (sink.hpp).
#include "banyan/record/sink.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "banyan/record/file.hpp"

namespace banyan::record {

void Sink::start(const world::World&) {}
void Sink::tick(const world::World&, const measure::Tick&) {}
void Sink::finish(const world::World&, const RunEnd&) {}
bool Sink::wants_fiedler(const world::World&) const { return false; }
std::string Sink::rest() const { return ""; }

void Sinks::add(std::string path, std::unique_ptr<Sink> sink) {
  members_.push_back({std::move(path), std::move(sink)});
}

template <class Call> void Sinks::tell(const Call& call) {
  for (auto& [path, sink] : members_) {
    if (!sink) continue;
    try {
      call(*sink);
    } catch (const FileError& error) {
      failures_.push_back({path, error.what(), sink->rest()});
      sink.reset();
    } catch (const std::exception& error) {
      failures_.push_back({path, path + ": " + error.what(), sink->rest()});
      sink.reset();
    }
  }
}

std::vector<std::string> Sinks::rests() const {
  std::vector<std::string> files;
  for (const auto& [path, sink] : members_)
    if (std::string file = sink ? sink->rest() : ""; !file.empty()) files.push_back(std::move(file));
  return files;
}

void Sinks::start(const world::World& world) {
  tell([&](Sink& sink) { sink.start(world); });
}
void Sinks::tick(const world::World& world, const measure::Tick& tick) {
  tell([&](Sink& sink) { sink.tick(world, tick); });
}
void Sinks::finish(const world::World& world, const RunEnd& end) {
  tell([&](Sink& sink) { sink.finish(world, end); });
}
bool Sinks::wants_fiedler(const world::World& world) const {
  return std::any_of(members_.begin(), members_.end(),
                     [&](const Member& member) { return member.sink && member.sink->wants_fiedler(world); });
}

}  // namespace banyan::record

// SPDX-License-Identifier: MIT
// Poses from a tracker (Vicon, OptiTrack, AprilTags, ...), as text in UDP datagrams, so that an adapter is thirty lines
// (hosts/udp/examples/tracker.py). A datagram has one or more lines, each ended by a newline:
//
//   ROBOT X Y HEADING    name or id, position in m, heading in rad counter-clockwise from the x axis, separated by
//                        single spaces
//
// Numbers are decimal. The frame is the laboratory's, the one in which the scenario has its targets. A line that is
// wrong makes its datagram worthless. Nothing is authenticated: take poses from this computer, or from a network of
// their own.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/vec2.hpp"
#include "banyan/hosts/udp/roster.hpp"
#include "banyan/hosts/udp/socket.hpp"

namespace banyan::udp {

struct TrackedPose {
  BasicVec2<double> position;
  double heading_rad = 0.0;
  friend bool operator==(const TrackedPose&, const TrackedPose&) = default;
};
struct PoseLine {
  PoseLine() = default;
  PoseLine(std::string name, const TrackedPose& at) : robot(std::move(name)), pose(at) {}
  PoseLine(std::size_t id, const TrackedPose& at) : robot(std::to_string(id)), pose(at) {}
  std::string robot;  // its name, or its id in decimals
  TrackedPose pose;
};
// Finite, and in bounds within which positions and headings are exact.
[[nodiscard]] bool is_sound(const TrackedPose& pose) noexcept;
// With its end.
[[nodiscard]] std::string pose_line(const PoseLine& line);
// Nothing if any of its lines is none.
[[nodiscard]] std::optional<std::vector<PoseLine>> parse_poses(std::string_view datagram);

class PoseStream {
 public:
  // `roster` must outlive it.
  PoseStream(const Address& listen, const Roster& roster) : socket_(listen), roster_(roster), poses_(roster.most()) {}
  // Whoever is tracked and not in the roster is named, once.
  void tell_unknown(std::function<void(const std::string& name)> tell) { tell_unknown_ = std::move(tell); }
  // Takes in what has come.
  void listen();
  // Where each robot was seen last, as lines; and from such lines again, as if they had just come.
  [[nodiscard]] std::string lines() const;
  void restore(std::string_view text);
  // Where each robot was seen last, by its index; nothing for one that never was, or has not joined. Stays where it is
  // in memory.
  [[nodiscard]] std::span<const std::optional<TrackedPose>> poses() const noexcept { return poses_; }
  [[nodiscard]] std::vector<std::size_t> missing() const;
  // Whether somebody was seen who is not in the roster and would have that id.
  [[nodiscard]] bool has_seen(NodeId newcomer) const { return others_.contains(newcomer); }
  // The roster has grown by one: by a newcomer that may have been seen before.
  void welcome(std::size_t robot);
  // Seconds of the wall since a sound datagram came; very many if none has.
  [[nodiscard]] double silence_s() const noexcept;
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] Address local() const noexcept { return socket_.local(); }

 private:
  void take(const std::vector<PoseLine>& lines);
  void take_other(const PoseLine& line);
  Socket socket_;
  const Roster& roster_;
  std::vector<std::optional<TrackedPose>> poses_;
  std::map<NodeId, TrackedPose> others_;  // seen, and not in the roster: at most 32
  std::function<void(const std::string&)> tell_unknown_;
  std::set<std::string> told_;
  Clock clock_;
  double heard_s_ = -1e9;
  std::uint64_t refused_ = 0;
};

}  // namespace banyan::udp

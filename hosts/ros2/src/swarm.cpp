// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/swarm.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "banyan/hosts/ros2/swarm_node.hpp"

namespace banyan::ros2 {
namespace {

constexpr double farewell_s = 0.5;  // for readers to have all that was said

class SwarmShow {
 public:
  explicit SwarmShow(const Options& options) : socket_(options.swarm), node_(options) {}

  int run() {
    ask(feed::FeedTopic::hello, "");
    std::array<pollfd, 2> watched{{{socket_, POLLIN, 0}, {node_.descriptor(), POLLIN, 0}}};
    for (;;) {
      if (::poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) break;
      if ((watched[1].revents & POLLIN) != 0)
        node_.listen([&](feed::FeedTopic topic, std::string_view text) { ask(topic, text); });
      if (watched[0].revents != 0 && !take()) break;
    }
    node_.settle(farewell_s);
    if (node_.unsent() > 0)
      std::fprintf(stderr, "banyan-ros2: %llu messages were not sent, because readers were slow\n",
                   static_cast<unsigned long long>(node_.unsent()));
    return 0;
  }

 private:
  // False: the mission has ended.
  bool take() {
    std::array<char, sizeof(feed::PartHead) + feed::largest_part> room{};
    for (;;) {
      const ssize_t size = ::recv(socket_, room.data(), room.size(), MSG_DONTWAIT);
      if (size < 0 && errno == EINTR) continue;
      if (size < 0) return errno == EAGAIN;
      if (size < static_cast<ssize_t>(sizeof(feed::PartHead))) return false;
      feed::PartHead head;
      std::memcpy(&head, room.data(), sizeof head);
      put_together(head, {room.data() + sizeof head, static_cast<std::size_t>(size) - sizeof head});
    }
  }

  // The parts of a message come one after the other; one whose end is missing is forgotten.
  void put_together(const feed::PartHead& head, std::string_view part) {
    if ((head.place & feed::first_part) != 0) message_.clear();
    message_ += part;
    if ((head.place & feed::last_part) == 0) return;
    if (head.topic == feed::FeedTopic::hello) node_.hello(head.robot, !message_.empty() && message_.front() == 1);
    else node_.publish(head.topic, head.robot, message_);
  }

  // A mission that does not listen is not waited for.
  void ask(feed::FeedTopic topic, std::string_view text) const {
    std::array<char, sizeof(feed::PartHead) + feed::longest_command> room{};
    const feed::PartHead head{topic, feed::whole, 0};
    const std::size_t size = std::min(text.size(), feed::longest_command);
    std::memcpy(room.data(), &head, sizeof head);
    std::memcpy(room.data() + sizeof head, text.data(), size);
    static_cast<void>(::send(socket_, room.data(), sizeof head + size, MSG_DONTWAIT | MSG_NOSIGNAL));
  }

  int socket_;
  SwarmNode node_;
  std::string message_;
};

}  // namespace

int show_swarm(const Options& options) { return SwarmShow(options).run(); }

}  // namespace banyan::ros2

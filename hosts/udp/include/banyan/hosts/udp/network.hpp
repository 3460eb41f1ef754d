// SPDX-License-Identifier: MIT
// Networks on one machine: one of the fleet and one of each robot, joined by a wire and a bridge. A wire can lose,
// delay, double and reorder what it carries, which is the kernel's work (tc netem). All of it is known to these
// processes alone, and the kernel takes it away with the last of them, however they end.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "banyan/hosts/udp/impairment.hpp"

namespace banyan::udp {

class FleetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Arguments = std::vector<std::string>;  // the program first

// Becomes another program; ends with 127 if there is none.
[[noreturn]] void become(const Arguments& arguments);

inline constexpr const char* bridge_address = "10.77.0.1";

// This thread moves into a network of its own with a bridge in it; so does all that it starts. False, and nothing has
// changed, if the machine does not allow it. Who is not root may have started no other thread.
[[nodiscard]] bool enter_network();

// As `tc` calls it. Clocks that are `speed` times as fast have delays that are as much shorter.
[[nodiscard]] std::string netem_words(const Impairment& hop, double speed);
// Why wires cannot do that, in the words of `tc`; "": they can. Tried on a wire of its own; after enter_network().
[[nodiscard]] std::string netem_fault(const Impairment& hop, double speed);

// From the bridge to a process in a network of its own. Made before that process is.
class Wire {
 public:
  Wire(std::size_t robot, const Impairment& hop, double speed);  // throws FleetError
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // In the process: moves into a network of its own and waits until the wire is there.
  [[nodiscard]] bool become_far_end();
  // On the other side, with that process.
  [[nodiscard]] bool join(pid_t far);

 private:
  std::size_t robot_;
  std::string netem_;                 // "": a good wire
  std::array<int, 2> there_{-1, -1};  // from the far end: it is in its network
  std::array<int, 2> wired_{-1, -1};  // to it: so is its wire
};

}  // namespace banyan::udp

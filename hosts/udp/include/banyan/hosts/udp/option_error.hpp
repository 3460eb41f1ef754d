// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace banyan::udp {

// What is wrong with a command line, in words.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace banyan::udp

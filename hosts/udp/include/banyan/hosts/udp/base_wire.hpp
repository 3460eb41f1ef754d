// SPDX-License-Identifier: MIT
// The wires to bases that carry a stream of bytes: TCP and serial ports. Descriptors do not block.
#pragma once

#include <stdexcept>
#include <string>

namespace banyan::udp {

class BaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// "ADDRESS:PORT". Throws BaseError.
[[nodiscard]] int connect_tcp(const std::string& name);
// The path of a serial device, which is set to `baud` (38400 to 921600, as serial ports have them), 8N1. Throws
// BaseError.
[[nodiscard]] int open_serial(const std::string& path, int baud = 115200);

}  // namespace banyan::udp

// SPDX-License-Identifier: MIT
// The same mission on this computer: the hashes that the chip has to find.      banyan_chip_host [ROBOTS]
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "run.hpp"

int main(int count, char** arguments) {
  const unsigned long robots = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 10;
  if (robots <= banyan::chip::targets || robots > 100) {
    std::fprintf(stderr, "banyan_chip_host: the number of robots is %zu to 100\n", banyan::chip::targets + 1);
    return 2;
  }
  banyan::chip::run(
      robots, []() noexcept { return std::uint32_t{0}; },
      [](const banyan::chip::Result& result) {
        std::printf("%.*s %zu %016" PRIx64 "\n", static_cast<int>(result.algorithm.size()), result.algorithm.data(),
                    result.robots, result.digest);
      });
  return 0;
}

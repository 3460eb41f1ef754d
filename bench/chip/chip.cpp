// SPDX-License-Identifier: MIT
// The mission on an emulated chip. The emulator takes a nanosecond of the chip's time for an instruction (-icount
// shift=0), so the chip's own timer counts instructions.
#include <cstdlib>
#include <span>

#include "run.hpp"
#include "semihosting.hpp"

namespace {

using banyan::chip::Result;
namespace embedded = banyan::embedded;

// SysTick of ARMv7-M, at the processor's 25 MHz: it counts 24 bits down, a step each 40 ns.
constexpr std::uint32_t instructions_per_step = 40;
volatile std::uint32_t& control = *reinterpret_cast<volatile std::uint32_t*>(0xE000E010);
volatile std::uint32_t& reload = *reinterpret_cast<volatile std::uint32_t*>(0xE000E014);
volatile std::uint32_t& current = *reinterpret_cast<volatile std::uint32_t*>(0xE000E018);

void start_timer() noexcept {
  reload = 0xFFFFFF;
  current = 0;
  control = 5;  // on, by the processor's clock, without interrupts
}
// Differences count modulo 2^24 steps, more than a robot-step takes.
std::uint32_t steps_taken() noexcept { return 0xFFFFFF - current; }

void write_number(std::uint64_t value) noexcept {
  char digits[21] = {};
  char* at = digits + 20;
  do *--at = static_cast<char>('0' + value % 10);
  while ((value /= 10) != 0);
  embedded::write(at);
}

// A hash as on the computer, then a row of a table.
void report(const Result& result) {
  char name[32] = {};
  result.algorithm.copy(name, sizeof name - 1);
  embedded::write(name);
  embedded::write(" ");
  write_number(result.robots);
  embedded::write(" ");
  embedded::write_hexadecimal(result.digest);
  embedded::write("\n| ");
  embedded::write(name);
  const banyan::chip::Cost& cost = result.cost;
  const auto instructions = [](std::uint64_t counts) { return counts * instructions_per_step; };
  for (const std::uint64_t value :
       {std::uint64_t{result.robots}, cost.packets / cost.robot_steps, instructions(cost.receiving) / cost.packets,
        instructions(cost.receiving + cost.stepping) / cost.robot_steps, instructions(cost.longest)}) {
    embedded::write(" | ");
    write_number(value);
  }
  embedded::write(" |\n");
}

// The last word of the command line.
std::size_t robots_asked_for() noexcept {
  char line[64] = {};
  if (!embedded::command_line(line, sizeof line)) return 0;
  const std::string_view words = line;
  const auto space = words.find_last_of(' ');
  return std::strtoul(space == std::string_view::npos ? line : line + space + 1, nullptr, 10);
}

}  // namespace

int main() {
  const std::size_t robots = robots_asked_for();
  if (robots <= banyan::chip::targets || robots > 100) {
    embedded::write("banyan_chip: the number of robots is 4 to 100\n");
    embedded::stop(false);
    return 1;
  }
  embedded::write(
      "| algorithm | robots | packets heard | instructions: a packet | a robot's tick | the longest "
      "|\n|---|---|---|---|---|---|\n");
  start_timer();
  banyan::chip::run(robots, steps_taken, report);
  embedded::stop(true);
  return 0;
}

// SPDX-License-Identifier: MIT
// banyan_soak: random missions, watched with eyes that share no code with the rooms they check. Not for users of
// robots.
#include "options.hpp"
#include "program.hpp"
#include "soak.hpp"

namespace banyan::soak {
namespace {

using namespace cli;

void add_soak(CLI::App& command, CommandAction& action) {
  constexpr std::int64_t most = 1'000'000'000'000;
  auto options = std::make_shared<SoakOptions>();
  command.footer(
      "Runs random missions of every kind and checks, at every tick, that nothing happens that must not;\n"
      "docs/soak.md lists what that is. A mission with a finding is reduced to a smaller one, which is written\n"
      "beside the journal, soak.csv, and the command that runs it again is printed. The same seed and number\n"
      "give the same mission; called again, the soak continues after the missions in its journal. With a FILE\n"
      "it watches that scenario. The exit code is 1 if a promise of docs/soak.md was broken.\n\n"
      "Examples:\n"
      "  banyan_soak --seconds 60\n"
      "  banyan_soak --seed 7 --missions 1000\n"
      "  banyan_soak --seed 7 --from 123 --missions 1 --out again\n"
      "  banyan_soak out/soak-7/split-123.toml");
  command.add_option("file", options->file, "a scenario to watch, instead of random missions")->type_name("FILE");
  command.add_option("-s,--seed", options->seed, "seed of the missions, default 1")
      ->type_name("N")
      ->check(whole_within(0, 9007199254740992));
  command.add_option("--from", options->from, "first mission, default 0")->type_name("N")->check(whole_within(0, most));
  command.add_option("--missions", options->missions, "how many; default as many as there is time for")
      ->type_name("N")
      ->check(whole_within(1, most));
  command.add_option("--seconds", options->seconds, "how long; default until Ctrl-C")->type_name("S")->check(moment());
  command.add_option("-o,--out", options->out, "directory for journal and findings, default out/soak-<seed>")
      ->type_name("DIR")
      ->check(a_name());
  command.add_option("-t,--threads", options->threads, "missions at once, default all cores")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command.add_flag("-f,--force", options->force, "start a new journal");
  command.add_flag("--no-shrink", options->whole, "keep missions with findings whole, instead of making them smaller");
  command.add_flag("-q,--quiet", options->quiet, "no progress and no summary; findings only");
  command.callback([options, &action] { action = [options] { return run_soak(*options); }; });
}

}  // namespace
}  // namespace banyan::soak

int main(int argc, char** argv) {
  return banyan::cli::run_program(
      {"banyan_soak", "run random missions and look for faults", "", {}, banyan::soak::add_soak}, argc, argv);
}

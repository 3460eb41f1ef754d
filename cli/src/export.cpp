// SPDX-License-Identifier: MIT
// `banyan export`: a table or a bag from a recording.
#include "banyan/record/export.hpp"

#include <unistd.h>

#include <filesystem>

#include "commands.hpp"
#include "options.hpp"
#include "recordings.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

struct ExportCommand {
  std::string recording;
  std::string output = "-";  // "-": standard output
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  std::size_t every = 1;
  bool force = false;
};

constexpr std::string_view bag_ending = ".mcap";

// Also run.mcap from run.mcap.part: the output is called that until it is whole.
void refuse_to_replace_the_source(const ExportCommand& options) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path output = fs::weakly_canonical(options.output, ignored);
  for (const fs::path& written : {output, fs::path(output.string() + ".part")})
    if (fs::equivalent(options.recording, written, ignored))
      throw CommandError(exit_usage, options.output + " would replace the recording itself; give another name");
}

int export_command(const ExportCommand& options) {
  refuse_to_overwrite(options.output, options.force);
  if (options.output != "-") refuse_to_replace_the_source(options);
  if (options.from_s > options.to_s) throw CommandError(exit_usage, "--from is later than --to: nothing to export");
  auto recording = open_recording(options.recording);
  const auto told = recording.warnings();
  const record::ExportOptions chosen{options.from_s, options.to_s, options.every};
  if (options.output == "-") {
    record::export_csv(
        recording, [](std::string_view piece) { record::write_all(STDOUT_FILENO, piece, "standard output"); }, chosen);
    tell_further_warnings(recording, options.recording, told);
    return exit_done;
  }
  const bool bag = options.output.ends_with(bag_ending);
  const auto number = bag ? record::export_bag(recording, options.output, existing(options.force), chosen)
                          : record::export_csv(recording, options.output, existing(options.force), chosen);
  tell_further_warnings(recording, options.recording, told);
  complain("wrote " + grouped(static_cast<double>(number)) + (bag ? " messages to " : " rows to ") + options.output);
  return exit_done;
}

}  // namespace

void add_export(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<ExportCommand>();
  command.footer(
      "Columns: tick, time_s, robot, x_m, y_m, heading_rad, role, phase, parent, old_parent, alive,\n"
      "connected, target. A FILE.mcap gets messages of ROS 2 instead, for `ros2 bag play`.\n\n"
      "Examples:\n"
      "  banyan export out/three-targets-convoy-1/run.mcap -o robots.csv\n"
      "  banyan export run.mcap --from 10 --to 20 --every 10 | head\n"
      "  banyan export run.mcap -o bag.mcap");
  command.add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command.add_option("-o,--output", options->output, "table or bag to write, default standard output")
      ->type_name("FILE");
  command.add_option("--from", options->from_s, "first moment, s")->type_name("S")->check(moment());
  command.add_option("--to", options->to_s, "last moment, s")->type_name("S")->check(moment());
  command.add_option("--every", options->every, "every Nth recorded tick only")
      ->type_name("N")
      ->check(whole_within(1, 1000000));
  command.add_flag("-f,--force", options->force, "replace the file if it exists");
  command.callback([options, &action] { action = [options] { return export_command(*options); }; });
}

}  // namespace banyan::cli

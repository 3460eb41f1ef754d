// SPDX-License-Identifier: MIT
// The banyan program: its commands. What each does, with its options and its help, is in the file named after it.
#include "program.hpp"

namespace {

using namespace banyan::cli;

constexpr const char* purpose =
    "Banyan: a swarm of robots deploys to several distant targets and keeps its radio\n"
    "network in one piece by growing a tree.\n";

constexpr const char* footer =
    "Examples:\n"
    "  banyan run scenarios/three-targets.toml\n"
    "  banyan run scenarios/paper-large.toml --set mission.algorithm=inwards --seed 7\n"
    "  banyan validate scenarios/*.toml\n"
    "  banyan COMMAND --help\n\n"
    "Exit codes: 0 done, whether or not the mission completed; 1 failed: a file cannot be read or\n"
    "written, or an internal error; 2 bad options or a bad scenario, nothing was started; 129,\n"
    "130 or 143 stopped by SIGHUP, Ctrl-C or SIGTERM, with valid files of what was done so far.";

constexpr Command commands[] = {
    {"demo", "watch a mission, with nothing to type", add_demo},
    {"run", "run a scenario and write its results", add_run},
    {"validate", "report everything that is wrong with scenarios, without running them", add_validate},
    {"export", "turn a recording into a table: a row per tick and robot", add_export},
    {"draw", "draw a moment of a recording as SVG or PNG", add_draw},
    {"film", "turn a recording into a film: MP4, WebM or GIF", add_film},
    {"view", "show a recording or a scenario in the browser", add_view},
    {"algorithms", "list the algorithms and their parameters", add_algorithms},
    {"keys", "list every key of a scenario: type, range, default, meaning", add_keys},
    {"tune", tune_purpose, nullptr, tune_program},
    {"study", "run a scenario many times over and compare", add_study},
    {"collect", "merge the shards of a study into its tables and figures", add_collect},
    {"doctor", "check what is installed, what is missing, and what for", add_doctor},
    {"bench", "measure the speed of the simulation on this machine", add_bench},
    {"hub", "hand each robot process what its robot can hear", add_hub},
    {"listen", "record robots that have no hub, from what they report", add_listen},
    {"robot", "be one robot; see banyan robot --help", nullptr, robot_program},
    {"ros2", "connect a fleet with ROS 2; see banyan ros2 --help", nullptr, ros2_program},
    {"fleet", "run a scenario as processes, over real UDP", add_fleet},
    {"argos", "write an experiment for the simulator ARGoS 3", add_argos},
    {"complete-keys", "", add_complete_keys},  // for the shell
};

}  // namespace

int main(int argc, char** argv) { return run_program({"banyan", purpose, footer, commands}, argc, argv); }

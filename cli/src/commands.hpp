// SPDX-License-Identifier: MIT
// The commands of the program: each has its options, its help and its examples beside what it does, or is a program.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace banyan::cli {

// What a command line asks for. Returns an exit code, and throws CommandError or record::FileError if something fails.
using CommandAction = std::function<int()>;
// Gives a command its options and help; `action` is set when it has been read.
using AddCommand = void(CLI::App& command, CommandAction& action);
// Finds the program, beside this one, that a command is. Throws CommandError.
using FindProgram = std::string();

AddCommand add_algorithms;
AddCommand add_argos;
AddCommand add_bench;
AddCommand add_collect;
AddCommand add_complete_keys;
AddCommand add_demo;
AddCommand add_doctor;
AddCommand add_draw;
AddCommand add_export;
AddCommand add_film;
AddCommand add_fleet;
AddCommand add_hub;
AddCommand add_keys;
AddCommand add_listen;
AddCommand add_run;
AddCommand add_study;
AddCommand add_validate;
AddCommand add_view;

FindProgram robot_program;
FindProgram ros2_program;
FindProgram tune_program;
inline constexpr const char* tune_purpose = "search for better controller parameters by evolution";

}  // namespace banyan::cli

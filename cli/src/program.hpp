// SPDX-License-Identifier: MIT
// A program, of commands or a command itself: reads the command line, says what is wrong with it, and turns errors into
// exit codes.
#pragma once

#include <span>

#include "commands.hpp"

namespace banyan::cli {

struct Command {
  const char* name;
  const char* purpose;  // "": not listed
  AddCommand* add;      // called if it is the one that is meant; null: it is a program of its own,
  FindProgram* program = nullptr;
};

struct ProgramParts {
  const char* name;
  const char* purpose;
  const char* footer;
  std::span<const Command> commands;
  AddCommand* add = nullptr;  // without commands: what it does itself
};

// Goes on as another program: its file, or /proc/self/exe. Throws CommandError if it cannot be started.
[[noreturn]] void become(std::string program, std::span<char*> arguments);

int run_program(const ProgramParts& program, int argc, char** argv);

}  // namespace banyan::cli

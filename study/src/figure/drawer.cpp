// SPDX-License-Identifier: MIT
// Figures are drawn by Python, a program of its own.
#include <cerrno>
#include <system_error>

#include "banyan/study/figure.hpp"
#include "child_program.hpp"

namespace banyan::study {

namespace {

constexpr int no_matplotlib = 3;  // how figures.py ends without it

// As a shell reads it.
std::string quoted(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=,:@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string draw_folder(const Drawer& drawer, const std::string& folder) {
  if (drawer.script.empty()) return "";
  const std::string path = folder.starts_with('-') ? "./" + folder : folder;  // no option
  const auto later = [&](const std::string& python) {
    return "; to draw them: " + quoted(python) + " " + quoted(drawer.script) + " " + quoted(path);
  };
  std::string missing = "Python is not installed";
  for (const std::string& python : drawer.pythons) {
    // Without bytecode beside the script, which may be in a folder of the system's.
    const ChildEnd end = run_program({python, "-B", drawer.script, path});
    if (end.start_error == ENOENT) continue;
    if (end.start_error != 0)
      return "figures were not drawn, since " + python +
             " cannot be started: " + std::generic_category().message(end.start_error) + later(python);
    if (end.ended.empty()) return "";
    missing = "matplotlib is not installed";
    if (end.status != no_matplotlib)
      return "figures were not drawn, or not all: " + python + " ended " + end.ended + later(python) +
             (end.said.empty() ? "" : "\n" + end.said);
  }
  return "figures were not drawn, since " + missing + " (Debian: python3-matplotlib)" +
         later(drawer.pythons.empty() ? "python3" : drawer.pythons.front());
}

std::string python_that_draws(const Drawer& drawer) {
  for (const std::string& python : drawer.pythons) {
    const ChildEnd end =
        run_program({python, "-B", "-c", "import matplotlib, sys; sys.exit(matplotlib.__version_info__ < (3, 6))"});
    if (end.start_error == 0 && end.ended.empty()) return python;
  }
  return "";
}

}  // namespace banyan::study

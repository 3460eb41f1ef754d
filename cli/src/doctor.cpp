// SPDX-License-Identifier: MIT
// `banyan doctor`: what is there, what is missing, and what it is for.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "banyan/study/figure.hpp"
#include "banyan/version.hpp"
#include "beside.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "shipped.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;

struct Finding {
  std::string name;
  std::string place;   // "": it is missing
  std::string serves;  // what for
  std::string remedy;  // what to do about it
};

// The file of a program in PATH; "" if there is none.
std::string in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    std::string file = std::string(folder) + "/" + name;
    if (!folder.empty() && ::access(file.c_str(), X_OK) == 0 && !fs::is_directory(file)) return file;
  }
  return "";
}

std::string existing(const std::string& file) {
  std::error_code ignored;
  return !file.empty() && fs::exists(file, ignored) ? file : "";
}

std::string beside(const char* program) { return existing((fs::path(own_program()).parent_path() / program).string()); }

std::string library(const char* name) {
  void* const opened = ::dlopen(name, RTLD_LAZY);
  if (opened == nullptr) return "";
  ::dlclose(opened);
  return name;
}

std::vector<Finding> look() {
  std::error_code ignored;
  const fs::path here = fs::current_path(ignored);
  return {
      {"this folder", ::access(".", W_OK) == 0 ? here.string() : "", "banyan run leaves its results in out/",
       "it cannot be written to; say --out FOLDER, or go elsewhere"},
      {"scenarios", existing(shipped_scenarios()), "missions to begin with", "reinstall Banyan, or work in a clone"},
      {"web viewer", shipped_page(), "banyan view, banyan demo in the browser, --view",
       "in a clone ./banyan view builds it; or say where it is by BANYAN_PAGE"},
      {"browser opener", in_path("xdg-open"), "opens the web viewer; without it open the address by hand",
       "Debian: xdg-utils"},
      {"librsvg", library("librsvg-2.so.2"), "PNG of banyan draw, and banyan film (SVG needs nothing)",
       "Debian: librsvg2-2, fonts-dejavu-core"},
      {"ffmpeg", in_path("ffmpeg"), "banyan film", "Debian: ffmpeg"},
      {"matplotlib", study::python_that_draws({shipped_figures()}), "figures of banyan study and banyan tune",
       "Debian: python3-matplotlib; or pip install matplotlib"},
      {"banyan-tune", beside("banyan-tune"), "banyan tune", "build the target banyan_tune (Debian: libpagmo-dev)"},
      {"banyan-robot", beside("banyan-robot"), "banyan fleet, banyan robot",
       "build the target banyan_robot (Debian: libsodium-dev)"},
      {"banyan-ros2", beside("banyan-ros2"), "banyan ros2: fleets with ROS 2",
       "build the target banyan_ros2 (Debian: cyclonedds-dev, cyclonedds-tools)"},
      {"ip", in_path("ip"), "banyan fleet: a network namespace per robot; without it robots share one",
       "Debian: iproute2"},
      {"mpirun", in_path("mpirun"), "studies and tunings over several machines", "Debian: openmpi-bin"},
      {"argos3", in_path("argos3"), "runs what banyan argos writes", "see docs/argos.md"},
  };
}

// What this program was built without is of no use, whatever the machine has.
void leave_out_missing_features(std::vector<Finding>& findings) {
  const std::string missing = ", " + std::string(missing_features) + ",";
  for (const auto& [feature, name] :
       {std::pair{"pixels", "librsvg"}, {"pixels", "ffmpeg"}, {"fleets", "ip"}, {"mpi", "mpirun"}}) {
    if (missing.find(std::string(", ") + feature + ",") == std::string::npos) continue;
    for (Finding& f : findings) {
      if (f.name != name) continue;
      f.place.clear();
      f.remedy = "this banyan was built without " + std::string(feature) + " (banyan --version)";
    }
  }
}

int doctor_command(bool as_json) {
  auto findings = look();
  leave_out_missing_features(findings);
  if (as_json) {
    auto list = nlohmann::ordered_json::array();
    for (const Finding& f : findings)
      list.push_back(
          {{"name", f.name}, {"found", !f.place.empty()}, {"place", f.place}, {"for", f.serves}, {"remedy", f.remedy}});
    print(nlohmann::ordered_json{{"version", version}, {"git", git_id()}, {"findings", list}}.dump(
              2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
          "\n");
    return exit_done;
  }
  std::string text = "banyan " + std::string(version) + " (git " + std::string(git_id()) + "), " +
                     plural(std::thread::hardware_concurrency(), "core") + "\n\n";
  std::size_t missing = 0;
  for (const Finding& f : findings) {
    const bool is_there = !f.place.empty();
    missing += is_there ? 0 : 1;
    text += format("  %-8s %-15s %s\n", is_there ? "ok" : "missing", f.name.c_str(), f.serves.c_str());
    if (!is_there) text += format("  %-8s %-15s -> %s\n", "", "", f.remedy.c_str());
  }
  text += missing == 0 ? "\nEverything is there.\n"
                       : (missing == 1 ? "\n1 thing is missing, and"
                                       : "\n" + std::to_string(missing) + " things are missing, and") +
                             " only what is listed beside needs it.\n";
  print_text(text);
  return exit_done;
}

}  // namespace

void add_doctor(CLI::App& command, CommandAction& action) {
  auto as_json = std::make_shared<bool>(false);
  command.footer(
      "Changes nothing. What is missing is needed only by what stands beside it.\n\nExamples:\n  banyan doctor");
  command.add_flag("--json", *as_json, "as JSON, with the place of each");
  action = [as_json] { return doctor_command(*as_json); };
}

}  // namespace banyan::cli

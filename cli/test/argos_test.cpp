// SPDX-License-Identifier: MIT
// `banyan argos`, and what it writes played in ARGoS itself, started from wherever. Where ARGoS was not found when this
// was built, those tests are skipped and say so.
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>

#include "started_program.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;

std::string scenario(const std::string& name) { return std::string(BANYAN_SCENARIOS) + "/" + name + ".toml"; }

class ArgosCommand : public StartedProgram {
 protected:
  void write_experiment(const std::string& name, const std::string& of, Arguments more = {}) {
    Arguments arguments{"argos", scenario(of), "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  void replace(const std::string& file, const std::string& old, const std::string& by) {
    std::string text = read(file);
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old << " in " << text;
    write(file, text.replace(at, old.size(), by));
  }
};

TEST_F(ArgosCommand, WritesAnExperimentAndItsWorld) {
  const Outcome outcome = run(
      {"argos", scenario("paper-medium"), "-o", "medium.argos", "--set", "mission.algorithm=convoy", "--seed", "7"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "medium.argos: 63 robots, 4 targets")) << outcome.out;
  const std::string experiment = read("medium.argos");
  EXPECT_TRUE(has(experiment, "scenario=\"" + fs::canonical(home_).string() + "/medium.world.toml\"")) << experiment;
  EXPECT_TRUE(has(experiment, "out=\"" + fs::canonical(home_).string() + "/medium\"")) << experiment;
  EXPECT_TRUE(has(experiment, "random_seed=\"7\""));
  EXPECT_EQ(run({"validate", "medium.world.toml", "-q"}).code, 0);
  EXPECT_TRUE(has(run({"validate", "medium.world.toml"}).out, "convoy"));
}

TEST_F(ArgosCommand, ReplacesNothingUnasked) {
  write_experiment("a.argos", "three-targets");
  write("a.argos", "mine");
  EXPECT_NE(run({"argos", scenario("three-targets"), "-o", "a.argos"}).code, 0);
  EXPECT_EQ(read("a.argos"), "mine");
  EXPECT_EQ(run({"argos", scenario("three-targets"), "-o", "a.argos", "--force"}).code, 0);
  EXPECT_TRUE(has(read("a.argos"), "force=\"true\""));
}

TEST_F(ArgosCommand, RefusesWhatArgosCannotDo) {
  const Outcome outcome = run({"argos", scenario("three-targets"), "-o", "a.argos", "--set", "radio.latency_ticks=3",
                               "--set", "radio.slots=4"});
  EXPECT_EQ(outcome.code, exit_usage);
  EXPECT_TRUE(has(outcome.err, "radio.latency_ticks")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "radio.slots")) << outcome.err;
  EXPECT_FALSE(exists("a.argos"));
  EXPECT_FALSE(exists("a.world.toml"));
  EXPECT_EQ(run({"argos", scenario("three-targets"), "-o", "a.xml"}).code, exit_usage);
  EXPECT_TRUE(
      has(run({"argos", scenario("three-targets"), "-o", "a.argos", "--set", "radio.lost=1"}).err, "radio.loss"));
}

// ---- In ARGoS ----

class InArgos : public ArgosCommand {
 protected:
  void SetUp() override {
    ArgosCommand::SetUp();
    if (*BANYAN_ARGOS_PROGRAM == '\0') GTEST_SKIP() << "ARGoS 3 was not found when this was built";
  }
  pid_t start_argos(const std::string& experiment, const std::string& directory = "") {
    return start({"-z", "-n", "-c", experiment},
                 {.directory = directory,
                  .program = BANYAN_ARGOS_PROGRAM,
                  .environment = {{"LD_LIBRARY_PATH", fs::path(BANYAN_ARGOS_CORE).parent_path().string()}}});
  }
  Outcome argos(const std::string& experiment, const std::string& directory = "") {
    return finish(start_argos(experiment, directory));
  }
  nlohmann::json result(const std::string& folder) {
    return nlohmann::json::parse(read(folder + "/run.json"), nullptr, false);
  }
  std::vector<std::string> files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(home_))
      if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(home_).string());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string column(const std::string& folder, const std::string& wanted) {
    std::istringstream file(read(folder + "/run.csv"));
    std::string header, row;
    std::getline(file, header);
    std::getline(file, row);
    std::istringstream names(header), values(row);
    for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
      if (name == wanted) return value;
    return "no such column";
  }
};

TEST_F(InArgos, AMissionLeavesItsResultsInOneFolderFromWhereverItIsStarted) {
  fs::create_directories(home_ / "there");
  write_experiment("there/three.argos", "three-targets");
  fs::create_directories(home_ / "elsewhere");
  const Outcome outcome = argos((home_ / "there/three.argos").string(), "elsewhere");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "banyan: complete at ")) << outcome.out;
  EXPECT_EQ(files(),
            (std::vector<std::string>{"stderr.txt", "stdout.txt", "there/three.argos", "there/three.world.toml",
                                      "there/three/run.csv", "there/three/run.json", "there/three/run.mcap"}));
  EXPECT_EQ(run({"export", "there/three/run.mcap", "-o", "robots.csv"}).code, 0);
  EXPECT_GT(fs::file_size(home_ / "robots.csv"), 10000U);
  // The same mission in our world takes as long, to a twentieth.
  ASSERT_EQ(run({"run", scenario("three-targets"), "--out", "ours", "-q"}).code, 0);
  const double ours = std::stod(column("ours", "completion_time_s"));
  EXPECT_NEAR(std::stod(column("there/three", "completion_time_s")), ours, 0.05 * ours);
}

// The page follows a recording that grows; here it is read while ARGoS computes an hour.
TEST_F(InArgos, AMissionCanBeWatchedWhileItRuns) {
  write_experiment(
      "a.argos", "three-targets",
      {"--set", "output.live=true", "--set", "mission.stop_when_complete=false", "--set", "mission.time_limit_s=3600"});
  const pid_t there = start_argos("a.argos");
  const auto seconds_recorded = [&] {
    if (!exists("a/run.mcap.part") ||
        run({"export", "a/run.mcap.part", "-o", "table.csv", "--every", "10", "--force"}).code != 0)
      return 0L;
    const std::string table = read("table.csv");
    return std::count(table.begin(), table.end(), '\n') / 18;  // a line for each robot
  };
  long first = 0, later = 0;
  for (int look = 0; look < 100 && later <= first; ++look) {
    ::usleep(100'000);
    (first == 0 ? first : later) = seconds_recorded();
  }
  EXPECT_GT(first, 0);
  EXPECT_GT(later, first);
  EXPECT_EQ(::waitpid(there, nullptr, WNOHANG), 0) << "it had ended";
  ::kill(there, SIGINT);
  EXPECT_EQ(finish(there).code, 0);
  EXPECT_TRUE(exists("a/run.mcap"));
}

// What is written in the .argos file counts, and is what the results say.
TEST_F(InArgos, TheExperimentHasTheLastWord) {
  write_experiment("a.argos", "three-targets", {"--sight", "exact"});
  replace("a.argos", "algorithm=\"convoy\"", "algorithm=\"outwards\"");
  replace("a.argos", "random_seed=\"1\"", "random_seed=\"9\"");
  replace("a.argos", "medium=\"rab\"", "medium=\"rab\" packet_drop_prob=\"0.2\"");
  replace("a.argos", "length=\"0\"", "length=\"3\"");
  replace("a.argos", "<params algorithm", "<params target_gain=\"0.7\" algorithm");
  const Outcome outcome = argos("a.argos");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  for (const auto& [name, value] :
       {std::pair{"algorithm", "outwards"}, {"seed", "9"}, {"ticks", "30"}, {"complete", "false"}})
    EXPECT_EQ(column("a", name), value);
  EXPECT_EQ(std::stod(column("a", "loss")), 0.2);
  EXPECT_EQ(result("a")["config"]["mission"]["parameters"]["target_gain"], 0.7);
}

TEST_F(InArgos, RunsRepeatWhereSightIsExact) {
  for (const char* name : {"one", "two"}) {
    write_experiment(std::string(name) + ".argos", "khepera-three-targets",
                     {"--sight", "exact", "--set", "mission.algorithm=convoy"});
    ASSERT_EQ(argos(std::string(name) + ".argos").code, 0);
  }
  EXPECT_EQ(column("one", "hash"), column("two", "hash"));
  EXPECT_EQ(column("one", "complete"), "true");
}

TEST_F(InArgos, MistakesAreNamed) {
  write_experiment("a.argos", "three-targets");
  replace("a.argos", "range_m=\"2\"", "rnage_m=\"2\"");
  const Outcome parameter = argos("a.argos");
  EXPECT_NE(parameter.code, 0);
  EXPECT_TRUE(has(parameter.out + parameter.err, "did you mean range_m?")) << parameter.out << parameter.err;
  write_experiment("b.argos", "three-targets");
  replace("b.argos", "obstacles=", "obstacle=");
  const Outcome option = argos("b.argos");
  EXPECT_NE(option.code, 0);
  EXPECT_TRUE(has(option.out + option.err, "did you mean obstacles?")) << option.out << option.err;
}

TEST_F(InArgos, FootBotsFindALight) {
  write_experiment("light.argos", "three-targets",
                   {"--robot", "foot-bot", "--set", "targets.count=1", "--set", "swarm.robots=9"});
  replace("light.argos", "<positioning implementation=\"default\" />",
          "<footbot_light implementation=\"rot_z_only\" />");
  replace("light.argos", "<media>", "<media><led id=\"leds\" />");
  const Outcome outcome = argos("light.argos");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(column("light", "complete"), "true");
  // It does not tell lights apart.
  write_experiment("lights.argos", "three-targets", {"--robot", "foot-bot"});
  replace("lights.argos", "<positioning implementation=\"default\" />",
          "<footbot_light implementation=\"rot_z_only\" />");
  EXPECT_TRUE(has(argos("lights.argos").err, "does not tell 3 targets apart"));
}

// Robots of the arena's own, without our loop functions: each controller says how its robots begin.
TEST_F(InArgos, RobotsBeginAsTheirControllersSay) {
  write_experiment("a.argos", "khepera-two-targets", {"--set", "mission.algorithm=convoy"});
  std::string text = read("a.argos");
  const std::size_t begin = text.find("<banyan_controller"), end = text.find("</banyan_controller>") + 20;
  const std::string spare = text.substr(begin, end - begin);
  const auto with = [&](const std::string& id, const std::string& words) {
    std::string controller = spare;
    controller.replace(controller.find("id=\"banyan\""), 11, "id=\"" + id + "\"");
    return controller.replace(controller.find("<params "), 8, "<params " + words + " ");
  };
  text.replace(begin, end - begin,
               with("worker", "role=\"worker\" target_m=\"1.5,0\"") + with("root", "role=\"root\"") +
                   with("spare", "role=\"spare\""));
  const std::size_t loop = text.find("<loop_functions"), after = text.find("</loop_functions>") + 17;
  text.erase(loop, after - loop);
  std::string robots;
  for (int k = 0; k < 3; ++k)
    robots += "<kheperaiv id=\"kh" + std::to_string(k) + "\" rab_range=\"2\" rab_data_size=\"96\"><body position=\"" +
              std::to_string(0.3 * k) + ",0,0\" orientation=\"0,0,0\" /><controller config=\"" +
              (k == 0   ? "root"
               : k == 1 ? "spare"
                        : "worker") +
              "\" /></kheperaiv>";
  text.replace(text.find("center=\"0,0,0.4\" />"), 20, "center=\"0,0,0.4\">" + robots + "</arena>");
  text.replace(text.find("length=\"0\""), 10, "length=\"5\"");
  write("b.argos", text);
  const Outcome outcome = argos("b.argos");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  text.replace(text.find("rab_data_size=\"96\""), 18, "rab_data_size=\"10\"");
  write("b.argos", text);
  const Outcome small = argos("b.argos");
  EXPECT_NE(small.code, 0);
  EXPECT_TRUE(has(small.out + small.err, "say rab_data_size=\"96\"")) << small.err;
}

TEST_F(InArgos, FootBotsDieAndObstaclesStand) {
  write_experiment("dead.argos", "deaths", {"--robot", "foot-bot", "--set", "mission.time_limit_s=60"});
  ASSERT_EQ(argos("dead.argos").code, 0);
  EXPECT_NE(column("dead", "deaths"), "0");
  EXPECT_EQ(column("dead", "complete"), "true");
  write_experiment("gap.argos", "wall-with-gap", {"--obstacles", "world", "--set", "mission.algorithm=convoy"});
  ASSERT_EQ(argos("gap.argos").code, 0);
  EXPECT_EQ(column("gap", "complete"), "true");
}

}  // namespace
}  // namespace banyan::cli

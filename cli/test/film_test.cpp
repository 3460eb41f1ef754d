// SPDX-License-Identifier: MIT
// Pictures and films of a recording, made by the program and read back by ffprobe.
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "started_program.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

class Film : public StartedProgram {
 protected:
  void SetUp() override {
    StartedProgram::SetUp();
    write("small.toml", "[swarm]\nrobots = 8\n[targets]\ncount = 2\nradius_m = 1.5\n");
    const auto made = run({"run", "small.toml", "-q", "--out", "o", "--set", "mission.time_limit_s=5"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  // What ffprobe says of the only stream, every frame decoded and counted.
  json probe(const std::string& file) {
    const auto outcome =
        finish(start({"-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json", file},
                     {.program = "ffprobe"}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto all = json::parse(outcome.out, nullptr, false);
    if (!all.is_object() || all["streams"].size() != 1) return {};
    json stream = all["streams"][0];
    stream["format_duration"] = all["format"]["duration"];
    return stream;
  }
  void expect_nothing_left(const std::string& name) {
    EXPECT_FALSE(exists(name));
    EXPECT_FALSE(exists(name + ".part"));
  }
};

// One second of the run at half speed: 2 s, and the last frame for one more.
TEST_F(Film, AnMp4HasItsFramesItsSizeAndItsLength) {
  const auto outcome = run({"film", "o/run.mcap", "-o", "a.mp4", "--fps", "10", "--speed", "0.5", "--from", "1", "--to",
                            "2", "--width", "320", "--height", "200", "--ids"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(has(outcome.err, "1 s to 2 s at 0.5x: 3.1 s of film, 31 frames of 320 x 200")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "wrote a.mp4, ")) << outcome.err;
  const json film = probe("a.mp4");
  EXPECT_EQ(film["codec_name"], "h264");
  EXPECT_EQ(film["pix_fmt"], "yuv420p");
  EXPECT_EQ(film["width"], 320);
  EXPECT_EQ(film["height"], 200);
  EXPECT_EQ(film["nb_read_frames"], "31");
  EXPECT_EQ(film["r_frame_rate"], "10/1");
  EXPECT_NEAR(std::stod(film["format_duration"].get<std::string>()), 3.1, 0.02);
  const std::string bytes = read("a.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));  // the index first: it plays while it is loaded
  EXPECT_FALSE(exists("a.mp4.part"));
}

TEST_F(Film, AGifAndAWebmToo) {
  for (const auto& [name, codec] : {std::pair{"a.gif", "gif"}, {"a.webm", "vp9"}}) {
    const auto outcome = run({"film", "o/run.mcap", "-o", name, "--fps", "10", "--speed", "4", "--to", "2", "--width",
                              "240", "--height", "160", "-q", "--dark", "--no-links", "--trail", "0"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const json film = probe(name);
    EXPECT_EQ(film["codec_name"], codec);
    EXPECT_EQ(film["width"], 240);
    EXPECT_EQ(film["height"], 160);
    EXPECT_EQ(film["nb_read_frames"], "16") << name;  // 0, 0.4 .. 2.0 s, and ten
  }
  EXPECT_TRUE(has(read("a.gif"), "NETSCAPE2.0"));  // goes round
}

TEST_F(Film, WithoutOptionsItIsHdAndAsLongAsItShouldBe) {
  const auto outcome = run({"film", "o/run.mcap", "-o", "a.mp4", "--fps", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.err, " s at 1x: ")) << outcome.err;  // five seconds need no haste
  const json film = probe("a.mp4");
  EXPECT_EQ(film["width"], 1280);
  EXPECT_EQ(film["height"], 720);
}

TEST_F(Film, WhatIsWrongIsSaidBeforeAnythingIsDone) {
  write("there.mp4", "mine");
  const auto refuse = [&](Arguments more, const std::string& reason, int code = 2) {
    Arguments arguments{"film", "o/run.mcap"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_TRUE(has(outcome.err, reason)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    expect_nothing_left("a.mp4");
  };
  refuse({"-o", "a.avi"}, "a.avi: the ending of a film must be .mp4, .webm or .gif");
  refuse({"-o", "there.mp4"}, "there.mp4 exists; add --force to replace it");
  refuse({"-o", "a.mp4", "--width", "321"}, "must be an even number of 200 to 7680, not \"321\"");
  refuse({"-o", "a.mp4", "--height", "x"}, "must be an even number");
  refuse({"-o", "a.mp4", "--speed", "100"}, "--speed");
  refuse({"-o", "a.mp4", "--from", "3", "--to", "2"}, "nothing to show from 3 s to 2 s: the recording has 0 s to ");
  refuse({"-o", "a.mp4", "--from", "900"}, "nothing to show from 900 s");
  refuse({}, "--output");
  EXPECT_EQ(read("there.mp4"), "mine");
  const auto missing = run({"film", "missing.mcap", "-o", "a.mp4"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_TRUE(has(missing.err, "missing.mcap: cannot open")) << missing.err;
}

TEST_F(Film, ARecordingWithoutFramesIsNoFilm) {
  // Its only chunks are gone: what is left is the head of the file.
  const std::string bytes = read("o/run.mcap");
  write("empty.mcap.part", bytes.substr(0, bytes.find("(\xB5/\xFD")));
  const auto outcome = run({"film", "empty.mcap.part", "-o", "a.mp4"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "the recording holds no frames")) << outcome.err;
  expect_nothing_left("a.mp4");
}

TEST_F(Film, WithoutFfmpegItSaysWhatToInstall) {
  fs::create_directory(home_ / "bin");
  const auto outcome =
      finish(start({"film", "o/run.mcap", "-o", "a.mp4"}, {.environment = {{"PATH", (home_ / "bin").string()}}}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "films are made by ffmpeg, which is not installed (Debian's package: ffmpeg)"))
      << outcome.err;
  expect_nothing_left("a.mp4");
}

TEST_F(Film, AnFfmpegThatGivesUpIsQuotedAndLeavesNothing) {
  write("bin/ffmpeg", "#!/bin/sh\nfor i in 1 2 3 4 5 6 7 8 9; do echo \"line $i\" >&2; done\nexit 7\n");
  fs::permissions(home_ / "bin/ffmpeg", fs::perms::owner_all);
  const auto outcome = finish(start({"film", "o/run.mcap", "-o", "a.mp4"},
                                    {.environment = {{"PATH", (home_ / "bin").string() + ":/usr/bin:/bin"}}}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "a.mp4: ffmpeg has given up (exit code 7); the last that it said:\nline 5\n"))
      << outcome.err;
  EXPECT_TRUE(has(outcome.err, "line 9\n")) << outcome.err;
  EXPECT_FALSE(has(outcome.err, "line 4\n")) << outcome.err;
  expect_nothing_left("a.mp4");

  if (!fs::exists("/usr/bin/ffmpeg")) return;
  const auto folder = run({"film", "o/run.mcap", "-o", "no/such/a.mp4"});
  EXPECT_EQ(folder.code, 1);
  EXPECT_TRUE(has(folder.err, "No such file or directory")) << folder.err;
}

// A parent that ignores its children's ends passes that on.
TEST_F(Film, AnFfmpegThatFailsAtTheEndIsNoticedWhoeverStartedUs) {
  write("bin/ffmpeg", "#!/bin/sh\ncat >/dev/null\nexit 7\n");
  fs::permissions(home_ / "bin/ffmpeg", fs::perms::owner_all);
  const auto outcome =
      run({"film", "o/run.mcap", "-o", "a.mp4"},
          {.environment = {{"PATH", (home_ / "bin").string() + ":/usr/bin:/bin"}}, .ignores_children = true});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(has(outcome.err, "a.mp4: ffmpeg has given up (exit code 7)")) << outcome.err;
  expect_nothing_left("a.mp4");
}

TEST_F(Film, AFolderIsRefusedBeforeAnythingIsDone) {
  fs::create_directory(home_ / "d.mp4");
  for (const bool force : {false, true}) {
    Arguments arguments{"film", "o/run.mcap", "-o", "d.mp4"};
    if (force) arguments.emplace_back("--force");
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.err, "d.mp4 is a directory")) << outcome.err;
  }
}

// Before the first frame, while frames come, and while ffmpeg makes a GIF of them.
TEST_F(Film, CtrlCLeavesNoHalfFile) {
  for (const char* name : {"a.mp4", "a.gif"}) {
    for (const auto wait : {0ms, 1500ms}) {
      write("old", "old");
      fs::rename(home_ / "old", home_ / name);
      fs::remove(home_ / "stderr.txt");  // of the film before: it must not be taken for this one's
      const pid_t child = start({"film", "o/run.mcap", "-o", name, "--force", "--speed", "0.1", "--fps", "60"});
      for (int k = 0; k < 1000 && !exists("stderr.txt"); ++k) std::this_thread::sleep_for(10ms);
      for (int k = 0; k < 1000 && !has(read("stderr.txt"), " of film, "); ++k) std::this_thread::sleep_for(10ms);
      std::this_thread::sleep_for(wait);
      ASSERT_EQ(::kill(child, SIGINT), 0);
      const auto outcome = finish(child);
      EXPECT_EQ(outcome.code, 130) << outcome.err;
      EXPECT_TRUE(has(outcome.err, "stopped by Ctrl-C; there is no film")) << outcome.err;
      EXPECT_EQ(read(name), "old");
      EXPECT_FALSE(exists(std::string(name) + ".part"));
    }
  }
}

// --------------------------------------------------------------------------------------- pictures

TEST_F(Film, APictureIsAPngByItsNameOrByFormat) {
  const auto by_name = run({"draw", "o/run.mcap", "--at", "2", "--width", "320", "-o", "a.png"});
  ASSERT_EQ(by_name.code, 0) << by_name.err;
  EXPECT_TRUE(read("a.png").starts_with("\x89PNG"));
  EXPECT_EQ(read("a.png").substr(16, 4), std::string("\0\0\1\x40", 4));
  const auto by_format = run({"draw", "o/run.mcap", "--at", "2", "--width", "320", "--format", "png"});
  EXPECT_EQ(by_format.out, read("a.png"));
  EXPECT_TRUE(has(run({"draw", "o/run.mcap", "--format", "svg"}).out, "</svg>"));
  ASSERT_EQ(run({"draw", "o/run.mcap", "--format", "svg", "--dark", "-o", "b.png"}).code, 0);
  EXPECT_TRUE(read("b.png").starts_with("<svg"));
  const auto odd = run({"draw", "o/run.mcap", "-o", "a.jpg"});
  EXPECT_EQ(odd.code, 2);
  EXPECT_TRUE(has(odd.err, "a.jpg: \".jpg\" is no picture that banyan draws; use .svg or .png, or --format"))
      << odd.err;
  EXPECT_EQ(run({"draw", "o/run.mcap", "--format", "jpg"}).code, 2);
}

}  // namespace
}  // namespace banyan::cli

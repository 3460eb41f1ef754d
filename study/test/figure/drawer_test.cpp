// SPDX-License-Identifier: MIT
// Drawing by Python, and everything that can go wrong with it. Most interpreters here are shell scripts.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "../temporary_folder.hpp"
#include "banyan/study/figure.hpp"

namespace banyan::study {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class FigureDrawer : public TemporaryFolder {
 protected:
  // A Python of that name.
  [[nodiscard]] std::string python(const std::string& name, const std::string& body) const {
    write(name, "#!/bin/sh\n" + body + "\n");
    ::chmod(path(name).c_str(), 0755);
    return path(name);
  }
  [[nodiscard]] std::string told(const std::vector<std::string>& pythons) const {
    return draw_folder({"/there/figures.py", pythons}, path("figures"));
  }
};

TEST_F(FigureDrawer, HasPythonDrawAFolder) {
  const std::string good = python("good", "echo \"$@\" > \"$0.words\"; cat > \"$0.input\"");
  EXPECT_EQ(told({good, path("never")}), "");
  EXPECT_EQ(read("good.words"), "-B /there/figures.py " + path("figures") + "\n");
  EXPECT_EQ(read("good.input"), "") << "and it does not wait for our input";
  EXPECT_EQ(draw_folder({}, path("figures")), "") << "no script, no pictures";
  (void)draw_folder({"/there/figures.py", {good}}, "-x");
  EXPECT_EQ(read("good.words"), "-B /there/figures.py ./-x\n") << "no option";
}

TEST_F(FigureDrawer, SaysHowToGetWhatIsMissing) {
  const std::string bare = python("bare", "exit 3");  // as figures.py ends without matplotlib
  const std::string later = "(Debian: python3-matplotlib); to draw them: ";
  EXPECT_EQ(told({path("none")}), "figures were not drawn, since Python is not installed " + later + path("none") +
                                      " /there/figures.py " + path("figures"));
  const std::string no_matplotlib = "figures were not drawn, since matplotlib is not installed " + later;
  EXPECT_TRUE(told({bare, path("none")}).starts_with(no_matplotlib + bare)) << told({bare, path("none")});
  EXPECT_TRUE(told({path("none"), bare}).starts_with(no_matplotlib));
  EXPECT_EQ(told({bare, python("good", "exit 0")}), "") << "another one has it";
}

TEST_F(FigureDrawer, TellsWhatPythonSaid) {
  const std::string bad = python("bad", "echo 'drawing'; echo 'time.json: no room on the disk' >&2; exit 1");
  const std::string said = told({bad, python("good", "exit 0")});
  EXPECT_TRUE(said.starts_with("figures were not drawn, or not all: " + bad + " ended with status 1; to draw them: "))
      << said;
  EXPECT_TRUE(said.ends_with("\ndrawing\ntime.json: no room on the disk")) << said;
  EXPECT_TRUE(holds(told({python("killed", "kill -9 $$")}), "by signal 9"));
  write("no-program", "");
  EXPECT_TRUE(holds(told({path("no-program")}), "cannot be started"));
}

TEST_F(FigureDrawer, KeepsTheEndOfALotOfMessages) {
  const std::string said = told({python("loud",
                                        "i=0; while [ $i -lt 3000 ]; do echo 'a rather long line of an error message'; "
                                        "i=$((i+1)); done; echo end; exit 1")});
  EXPECT_GT(said.size(), 1000U);
  EXPECT_LT(said.size(), 10000U);
  EXPECT_TRUE(said.ends_with("\nend"));
}

// The command that it names does it.
TEST_F(FigureDrawer, ItsCommandIsForAShell) {
  const std::string odd =
      python("it's a python", "test -e \"$0.failed\" || { touch \"$0.failed\"; exit 1; }; echo \"$2\" > \"$0.drew\"");
  const std::string said = draw_folder({"/there/figures.py", {odd}}, "/a \"folder\"/$x");
  const std::string command = said.substr(said.find("draw them: ") + 11);
  // As a user would: NOLINTNEXTLINE(cert-env33-c)
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_EQ(read("it's a python.drew"), "/a \"folder\"/$x\n");
}

// With figures.py itself, once: all that a figure may hold.
TEST_F(FigureDrawer, DrawsWhatFiguresMayHold) {
  BoxFigure figure;
  figure.title = "$x_1$ \x01 50% <b>\nit's";
  figure.groups = {"1", "2"};
  figure.outer = {{"T", {"2", "3"}, {"T = 2", "T = 3"}}};
  for (std::size_t s = 0; s < most_series; ++s) figure.series.push_back({"_s", s, most_variants - 1});
  figure.measures = {{"time", Scale::log, {}, {}, 1.0, {}, true}, {"done", Scale::linear, {}, {}, {}, 0.9}};
  const std::vector<BoxRuns> boxes(most_series, BoxRuns{{0.0, 1.0}, 0});
  figure.panels = {{"a", 0, {boxes, boxes}}, {"b", 1, {boxes, boxes}}};
  figure.panels[0].boxes[0][0].missed = 3;
  CurveFigure curves;
  curves.curves.assign(most_series, {"c", {0, 1}, {1, std::nan("")}, {0, 0}, {2, 2}, true});
  std::filesystem::create_directory(path("figures"));
  write("figures/boxes.json", figure_json(figure));
  write("figures/curves.json", figure_json(curves));
  EXPECT_EQ(draw_folder({BANYAN_FIGURES_SCRIPT}, path("figures")), "");
  for (const char* name : {"boxes", "curves"}) {
    for (const char* kind : {".svg", ".pdf", ".png"})
      EXPECT_TRUE(exists("figures/" + std::string(name) + kind)) << name << kind;
  }
  EXPECT_TRUE(holds(read("figures/boxes.svg"), "$x_1$")) << "no markup";
}

}  // namespace
}  // namespace banyan::study

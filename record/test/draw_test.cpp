// SPDX-License-Identifier: MIT
// Pictures: well-formed, complete, and with the links that geometry says.
#include "banyan/record/draw.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "banyan/record/palette.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

// Tags opened and closed in order, quotes paired, no stray '<' or '&': enough of XML for what we write.
bool well_formed(std::string_view svg) {
  std::vector<std::string_view> open;
  std::size_t at = 0;
  while ((at = svg.find('<', at)) != std::string_view::npos) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string_view::npos) return false;
    const std::string_view tag = svg.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string_view::npos) return false;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    const std::string_view name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  for (std::size_t k = 0; (k = svg.find('&', k)) != std::string_view::npos; ++k) {
    if (svg.find(';', k) > k + 6) return false;
  }
  return open.empty() && svg.find("nan") == std::string_view::npos && svg.find("null") == std::string_view::npos;
}

std::size_t count(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t k = 0; (k = text.find(what, k)) != std::string_view::npos; ++k) ++n;
  return n;
}

TEST(Draw, AMapIsOnePathOfFewRectangles) {
  Setting setting = test::sample_setting();
  world::FloorMap map;
  map.cell_m = 0.05;
  map.origin = {-2.0, -2.0};
  map.cells = std::make_shared<const world::CellGrid>(world::CellGrid::from_text("2*200#\n196*2#196.2#\n2*200#"));
  setting.obstacles = {map};
  const std::string svg = draw_svg(setting, test::sample_frame(9, 1.0, 30), {}, {});
  EXPECT_TRUE(well_formed(svg));
  const auto from = svg.find("crispEdges");
  ASSERT_NE(from, std::string::npos);
  EXPECT_EQ(svg.find("crispEdges", from + 1), std::string::npos);
  EXPECT_EQ(count(svg.substr(from, svg.find('\n', from) - from), "Z"), 4U) << "of 1,584 cells";
}

TEST(Draw, ShowsEveryRobotTargetAndTheProvenance) {
  Setting setting = test::sample_setting();
  for (const std::size_t n : {9U, 94U, 1000U}) {
    PictureOptions options;
    options.legend = false;
    const Frame frame = test::sample_frame(n, 0.3 * std::sqrt(static_cast<double>(n)), 300);
    const std::string svg = draw_svg(setting, frame, {}, options);
    EXPECT_TRUE(well_formed(svg)) << n;
    for (const Role role : {Role::root, Role::worker, Role::connector, Role::spare}) {
      const auto robots = static_cast<std::size_t>(std::count_if(
          frame.robots.begin(), frame.robots.end(), [&](const RobotFrame& r) { return r.alive && r.role == role; }));
      EXPECT_EQ(count(svg, "<use href=\"#" + std::string(name_of(role)) + "-"), robots) << name_of(role);
      EXPECT_EQ(count(svg, "<g id=\"" + std::string(name_of(role)) + "-"), 1U);
      EXPECT_NE(svg.find(color_of(role).hex), std::string::npos);
    }
    EXPECT_EQ(count(svg, ">T0<") + count(svg, ">T1<"), frame.targets.size());
    EXPECT_NE(svg.find("t = 30.0 s"), std::string::npos);
    EXPECT_NE(svg.find("outwards"), std::string::npos);
    EXPECT_NE(svg.find("seed 18446744073709551615"), std::string::npos);
    EXPECT_NE(svg.find("sample &quot;ring&quot; &lt;&amp;&gt;"), std::string::npos);
  }
}

TEST(Draw, EmptyExtremeAndBrokenFramesGiveAPicture) {
  const Setting setting = test::sample_setting();
  EXPECT_TRUE(well_formed(draw_svg(setting, {})));
  EXPECT_TRUE(well_formed(draw_svg({}, {})));
  Frame frame = test::sample_frame(5, 1.0, 3);
  frame.robots[1].position = {1e11, -1e11};
  frame.robots[2].parent = 77;
  frame.robots[3].old_parent = 5;
  frame.targets[0].worker = 99;
  EXPECT_TRUE(well_formed(draw_svg(setting, frame)));
}

// The number after `name="` in an SVG.
double attribute(std::string_view svg, const std::string& name) {
  const std::size_t at = svg.find(" " + name + "=\"");
  return at == std::string_view::npos ? -1.0 : std::stod(std::string(svg.substr(at + name.size() + 3, 20)));
}

TEST(Draw, APictureOfGivenSizeIsThatSizeWhateverItsShape) {
  const Setting setting = test::sample_setting();
  const Frame frame = test::sample_frame(94, 3.0, 300);
  PictureOptions options;
  options.steady = true;
  for (const auto& [width, height] : {std::pair{1280.0, 720.0}, {640.0, 400.0}, {300.0, 900.0}, {200.0, 150.0}}) {
    options.width_px = width;
    options.height_px = height;
    const std::string svg = draw_svg(setting, frame, {}, options);
    EXPECT_TRUE(well_formed(svg));
    EXPECT_EQ(attribute(svg, "width"), width);
    EXPECT_EQ(attribute(svg, "height"), height);
  }
}

// In a film only the world moves: the same view puts a target at the same place, whoever has gone where.
TEST(Draw, AGivenViewStandsStill) {
  const Setting setting = test::sample_setting();
  Frame frame = test::sample_frame(30, 3.0, 300);
  PictureOptions options;
  options.height_px = 720.0;
  options.steady = true;
  options.view = Viewport{{-6.0, -6.0}, {6.0, 6.0}};
  const auto place = [](const std::string& svg, const std::string& what) {
    const std::size_t end = svg.find(what);
    return svg.substr(svg.rfind("<text", end), end - svg.rfind("<text", end));
  };
  const std::string before = draw_svg(setting, frame, {}, options);
  for (RobotFrame& robot : frame.robots) robot.position = 1.5 * robot.position;
  frame.robots[4].alive = false;
  frame.robots[5].old_parent = 2;
  const std::string after = draw_svg(setting, frame, {}, options);
  for (const char* what : {">T0<", ">T1<", ">radio link<", ">target, tolerance<"})
    EXPECT_EQ(place(before, what), place(after, what)) << what;
  EXPECT_NE(after.find(">dead 2<"), std::string::npos);
  options.view.reset();
  EXPECT_NE(place(draw_svg(setting, frame, {}, options), ">T0<"), place(after, ">T0<"));
}

TEST(Draw, ViewsHoldEverythingAndJoin) {
  Setting setting = test::sample_setting();
  setting.obstacles.clear();
  Frame frame;
  const Viewport nothing = view_of(setting, frame);
  EXPECT_EQ(nothing.high - nothing.low, (Vec2{2.0, 2.0}));
  frame.robots.resize(2);
  frame.robots[1].position = {5.0, -3.0};
  const Viewport two = view_of(setting, frame);
  EXPECT_DOUBLE_EQ(two.high.x, 5.0 + setting.radius_m);
  EXPECT_DOUBLE_EQ(two.low.y, -3.0 - setting.radius_m);
  const Viewport all = joined({{0.0, 0.0}, {1.0, 1.0}}, {{-1.0, 0.5}, {0.5, 4.0}});
  EXPECT_EQ(all.low, (Vec2{-1.0, 0.0}));
  EXPECT_EQ(all.high, (Vec2{1.0, 4.0}));
}

TEST(Draw, DarkHasNoWhitePaperAndNoBlackInk) {
  PictureOptions options;
  options.dark = true;
  const std::string svg = draw_svg(test::sample_setting(), test::sample_frame(30, 3.0, 300), {}, options);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(svg.find("height=\"100%\" fill=\"#ffffff\""), std::string::npos);
  EXPECT_EQ(svg.find("fill=\"#000000\""), std::string::npos);
  EXPECT_NE(svg.find(color_of(Role::worker).hex), std::string::npos);  // roles keep their colours
}

TEST(TrailLog, EndsAtTheRobotAndIsAsLongAsWanted) {
  TrailLog log(2.0);
  Frame frame;
  frame.robots.resize(2);
  for (int t = 0; t <= 100; ++t) {
    frame.time_s = 0.1 * t;
    frame.robots[0].position = {frame.time_s, 0.0};  // 1 m/s; robot 1 stands
    log.add(frame);
  }
  const Trails trails = log.trails(frame);
  ASSERT_EQ(trails.size(), 2U);
  EXPECT_NEAR(trails[0].front().x, 8.0, 1e-9);
  EXPECT_EQ(trails[0].back(), frame.robots[0].position);
  EXPECT_LE(trails[0].size(), 6U);
  EXPECT_EQ(trails[1].size(), 1U);
  frame.time_s = 10.25;  // between samples: the old end moves on too
  frame.robots[0].position = {10.25, 0.0};
  EXPECT_NEAR(log.trails(frame)[0].front().x, 8.25, 1e-9);
  EXPECT_TRUE(TrailLog(0.0).trails(frame)[0].empty());
}

TEST(Draw, ATargetGivenUpIsFaint) {
  Frame frame = test::sample_frame(9, 1.0, 3);
  PictureOptions options;
  options.legend = false;
  const auto filled = [&] {
    return count(draw_svg(test::sample_setting(), frame, {}, options), "fill-opacity=\"0.18\"");
  };
  EXPECT_EQ(filled(), 2U);
  frame.targets[1].active = false;
  EXPECT_EQ(filled(), 1U);
  const std::string svg = draw_svg(test::sample_setting(), frame, {}, options);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find(">T1<"), std::string::npos);
}

TEST(Draw, TheVanishedHideNobody) {
  Setting setting;
  setting.line_of_sight = true;
  Frame frame;
  frame.robots.resize(3);
  frame.robots[1].position = {0.5, 0.02};
  frame.robots[2].position = {1.0, 0.0};
  frame.robots[1].alive = false;
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  EXPECT_EQ(radio_links(setting, frame).blocked, (Pairs{{0, 2}}));
  setting.dead_bodies = false;
  EXPECT_EQ(radio_links(setting, frame).open, (Pairs{{0, 2}}));
  frame.robots[1].alive = true;
  EXPECT_EQ(radio_links(setting, frame).blocked, (Pairs{{0, 2}}));
}

TEST(Draw, LinksAgreeWithBruteForce) {
  Setting setting = test::sample_setting();
  for (std::uint64_t round = 0; round < 20; ++round) {
    const Frame frame = test::sample_frame(60, 1.5 + 0.2 * static_cast<double>(round), 10 * round);
    setting.line_of_sight = round % 2 == 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open, blocked;
    for (std::uint32_t i = 0; i < 60; ++i) {
      for (std::uint32_t j = i + 1; j < 60; ++j) {
        const Vec2 a = frame.robots[i].position;
        const Vec2 d = frame.robots[j].position - a;
        if (!frame.robots[i].alive || !frame.robots[j].alive || norm(d) >= setting.range_m) continue;
        bool hidden = false;
        for (std::uint32_t k = 0; k < 60; ++k) {
          const Vec2 c = frame.robots[k].position - a;
          const double along = std::clamp(dot(c, d) / squared_norm(d), 0.0, 1.0);
          hidden = hidden || (k != i && k != j && norm(c - along * d) < setting.radius_m);
        }
        // The obstacles of the sample: a disc, a box and a wall, sampled along the segment.
        for (int s = 0; s <= 2000; ++s) {
          const Vec2 p = a + (s / 2000.0) * d;
          hidden = hidden || distance(p, Vec2{4.0, 0.1}) < 0.25;
          const Vec2 q = rotate_back(unit_vector(0.5), p - Vec2{-2.5, 1.0});
          hidden = hidden || (std::fabs(q.x) < 0.3 && std::fabs(q.y) < 0.1);
        }
        const Vec2 w{2.0, -0.5}, from = Vec2{-1.0, -2.0} - a;
        const double t = cross(from, w) / cross(d, w), u = cross(from, d) / cross(d, w);
        hidden = hidden || (t > 0.0 && t < 1.0 && u > 0.0 && u < 1.0);
        (setting.line_of_sight && hidden ? blocked : open).emplace_back(i, j);
      }
    }
    const RadioLinks links = radio_links(setting, frame);
    EXPECT_EQ(links.open, open) << round;
    EXPECT_EQ(links.blocked, blocked) << round;
  }
}

TEST(Draw, FromARecordingWithTrails) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 20, 100);
  Recording recording(directory.file("a.mcap"));
  PictureOptions options;
  options.trail_s = 3.0;
  const std::string svg = draw_svg(recording, 5.0, options);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("t = 5.0 s"), std::string::npos);
  EXPECT_NE(svg.find("trail, 3 s"), std::string::npos);
  options.trail_s = 0.0;
  EXPECT_EQ(draw_svg(recording, 5.0, options).find("trail"), std::string::npos);
}

}  // namespace
}  // namespace banyan::record

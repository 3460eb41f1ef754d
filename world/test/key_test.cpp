// SPDX-License-Identifier: MIT
#include "banyan/world/key.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace banyan::world {

// An owner of parts, one of them in a variant.
struct Engine {
  static constexpr std::string_view kind = "engine";
  double power = 1.0;
};
struct Sail {
  static constexpr std::string_view kind = "sail";
  double power = 2.0;
  std::optional<std::size_t> crew;
};
enum class Flag { none, red };
struct Boat {
  std::string name;
  Flag flag = Flag::none;
  int masts = 3;
  double course_rad = 0.0;
  std::variant<Engine, Sail> drive;
};
template <> struct NamesOf<Flag> { static constexpr std::string_view list[] = {"none", "red"}; };
template <> struct NamesOf<std::variant<Engine, Sail>> {
  static constexpr std::string_view list[] = {Engine::kind, Sail::kind};
};
template <> struct Parts<Boat> {
  template <class Part> static Part* find(Boat& boat) noexcept {
    if constexpr (std::is_same_v<Part, Boat>) return &boat;
    else return std::get_if<Part>(&boat.drive);
  }
};

namespace {

constexpr Key<Boat> flag{"boat.flag", of<&Boat::flag>, "", {}, "a flag"};
constexpr Key<Boat> masts{"boat.masts", of<&Boat::masts>, "", {0.0, 5.0}, "masts"};
constexpr Key<Boat> course{"boat.course_deg", of<&Boat::course_rad>, "deg", {}, "where to"};
constexpr Key<Boat> drive{"boat.drive", of<&Boat::drive>, "", {}, "what moves it"};
constexpr Key<Boat> power{"boat.power", of<&Engine::power, &Sail::power>, "", {}, "of the drive"};
constexpr Key<Boat> crew{"boat.crew", of<&Sail::crew>, "", {}, "who handles it"};

TEST(Key, ReachesTheMemberOfThePartThatIsThere) {
  Boat boat;
  EXPECT_EQ(std::get<double>(get(power, boat)), 1.0);
  EXPECT_FALSE(crew.access.applies(boat));
  EXPECT_EQ(get(crew, boat).index(), 0U);
  set(drive, boat, std::string("sail"));
  EXPECT_EQ(std::get<std::string>(get(drive, boat)), "sail");
  EXPECT_EQ(std::get<double>(get(power, boat)), 2.0);
  set(power, boat, 7.5);
  EXPECT_EQ(std::get<Sail>(boat.drive).power, 7.5);
  EXPECT_TRUE(crew.access.applies(boat));
  EXPECT_EQ(get(crew, boat).index(), 0U) << "it has a place, and nothing is given";
  set(crew, boat, std::int64_t{4});
  EXPECT_EQ(std::get<Sail>(boat.drive).crew, std::size_t{4});
}

TEST(Key, IsOfTheTypeOfItsMember) {
  Boat boat;
  EXPECT_EQ(flag.access.type, Type::name);
  EXPECT_EQ(masts.access.type, Type::whole);
  EXPECT_EQ(course.access.type, Type::number);
  EXPECT_TRUE(crew.access.optional);
  EXPECT_FALSE(masts.access.optional);
  set(flag, boat, std::string("red"));
  EXPECT_EQ(boat.flag, Flag::red);
  set(masts, boat, std::int64_t{-1});
  EXPECT_EQ(boat.masts, -1);
  EXPECT_EQ(flag.section(), "boat");
  EXPECT_EQ(flag.name(), "flag");
}

TEST(Key, AnEnumBeyondItsNamesHasNone) {
  Boat boat;
  boat.flag = static_cast<Flag>(2);
  EXPECT_EQ(std::get<std::string>(get(flag, boat)), "");
}

TEST(Key, AnglesAreDegreesOutsideAndTheSameRadiansAgain) {
  Boat boat;
  set(course, boat, 90.0);
  EXPECT_DOUBLE_EQ(boat.course_rad, std::acos(0.0));
  EXPECT_EQ(std::get<double>(get(course, boat)), 90.0);
  for (int k = -3600; k <= 3600; ++k) {
    const double degrees = 0.1 * k;
    set(course, boat, degrees);
    EXPECT_EQ(radians(std::get<double>(get(course, boat))), boat.course_rad) << degrees;
    const double any = 1e-3 * k + 1e-9;  // there need not be degrees for it
    EXPECT_DOUBLE_EQ(radians(exact_degrees(any)), any);
  }
  EXPECT_TRUE(std::isnan(exact_degrees(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Range, SaysWhatItHolds) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Range share{0.0, 1.0};
  EXPECT_TRUE(share.holds(0.0) && share.holds(1.0));
  EXPECT_FALSE(share.holds(-1e-9) || share.holds(1.1) || share.holds(nan));
  EXPECT_FALSE((Range{0.0, 1.0, true}.holds(0.0)));
  EXPECT_FALSE(Range{}.holds(infinity)) << "a number of a scenario is finite";
  EXPECT_EQ(range_text(share, ""), "0 to 1");
  EXPECT_EQ(range_text({0.0, 1e7, true}, "s"), "above 0, at most 10000000 s");
  EXPECT_EQ(range_text({0.5, infinity}, "m"), "at least 0.5 m");
  EXPECT_EQ(range_text({-infinity, 2.0}, ""), "at most 2");
  EXPECT_EQ(range_text({}, "m"), "any finite number");
  EXPECT_EQ(range_fault(1.5, share, "").value_or(""), "is 1.5; allowed: 0 to 1");
  EXPECT_FALSE(range_fault(0.5, share, ""));
}

TEST(Names, OneThatIsUnknownIsAnsweredWithAllAndTheNearest) {
  const std::string_view known[] = {"outwards", "inwards"};
  EXPECT_FALSE(name_fault("inwards", known));
  EXPECT_EQ(name_fault("inward", known).value_or(""),
            "must be \"outwards\" or \"inwards\", not the text \"inward\"; did you mean \"inwards\"?");
  EXPECT_EQ(name_fault("zzzzzzzzzz", known).value_or(""),
            "must be \"outwards\" or \"inwards\", not the text \"zzzzzzzzzz\"");
}

}  // namespace
}  // namespace banyan::world

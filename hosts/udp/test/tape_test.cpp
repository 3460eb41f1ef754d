// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/tape.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace banyan::udp {
namespace {

class TapeFile : public ::testing::Test {
 protected:
  void SetUp() override { path_ = ::testing::TempDir() + "banyan-tape-" + std::to_string(::getpid()); }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_;
  const std::vector<TapeTick> ticks_ = {{}, {{0, {1, 2, 3}}, {2, {4}}}, {{1, {}}}, {{0, Bytes(300, 7)}}};
};

TEST_F(TapeFile, ComesBackAndGoesOn) {
  {
    Tape tape(path_, 42, 7);
    EXPECT_TRUE(tape.recorded().empty());
    for (std::uint32_t tick = 0; tick < 2; ++tick) tape.append(tick, ticks_[tick]);
  }
  {
    Tape tape(path_, 42);
    EXPECT_EQ(tape.mission(), 7U);
    EXPECT_EQ(tape.recorded(), std::vector<TapeTick>(ticks_.begin(), ticks_.begin() + 2));
    for (std::uint32_t tick = 2; tick < 4; ++tick) tape.append(tick, ticks_[tick]);
  }
  EXPECT_EQ(Tape(path_, 42).recorded(), ticks_);
}

// The hub may be killed at any byte.
TEST_F(TapeFile, ATickThatWasCutOffIsNotThere) {
  {
    Tape tape(path_, 42, 7);
    for (std::uint32_t tick = 0; tick < 4; ++tick) tape.append(tick, ticks_[tick]);
  }
  for (auto size = std::filesystem::file_size(path_) - 1; size >= 24; --size) {
    std::filesystem::resize_file(path_, size);
    std::size_t there = 0;
    {
      Tape tape(path_, 42);
      there = tape.recorded().size();
      ASSERT_LT(there, 4U);
      for (std::size_t tick = 0; tick < there; ++tick) ASSERT_EQ(tape.recorded()[tick], ticks_[tick]);
      tape.append(static_cast<std::uint32_t>(there), {{9, {9}}});
    }
    const Tape again(path_, 42);
    ASSERT_EQ(again.recorded().size(), there + 1) << size;
    ASSERT_EQ(again.recorded()[there], (TapeTick{{9, {9}}}));
    size = std::min(size, std::filesystem::file_size(path_));
  }
}

TEST_F(TapeFile, KeepsWhereATrackerSawRobots) {
  const std::string start = "0 1 2 3\n1 4 5 6\n";
  const TapeTick seen{{TapeEntry::tracker, {'0', ' '}}, {1, {}}};
  {
    Tape tape(path_, 42, 7, start);
    EXPECT_EQ(tape.start(), start);
    tape.append(0, seen);
  }
  const Tape again(path_, 42);
  EXPECT_EQ(again.start(), start);
  EXPECT_EQ(again.recorded(), std::vector<TapeTick>{seen});
  EXPECT_FALSE(TapeEntry({TapeEntry::tracker, {}}).says_dead());
  EXPECT_TRUE(seen[1].says_dead());
}

TEST_F(TapeFile, OfSomethingElseIsRefused) {
  EXPECT_THROW(Tape(path_, 42), TapeError);
  { const Tape tape(path_, 42, 7); }
  EXPECT_THROW(Tape(path_, 43), TapeError);
  std::ofstream(path_) << "a quite different file";
  EXPECT_THROW(Tape(path_, 42), TapeError);
  EXPECT_THROW(Tape("/no/such/folder/tape", 42, 7), TapeError);
}

}  // namespace
}  // namespace banyan::udp

// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/journal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace banyan::udp {
namespace {

class TapeFile : public ::testing::Test {
 protected:
  void SetUp() override { path_ = ::testing::TempDir() + "banyan-journal-" + std::to_string(::getpid()); }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_;
  const std::vector<HubJournalTick> ticks_ = {{}, {{0, {1, 2, 3}}, {2, {4}}}, {{1, {}}}, {{0, Bytes(300, 7)}}};
};

TEST_F(TapeFile, ComesBackAndGoesOn) {
  {
    HubJournal journal(path_, 42, 7);
    EXPECT_TRUE(journal.recorded().empty());
    for (std::uint32_t tick = 0; tick < 2; ++tick) journal.append(tick, ticks_[tick]);
  }
  {
    HubJournal journal(path_, 42);
    EXPECT_EQ(journal.mission(), 7U);
    EXPECT_EQ(journal.recorded(), std::vector<HubJournalTick>(ticks_.begin(), ticks_.begin() + 2));
    for (std::uint32_t tick = 2; tick < 4; ++tick) journal.append(tick, ticks_[tick]);
  }
  EXPECT_EQ(HubJournal(path_, 42).recorded(), ticks_);
}

// The hub may be killed at any byte.
TEST_F(TapeFile, ATickThatWasCutOffIsNotThere) {
  {
    HubJournal journal(path_, 42, 7);
    for (std::uint32_t tick = 0; tick < 4; ++tick) journal.append(tick, ticks_[tick]);
  }
  for (auto size = std::filesystem::file_size(path_) - 1; size >= 24; --size) {
    std::filesystem::resize_file(path_, size);
    std::size_t there = 0;
    {
      HubJournal journal(path_, 42);
      there = journal.recorded().size();
      ASSERT_LT(there, 4U);
      for (std::size_t tick = 0; tick < there; ++tick) ASSERT_EQ(journal.recorded()[tick], ticks_[tick]);
      journal.append(static_cast<std::uint32_t>(there), {{9, {9}}});
    }
    const HubJournal again(path_, 42);
    ASSERT_EQ(again.recorded().size(), there + 1) << size;
    ASSERT_EQ(again.recorded()[there], (HubJournalTick{{9, {9}}}));
    size = std::min(size, std::filesystem::file_size(path_));
  }
}

TEST_F(TapeFile, KeepsWhereATrackerSawRobots) {
  const std::string start = "0 1 2 3\n1 4 5 6\n";
  const HubJournalTick seen{{HubJournalEntry::tracker, {'0', ' '}}, {1, {}}};
  {
    HubJournal journal(path_, 42, 7, start);
    EXPECT_EQ(journal.start(), start);
    journal.append(0, seen);
  }
  const HubJournal again(path_, 42);
  EXPECT_EQ(again.start(), start);
  EXPECT_EQ(again.recorded(), std::vector<HubJournalTick>{seen});
  EXPECT_FALSE(HubJournalEntry({HubJournalEntry::tracker, {}}).says_dead());
  EXPECT_TRUE(seen[1].says_dead());
}

TEST_F(TapeFile, OfSomethingElseIsRefused) {
  EXPECT_THROW(HubJournal(path_, 42), HubJournalError);
  { const HubJournal journal(path_, 42, 7); }
  EXPECT_THROW(HubJournal(path_, 43), HubJournalError);
  std::ofstream(path_) << "a quite different file";
  EXPECT_THROW(HubJournal(path_, 42), HubJournalError);
  EXPECT_THROW(HubJournal("/no/such/folder/journal", 42, 7), HubJournalError);
}

}  // namespace
}  // namespace banyan::udp

// SPDX-License-Identifier: MIT
// Whatever happens to a journal, what was written is read again, and what is damaged is said to be.
#include "banyan/study/journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "banyan/record/file.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {
namespace {

JournalEntry entry(int i) {
  return {"id" + std::to_string(i), {"row \"" + std::to_string(i) + "\", with\ttab", i % 2 ? "fault" : "", 0.5 * i}};
}

void expect_entries(const JournalContent& content, std::size_t count) {
  ASSERT_EQ(content.entries.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto wanted = entry(static_cast<int>(i));
    EXPECT_EQ(content.entries[i].id, wanted.id);
    EXPECT_EQ(content.entries[i].outcome.row, wanted.outcome.row);
    EXPECT_EQ(content.entries[i].outcome.error, wanted.outcome.error);
    EXPECT_EQ(content.entries[i].outcome.wall_s, wanted.outcome.wall_s);
  }
}

class JournalTest : public TemporaryFolder {
 protected:
  // The bytes of a journal with the first `count` entries.
  std::string journal_text(int count) {
    {
      Journal journal(path("j"), "s", "1.2", "abc");
      for (int i = 0; i < count; ++i) journal.append(entry(i));
    }
    auto text = read("j");
    std::filesystem::remove(path("j"));
    return text;
  }
  std::string failure_of_reading() {
    try {
      (void)read_journal(path("j"));
    } catch (const record::FileError& e) { return e.what(); }
    return "read";
  }
  std::string failure_of_opening(const std::string& study) {
    try {
      const Journal journal(path("j"), study, "1.2", "abc");
    } catch (const record::FileError& e) { return e.what(); }
    return "opened";
  }
};

TEST_F(JournalTest, KeepsEntriesInOrder) {
  write("j", journal_text(3));
  const auto content = read_journal(path("j"));
  EXPECT_EQ(content.study, "s");
  EXPECT_EQ(content.version, "1.2");
  EXPECT_EQ(content.git, "abc");
  EXPECT_EQ(content.bytes, read("j").size());
  expect_entries(content, 3);
}

TEST_F(JournalTest, GoesOnBehindAnEndTornAnywhere) {
  const auto whole = journal_text(3);
  const auto last = whole.rfind('\n', whole.size() - 2);  // of two entries: what is appended is then known
  for (std::size_t length = 0; length <= last + 1; ++length) {
    const auto torn = whole.substr(0, length);
    write("j", torn);
    const auto lines = static_cast<std::size_t>(std::count(torn.begin(), torn.end(), '\n'));
    const std::size_t kept = lines > 0 ? lines - 1 : 0;

    expect_entries(read_journal(path("j")), kept);
    {
      Journal journal(path("j"), "s", "1.2", "abc");
      expect_entries(journal.content(), kept);
      journal.append(entry(static_cast<int>(kept)));
    }
    expect_entries(read_journal(path("j")), kept + 1);
    ASSERT_EQ(read("j"), whole.substr(0, read("j").size())) << length;
    if (HasFailure()) return;
  }
}

TEST_F(JournalTest, NoDamagedByteGoesUnnoticed) {
  const auto whole = journal_text(2);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flipped : {0x01, 0x20}) {
      auto damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flipped);
      write("j", damaged);
      const auto line = 1 + std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      if (at + 1 == whole.size()) {  // the end of the last line: as if it was never written
        expect_entries(read_journal(path("j")), 1);
        continue;
      }
      const auto failure = failure_of_reading();
      if (failure == "read") {  // "a" or "A" as a digit of the checksum: no damage
        EXPECT_EQ(flipped, 0x20) << at;
        expect_entries(read_journal(path("j")), 2);
        continue;
      }
      EXPECT_NE(failure.find("line " + std::to_string(line) + ":"), std::string::npos) << at;
      if (flipped != 0x01 || at % 8 != 0) continue;
      EXPECT_EQ(failure_of_opening("s"), failure);
      ASSERT_EQ(read("j"), damaged) << "a damaged journal must stay as it is";
    }
  }
}

TEST_F(JournalTest, SaysWhatToDoAboutADamagedLine) {
  auto text = journal_text(3);
  text[text.find("\"id1\"") + 2] = 'X';
  write("j", text);
  EXPECT_EQ(failure_of_reading().find(path("j") + ": line 3: the line is damaged; delete it"), 0U)
      << failure_of_reading();
}

TEST_F(JournalTest, IsNoOtherFile) {
  for (const char* other : {"name,algorithm\n1,2\n", "{}\n", "\n", "00000000 {}\n"}) {
    write("j", other);
    EXPECT_NE(failure_of_reading().find("line 1: this is no journal"), std::string::npos) << other;
    EXPECT_NE(failure_of_opening("s").find("line 1: this is no journal"), std::string::npos) << other;
    EXPECT_EQ(read("j"), other);
  }
  EXPECT_THROW((void)read_journal(path("missing")), record::FileError);
  EXPECT_THROW((void)read_journal(home_.string()), record::FileError);
  EXPECT_THROW(Journal(path("no/such/folder"), "s", "1.2", "abc"), record::FileError);
}

TEST_F(JournalTest, RefusesAnotherStudyAndLeavesItAlone) {
  const auto text = journal_text(2);
  write("j", text);
  EXPECT_NE(failure_of_opening("t").find("belongs to the study \"s\", not to \"t\""), std::string::npos);
  EXPECT_EQ(read("j"), text);
}

TEST_F(JournalTest, HasOneWriterAtATime) {
  {
    Journal journal(path("j"), "s", "1.2", "abc");
    EXPECT_TRUE(in_use(path("j")));
    EXPECT_NE(failure_of_opening("s").find("another banyan is at work"), std::string::npos);
    journal.append(entry(0));
    expect_entries(read_journal(path("j")), 1);  // reading is free
  }
  EXPECT_FALSE(in_use(path("j")));
  EXPECT_FALSE(in_use(path("missing")));
  EXPECT_EQ(failure_of_opening("s"), "opened");
}

TEST_F(JournalTest, AFullDiskLeavesWholeLines) {
  const auto text = journal_text(3);
  for (const std::size_t room : {text.size() + 1, text.size() + 60, text.size() + 300}) {
    write("j", text);
    const pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{room, room};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      int failures = 0;
      Journal journal(path("j"), "s", "1.2", "abc");
      for (int i = 3; i < 10; ++i) {
        try {
          journal.append(entry(i));
        } catch (const record::FileError&) {
          if (++failures == 2) ::_exit(0);  // and it fails again, without more harm
          --i;
        }
      }
      ::_exit(1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << room;
    EXPECT_TRUE(read("j").ends_with('\n'));

    const auto kept = read_journal(path("j")).entries.size();
    Journal journal(path("j"), "s", "1.2", "abc");
    for (auto i = static_cast<int>(kept); i < 10; ++i) journal.append(entry(i));
    expect_entries(read_journal(path("j")), 10);
  }
}

TEST_F(JournalTest, TakesAnyBytesOfAnError) {
  {
    Journal journal(path("j"), "s", "1.2", "abc");
    journal.append({"id", {"", "not \xff text\n", 0.0}});
  }
  const auto content = read_journal(path("j"));
  ASSERT_EQ(content.entries.size(), 1U);
  EXPECT_EQ(content.entries[0].outcome.error, "not \xEF\xBF\xBD text\n");
}

TEST_F(JournalTest, AreListedByName) {
  EXPECT_TRUE(journals_in(path("nothing")).empty());
  std::filesystem::create_directories(home_ / "f/journal");
  for (const char* name : {"f/journal/b.jsonl", "f/journal/a.jsonl", "f/journal/notes.txt"}) write(name, "");
  EXPECT_EQ(journals_in(path("f")), (std::vector<std::string>{path("f/journal/a.jsonl"), path("f/journal/b.jsonl")}));
}

}  // namespace
}  // namespace banyan::study

// SPDX-License-Identifier: MIT
// Whatever happens to a journal, what was written is read again, and what is damaged is said to be.
#include "banyan/study/journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "banyan/record/file.hpp"
#include "banyan/record/mcap.hpp"
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
    EXPECT_THROW(JournalLock(path("j")), record::FileBusy);
    EXPECT_NE(failure_of_opening("s").find("another banyan is at work"), std::string::npos);
    journal.append(entry(0));
    expect_entries(read_journal(path("j")), 1);  // reading is free
  }
  EXPECT_EQ(failure_of_opening("s"), "opened");
}

TEST_F(JournalTest, IsThrownAwayOnlyIfNobodyWritesToIt) {
  write("j", journal_text(2));
  {
    JournalLock lock(path("j"));
    EXPECT_NE(failure_of_opening("s").find("another banyan is at work"), std::string::npos);
    lock.remove();
    const Journal another(path("j"), "s", "1.2", "abc");  // of the same name: not the one that is locked
    EXPECT_TRUE(another.content().entries.empty());
  }
  EXPECT_THROW(JournalLock(path("missing")), record::FileError);
}

TEST_F(JournalTest, SaysSoWhenItWasTakenAway) {
  Journal journal(path("j"), "s", "1.2", "abc");
  journal.append(entry(0));
  journal.sync();
  std::filesystem::remove(path("j"));
  EXPECT_THROW(journal.sync(), record::FileError);
  write("j", "");  // another one of the same name
  EXPECT_THROW(journal.sync(), record::FileError);
}

TEST_F(JournalTest, ALineOfOtherTypesIsDamagedWhateverItsChecksum) {
  const auto lines = [&](const std::string& header, const std::string& line) {
    std::string text;
    for (const auto& one : {header, line}) {
      std::array<char, 16> crc{};
      std::snprintf(crc.data(), crc.size(), "%08x ", record::mcap::crc32(one));
      text += crc.data() + one + "\n";
    }
    write("j", text);
  };
  const std::string header =
      R"({"format":"banyan.journal","format_version":1,"study":"s","version":"1.2","git":"abc"})";
  const std::string line = R"({"id":"a","row":"1,2","error":"","wall_s":1})";
  lines(header, line);
  EXPECT_EQ(read_journal(path("j")).entries.size(), 1U);
  for (const char* wrong : {R"({"id":5,"row":"","error":"","wall_s":1})", R"({"id":"a","row":7,"error":"","wall_s":1})",
                            R"({"id":"a","row":"","error":null,"wall_s":1})", R"({"id":"a","row":"","error":""})",
                            R"({"id":"a","row":"","error":"","wall_s":"1"})", "[]", "7"}) {
    lines(header, wrong);
    EXPECT_NE(failure_of_reading().find("line 2: the line is damaged"), std::string::npos) << wrong;
  }
  for (const char* wrong :
       {R"({"format":7})", R"({"format":"banyan.journal","format_version":1,"study":7,"version":"","git":""})",
        R"({"format":"banyan.journal","format_version":1,"study":"s","version":"","git":[]})"}) {
    lines(wrong, line);
    EXPECT_NE(failure_of_reading().find("line 1: this is no journal"), std::string::npos) << wrong;
    lines(header, wrong);
    EXPECT_NE(failure_of_reading().find("line 2: this is no journal"), std::string::npos) << wrong;
  }
  lines(R"({"format":"banyan.journal","format_version":"1","study":"s","version":"","git":""})", line);
  EXPECT_NE(failure_of_reading().find("of another format version"), std::string::npos);
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

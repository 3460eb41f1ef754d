// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/key.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace banyan::udp {
namespace {

class KeyFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "banyan-key-" + std::to_string(::getpid());
    std::filesystem::remove(path_);
  }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path_) << text;
    ::chmod(path_.c_str(), mode);
  }
  [[nodiscard]] std::string fault() const {
    try {
      static_cast<void>(read_keys(path_));
    } catch (const KeyError& error) { return error.what(); }
    return "";
  }
  std::string path_;
  const std::string a_ = std::string(64, 'a'), b_ = std::string(64, '0');
};

TEST_F(KeyFiles, ANewOneIsForItsOwnerAndRandom) {
  write_new_key(path_);
  struct stat status {};
  ASSERT_EQ(::stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  const auto first = read_keys(path_).signing();
  EXPECT_EQ(first.number, 1);
  EXPECT_THROW(write_new_key(path_), KeyError);  // never replaces one
  std::filesystem::remove(path_);
  write_new_key(path_);
  EXPECT_NE(read_keys(path_).signing().secret, first.secret);
}

TEST_F(KeyFiles, TheFirstSignsAndAllAreAccepted) {
  write("# a fleet\n\n7 " + a_ + "  # since May\n3 " + b_ + "\n");
  const KeyRing keys = read_keys(path_);
  EXPECT_EQ(keys.signing().number, 7);
  EXPECT_EQ(keys.signing().secret[31], 0xAA);
  ASSERT_NE(keys.find(3), nullptr);
  EXPECT_EQ(keys.find(3)->secret[0], 0);
  EXPECT_EQ(keys.find(1), nullptr);
}

TEST_F(KeyFiles, OthersMustNotReadIt) {
  for (const mode_t mode : {0640U, 0604U, 0620U, 0666U}) {
    write("1 " + a_ + "\n", mode);
    EXPECT_NE(fault().find("chmod 600"), std::string::npos) << std::oct << mode;
  }
}

// Nobody writes into this pipe: who opens it to read waits for ever.
TEST_F(KeyFiles, WhatIsNoRegularFileIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_NE(fault().find(path_ + ": is no regular file, but a pipe; keys are read from a file"), std::string::npos)
      << fault();
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_NE(fault().find("is no regular file, but a directory"), std::string::npos) << fault();
  std::filesystem::remove(path_);
  std::filesystem::create_symlink("/dev/zero", path_);
  EXPECT_NE(fault().find("is no regular file, but a device"), std::string::npos) << fault();
  std::filesystem::remove(path_);
  EXPECT_NE(fault().find("No such file"), std::string::npos) << fault();
  write(std::string((1U << 20U) + 1, '#'));
  EXPECT_NE(fault().find("larger than 1 MiB"), std::string::npos) << fault();
}

TEST_F(KeyFiles, WhatIsWrongIsSaidWithItsLine) {
  const std::string line = path_ + ":1: must be a number from 0 to 255 and 64 hexadecimal digits";
  for (const std::string& wrong : std::vector<std::string>{"1 " + a_ + "a", "1 " + a_.substr(1), "256 " + a_,
                                                           "-1 " + a_, "1", "1 " + a_ + " x", "1 g" + a_.substr(1)}) {
    write(wrong + "\n");
    EXPECT_EQ(fault(), line) << wrong;
  }
  write("1 " + a_ + "\n1 " + b_ + "\n");
  EXPECT_EQ(fault(), path_ + ":2: there is another key of this number");
  write("# nothing\n");
  EXPECT_EQ(fault(), path_ + ": has no key");
  std::filesystem::remove(path_);
  EXPECT_EQ(fault(), path_ + ": No such file or directory");
}

TEST_F(KeyFiles, IsReadAgainWhenItHasChanged) {
  write("1 " + a_ + "\n");
  KeyFile file(path_);
  EXPECT_EQ(file.refresh(), "");
  write("2 " + b_ + "\n1 " + a_ + "\n");
  EXPECT_EQ(file.keys().signing().number, 1);
  EXPECT_EQ(file.refresh(), "");
  EXPECT_EQ(file.keys().signing().number, 2);
  write("nonsense\n");
  const std::string fault =
      path_ + ":1: must be a number from 0 to 255 and 64 hexadecimal digits; the keys stay as they were";
  EXPECT_EQ(file.refresh(), fault);
  EXPECT_EQ(file.refresh(), "");         // it is said once,
  EXPECT_EQ(file.refresh(true), fault);  // or whenever it is asked for
  EXPECT_NE(file.keys().find(1), nullptr);
  std::filesystem::remove(path_);
  EXPECT_EQ(file.refresh(), path_ + ": No such file or directory; the keys stay as they were");
  write("2 " + b_ + "\n");
  EXPECT_EQ(file.refresh(), "");
  EXPECT_EQ(file.keys().find(1), nullptr);
  EXPECT_THROW(KeyFile("/nowhere/fleet.key"), KeyError);
}

}  // namespace
}  // namespace banyan::udp

// SPDX-License-Identifier: MIT
// Files are whole or not there, also when the disk is full.
#include "banyan/record/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "sample.hpp"

namespace banyan::record {
namespace {

namespace fs = std::filesystem;

int error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find(error.path()), std::string::npos);
    return error.error_number();
  }
  ADD_FAILURE() << "no FileError";
  return -1;
}

// A disk that is full after `bytes`: the limit of the process on file sizes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int) = SIG_DFL;
};

// One throws the file away as often as it can, locked, while the other opens it.
TEST(OpenLocked, HasTheFileOfThatNameWhateverHappensBetweenOpeningAndLocking) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  const auto attempt = [&](const std::function<void(int)>& use) {
    try {
      const int descriptor = open_locked(path, O_RDWR | O_CREAT);
      use(descriptor);
      ::close(descriptor);
      return 1;
    } catch (const FileBusy&) { return 0; }
  };
  std::atomic<bool> over = false;
  std::thread other([&] {
    while (!over) attempt([&](int) { ::unlink(path.c_str()); });
  });
  int opened = 0, strangers = 0;
  for (int i = 0; i < 20'000; ++i)
    opened += attempt([&](int descriptor) { strangers += has_name(descriptor, path) ? 0 : 1; });
  over = true;
  other.join();
  EXPECT_GT(opened, 0);
  EXPECT_EQ(strangers, 0);
}

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.csv");
  OutputFile file(path);
  file.write("one,");
  file.flush();
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(fs::exists(path + ".part"));
  file.write("two");
  EXPECT_EQ(file.position(), 7U);
  file.commit();
  EXPECT_EQ(test::contents(path), "one,two");
  EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(OutputFile, LargeAndSmallWritesKeepTheirOrder) {
  const test::TemporaryDirectory directory;
  std::string expected;
  OutputFile file(directory.file("a"));
  for (std::size_t k = 0; k < 400; ++k) {
    const std::string piece(k * k % 90001, static_cast<char>('a' + k % 26));
    expected += piece;
    file.write(piece);
  }
  file.commit();
  EXPECT_EQ(test::contents(directory.file("a")), expected);
}

TEST(OutputFile, NeverReplacesUnlessTold) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  write_file(path, "old");
  EXPECT_EQ(error_of([&] { write_file(path, "new"); }), EEXIST);
  EXPECT_EQ(test::contents(path), "old");
  write_file(path, "new", Existing::replace);
  EXPECT_EQ(test::contents(path), "new");
}

TEST(OutputFile, DoesNotReplaceAFileThatAppearedMeanwhile) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  OutputFile file(path);
  file.write("mine");
  std::ofstream(path) << "theirs";
  EXPECT_EQ(error_of([&] { file.commit(); }), EEXIST);
  EXPECT_EQ(test::contents(path), "theirs");
  EXPECT_EQ(test::contents(path + ".part"), "mine");
}

TEST(OutputFile, WithoutCommitThePartGoesOrStays) {
  const test::TemporaryDirectory directory;
  { OutputFile(directory.file("a")).write("x"); }
  EXPECT_FALSE(fs::exists(directory.file("a.part")));
  {
    OutputFile file(directory.file("b"));
    file.keep_part();
    file.write("x");
    file.flush();
  }
  EXPECT_EQ(test::contents(directory.file("b.part")), "x");
}

TEST(OutputFile, TwoWritersCannotShareAFile) {
  const test::TemporaryDirectory directory;
  OutputFile first(directory.file("a"));
  first.write("first");
  first.flush();
  EXPECT_THROW(OutputFile(directory.file("a")), FileError);
  first.commit();
  EXPECT_EQ(test::contents(directory.file("a")), "first");
}

TEST(OutputFile, ReplacesWhatALinkPointsTo) {
  const test::TemporaryDirectory directory;
  write_file(directory.file("real"), "old");
  fs::create_symlink("real", directory.file("link"));
  write_file(directory.file("link"), "new", Existing::replace);
  EXPECT_TRUE(fs::is_symlink(directory.file("link")));
  EXPECT_EQ(test::contents(directory.file("real")), "new");
}

TEST(OutputFile, SaysWhyAFileCannotBeCreated) {
  const test::TemporaryDirectory directory;
  EXPECT_EQ(error_of([&] { OutputFile(directory.file("")); }), EISDIR);
  EXPECT_EQ(error_of([&] { OutputFile(directory.file("missing/a")); }), ENOENT);
  write_file(directory.file("file"), "x");
  EXPECT_EQ(error_of([&] { OutputFile(directory.file("file/a")); }), ENOTDIR);
  EXPECT_EQ(error_of([&] { OutputFile(""); }), ENOENT);
  if (::geteuid() != 0) {  // root may write anywhere
    ::chmod(directory.file(".").c_str(), 0500);
    EXPECT_EQ(error_of([&] { OutputFile(directory.file("b")); }), EACCES);
    ::chmod(directory.file(".").c_str(), 0700);
  }
}

TEST(OutputFile, AFullDeviceIsAnError) {
  EXPECT_EQ(error_of([] { write_file("/dev/full", "x"); }), ENOSPC);
  EXPECT_EQ(error_of([] { write_file("/dev/full", std::string(1000000, 'x')); }), ENOSPC);
  EXPECT_TRUE(fs::exists("/dev/full"));
}

TEST(OutputFile, AFullDiskLosesNoFinishedFile) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  write_file(path, "old");
  {
    const FullDisk full(100000);
    EXPECT_EQ(error_of([&] { write_file(path, std::string(300000, 'x'), Existing::replace); }), EFBIG);
  }
  EXPECT_EQ(test::contents(path), "old");
  EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(Recorder, AFullDiskIsReportedAndWhatWasWrittenIsReadable) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.mcap");
  RecorderOptions options;
  options.chunk_bytes = 20000;
  {
    const FullDisk full(60000);
    EXPECT_EQ(error_of([&] { test::record_sample(path, 30, 2000, options); }), EFBIG);
  }
  EXPECT_FALSE(fs::exists(path));
  Recording recording(path + ".part");
  EXPECT_GT(recording.frames(), 5U);
  EXPECT_FALSE(recording.warnings().empty());
  EXPECT_EQ(recording.frame_at(0.3).tick, 3U);
  EXPECT_EQ(recording.frame_at(0.3).robots.size(), 30U);
}

TEST(InputFile, LooksWhetherSomebodyWritesWithoutKeepingAnybodyFromIt) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a");
  std::atomic<bool> over{false};
  write_file(path + ".part", "left by somebody who died");
  EXPECT_FALSE(InputFile(path + ".part").is_being_written());
  EXPECT_LT(InputFile(path + ".part").unchanged_s(), 60.0);
  std::thread looks([&] {
    const InputFile file(path + ".part");
    while (!over) (void)file.is_being_written();
  });
  for (int k = 0; k < 200; ++k) EXPECT_NO_THROW(OutputFile(path).keep_part()) << k;
  over = true;
  looks.join();
}

TEST(InputFile, RefusesWhatCannotBeRead) {
  const test::TemporaryDirectory directory;
  EXPECT_EQ(error_of([&] { InputFile(directory.file("missing")); }), ENOENT);
  EXPECT_EQ(error_of([&] { InputFile(directory.file("")); }), EISDIR);
  EXPECT_EQ(error_of([&] { InputFile("/dev/zero"); }), ESPIPE);
  ASSERT_EQ(::mkfifo(directory.file("fifo").c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { InputFile(directory.file("fifo")); }), ESPIPE);
}

TEST(InputFile, NeverReadsPastTheEnd) {
  const test::TemporaryDirectory directory;
  write_file(directory.file("a"), "0123456789");
  const InputFile file(directory.file("a"));
  std::string bytes;
  EXPECT_TRUE(file.read(2, 3, bytes));
  EXPECT_EQ(bytes, "234");
  EXPECT_TRUE(file.read(10, 0, bytes));
  EXPECT_FALSE(file.read(9, 2, bytes));
  EXPECT_FALSE(file.read(11, 0, bytes));
  EXPECT_FALSE(file.read(2, ~std::uint64_t{0}, bytes));
}

}  // namespace
}  // namespace banyan::record

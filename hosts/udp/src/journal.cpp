// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace banyan::udp {
namespace {

constexpr std::array<std::uint8_t, 8> mark = {'b', 'a', 'n', 'y', 'a', 'n', '3', '\n'};
constexpr std::size_t header = 24;

Bytes bytes_of(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw HubJournalError(path +
                          ": is no regular file; a journal is read and then written on");  // a pipe would be waited for
  std::ifstream file(path, std::ios::binary);
  if (!file) throw HubJournalError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

HubJournalEntry HubJournalEntry::of_newcomer(std::uint16_t id) {
  HubJournalEntry entry{joins, {}};
  DatagramWriter(entry.status).put(id);
  return entry;
}

std::optional<std::uint16_t> HubJournalEntry::newcomer() const noexcept {
  if (robot != joins) return std::nullopt;
  DatagramReader in(status);
  const auto id = in.take<std::uint16_t>();
  return in.ok() ? std::optional(id) : std::nullopt;
}

HubJournal::HubJournal(const std::string& path, std::uint64_t configuration, std::uint32_t mission,
                       const std::string& start)
    : path_(path),
      file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)),
      mission_(mission),
      start_(start) {
  if (file_ < 0) throw HubJournalError(path + ": " + std::strerror(errno));
  Bytes begin(mark.begin(), mark.end());
  DatagramWriter out(begin);
  out.put(configuration);
  out.put(mission);
  out.put(static_cast<std::uint32_t>(start.size()));
  begin.insert(begin.end(), start.begin(), start.end());
  write(begin);
}

HubJournal::HubJournal(const std::string& path, std::uint64_t configuration) : path_(path) {
  const std::size_t sound = read(path, configuration);
  file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file_ < 0 || ::ftruncate(file_, static_cast<off_t>(sound)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) {
    const int error = errno;
    if (file_ >= 0) ::close(file_);
    throw HubJournalError(path + ": " + std::strerror(error));
  }
}

HubJournal::~HubJournal() {
  if (file_ >= 0) ::close(file_);
}

// Returns how many bytes of it make sense.
std::size_t HubJournal::read(const std::string& path, std::uint64_t configuration) {
  const Bytes all = bytes_of(path);
  DatagramReader in(all);
  const ByteView begin = in.take(mark.size());
  if (!std::equal(begin.begin(), begin.end(), mark.begin(), mark.end()))
    throw HubJournalError(path + ": is no journal of a hub");
  if (in.take<std::uint64_t>() != configuration)
    throw HubJournalError(path + ": is the journal of another configuration");
  mission_ = in.take<std::uint32_t>();
  const ByteView start = in.take(in.take<std::uint32_t>());
  if (!in.ok()) throw HubJournalError(path + ": is no journal of a hub");
  start_.assign(start.begin(), start.end());
  std::size_t sound = header + start.size(), end = sound;
  while (in.ok()) {
    const auto tick = in.take<std::uint32_t>();
    const auto count = in.take<std::uint16_t>();
    end += 6;
    HubJournalTick entries;
    for (int k = 0; k < count && in.ok(); ++k) {
      HubJournalEntry entry;
      entry.robot = in.take<std::uint16_t>();
      const ByteView status = in.take(in.take<std::uint16_t>());
      entry.status.assign(status.begin(), status.end());
      end += 4 + entry.status.size();
      entries.push_back(std::move(entry));
    }
    if (!in.ok() || tick != recorded_.size()) break;
    recorded_.push_back(std::move(entries));
    sound = end;
  }
  return sound;
}

void HubJournal::append(std::uint32_t tick, const HubJournalTick& entries) {
  Bytes bytes;
  DatagramWriter out(bytes);
  out.put(tick);
  out.put(static_cast<std::uint16_t>(entries.size()));
  for (const HubJournalEntry& entry : entries) {
    out.put(entry.robot);
    out.put(static_cast<std::uint16_t>(entry.status.size()));
    out.put(ByteView(entry.status));
  }
  write(bytes);
}

void HubJournal::write(const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw HubJournalError(path_ + ": " + std::strerror(errno));
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace banyan::udp

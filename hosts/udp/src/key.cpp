// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/key.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>

namespace banyan::udp {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;  // 256 keys take 18 KB, and there are comments

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::optional<SecretKey> parse_key(const std::string& line) {
  std::istringstream words(line);
  std::string number, digits, more;
  if (!(words >> number >> digits) || words >> more) return std::nullopt;
  SecretKey key;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), key.number);
  if (error != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  std::size_t length = 0;
  const char* rest = nullptr;
  const int status =
      ::sodium_hex2bin(key.secret.data(), key.secret.size(), digits.data(), digits.size(), nullptr, &length, &rest);
  if (status != 0 || length != key.secret.size() || rest != digits.data() + digits.size()) return std::nullopt;
  return key;
}

// What is checked is what is read: both through one descriptor. A pipe without a writer would be waited for for ever,
// and what comes out of one cannot be read again when keys change.
std::string text_of(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw KeyError(path + ": " + std::strerror(errno));
  struct Closer {
    int file;
    ~Closer() { ::close(file); }
  } closer{file};
  struct stat status {};
  if (::fstat(file, &status) != 0) throw KeyError(path + ": " + std::strerror(errno));
  if (!S_ISREG(status.st_mode))
    throw KeyError(path + ": is no regular file, but " + kind_of(status.st_mode) +
                   "; keys are read from a file that only its owner may read: banyan hub --new-key FILE makes one");
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw KeyError(path + ": others than its owner have access to this key file; chmod 600 it");
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(file, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw KeyError(path + ": cannot be read: " + std::strerror(errno));
    if (got == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
    if (text.size() > largest_file) throw KeyError(path + ": is larger than 1 MiB: this is no key file");
  }
}

void start_library() {
  if (::sodium_init() < 0) throw KeyError("libsodium cannot be started");
}

}  // namespace

const SecretKey* KeyRing::find(std::uint8_t number) const noexcept {
  const auto at = std::find_if(keys_.begin(), keys_.end(), [&](const SecretKey& key) { return key.number == number; });
  return at == keys_.end() ? nullptr : &*at;
}

KeyRing read_keys(const std::string& path) {
  start_library();
  std::istringstream file(text_of(path));
  std::vector<SecretKey> keys;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto key = parse_key(line);
    const std::string where = path + ":" + std::to_string(number);
    if (!key) throw KeyError(where + ": must be a number from 0 to 255 and 64 hexadecimal digits");
    if (std::any_of(keys.begin(), keys.end(), [&](const SecretKey& other) { return other.number == key->number; }))
      throw KeyError(where + ": there is another key of this number");
    keys.push_back(*key);
  }
  if (keys.empty()) throw KeyError(path + ": has no key");
  return KeyRing(std::move(keys));
}

KeyFile::KeyFile(std::string path) : path_(std::move(path)), read_(version()), keys_(read_keys(path_)) {}

KeyFile::Version KeyFile::version() const noexcept {
  struct stat status {};
  if (::stat(path_.c_str(), &status) != 0) return {};
  return {status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec, status.st_size, status.st_ino};
}

std::string KeyFile::refresh(bool anyway) {
  const Version now = version();
  if (now == read_ && !anyway) return "";
  read_ = now;
  try {
    keys_ = read_keys(path_);
    return "";
  } catch (const KeyError& error) { return std::string(error.what()) + "; the keys stay as they were"; }
}

std::string new_key_text() {
  start_library();
  SecretKey key;
  ::randombytes_buf(key.secret.data(), key.secret.size());
  std::array<char, 2 * sizeof(key.secret) + 1> digits{};
  ::sodium_bin2hex(digits.data(), digits.size(), key.secret.data(), key.secret.size());
  return "1 " + std::string(digits.data()) + "\n";
}

void write_new_key(const std::string& path) {
  const std::string text = new_key_text();
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) throw KeyError(path + ": " + std::strerror(errno));
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (::close(file) != 0 || !written) throw KeyError(path + ": cannot be written");
}

}  // namespace banyan::udp

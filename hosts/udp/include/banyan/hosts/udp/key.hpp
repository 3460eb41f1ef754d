// SPDX-License-Identifier: MIT
// The keys of a fleet, from a file that only its owner can read. A line of it is a number from 0 to 255 and 64
// hexadecimal digits; '#' begins a comment. The first key signs, all of them are accepted. So a fleet changes its key
// without a pause: append the new key everywhere, then put it first everywhere, then remove the old one.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace banyan::udp {

struct SecretKey {
  std::uint8_t number = 0;
  std::array<std::uint8_t, 32> secret{};
};

// What is wrong with a key file, in words that begin with its path.
class KeyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class KeyRing {
 public:
  // Never empty, no number twice.
  explicit KeyRing(std::vector<SecretKey> keys) : keys_(std::move(keys)) {}
  [[nodiscard]] const SecretKey& signing() const noexcept { return keys_.front(); }
  [[nodiscard]] const SecretKey* find(std::uint8_t number) const noexcept;  // null: there is none

 private:
  std::vector<SecretKey> keys_;
};

// Throws KeyError, also if others than the owner may read or write the file.
[[nodiscard]] KeyRing read_keys(const std::string& path);

// A fleet's key file, which may change while a mission goes on. One that is wrong then changes nothing.
class KeyFile {
 public:
  explicit KeyFile(std::string path);  // throws KeyError
  [[nodiscard]] const KeyRing& keys() const noexcept { return keys_; }
  // Reads the file again if it has been written since, or anyway. What is wrong with it, in words; "": nothing.
  [[nodiscard]] std::string refresh(bool anyway = false);

 private:
  struct Version {
    std::int64_t written_ns = 0, size = 0;
    std::uint64_t inode = 0;
    friend bool operator==(const Version&, const Version&) = default;
  };
  [[nodiscard]] Version version() const noexcept;
  std::string path_;
  Version read_;
  KeyRing keys_;
};

// A key file with one random key, as text. Throws KeyError.
[[nodiscard]] std::string new_key_text();
// A new file with one random key, mode 0600. Throws KeyError, also if the file exists.
void write_new_key(const std::string& path);

}  // namespace banyan::udp

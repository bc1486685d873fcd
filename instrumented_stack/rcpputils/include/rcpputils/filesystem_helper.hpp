// SPDX-License-Identifier: Apache-2.0
// rcpputils::fs, which ROS 2 kept from the time before C++17: std::filesystem with older names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace rcpputils::fs {

class path {
 public:
  path() = default;
  path(const std::string& text) : path_(text) {}                  // NOLINT: strings are paths
  path(const char* text) : path_(text) {}                         // NOLINT: strings are paths
  path(std::filesystem::path other) : path_(std::move(other)) {}  // NOLINT: the same thing

  std::string string() const { return path_.string(); }
  bool exists() const { return std::filesystem::exists(path_); }
  bool is_directory() const noexcept {
    std::error_code error;
    return std::filesystem::is_directory(path_, error);
  }
  bool is_regular_file() const noexcept {
    std::error_code error;
    return std::filesystem::is_regular_file(path_, error);
  }
  // Throws std::filesystem::filesystem_error.
  uint64_t file_size() const { return std::filesystem::file_size(path_); }
  bool empty() const { return path_.empty(); }
  bool is_absolute() const { return path_.is_absolute(); }
  path parent_path() const { return path_.parent_path(); }
  path filename() const { return path_.filename(); }
  path extension() const { return path_.extension(); }
  path operator/(const path& other) const { return path_ / other.path_; }
  path& operator/=(const path& other) {
    path_ /= other.path_;
    return *this;
  }
  bool operator==(const path& other) const { return path_ == other.path_; }
  bool operator!=(const path& other) const { return path_ != other.path_; }

 private:
  std::filesystem::path path_;
};

inline bool exists(const path& file) {
  return file.exists();
}
inline bool is_directory(const path& file) noexcept {
  return file.is_directory();
}
inline bool is_regular_file(const path& file) noexcept {
  return file.is_regular_file();
}
inline uint64_t file_size(const path& file) {
  return file.file_size();
}
inline path temp_directory_path() {
  return std::filesystem::temp_directory_path();
}
inline path current_path() {
  return std::filesystem::current_path();
}
// Whether the directory exists afterwards.
inline bool create_directories(const path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory.string(), error);
  return !error;
}
inline bool remove(const path& file) {
  std::error_code error;
  return std::filesystem::remove(file.string(), error);
}
inline bool remove_all(const path& directory) {
  std::error_code error;
  return std::filesystem::remove_all(directory.string(), error) != static_cast<std::uintmax_t>(-1);
}

}  // namespace rcpputils::fs

// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/read_source_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/files/unique_fd.hpp"
#include "base/text/names.hpp"

namespace launch {

namespace {

std::map<std::string, std::string>& unsaved_texts() {
  static auto* const texts = new std::map<std::string, std::string>;
  return *texts;
}

// Null for a file that no editor has changed.
const std::string* unsaved_text(const std::string& path) {
  if (unsaved_texts().empty()) {
    return nullptr;
  }
  std::error_code ignored;
  auto found = unsaved_texts().find(path);
  if (found == unsaved_texts().end()) {
    found = unsaved_texts().find(std::filesystem::weakly_canonical(path, ignored).string());
  }
  return found == unsaved_texts().end() ? nullptr : &found->second;
}

// What an included file that does not exist may be meant to be: another one in its folder. Endings make names alike, so
// they are compared apart.
std::string help_for_missing_include(const std::string& path) {
  constexpr int kMost = 10'000;
  const std::filesystem::path wanted(path);
  const std::string name = wanted.filename().string();
  const std::string beginning = name.substr(0, name.find('.'));
  const std::string ending = name.substr(beginning.size());
  std::vector<std::string> beginnings;
  std::vector<std::string> endings;
  std::error_code unreadable;
  const std::filesystem::path folder = wanted.has_parent_path() ? wanted.parent_path() : std::filesystem::path(".");
  int count = 0;
  for (std::filesystem::directory_iterator entry(folder, unreadable), end;
       entry != end && !unreadable && ++count < kMost; entry.increment(unreadable)) {
    const std::string other = entry->path().filename().string();
    if (!ending.empty() && other.ends_with(ending)) {
      beginnings.push_back(other.substr(0, other.size() - ending.size()));
    }
    if (other.starts_with(beginning + ".")) {
      endings.push_back(other.substr(beginning.size()));
    }
  }
  if (const std::string nearest = nearest_name(beginning, beginnings); !nearest.empty()) {
    return fmt::format("did you mean '{}{}'?", nearest, ending);
  }
  if (const std::string nearest = nearest_name(ending, endings); !nearest.empty()) {
    return fmt::format("did you mean '{}{}'?", beginning, nearest);
  }
  return path.starts_with('/') ? ""
                               : "a relative path is relative to the launcher's working directory; use $(dirname)/…";
}

}  // namespace

void set_unsaved_texts(std::map<std::string, std::string> texts) {
  unsaved_texts() = std::move(texts);
}

std::shared_ptr<const SourceFile> read_source_file(const std::string& path, SourceRange included_from) {
  const auto fail = [&](int error) {
    throw LaunchError(fmt::format("can't read launch file '{}': {}", path, std::strerror(error)), included_from,
                      included_from ? help_for_missing_include(path) : "", Finding::kUnreadableFile);
  };
  if (const std::string* const text = unsaved_text(path)) {
    return std::make_shared<const SourceFile>(path, *text, std::move(included_from));
  }
  const UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) {
    fail(errno);
  }
  std::string text;
  constexpr std::size_t kChunk = 64 * 1024;
  constexpr std::size_t kLargest = 64UL << 20U;  // a device such as /dev/zero has no end
  while (true) {
    const std::size_t size = text.size();
    text.resize(size + kChunk);
    const ssize_t count = ::read(fd.get(), text.data() + size, kChunk);
    const int error = errno;
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0) {
      break;
    }
    if (count < 0 && error != EINTR) {
      fail(error);
    }
    if (text.size() > kLargest) {
      throw LaunchError(fmt::format("'{}' is larger than {} MiB", path, kLargest >> 20U), included_from,
                        "no launch file is so large; is it another file?", Finding::kUnreadableFile);
    }
  }
  text.shrink_to_fit();  // the text stays as long as the launch, and each process of `launch test` inherits it
  try {
    return std::make_shared<const SourceFile>(path, std::move(text), included_from);
  } catch (const std::length_error& error) {
    throw LaunchError(error.what(), included_from, {}, Finding::kUnreadableFile);
  }
}

}  // namespace launch

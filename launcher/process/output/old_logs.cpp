// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/old_logs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace launch {
namespace {

namespace fs = std::filesystem;
using FileClock = fs::file_time_type::clock;

constexpr const char* kLogMark = ".launch-logs";
constexpr std::string_view kTextOfMark =
    "A launch has made this directory. A later one removes it, see --keep-logs of launch.\n";
constexpr std::chrono::minutes kQuiet{1};  // the guardian of a launch that was killed may still write

struct LogRun {
  fs::path path;
  fs::file_time_type written;
  std::uint64_t bytes = 0;
};

// "talker-1-stdout.log", "launch.log.3"
bool is_log(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const std::string_view stem = end != std::string::npos && end + 1 < name.size() && name[end] == '.'
                                    ? std::string_view(name).substr(0, end)
                                    : std::string_view(name);
  return stem.ends_with(".log");
}

// Nothing if it is no directory of a launch, or one in which something else was put.
std::optional<LogRun> look_at_run(const fs::path& directory) {
  std::error_code error;
  if (fs::symlink_status(directory, error).type() != fs::file_type::directory ||
      !fs::is_regular_file(fs::symlink_status(directory / kLogMark, error))) {
    return std::nullopt;
  }
  LogRun run{directory, fs::file_time_type::min()};
  for (fs::directory_iterator entry(directory, error), last; !error && entry != last; entry.increment(error)) {
    const fs::file_status status = entry->symlink_status(error);
    const std::string name = entry->path().filename().string();
    if (error || status.type() != fs::file_type::regular || (name != kLogMark && !is_log(name))) {
      return std::nullopt;
    }
    run.written = std::max(run.written, entry->last_write_time(error));
    run.bytes += entry->file_size(error);
  }
  return error ? std::nullopt : std::optional(run);
}

// Whether it was removed: only if its launch does not run.
bool remove_run(const LogRun& run) {
  const UniqueFd mark(::open((run.path / kLogMark).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (!mark || ::flock(mark.get(), LOCK_EX | LOCK_NB) != 0) {
    return false;
  }
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(run.path, error), last; !error && entry != last; entry.increment(error)) {
    if (const std::string name = entry->path().filename().string(); is_log(name)) {
      files.push_back(entry->path());
    }
  }
  files.push_back(run.path / kLogMark);  // the last one: what is left of a removal that was cut short is removed later
  for (const fs::path& file : files) {
    ::unlink(file.c_str());
  }
  return ::rmdir(run.path.c_str()) == 0;
}

[[noreturn]] void refuse_limits(std::string_view text) {
  throw std::invalid_argument(
      fmt::format("'{}' is no limit for logs, expected such as 200,90d,4G (directories, days, bytes), or all", text));
}

}  // namespace

LogLimits parse_log_limits(std::string_view text) {
  LogLimits limits{.runs = 0, .age = std::chrono::days(0), .bytes = 0};
  if (text == "all") {
    return limits;
  }
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view word = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const std::string_view unit = word.substr(static_cast<std::size_t>(end - word.data()));
    if (error != std::errc() || number == 0) {
      refuse_limits(text);
    }
    if (unit.empty()) {
      limits.runs = number;
    } else if (unit == "d") {
      limits.age = std::chrono::days(number);
    } else if (const std::size_t power = std::string_view("KMG").find(unit);
               unit.size() == 1 && power != std::string_view::npos) {
      limits.bytes = std::uint64_t{number} << (10 * (power + 1));
    } else {
      refuse_limits(text);
    }
  }
  if (limits.runs == 0 && limits.age.count() == 0 && limits.bytes == 0) {
    refuse_limits(text);
  }
  return limits;
}

UniqueFd mark_log_directory(const std::string& directory) {
  UniqueFd mark(::open((fs::path(directory) / kLogMark).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (mark &&
      (::flock(mark.get(), LOCK_EX | LOCK_NB) != 0 ||
       ::write(mark.get(), kTextOfMark.data(), kTextOfMark.size()) != static_cast<ssize_t>(kTextOfMark.size()))) {
    ::unlink((fs::path(directory) / kLogMark).c_str());
    mark.reset();
  }
  return mark;
}

RemovedLogs remove_old_logs(const std::string& base, const std::string& own, const LogLimits& limits) {
  RemovedLogs removed;
  std::vector<LogRun> runs;
  std::error_code error;
  for (fs::directory_iterator entry(base, error), last; !error && entry != last; entry.increment(error)) {
    if (entry->path() != own) {
      if (std::optional<LogRun> run = look_at_run(entry->path())) {
        runs.push_back(*std::move(run));
      }
    }
  }
  std::sort(runs.begin(), runs.end(), [](const LogRun& a, const LogRun& b) { return a.written > b.written; });
  const FileClock::time_point now = FileClock::now();
  std::uint64_t bytes = 0;
  std::size_t count = 1;  // the directory of this launch
  for (const LogRun& run : runs) {
    const bool too_many = limits.runs != 0 && count >= limits.runs;
    const bool too_old = limits.age.count() != 0 && now - run.written > limits.age;
    const bool too_large = limits.bytes != 0 && bytes + run.bytes > limits.bytes;
    if ((too_many || too_old || too_large) && now - run.written > kQuiet && remove_run(run)) {
      ++removed.directories;
      removed.bytes += run.bytes;
    } else {
      ++count;
      bytes += run.bytes;
    }
  }
  removed.left = count;
  return removed;
}

}  // namespace launch

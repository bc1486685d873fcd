// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/machine_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

namespace tracing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kClockFile = "clock.json";
constexpr const char* kVerdict = "verdict.json";
constexpr const char* kClockName = "monotonic";  // as LTTng calls the one that the launch has compared
constexpr int kFoldersOfARecording = 8;          // from a trace up to the directory of its machine
constexpr std::uintmax_t kLargestFile = 64 * 1024;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kLargestTime = 100LL * 366 * 24 * 3600 * kSecond;  // sums of two of them are numbers, too
constexpr double kLargestDrift = 1e-3;

struct MeasuredClock {
  fs::path folder;  // of the machine
  // Of the monotonic clock of the launch; the offset is what that of the machine was ahead then, and grows by the
  // drift.
  std::int64_t at = 0;
  std::int64_t offset = 0;
  double drift = 0;
  std::int64_t epoch = 0;  // from the epoch to the zero of the monotonic clock of the launch
  std::int64_t uncertainty = 0;
  std::string boot;  // of the machine of the launch
};

std::optional<std::int64_t> time_in(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name) || !object[name].is_number_integer()) {
    return std::nullopt;
  }
  const auto value = object[name].get<std::int64_t>();
  return value < -kLargestTime || value > kLargestTime ? std::nullopt : std::optional(value);
}

std::optional<MeasuredClock> read_clock(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed) || fs::file_size(file, failed) > kLargestFile) {
    return std::nullopt;
  }
  std::ifstream stream(file);
  const Json said = Json::parse(stream, nullptr, false);
  if (!said.is_object() || !said.contains("monotonic") || !said.contains("drift") || !said["drift"].is_number()) {
    return std::nullopt;
  }
  const Json& monotonic = said["monotonic"];
  const std::optional<std::int64_t> at = time_in(monotonic, "at_ns");
  const std::optional<std::int64_t> offset = time_in(monotonic, "offset_ns");
  const std::optional<std::int64_t> epoch = time_in(monotonic, "epoch_ns");
  const std::optional<std::int64_t> uncertainty = time_in(said, "uncertainty_ns");
  const auto drift = said["drift"].get<double>();
  if (!at || !offset || !epoch || !uncertainty || *uncertainty < 0 || !(std::abs(drift) <= kLargestDrift)) {
    return std::nullopt;
  }
  const bool has_boot = monotonic.contains("boot") && monotonic["boot"].is_string();
  return MeasuredClock{file.parent_path(),
                       *at,
                       *offset,
                       drift,
                       *epoch,
                       *uncertainty,
                       has_boot ? monotonic["boot"].get<std::string>() : ""};
}

std::optional<MeasuredClock> clock_beside(const fs::path& trace) {
  std::error_code unknown;
  fs::path directory = fs::absolute(trace, unknown);
  for (int i = 0; i < kFoldersOfARecording; ++i, directory = directory.parent_path()) {
    if (fs::exists(directory / kClockFile, unknown)) {
      return read_clock(directory / kClockFile);
    }
    if (fs::exists(directory / kVerdict, unknown)) {
      break;
    }
  }
  return std::nullopt;
}

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / static_cast<double>(kSecond);
}

bool is_below(const fs::path& path, const fs::path& folder) {
  std::error_code unknown;
  const fs::path full = fs::absolute(path, unknown);
  return std::mismatch(folder.begin(), folder.end(), full.begin(), full.end()).first == folder.end();
}

bool is_clock_of_lttng(const ctf::TraceClass& declarations) {
  return declarations.clocks.size() == 1 && declarations.clocks.begin()->second.name == kClockName &&
         declarations.clocks.begin()->second.frequency == static_cast<std::uint64_t>(kSecond);
}

// Returns a sentence on it, if it was moved.
std::string move(const ClockOfTrace& trace, const MeasuredClock& measured) {
  ctf::Clock& clock = trace.declarations.clocks.begin()->second;
  // When the clock of the machine shows this, the one of the launch shows `at`.
  const std::int64_t there = measured.at + measured.offset;
  const std::int64_t epoch = measured.at + measured.epoch;
  if (there < 0 || epoch < 0) {
    return {};
  }
  const std::int64_t ahead = clock.nanoseconds(static_cast<std::uint64_t>(there)) - epoch;
  if (std::abs(ahead) <= measured.uncertainty && measured.drift == 0) {
    return {};
  }
  // A clock that runs faster has more cycles in a second.
  clock.frequency = static_cast<std::uint64_t>(std::llround(static_cast<double>(kSecond) * (1 + measured.drift)));
  clock.offset_s = epoch / kSecond;
  clock.offset = std::llround(static_cast<double>(epoch % kSecond) * (1 + measured.drift)) - there;
  const std::string& host = trace.recording.host;
  const std::string drifts =
      measured.drift == 0 ? std::string() : fmt::format(" and drifted by {:+.2f} ppm", measured.drift * 1e6);
  return fmt::format(
      "the clock of {} was {:.6f} s {} that of the launch{}, as measured through the connection within {:.6f} s: its "
      "times were moved",
      host.empty() ? "a machine" : host, std::abs(seconds(ahead)), ahead > 0 ? "ahead of" : "behind", drifts,
      seconds(measured.uncertainty));
}

}  // namespace

void put_on_clock_of_launch(const std::vector<ClockOfTrace>& traces, std::vector<std::string>& notes) {
  std::vector<std::pair<const ClockOfTrace*, MeasuredClock>> of_machines;
  std::vector<const ClockOfTrace*> others;
  for (const ClockOfTrace& trace : traces) {
    if (!is_clock_of_lttng(trace.declarations)) {
      continue;
    }
    if (std::optional<MeasuredClock> measured = clock_beside(trace.directory)) {
      of_machines.emplace_back(&trace, *std::move(measured));
    } else {
      others.push_back(&trace);
    }
  }
  for (auto& [trace, measured] : of_machines) {
    // The trace of the machine of the launch has its own measurement, and the traces must agree with each other.
    const auto own = std::find_if(others.begin(), others.end(), [&measured = measured](const ClockOfTrace* other) {
      return !measured.boot.empty() && other->recording.machine == measured.boot &&
             is_below(other->directory, measured.folder.parent_path());
    });
    if (own != others.end()) {
      measured.epoch = (*own)->declarations.clocks.begin()->second.nanoseconds(0);
    }
    std::string note = move(*trace, measured);
    if (!note.empty() && std::find(notes.begin(), notes.end(), note) == notes.end()) {
      notes.push_back(std::move(note));
    }
  }
}

}  // namespace tracing

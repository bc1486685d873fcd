// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/steer/process_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace launch {

std::string end_text(const nlohmann::ordered_json& end) {
  return end.contains("signal") ? end["signal"].get<std::string>()
                                : fmt::format("exit code {}", end.value("exit_code", 0));
}

std::string state_text(const nlohmann::ordered_json& process) {
  const auto end = process.find("last_end");
  return state_text(process.value("state", ""), end == process.end() ? "" : end_text(*end), process.value("health", ""),
                    process.value("status", ""));
}

std::string state_text(const std::string& state, const std::string& end, const std::string& health,
                       const std::string& status) {
  if (state == "running" && !health.empty()) {
    return fmt::format("running, {}{}", health, status.empty() ? "" : fmt::format(" ({})", status));
  }
  return state == "ended" && !end.empty() ? fmt::format("ended: {}", end) : state;
}

std::string memory_text(std::uint64_t bytes) {
  constexpr double kStep = 1024;
  double value = static_cast<double>(bytes) / kStep;
  const char* unit = "KiB";
  for (const char* const larger : {"MiB", "GiB", "TiB"}) {
    if (value >= kStep) {
      value /= kStep;
      unit = larger;
    }
  }
  return fmt::format("{:.1f} {}", value, unit);
}

std::string share_text(double share) {
  return share < 0 ? "" : fmt::format(" ({:.0f} %)", 100 * share);
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::max(seconds, 0.0));
  const long minutes = whole / 60;
  const long hours = minutes / 60;
  if (hours >= 24) {
    return fmt::format("{} d {}:{:02}", hours / 24, hours % 24, minutes % 60);
  }
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes % 60, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string place_text(const nlohmann::ordered_json& place) {
  return place.is_object() ? place_text(place.value("file", ""), place.value("line", 0)) : "-";
}

std::string place_text(const std::string& file, int line) {
  // Most processes are asked for by one file, and a path takes longer than the rest of a row.
  static std::string last;
  static std::string shown;
  if (file != last || shown.empty()) {
    std::error_code unknown;
    static const std::filesystem::path here = std::filesystem::current_path(unknown);
    const std::string relative = std::filesystem::path(file).lexically_relative(here).string();
    last = file;
    shown = relative.empty() || relative.starts_with("..") ? file : relative;
  }
  return fmt::format("{}:{}", shown, line);
}

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/event_cuts.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tracing {
namespace {

std::filesystem::path cuts_file(const TraceConfig& config) {
  return std::filesystem::path(config.event_counters) / ("cuts." + config.lttng_session_name());
}

}  // namespace

void note_cut(const TraceConfig& config, const EventCut& cut) {
  const nlohmann::json line = {
      {"class", cut.event_class}, {"events", cut.events}, {"time", cut.time}, {"rate", cut.rate}, {"share", cut.share}};
  std::ofstream(cuts_file(config), std::ios::app) << line.dump() << '\n';
}

std::vector<EventCut> read_cuts(const TraceConfig& config) {
  std::vector<EventCut> cuts;
  std::ifstream file(cuts_file(config));
  for (std::string line; std::getline(file, line);) {
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) {
      continue;  // of a launcher that was killed while it wrote
    }
    cuts.push_back({.event_class = json.value("class", ""),
                    .events = json.value("events", std::vector<std::string>()),
                    .time = json.value("time", std::int64_t{0}),
                    .rate = json.value("rate", std::uint64_t{0}),
                    .share = json.value("share", 0.0)});
  }
  return cuts;
}

}  // namespace tracing

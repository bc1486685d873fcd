// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/launch_filter.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "tracing/decode/reader/recorded_bytes.hpp"
#include "tracing/model/findings/quantity_text.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

fs::path plain_path(const fs::path& path) {
  std::error_code failed;
  fs::path result = fs::weakly_canonical(path, failed);
  return failed ? path : result;
}

std::unique_ptr<std::unordered_set<std::int64_t>> processes_in(const fs::path& file) {
  std::ifstream stream(file);
  const nlohmann::json verdict = nlohmann::json::parse(stream, nullptr, false);
  if (!verdict.is_object() || !verdict.contains("launch_processes") || !verdict["launch_processes"].is_array()) {
    return nullptr;
  }
  auto processes = std::make_unique<std::unordered_set<std::int64_t>>();
  for (const nlohmann::json& process : verdict["launch_processes"]) {
    if (process.is_number_integer()) {
      processes->insert(process.get<std::int64_t>());
    }
  }
  return processes;
}

}  // namespace

LaunchFilter::LaunchFilter(const TraceReader& reader, const std::vector<fs::path>& directories, TraceSink& next,
                           bool all)
    : reader_(reader), next_(next) {
  if (!all) {
    for (const fs::path& file : verdict_files(directories)) {
      recordings_.emplace(plain_path(file.parent_path()), processes_in(file));
    }
    // A trace may stand below the directory of its verdict.
    for (const fs::path& directory : directories) {
      for (fs::path above = plain_path(directory).parent_path(); above.has_relative_path();
           above = above.parent_path()) {
        const fs::path file = above / "verdict.json";
        std::error_code none;
        if (fs::exists(file, none)) {
          recordings_.emplace(above, processes_in(file));
          break;
        }
      }
    }
  }
  is_open_ =
      std::none_of(recordings_.begin(), recordings_.end(), [](const auto& one) { return one.second != nullptr; });
}

const LaunchFilter::Processes* LaunchFilter::of_directory(fs::path directory) const {
  for (; directory.has_relative_path(); directory = directory.parent_path()) {
    if (const auto found = recordings_.find(directory); found != recordings_.end()) {
      return found->second.get();
    }
  }
  return nullptr;
}

// A trace of several snapshots has a verdict for each.
const LaunchFilter::Processes* LaunchFilter::of_trace(std::size_t trace) {
  const auto [found, is_new] = by_trace_.try_emplace(trace);
  if (!is_new || trace >= reader_.traces().size()) {
    return found->second.get();
  }
  auto processes = std::make_unique<Processes>();
  for (const fs::path& directory : reader_.traces()[trace].directories) {
    const Processes* const named = of_directory(plain_path(directory));
    if (named == nullptr) {
      return nullptr;
    }
    processes->insert(named->begin(), named->end());
  }
  found->second = std::move(processes);
  return found->second.get();
}

LaunchFilter::Wanted LaunchFilter::find(const EventClass& event_class) {
  if (event_class.recording != nullptr && event_class.recording->of_kernel) {
    return {};
  }
  const std::string& name = event_class.name;
  const bool of_launcher = name.starts_with("launch:");
  return {of_trace(event_class.trace), of_launcher,
          of_launcher || name.starts_with("ros2:") || name.starts_with("ros2_ext:") ||
              name.starts_with("lttng_ust_statedump:")};
}

void LaunchFilter::on_event(const Event& event) {
  if (is_open_ || !event.vpid) {
    return next_.on_event(event);
  }
  const Wanted& wanted = wanted_.of(*event.event_class, [&] { return find(*event.event_class); });
  if (wanted.processes == nullptr || wanted.processes->contains(*event.vpid)) {
    return next_.on_event(event);
  }
  // A process of the launch without tracetools, such as a program whose memory is recorded, counts nothing itself.
  if (!count(event, wanted)) {
    next_.on_event(event);
  }
}

bool LaunchFilter::count(const Event& event, const Wanted& wanted) {
  static const std::string kNoHost;
  const Recording* const recording = event.event_class->recording;
  Other& other = others_[{recording == nullptr ? kNoHost : recording->host, *event.vpid}];
  other.is_of_ros2 = other.is_of_ros2 || wanted.is_of_ros2;
  if (!other.is_of_ros2) {
    return false;
  }
  ++other.process.events;
  other.is_traced = other.is_traced || !wanted.of_launcher;
  if (event.procname && !other.is_named) {
    other.process.name = *event.procname;
    other.is_named = event.vtid == event.vpid;
  }
  return true;
}

std::vector<OtherProcess> LaunchFilter::others() const {
  std::vector<OtherProcess> result;
  for (const auto& [place, other] : others_) {
    if (other.is_traced) {
      result.push_back(other.process);
      result.back().host = place.first;
      result.back().vpid = place.second;
    }
  }
  return result;
}

std::string others_phrase(const std::vector<OtherProcess>& others, const std::string& how) {
  return others.empty() ? "" : format_count(others.size(), "process") + " of others: " + how;
}

}  // namespace tracing

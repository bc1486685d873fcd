// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/metrics.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "launcher/control/control_client.hpp"
#include "launcher/control/process_usage.hpp"

namespace launch::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kEndedBySignal = 128;  // as a shell adds it

std::string label(const char* name, const std::string& value) {
  std::string text = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '\\' || c == '"') {
      text += '\\';
    }
    text += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  return text + '"';
}

// Of "SIGSEGV"; 0 for another text.
int number_of_signal(const std::string& name) {
  for (int number = 1; number < NSIG; ++number) {
    const char* const known = ::sigabbrev_np(number);
    if (known != nullptr && name == std::string("SIG") + known) {
      return number;
    }
  }
  return 0;
}

// A family with its samples.
class Family {
 public:
  Family(const char* name, const char* type, const char* unit, const char* help)
      : name_(name), is_counter_(std::string_view(type) == "counter") {
    header_ = fmt::format("# TYPE {} {}\n", name, type);
    header_ += unit == nullptr ? "" : fmt::format("# UNIT {} {}\n", name, unit);
    header_ += fmt::format("# HELP {} {}\n", name, help);
  }
  void add(const std::string& labels, double value) {
    samples_ += fmt::format("{}{}{{{}}} {}\n", name_, is_counter_ ? "_total" : "", labels, value);
  }
  std::string text() const { return samples_.empty() ? "" : header_ + samples_; }

 private:
  std::string name_;
  bool is_counter_;
  std::string header_;
  std::string samples_;
};

struct Families {
  Family info{"launch_info", "gauge", nullptr, "1 for each launch that runs, with its number."};
  Family running_for{"launch_running_seconds", "gauge", "seconds", "For how long the launch has been running."};
  Family state{"launch_process_state", "gauge", nullptr, "1 for the state in which the process is."};
  Family up{"launch_process_up", "gauge", nullptr, "Whether the process runs."};
  Family process_running_for{"launch_process_running_seconds", "gauge", "seconds",
                             "For how long the process has been running."};
  Family restarts{"launch_process_restarts", "counter", nullptr, "Starts after the first one."};
  Family cpu{"launch_process_cpu_seconds", "counter", "seconds", "Time of processors since the start of the process."};
  Family memory{"launch_process_resident_memory_bytes", "gauge", "bytes", "Memory that is resident."};
  Family healthy{"launch_process_healthy", "gauge", nullptr, "Whether the watches say that the process is healthy."};
  Family last_code{"launch_process_last_exit_code", "gauge", nullptr,
                   "Exit code of the last end of the process; 128+N if signal N ended it."};
  Family group_memory{"launch_control_group_memory_bytes", "gauge", "bytes", "Memory of a control group."};
  Family group_limit{"launch_control_group_memory_max_bytes", "gauge", "bytes", "What it may have."};
  Family throttled{"launch_control_group_throttled_seconds", "counter", "seconds",
                   "Time in which the kernel held the group back."};
  Family out_of_memory{"launch_control_group_out_of_memory_kills", "counter", nullptr,
                       "Processes that the kernel has ended for want of memory."};
};

void add_number(Family& family, const std::string& labels, const Json& object, const char* key) {
  if (object.contains(key) && object[key].is_number()) {
    family.add(labels, object[key].get<double>());
  }
}

void add_process(Families& families, const std::string& launch, const Json& process) {
  const std::string labels = launch + "," + label("process", process.value("name", ""));
  const std::string state = process.value("state", "");
  families.state.add(labels + "," + label("state", state), 1);
  const bool runs = process.value("pid", 0) > 0;
  families.up.add(labels, runs ? 1 : 0);
  add_number(families.restarts, labels, process, "restarts");
  if (runs) {
    add_number(families.process_running_for, labels, process, "running_for");
    add_number(families.cpu, labels, process, "cpu");
    add_number(families.memory, labels, process, "memory");
  }
  if (const std::string health = process.value("health", ""); health == "healthy" || health == "unhealthy") {
    families.healthy.add(labels, health == "healthy" ? 1 : 0);
  }
  if (process.contains("last_end")) {
    const Json& end = process["last_end"];
    add_number(families.last_code, labels, end, "exit_code");
    if (end.contains("signal") && end["signal"].is_string()) {
      families.last_code.add(labels, kEndedBySignal + number_of_signal(end["signal"].get<std::string>()));
    }
  }
  if (process.contains("control_groups")) {
    for (const Json& group : process["control_groups"]) {
      const std::string of_group = labels + "," + label("group", group.value("name", ""));
      add_number(families.group_memory, of_group, group, "memory");
      add_number(families.group_limit, of_group, group, "memory_max");
      add_number(families.throttled, of_group, group, "throttled");
      add_number(families.out_of_memory, of_group, group, "out_of_memory");
    }
  }
}

std::string files_of(const Json& launch) {
  std::string files;
  if (launch.contains("files")) {
    for (const Json& file : launch["files"]) {
      files += (files.empty() ? "" : " ") + std::filesystem::path(file.get<std::string>()).filename().string();
    }
  }
  return files;
}

}  // namespace

std::vector<Json> ask_all_launches(const Environment& environment) {
  std::vector<Json> answers;
  for (FoundLaunch& found : find_launches(environment)) {
    ControlClient client(std::move(found));
    try {
      Json answer = client.ask("ps");
      add_usage(answer["processes"]);
      answers.push_back(std::move(answer));
    } catch (const ControlError&) {
      // It has ended, or does not answer. It has no metrics, which a monitoring system sees.
    }
  }
  return answers;
}

std::string launch_metrics(const std::vector<Json>& launches) {
  std::map<std::string, int> of_name;
  for (const Json& answer : launches) {
    ++of_name[files_of(answer.at("launch"))];
  }
  Families families;
  for (const Json& answer : launches) {
    const Json& launch = answer.at("launch");
    const std::string pid = std::to_string(launch.value("pid", 0));
    const std::string files = files_of(launch);
    // The number of a launch is another one each time, so it is part of the name only where it must be.
    const std::string name = label("launch", of_name[files] > 1 ? fmt::format("{} {}", files, pid) : files);
    families.info.add(name + "," + label("pid", pid) + "," + label("state", launch.value("state", "")), 1);
    add_number(families.running_for, name, launch, "running_for");
    for (const Json& process : answer.at("processes")) {
      add_process(families, name, process);
    }
  }
  std::string text;
  for (const Family* family :
       {&families.info, &families.running_for, &families.state, &families.up, &families.process_running_for,
        &families.restarts, &families.cpu, &families.memory, &families.healthy, &families.last_code,
        &families.group_memory, &families.group_limit, &families.throttled, &families.out_of_memory}) {
    text += family->text();
  }
  return text;
}

MetricsFormat metrics_format_for(const std::string& accept_header) {
  return accept_header.find("application/openmetrics-text") != std::string::npos ? MetricsFormat::kOpenMetrics
                                                                                 : MetricsFormat::kPrometheusText;
}

const char* metrics_content_type(MetricsFormat format) {
  return format == MetricsFormat::kOpenMetrics ? "application/openmetrics-text; version=1.0.0; charset=utf-8"
                                               : "text/plain; version=0.0.4; charset=utf-8";
}

std::string metrics_text(const std::string& families, MetricsFormat format) {
  if (format == MetricsFormat::kOpenMetrics) {
    return families + "# EOF\n";
  }
  // There a counter is named as its sample, and nothing has a unit.
  std::string text;
  std::string counter;
  std::istringstream lines(families);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string hash;
    std::string kind;
    std::string name;
    std::string type;
    words >> hash >> kind >> name >> type;
    if (hash == "#" && kind == "UNIT") {
      continue;
    }
    if (hash == "#" && kind == "TYPE") {
      counter = type == "counter" ? name : "";
    }
    if (hash == "#" && !counter.empty() && name == counter) {
      line.insert(line.find(name) + name.size(), "_total");
    }
    text += line + "\n";
  }
  return text;
}

std::string NodeMetrics::families() {
  const std::lock_guard<std::mutex> lock(mutex_);
  asked_ = std::chrono::steady_clock::now();
  if (!watch_) {
    watch_ = std::make_unique<NodeWatch>(NodeWatch::Tells::kMetrics);
  }
  watch_->update();
  if (!watch_->goes_on()) {
    watch_.reset();  // old figures are no figures; the next question begins anew
    return "";
  }
  return watch_->metrics();
}

void NodeMetrics::rest() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (watch_ && std::chrono::steady_clock::now() - asked_ > kPatience) {
    watch_.reset();
  }
}

}  // namespace launch::serve

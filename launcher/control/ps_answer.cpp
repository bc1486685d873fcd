// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/ps_answer.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "launcher/control/control_client.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

// Where in the answer the reader is.
enum class Part { kNothing, kAnswer, kLaunch, kFiles, kProcesses, kProcess, kPlace, kEnd };

class PsReader final : public nlohmann::json_sax<Json> {
 public:
  explicit PsReader(std::function<void(const ListedProcess&)> on_process) : on_process_(std::move(on_process)) {}

  bool ok = false;
  std::string error;
  std::string help;
  ListedLaunch launch;

  bool null() override { return true; }
  bool boolean(bool value) override {
    if (part() == Part::kAnswer && key_ == "ok") {
      ok = value;
    } else if (part() == Part::kProcess && key_ == "away") {
      launch.processes.back().away = value;
    }
    return true;
  }
  bool number_integer(std::int64_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) override { return number(value); }
  bool string(std::string& value) override;
  bool binary(Json::binary_t&) override { return true; }

  bool key(std::string& name) override {
    key_.swap(name);
    return true;
  }
  bool start_object(std::size_t) override {
    enter(object_part());
    return true;
  }
  bool start_array(std::size_t) override {
    const bool files = part() == Part::kLaunch && key_ == "files";
    const bool processes = part() == Part::kAnswer && key_ == "processes";
    if (parts_.empty()) {
      return false;
    }
    enter(files ? Part::kFiles : processes ? Part::kProcesses : Part::kNothing);
    return true;
  }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

 private:
  Part part() const { return parts_.empty() ? Part::kNothing : parts_.back(); }
  void enter(Part part) {
    parts_.push_back(part);
    if (part == Part::kProcess) {
      launch.processes.emplace_back();
    }
  }
  bool leave() {
    if (part() == Part::kProcess && on_process_) {
      on_process_(launch.processes.back());
    }
    parts_.pop_back();
    return true;
  }
  Part object_part() const;
  bool number(double value);

  std::function<void(const ListedProcess&)> on_process_;
  std::vector<Part> parts_;
  std::string key_;
};

Part PsReader::object_part() const {
  switch (part()) {
    case Part::kNothing:
      return parts_.empty() ? Part::kAnswer : Part::kNothing;
    case Part::kAnswer:
      return key_ == "launch" ? Part::kLaunch : Part::kNothing;
    case Part::kProcesses:
      return Part::kProcess;
    case Part::kProcess:
      return key_ == "place" ? Part::kPlace : key_ == "last_end" ? Part::kEnd : Part::kNothing;
    default:
      return Part::kNothing;
  }
}

bool PsReader::string(std::string& value) {
  switch (part()) {
    case Part::kAnswer:
      if (key_ == "error") {
        error = std::move(value);
      } else if (key_ == "help") {
        help = std::move(value);
      }
      break;
    case Part::kLaunch:
      if (key_ == "state") {
        launch.state = std::move(value);
      } else if (key_ == "isolation") {
        launch.isolation = std::move(value);
      }
      break;
    case Part::kFiles:
      launch.files.push_back(std::move(value));
      break;
    case Part::kProcess:
      if (key_ == "name") {
        launch.processes.back().name = std::move(value);
      } else if (key_ == "state") {
        launch.processes.back().state = std::move(value);
      } else if (key_ == "machine") {
        launch.processes.back().machine = std::move(value);
      } else if (key_ == "health") {
        launch.processes.back().health = std::move(value);
      } else if (key_ == "status") {
        launch.processes.back().status = std::move(value);
      }
      break;
    case Part::kEnd:
      if (key_ == "signal") {
        launch.processes.back().end = std::move(value);
      }
      break;
    case Part::kPlace:
      // Most processes are asked for by one file.
      if (key_ == "file" && (launch.places.empty() || launch.places.back() != value)) {
        launch.places.push_back(std::move(value));
      }
      launch.processes.back().file = launch.places.empty() ? 0 : launch.places.size() - 1;
      break;
    default:
      break;
  }
  return true;
}

bool PsReader::number(double value) {
  if (part() == Part::kLaunch) {
    if (key_ == "pid") {
      launch.pid = static_cast<pid_t>(value);
    } else if (key_ == "running_for") {
      launch.running_for = value;
    } else if (key_ == "started" && launch.running_for == 0) {  // all that launches of version 0.1 tell
      const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
      launch.running_for = now.count() - value;
    }
  } else if (part() == Part::kProcess) {
    ListedProcess& process = launch.processes.back();
    if (key_ == "pid") {
      process.pid = static_cast<pid_t>(value);
    } else if (key_ == "pid_there") {
      process.pid_there = static_cast<pid_t>(value);
    } else if (key_ == "running_for") {
      process.running_for = value;
    } else if (key_ == "memory_share") {
      process.memory_share = value;
    } else if (key_ == "restarts") {
      process.restarts = static_cast<std::int64_t>(value);
    }
  } else if (part() == Part::kEnd && key_ == "exit_code") {
    launch.processes.back().end = fmt::format("exit code {}", static_cast<int>(value));
  } else if (part() == Part::kPlace && key_ == "line") {
    launch.processes.back().line = static_cast<int>(value);
  }
  return true;
}

}  // namespace

ListedLaunch read_ps_answer(std::string_view line, std::function<void(const ListedProcess&)> on_process) {
  PsReader reader(std::move(on_process));
  if (!Json::sax_parse(line, &reader)) {
    throw ControlError("the launch speaks another language");
  }
  if (!reader.ok) {
    throw ControlError(reader.error.empty() ? "the launch has given no reason" : reader.error, reader.help);
  }
  return std::move(reader.launch);
}

}  // namespace launch

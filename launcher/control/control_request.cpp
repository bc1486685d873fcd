// SPDX-License-Identifier: Apache-2.0
// What clients ask: the requests among the lines of a control socket.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/text/base64.hpp"
#include "launcher/control/control_protocol.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/run/user/scaling.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ControlRequest::Kind;

struct KindName {
  Kind kind;
  const char* name;
};
constexpr std::array<KindName, 14> kKinds{{{Kind::kInfo, "info"},
                                           {Kind::kPs, "ps"},
                                           {Kind::kStop, "stop"},
                                           {Kind::kStart, "start"},
                                           {Kind::kRestart, "restart"},
                                           {Kind::kSignal, "signal"},
                                           {Kind::kShutdown, "shutdown"},
                                           {Kind::kEvents, "events"},
                                           {Kind::kOutput, "output"},
                                           {Kind::kReload, "reload"},
                                           {Kind::kScale, "scale"},
                                           {Kind::kAttach, "attach"},
                                           {Kind::kInput, "input"},
                                           {Kind::kResize, "resize"}}};

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

Kind kind_of(const Json& name) {
  if (!name.is_string()) {
    refuse("\"do\" is missing, it names what to do");
  }
  const std::string text = name.get<std::string>();
  std::vector<std::string> known;
  for (const KindName& entry : kKinds) {
    if (text == entry.name) {
      return entry.kind;
    }
    known.emplace_back(entry.name);
  }
  refuse(fmt::format("\"do\": \"{}\" is unknown; there are {}", text, fmt::join(known, ", ")));
}

std::vector<std::string> names_of(const Json& json, const char* key) {
  const Json names = json.value(key, Json::array());
  if (!names.is_array() ||
      !std::all_of(names.begin(), names.end(), [](const Json& name) { return name.is_string(); })) {
    refuse(fmt::format("\"{}\" must be a list of names", key));
  }
  return names.get<std::vector<std::string>>();
}

int signal_of(const Json& signal) {
  const int number = signal.is_string() ? signal_number(signal.get<std::string>()) : 0;
  if (number == 0) {
    refuse("\"signal\" must be the name of a signal, such as \"SIGUSR1\"");
  }
  return number;
}

// Of a terminal: the numbers of its lines and columns.
std::size_t size_of(const Json& number, const char* key) {
  constexpr std::size_t kMost = 10'000;
  if (!number.is_number_unsigned() || number > kMost) {
    refuse(fmt::format("\"{}\" must be a number up to {}", key, kMost));
  }
  return number.get<std::size_t>();
}

void take_terminal(const Json& json, ControlRequest& request) {
  if (request.kind == Kind::kAttach && (request.processes.size() != 1 || !request.groups.empty())) {
    refuse("\"processes\" must hold one name");
  }
  request.size = {size_of(json.value("columns", Json(0U)), "columns"), size_of(json.value("lines", Json(0U)), "lines")};
  if (request.kind == Kind::kInput) {
    const Json data = json.value("data", Json());
    std::optional<std::string> bytes = data.is_string() ? from_base64(data.get<std::string>()) : std::nullopt;
    if (!bytes) {
      refuse("\"data\" must be Base64");
    }
    request.text = *std::move(bytes);
  }
}

}  // namespace

ControlRequest parse_control_request(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) {
    refuse("a request is a JSON object on one line, such as {\"version\": 1, \"do\": \"ps\"}");
  }
  const Json version = json.value("version", Json());
  if (version != kControlVersion) {
    refuse(fmt::format("\"version\" must be {}", kControlVersion));
  }
  ControlRequest request{.kind = kind_of(json.value("do", Json()))};
  request.processes = names_of(json, "processes");
  request.groups = names_of(json, "groups");
  const bool names_processes = request.kind == Kind::kStop || request.kind == Kind::kStart ||
                               request.kind == Kind::kRestart || request.kind == Kind::kSignal;
  if (names_processes && request.processes.empty() && request.groups.empty()) {
    refuse("\"processes\" is missing, it names the processes");
  }
  for (const auto& [key, flag] :
       {std::pair{"dry_run", &request.dry_run}, {"restart", &request.restart}, {"read_only", &request.read_only}}) {
    const Json value = json.value(key, Json(false));
    if (!value.is_boolean()) {
      refuse(fmt::format("\"{}\" must be true or false", key));
    }
    *flag = value.get<bool>();
  }
  if (request.kind == Kind::kScale) {
    const Json count = json.value("count", Json());
    if (request.processes.size() != 1 || !count.is_number_unsigned() || count == 0U || count > Scaling::kMost) {
      refuse(fmt::format("\"processes\" must hold one name, and \"count\" be a number from 1 to {}", Scaling::kMost));
    }
    request.count = count.get<std::size_t>();
  }
  if (request.kind == Kind::kAttach || request.kind == Kind::kInput || request.kind == Kind::kResize) {
    take_terminal(json, request);
  }
  if (request.kind == Kind::kSignal) {
    request.signal = signal_of(json.value("signal", Json()));
  }
  return request;
}

}  // namespace launch

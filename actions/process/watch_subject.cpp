// SPDX-License-Identifier: Apache-2.0
#include "actions/process/watch_subject.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/un.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

#include "actions/process/resource_settings.hpp"
#include "actions/values/ros_condition.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/language/output_pattern.hpp"

namespace launch {

namespace {

using Type = AttributeType;
using std::chrono::milliseconds;
using std::chrono::seconds;

// An attribute that only one kind has.
struct KindAttribute {
  AttributeSpec attribute;
  const char* kind;
};

const std::vector<KindAttribute>& kind_attributes() {
  static const std::vector<KindAttribute> attributes = {
      {{"pattern", Type::kText, false, "any line", "with output: regular expression to be found in the line", true},
       "output"},
      {{"stream", Type::kText, false, "both", "with output: stdout, stderr or both", true}, "output"},
      {{"cmd", Type::kCommandLine, false, "", "with command: the command line; split into words, not run by a shell",
        true},
       "command"},
      {{"topic", Type::kText, false, "", "with topic: its name", true}, "topic"},
      {{"min_rate", Type::kFloat, false, "one message in each timeout",
        "with topic: so many messages a second, over each timeout", true},
       "topic"},
      {{"service", Type::kText, false, "", "with service: its name", true}, "service"},
      {{"node", Type::kText, false, "that of the process", "with lifecycle: the managed node", true}, "lifecycle"},
      {{"lifecycle_state", Type::kText, false, "active", "with lifecycle: unconfigured, inactive, active or finalized",
        true},
       "lifecycle"},
      {{"port", Type::kInteger, false, "", "with port: the number of a port, from 1 to 65535", true}, "port"},
      {{"host", Type::kText, false, "localhost", "with port and TCP: an IP address, or localhost", true}, "port"},
      {{"protocol", Type::kText, false, "tcp", "with port: tcp or udp", true}, "port"},
      {{"socket", Type::kText, false, "",
        "with port, instead of one: the path of a Unix socket, or @NAME for an abstract one", true},
       "port"},
      {{"watchdog", Type::kBoolean, false, "false",
        "with notify: true: once it is ready, the process must also say WATCHDOG=1 in each timeout", true},
       "notify"},
      {{"max_memory", Type::kText, false, "",
        "with memory: resident memory of the process alone, in bytes, or with K, M or G", true},
       "memory"},
      {{"max_growth", Type::kText, false, "",
        "with memory: so much more than at the first look after start_period, likewise", true},
       "memory"},
      {{"max_load", Type::kText, false, "",
        "with load: time of processors of the process alone over each timeout, in percents of one processor, such as "
        "150%",
        true},
       "load"},
  };
  return attributes;
}

void require(const Fields& fields, const std::string& kind, const char* attribute, const char* what) {
  if (!fields.has(attribute)) {
    throw LaunchError(fmt::format("a watch of kind=\"{}\" needs a {}", kind, what), fields.where("kind"),
                      fmt::format("give {}=\"…\"", attribute), Finding::kMissingAttribute);
  }
}

std::string perform_state(const Fields& fields, Scope& scope) {
  if (!fields.has("lifecycle_state")) {
    return "active";
  }
  static const std::vector<std::string> states = {"unconfigured", "inactive", "active", "finalized"};
  const Template& given = fields.text("lifecycle_state");
  std::string state = given.perform(scope);
  if (std::find(states.begin(), states.end(), state) == states.end()) {
    throw LaunchError(
        fmt::format("lifecycle_state can be unconfigured, inactive, active or finalized, got '{}'", state),
        given.where(), did_you_mean(state, states));
  }
  return state;
}

TopicIsPublished perform_topic(const Fields& fields, Scope& scope) {
  TopicIsPublished topic{.topic = resolve_name(fields.text("topic"), scope)};
  if (fields.has("min_rate")) {
    topic.min_rate = fields.number("min_rate")->perform(scope);
    if (!(topic.min_rate > 0) || std::isinf(topic.min_rate)) {
      throw LaunchError(fmt::format("min_rate is a number above 0, got {}", topic.min_rate), fields.where("min_rate"),
                        "leave it out to want one message in each timeout");
    }
  }
  return topic;
}

LifecycleState perform_lifecycle(const Fields& fields, Scope& scope, const ProcessSpec& process) {
  std::string state = perform_state(fields, scope);
  if (fields.has("node")) {
    return {resolve_name(fields.text("node"), scope), std::move(state)};
  }
  if (process.other_names.empty()) {
    throw LaunchError("it is not said which node has a state", fields.where("kind"),
                      "give node=\"…\", or a name to the node of the process", Finding::kMissingAttribute);
  }
  return {process.other_names.back(), std::move(state)};
}

MemoryStays perform_memory(const Fields& fields, Scope& scope) {
  MemoryStays memory;
  const auto perform = [&](const char* name, std::optional<std::uint64_t>& bytes) {
    if (fields.has(name)) {
      bytes = parse_bytes(fields.text(name).perform(scope), fields.where(name));
    }
  };
  perform("max_memory", memory.most);
  perform("max_growth", memory.most_growth);
  return memory;
}

LoadStays perform_load(const Fields& fields, Scope& scope) {
  return {.most = parse_share(fields.text("max_load").perform(scope), fields.where("max_load"))};
}

bool is_address(const std::string& text) {
  in6_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1 || ::inet_pton(AF_INET6, text.c_str(), &address) == 1;
}

std::string perform_socket(const Fields& fields, Scope& scope) {
  std::string path = fields.text("socket").perform(scope);
  if (path.size() < 2 || (path[0] != '/' && path[0] != '@')) {
    throw LaunchError(fmt::format("'{}' is no path of a socket", path), fields.where("socket"),
                      "write an absolute path, or @NAME for an abstract socket");
  }
  if (path.size() >= sizeof(sockaddr_un::sun_path)) {
    throw LaunchError(fmt::format("the path of a socket has at most {} bytes, got {}",
                                  sizeof(sockaddr_un::sun_path) - 1, path.size()),
                      fields.where("socket"));
  }
  return path;
}

PortAccepts perform_port(const Fields& fields, Scope& scope) {
  using Protocol = PortAccepts::Protocol;
  if (fields.has("socket")) {
    return {.protocol = Protocol::kUnix, .socket = perform_socket(fields, scope)};
  }
  PortAccepts port{.host = "localhost"};
  if (fields.has("protocol")) {
    const Template& given = fields.text("protocol");
    const std::string name = given.perform(scope);
    if (name != "tcp" && name != "udp") {
      throw LaunchError(fmt::format("protocol can be tcp or udp, got '{}'", name), given.where(),
                        did_you_mean(name, {"tcp", "udp"}));
    }
    port.protocol = name == "udp" ? Protocol::kUdp : Protocol::kTcp;
  }
  if (fields.has("host")) {
    if (port.protocol == Protocol::kUdp) {
      throw LaunchError("host goes with TCP only", fields.where("host"),
                        "a port of UDP is looked for in the network of the process", Finding::kExclusive);
    }
    port.host = fields.text("host").perform(scope);
    if (port.host != "localhost" && !is_address(port.host)) {
      throw LaunchError(fmt::format("'{}' is no IP address", port.host), fields.where("host"),
                        "write an address such as 127.0.0.1 or ::1, or localhost");
    }
  }
  constexpr auto kMost = std::numeric_limits<std::uint16_t>::max();
  const double number = fields.number("port")->perform(scope);
  if (number < 1 || number > kMost) {
    throw LaunchError(fmt::format("port is a number from 1 to {}, got {}", kMost, number), fields.where("port"),
                      "write the number at which the process listens");
  }
  port.port = static_cast<std::uint16_t>(number);
  return port;
}

void check_port(const Fields& fields) {
  if (!fields.has("port") && !fields.has("socket")) {
    throw LaunchError("a watch of kind=\"port\" needs a port or a socket", fields.where("kind"),
                      "give port=\"…\" or socket=\"…\"", Finding::kMissingAttribute);
  }
  for (const char* const of_port : {"port", "host", "protocol"}) {
    if (fields.has("socket") && fields.has(of_port)) {
      throw LaunchError(fmt::format("{} does not go with socket", of_port), fields.where(of_port),
                        "write a watch for each", Finding::kExclusive);
    }
  }
}

// The kinds that ask somebody, who may be slow once in a while.
bool asks(const HealthWatch& watch) {
  return std::holds_alternative<CommandSucceeds>(watch.subject) || std::holds_alternative<PortAccepts>(watch.subject);
}

Duration default_interval(const HealthWatch& watch) {
  const auto part = [&](int divisor, Duration most) {
    return std::clamp<Duration>(watch.timeout / divisor, milliseconds(50), most);
  };
  if (std::holds_alternative<CommandSucceeds>(watch.subject)) {
    return seconds(10);
  }
  if (std::holds_alternative<PortAccepts>(watch.subject)) {
    return seconds(5);
  }
  if (std::holds_alternative<ServiceAnswers>(watch.subject) || std::holds_alternative<LifecycleState>(watch.subject)) {
    return part(2, seconds(5));
  }
  // What blocks a process is looked up in /proc, which costs ten times as much as other looks.
  return std::holds_alternative<NotBlocked>(watch.subject) ? part(2, seconds(2)) : part(5, seconds(1));
}

}  // namespace

const std::vector<std::string>& watch_kinds() {
  static const std::vector<std::string> kinds = {"executor",  "output", "blocked", "command", "topic", "service",
                                                 "lifecycle", "port",   "notify",  "memory",  "load"};
  return kinds;
}

std::vector<AttributeSpec> watch_subject_attributes() {
  std::vector<AttributeSpec> attributes;
  for (const KindAttribute& each : kind_attributes()) {
    attributes.push_back(each.attribute);
  }
  return attributes;
}

void check_watch_subject(const Fields& fields, const std::string& kind) {
  for (const auto& [attribute, of] : kind_attributes()) {
    if (fields.has(attribute.name) && kind != of) {
      throw LaunchError(fmt::format("{} goes with kind=\"{}\" only", attribute.name, of), fields.where(attribute.name),
                        {}, Finding::kExclusive);
    }
  }
  const auto is_literal_or_missing = [&](const char* name) {
    return !fields.has(name) || fields.text(name).is_literal();
  };
  Scope nothing;
  if (kind == "command") {
    require(fields, kind, "cmd", "command");
  } else if (kind == "topic") {
    require(fields, kind, "topic", "topic");
  } else if (kind == "service") {
    require(fields, kind, "service", "service");
  } else if (kind == "memory" && !fields.has("max_memory") && !fields.has("max_growth")) {
    throw LaunchError("a watch of kind=\"memory\" needs max_memory or max_growth", fields.where("kind"),
                      "give max_memory=\"500M\"", Finding::kMissingAttribute);
  } else if (kind == "memory" && is_literal_or_missing("max_memory") && is_literal_or_missing("max_growth")) {
    perform_memory(fields, nothing);
  } else if (kind == "load") {
    require(fields, kind, "max_load", "limit");
    if (is_literal_or_missing("max_load")) {
      perform_load(fields, nothing);
    }
  } else if (kind == "port") {
    check_port(fields);
  } else if (kind == "lifecycle" && is_literal_or_missing("lifecycle_state")) {
    perform_state(fields, nothing);
  } else if (kind == "output" && is_literal_or_missing("pattern") && is_literal_or_missing("stream")) {
    perform_output_pattern(fields, nothing);
  }
}

WatchSubject perform_watch_subject(const Fields& fields, const std::string& kind, Scope& scope,
                                   const ProcessSpec& process) {
  if (kind == "output") {
    const OutputPattern pattern = perform_output_pattern(fields, scope);
    return OutputLines{pattern.expression(), std::string(pattern.stream())};
  }
  if (kind == "blocked") {
    return NotBlocked{};
  }
  if (kind == "command") {
    CommandSucceeds command;
    for (const Template& word : fields.words("cmd")) {
      command.argv.push_back(word.perform(scope));
    }
    if (command.argv.empty() || command.argv.front().empty()) {
      throw LaunchError("the command is empty", fields.where("cmd"));
    }
    return command;
  }
  if (kind == "topic") {
    return perform_topic(fields, scope);
  }
  if (kind == "service") {
    return ServiceAnswers{resolve_name(fields.text("service"), scope)};
  }
  if (kind == "lifecycle") {
    return perform_lifecycle(fields, scope, process);
  }
  if (kind == "port") {
    return perform_port(fields, scope);
  }
  if (kind == "memory") {
    return perform_memory(fields, scope);
  }
  if (kind == "load") {
    return perform_load(fields, scope);
  }
  if (kind == "notify") {
    return Notifies{.watchdog = fields.boolean("watchdog", false).perform(scope)};
  }
  return ExecutorProgress{};
}

void complete_watch(const Fields& fields, HealthWatch& watch) {
  if (watch.failures == 0) {
    watch.failures = asks(watch) ? 3 : 1;
  }
  if (watch.interval == Duration{0}) {
    watch.interval = default_interval(watch);
  }
  const auto* const topic = std::get_if<TopicIsPublished>(&watch.subject);
  const double timeout = std::chrono::duration<double>(watch.timeout).count();
  constexpr double kFewest = 2;  // one may be late
  if (topic != nullptr && topic->min_rate > 0 && topic->min_rate * timeout < kFewest) {
    throw LaunchError(fmt::format("in a timeout of {} s, a rate of {} comes to less than {} messages", timeout,
                                  topic->min_rate, kFewest),
                      fields.where("min_rate"),
                      fmt::format("give a timeout of {} at least, or leave out min_rate to want one message in each",
                                  std::ceil(kFewest / topic->min_rate)));
  }
}

}  // namespace launch

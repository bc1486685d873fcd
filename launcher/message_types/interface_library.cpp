// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/interface_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "launcher/message_types/interface_file.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

const std::string kIdl = "idl";

struct InterfaceName {
  std::string package;
  std::string kind;
  std::string name;
};

InterfaceName split(const std::string& full) {
  const std::size_t first = full.find('/');
  const std::size_t last = full.rfind('/');
  if (first == std::string::npos || full.size() == last + 1) {
    throw LaunchError(fmt::format("'{}' is not the name of an interface", full), {}, "write PACKAGE/msg/NAME");
  }
  if (first == last) {
    return {full.substr(0, first), "msg", full.substr(first + 1)};
  }
  return {full.substr(0, first), full.substr(first + 1, last - first - 1), full.substr(last + 1)};
}

// The file that a name comes from: "Fibonacci" of "Fibonacci_SendGoal_Request".
std::string base_name(const std::string& name) {
  return name.substr(0, name.find('_'));
}

// Of the parts of an interface.
std::vector<std::string> struct_names(const std::string& kind, const std::string& name) {
  if (kind == "msg") {
    return {name};
  }
  if (kind == "srv") {
    return {name + "_Request", name + "_Response"};
  }
  return {name + "_Goal", name + "_Result", name + "_Feedback"};
}

MessageField part_field(std::string name, std::shared_ptr<const MessageType> message) {
  FieldType type{FieldKind::kMessage, std::move(message)};
  MessageValue value = default_value(type);
  return {std::move(name), std::move(type), std::move(value)};
}

MessageField primitive_field(std::string name, FieldKind kind) {
  const FieldType type{kind};
  return {std::move(name), type, default_value(type)};
}

}  // namespace

InterfaceLibrary::InterfaceLibrary(PackageIndex packages, Environment environment)
    : packages_(std::move(packages)), environment_(std::move(environment)) {}

std::string InterfaceLibrary::file_of(const std::string& name) {
  const InterfaceName parts = split(name);
  std::string share;
  try {
    share = packages_.share(parts.package, environment_);
  } catch (const std::runtime_error&) {
    throw LaunchError(fmt::format("package '{}' is not found", parts.package), {},
                      packages_.help_for_missing(parts.package, environment_));
  }
  const std::string base = base_name(parts.name);
  const std::string path = fmt::format("{}/{}/{}.", share, parts.kind, base);
  std::error_code error;
  for (const std::string& extension : {parts.kind, kIdl}) {
    if (fs::is_regular_file(path + extension, error)) {
      return path + extension;
    }
  }
  const std::vector<std::string> names = names_of_package(parts.package, parts.kind);
  std::string help = did_you_mean(fmt::format("{}/{}/{}", parts.package, parts.kind, base), names);
  if (help.empty() && names.empty()) {
    help = fmt::format("the package has no {} interfaces", parts.kind);
  }
  throw LaunchError(fmt::format("there is no interface '{}/{}/{}'", parts.package, parts.kind, base), {}, help);
}

std::vector<std::string> InterfaceLibrary::names_of_package(const std::string& package, const std::string& kind) const {
  std::vector<std::string> names;
  std::string share;
  try {
    share = packages_.share(package, environment_);
  } catch (const std::runtime_error&) {
    return names;
  }
  std::error_code error;
  for (fs::directory_iterator entry(fmt::format("{}/{}", share, kind), error), end; entry != end && !error;
       entry.increment(error)) {
    const std::string extension = entry->path().extension().string();
    if (extension == "." + kind || extension == "." + kIdl) {
      names.push_back(fmt::format("{}/{}/{}", package, kind, entry->path().stem().string()));
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());  // many packages have both kinds of files
  return names;
}

std::vector<std::string> InterfaceLibrary::names(const std::string& kind) const {
  std::vector<std::string> all;
  for (const std::string& package : packages_.packages(environment_)) {
    const std::vector<std::string> names = names_of_package(package, kind);
    all.insert(all.end(), names.begin(), names.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void InterfaceLibrary::load(const std::string& package, const std::string& kind, const std::string& name) {
  const std::string full = fmt::format("{}/{}/{}", package, kind, name);
  const auto file = read_source_file(file_of(full));
  if (std::find(loading_.begin(), loading_.end(), full) != loading_.end()) {
    throw LaunchError(fmt::format("'{}' contains itself", full), {file, 0, 0});
  }
  const FindMessage find_message = [this](const std::string& used) { return message(used); };
  std::vector<MessageType> parts;
  loading_.push_back(full);
  try {
    parts = file->path().ends_with(kIdl) ? parse_idl_file(file, package, struct_names(kind, name), find_message)
                                         : parse_interface_file(file, package, find_message);
  } catch (...) {
    loading_.pop_back();
    throw;
  }
  loading_.pop_back();
  const auto keep = [&](const std::string& suffix, MessageType type) {
    type.name = full + suffix;
    auto kept = std::make_shared<const MessageType>(std::move(type));
    messages_[kept->name] = kept;
    return kept;
  };
  const std::size_t expected = kind == "msg" ? 1 : kind == "srv" ? 2 : 3;
  if (parts.size() != expected) {
    throw LaunchError(
        fmt::format("a .{} file has {} parts with '---' between them, found {}", kind, expected, parts.size()),
        {file, 0, 0});
  }
  if (kind == "msg") {
    keep("", std::move(parts[0]));
    return;
  }
  if (kind == "srv") {
    keep("_Request", std::move(parts[0]));
    keep("_Response", std::move(parts[1]));
    return;
  }
  const auto goal = keep("_Goal", std::move(parts[0]));
  const auto result = keep("_Result", std::move(parts[1]));
  const auto feedback = keep("_Feedback", std::move(parts[2]));
  const auto id = message("unique_identifier_msgs/msg/UUID");
  const auto time = message("builtin_interfaces/msg/Time");
  keep("_SendGoal_Request", {{}, {part_field("goal_id", id), part_field("goal", goal)}, {}});
  keep("_SendGoal_Response", {{}, {primitive_field("accepted", FieldKind::kBool), part_field("stamp", time)}, {}});
  keep("_GetResult_Request", {{}, {part_field("goal_id", id)}, {}});
  keep("_GetResult_Response", {{}, {primitive_field("status", FieldKind::kInt8), part_field("result", result)}, {}});
  keep("_FeedbackMessage", {{}, {part_field("goal_id", id), part_field("feedback", feedback)}, {}});
}

std::shared_ptr<const MessageType> InterfaceLibrary::message(const std::string& name) {
  const InterfaceName parts = split(name);
  const std::string full = fmt::format("{}/{}/{}", parts.package, parts.kind, parts.name);
  if (const auto found = messages_.find(full); found != messages_.end()) {
    return found->second;
  }
  constexpr std::array<std::string_view, 3> kKinds = {"msg", "srv", "action"};
  if (std::find(kKinds.begin(), kKinds.end(), parts.kind) == kKinds.end()) {
    throw LaunchError(fmt::format("'{}' is not the name of an interface", name), {}, "write PACKAGE/msg/NAME");
  }
  if (constexpr std::string_view kEvent = "_Event"; parts.kind != "msg" && full.ends_with(kEvent)) {
    return event_of(full.substr(0, full.size() - kEvent.size()));
  }
  load(parts.package, parts.kind, base_name(parts.name));
  const auto found = messages_.find(full);
  if (found == messages_.end()) {
    throw LaunchError(fmt::format("'{}' is not a message", full), {});
  }
  return found->second;
}

std::shared_ptr<const MessageType> InterfaceLibrary::event_of(const std::string& service) {
  const auto one_at_most = [](std::string name, std::shared_ptr<const MessageType> type) {
    return MessageField{std::move(name),
                        {.kind = FieldKind::kMessage, .message = std::move(type), .many = Many::kSequence, .count = 1},
                        {MessageValue::List()}};
  };
  MessageType event;
  event.name = service + "_Event";
  event.fields = {part_field("info", message("service_msgs/msg/ServiceEventInfo")),
                  one_at_most("request", message(service + "_Request")),
                  one_at_most("response", message(service + "_Response"))};
  auto kept = std::make_shared<const MessageType>(std::move(event));
  messages_[kept->name] = kept;
  return kept;
}

ServiceType InterfaceLibrary::service(const std::string& name) {
  const InterfaceName parts = split(name);
  const std::string kind = std::count(name.begin(), name.end(), '/') == 1 ? "srv" : parts.kind;
  const std::string full = fmt::format("{}/{}/{}", parts.package, kind, parts.name);
  if (kind == "msg") {
    throw LaunchError(fmt::format("'{}' is a message, not a service", name), {}, "write PACKAGE/srv/NAME");
  }
  return {full, message(full + "_Request"), message(full + "_Response")};
}

ServiceType InterfaceLibrary::action_service(const std::string& action, const std::string& part) {
  return service(fmt::format("{}_{}", action, part));
}

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/spec_wire.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace launch {
namespace {

constexpr std::size_t kText = 4;  // bytes of an empty one

template <typename Number>
void put_optional(WireWriter& writer, const std::optional<Number>& value) {
  writer.flag(value.has_value()).i64(value ? static_cast<std::int64_t>(*value) : 0);
}

template <typename Number>
std::optional<Number> get_optional(WireReader& reader) {
  const bool given = reader.flag();
  const auto value = static_cast<Number>(reader.i64());
  return given ? std::optional<Number>(value) : std::nullopt;
}

void put_limits(WireWriter& writer, const ResourceLimits& limits) {
  put_optional(writer, limits.niceness);
  put_optional(writer, limits.policy);
  writer.i32(limits.priority).u32(static_cast<std::uint32_t>(limits.cpus.size()));
  for (const int cpu : limits.cpus) {
    writer.i32(cpu);
  }
  put_optional(writer, limits.memory);
  put_optional(writer, limits.open_files);
  writer.i64(limits.schedule.runtime.count()).i64(limits.schedule.deadline.count());
  writer.i64(limits.schedule.period.count());
  writer.flag(limits.timer_slack.has_value()).i64(limits.timer_slack ? limits.timer_slack->count() : 0);
  put_optional(writer, limits.oom_score_adj);
  put_optional(writer, limits.locked_memory);
}

ResourceLimits get_limits(WireReader& reader) {
  ResourceLimits limits;
  limits.niceness = get_optional<int>(reader);
  limits.policy = get_optional<int>(reader);
  limits.priority = reader.i32();
  for (std::uint32_t left = reader.count(sizeof(std::int32_t)); left > 0; --left) {
    limits.cpus.push_back(reader.i32());
  }
  limits.memory = get_optional<std::uint64_t>(reader);
  limits.open_files = get_optional<std::uint64_t>(reader);
  limits.schedule.runtime = std::chrono::nanoseconds(reader.i64());
  limits.schedule.deadline = std::chrono::nanoseconds(reader.i64());
  limits.schedule.period = std::chrono::nanoseconds(reader.i64());
  const bool slack = reader.flag();
  const std::chrono::nanoseconds time(reader.i64());
  limits.timer_slack = slack ? std::optional(time) : std::nullopt;
  limits.oom_score_adj = get_optional<int>(reader);
  limits.locked_memory = get_optional<std::uint64_t>(reader);
  return limits;
}

void put_targets(WireWriter& writer, const OutputTargets& targets) {
  writer.flag(targets.screen).flag(targets.log).flag(targets.own_log);
}

OutputTargets get_targets(WireReader& reader) {
  OutputTargets targets;
  targets.screen = reader.flag();
  targets.log = reader.flag();
  targets.own_log = reader.flag();
  return targets;
}

void require_no_zero(const std::string& text) {
  if (text.find('\0') != std::string::npos) {
    throw WireError("a process can't be started with a zero byte in a word");
  }
}

}  // namespace

void put(WireWriter& writer, const ProcessSpec& spec) {
  writer.text(spec.name).text(spec.label).u32(static_cast<std::uint32_t>(spec.argv.size()));
  for (const std::string& word : spec.argv) {
    writer.text(word);
  }
  writer.u32(static_cast<std::uint32_t>(spec.environment.size()));
  for (const auto& [name, value] : spec.environment) {
    writer.text(name).text(value);
  }
  writer.text(spec.working_directory).flag(spec.shell).flag(spec.emulate_tty);
  put_targets(writer, spec.output.out);
  put_targets(writer, spec.output.err);
  put_limits(writer, spec.limits);
  writer.i64(spec.sigterm_timeout.count()).i64(spec.sigkill_timeout.count());
  writer.u32(static_cast<std::uint32_t>(spec.files.size()));
  for (const GeneratedFile& file : spec.files) {
    writer.u32(static_cast<std::uint32_t>(file.argument)).text(file.name).text(file.content);
  }
  writer.flag(spec.traced).u32(static_cast<std::uint32_t>(spec.other_names.size()));
  for (const std::string& name : spec.other_names) {
    writer.text(name);
  }
}

ProcessSpec get_spec(WireReader& reader) {
  ProcessSpec spec;
  spec.name = reader.text();
  spec.label = reader.text();
  for (std::uint32_t left = reader.count(kText); left > 0; --left) {
    spec.argv.push_back(reader.text());
    require_no_zero(spec.argv.back());
  }
  Environment::Variables environment;
  for (std::uint32_t left = reader.count(2 * kText); left > 0; --left) {
    std::string name = reader.text();
    std::string value = reader.text();
    require_no_zero(name);
    require_no_zero(value);
    environment.insert_or_assign(std::move(name), std::move(value));
  }
  spec.environment = Environment(std::move(environment));
  spec.working_directory = reader.text();
  spec.shell = reader.flag();
  spec.emulate_tty = reader.flag();
  spec.output.out = get_targets(reader);
  spec.output.err = get_targets(reader);
  spec.limits = get_limits(reader);
  spec.sigterm_timeout = Duration(reader.i64());
  spec.sigkill_timeout = Duration(reader.i64());
  for (std::uint32_t left = reader.count(3 * kText); left > 0; --left) {
    GeneratedFile file;
    file.argument = reader.u32();
    file.name = reader.text();
    file.content = reader.text();
    if (file.argument >= spec.argv.size()) {
      throw WireError("a file of a process belongs to no word of its command line");
    }
    spec.files.push_back(std::move(file));
  }
  spec.traced = reader.flag();
  for (std::uint32_t left = reader.count(kText); left > 0; --left) {
    spec.other_names.push_back(reader.text());
  }
  reader.end();
  if (spec.argv.empty() || spec.argv.front().empty()) {
    throw WireError("a process can't be started without a program");
  }
  if (spec.sigterm_timeout < Duration{0} || spec.sigkill_timeout < Duration{0}) {
    throw WireError("a process has a timeout below zero");
  }
  return spec;
}

}  // namespace launch

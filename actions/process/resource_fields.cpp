// SPDX-License-Identifier: Apache-2.0
#include "actions/process/resource_fields.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace launch {

namespace {

constexpr std::int64_t kMostUrgent = -20;
constexpr std::int64_t kLeastUrgent = 19;
constexpr std::int64_t kHighestPriority = 99;
constexpr std::int64_t kLeastOpenFiles = 3;  // the standard streams

std::int64_t bounded(const NumberField& number, Scope& scope, const SourceRange& where, const char* name,
                     std::int64_t least, std::int64_t most) {
  const auto value = static_cast<std::int64_t>(number.perform(scope));
  if (value < least || value > most) {
    throw LaunchError(most == std::numeric_limits<int>::max()
                          ? fmt::format("{} is at least {}, got {}", name, least, value)
                          : fmt::format("{} is a number from {} to {}, got {}", name, least, most, value),
                      where);
  }
  return value;
}

template <typename Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && result.ec == std::errc() && result.ptr == text.data() + text.size();
}

// "0,2-3"
std::vector<int> parse_cpus(const std::string& text, const SourceRange& where) {
  std::vector<int> cpus;
  const std::string_view view = text;
  for (std::size_t begin = 0; begin <= view.size();) {
    const std::size_t end = std::min(view.find(',', begin), view.size());
    const std::string_view range = view.substr(begin, end - begin);
    const std::size_t dash = std::min(range.find('-'), range.size());
    int first = 0;
    int last = 0;
    if (!parse_whole(range.substr(0, dash), first) ||
        !parse_whole(dash == range.size() ? range : range.substr(dash + 1), last) || first < 0 || last < first ||
        last >= CPU_SETSIZE) {
      throw LaunchError(fmt::format("'{}' is no list of CPUs", text), where, "write numbers and ranges, such as 0,2-3");
    }
    for (int cpu = first; cpu <= last; ++cpu) {
      cpus.push_back(cpu);
    }
    begin = end + 1;
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

bool is_literal(const std::optional<Template>& text) {
  return text && text->is_literal();
}

}  // namespace

std::uint64_t parse_bytes(const std::string& text, const SourceRange& where) {
  std::string_view digits = text;
  unsigned shift = 0;
  if (!digits.empty()) {
    constexpr std::string_view kUnits = "KMG";
    if (const std::size_t unit = kUnits.find(digits.back()); unit != std::string_view::npos) {
      shift = static_cast<unsigned>(unit + 1) * 10;
      digits.remove_suffix(1);
    }
  }
  std::uint64_t value = 0;
  if (!parse_whole(digits, value) || value == 0 || value > (std::numeric_limits<std::uint64_t>::max() >> shift)) {
    throw LaunchError(fmt::format("'{}' is no amount of memory", text), where,
                      "write bytes, or a number with K, M or G");
  }
  return value << shift;
}

std::vector<AttributeSpec> ResourceFields::attributes() {
  return {
      {"nice", AttributeType::kInteger, false, "the launcher's", "niceness, from -20 (urgent) to 19", true},
      {"sched_policy", AttributeType::kText, false, "the launcher's", "other, batch, idle, fifo or rr", true},
      {"sched_priority", AttributeType::kInteger, false, "", "with fifo and rr: 1 to 99 (urgent)", true},
      {"cpus", AttributeType::kText, false, "the launcher's", "CPUs that the process may run on, such as 0,2-3", true},
      {"memory_limit", AttributeType::kText, false, "none", "private memory in bytes, or with K, M or G", true},
      {"open_files_limit", AttributeType::kInteger, false, "the launcher's",
       "how many descriptors the process may have", true},
  };
}

ResourceFields::ResourceFields(const Fields& fields)
    : nice_{fields.number("nice"), fields.where("nice")},
      policy_(fields.optional_text("sched_policy")),
      priority_{fields.number("sched_priority"), fields.where("sched_priority")},
      cpus_(fields.optional_text("cpus")),
      memory_(fields.optional_text("memory_limit")),
      open_files_{fields.number("open_files_limit"), fields.where("open_files_limit")} {
  Scope nothing;
  if (is_literal(cpus_)) {
    parse_cpus(cpus_->perform(nothing), cpus_->where());
  }
  if (is_literal(memory_)) {
    parse_bytes(memory_->perform(nothing), memory_->where());
  }
}

ResourceLimits ResourceFields::perform(Scope& scope) const {
  ResourceLimits limits;
  if (nice_.number) {
    limits.niceness = bounded(*nice_.number, scope, nice_.where, "nice", kMostUrgent, kLeastUrgent);
  }
  set_policy(scope, limits);
  if (cpus_) {
    limits.cpus = parse_cpus(cpus_->perform(scope), cpus_->where());
  }
  if (memory_) {
    limits.memory = parse_bytes(memory_->perform(scope), memory_->where());
  }
  if (open_files_.number) {
    limits.open_files = bounded(*open_files_.number, scope, open_files_.where, "open_files_limit", kLeastOpenFiles,
                                std::numeric_limits<int>::max());
  }
  return limits;
}

void ResourceFields::set_policy(Scope& scope, ResourceLimits& limits) const {
  if (policy_) {
    const std::string name = policy_->perform(scope);
    limits.policy = scheduling_policy(name);
    if (!limits.policy) {
      throw LaunchError(fmt::format("'{}' is no scheduling policy, expected other, batch, idle, fifo or rr", name),
                        policy_->where(), did_you_mean(name, {"other", "batch", "idle", "fifo", "rr"}));
    }
  }
  const bool real_time = limits.policy == SCHED_FIFO || limits.policy == SCHED_RR;
  if (priority_.number && !real_time) {
    throw LaunchError("sched_priority goes with the policies fifo and rr only", priority_.where,
                      "add sched_policy=\"fifo\", or use nice", Finding::kExclusive);
  }
  if (real_time && !priority_.number) {
    throw LaunchError(fmt::format("the policy {} needs a priority", scheduling_policy_name(*limits.policy)),
                      policy_->where(), "add sched_priority, from 1 to 99", Finding::kMissingAttribute);
  }
  if (real_time) {
    limits.priority =
        static_cast<int>(bounded(*priority_.number, scope, priority_.where, "sched_priority", 1, kHighestPriority));
  }
}

}  // namespace launch

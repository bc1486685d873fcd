// SPDX-License-Identifier: Apache-2.0
// <fault group="…" do="partition|lose|delay">: what it does to the network.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "actions/test/fault_kinds.hpp"
#include "actions/values/range_field.hpp"

namespace launch {

namespace {

struct NetworkRanges {
  NetworkFault fault = {};
  NumberRange share = {1, 1};
  NumberRange by = {};
};

std::vector<NetworkFault::Member> members(const std::vector<Template>& names, Scope& scope) {
  std::vector<NetworkFault::Member> members;
  for (const Template& name : names) {
    members.push_back({name.perform(scope), name.where()});
  }
  return members;
}

std::vector<std::string> names_of_members(const std::vector<NetworkFault::Member>& members) {
  std::vector<std::string> names;
  for (const NetworkFault::Member& member : members) {
    names.push_back(member.name);
  }
  return names;
}

void perform_group(const Fields& fields, Scope& scope, NetworkRanges& ranges) {
  ranges.fault.group = members(fields.words("group"), scope);
  if (ranges.fault.group.empty()) {
    throw LaunchError("the group has no process", fields.where(), {}, Finding::kWrongValue);
  }
}

void perform_others(const Fields& fields, Scope& scope, NetworkRanges& ranges) {
  ranges.fault.from = members(fields.words("from"), scope);
  for (const NetworkFault::Member& other : ranges.fault.from) {
    const auto same = [&](const NetworkFault::Member& member) { return member.name == other.name; };
    if (std::any_of(ranges.fault.group.begin(), ranges.fault.group.end(), same)) {
      throw LaunchError(fmt::format("'{}' is on both sides", other.name), other.where, {}, Finding::kExclusive);
    }
  }
}

const std::vector<Setting<NetworkRanges>>& network_rows() {
  static const std::vector<Setting<NetworkRanges>> rows = {
      {.attribute = {"group", AttributeType::kWords, false, "",
                     "with partition, lose and delay: names of processes, between which and others the network suffers",
                     true},
       .perform = perform_group},
      {.attribute = {"from", AttributeType::kWords, false, "all others", "with group: the names of those others", true},
       .perform = perform_others},
      range_row({"share", AttributeType::kText, false, "",
                 "with lose: the part of the packets that gets lost, from 0 to 1, or a range", true},
                &NetworkRanges::share)};
  return rows;
}

NetworkRanges perform_network(const Fields& fields, NetworkFault::Kind kind, Scope& scope) {
  NetworkRanges ranges;
  ranges.fault.kind = kind;
  perform_settings(network_rows(), fields, scope, ranges);
  if (ranges.share.to > 1) {
    throw LaunchError(fmt::format("a share is at most 1, got {:g}", ranges.share.to), fields.text("share").where(), {},
                      Finding::kWrongValue);
  }
  if (fields.has("by")) {
    ranges.by = perform_range(fields, "by", scope);
  }
  return ranges;
}

std::string identity_of(const NetworkRanges& ranges) {
  const NetworkFault& fault = ranges.fault;
  return fmt::format("network {} {} from {} {}..{} {}..{}", static_cast<int>(fault.kind),
                     fmt::join(names_of_members(fault.group), " "), fmt::join(names_of_members(fault.from), " "),
                     ranges.share.from, ranges.share.to, ranges.by.from, ranges.by.to);
}

NetworkFault draw_of(const NetworkRanges& ranges, const FaultDraw& draw) {
  NetworkFault drawn = ranges.fault;
  drawn.share = draw.number("share", ranges.share);
  drawn.by = as_duration(draw.number("by", ranges.by));
  constexpr double kSeeds = 1e15;
  drawn.seed = draw.whole("packets", {0, kSeeds});
  return drawn;
}

}  // namespace

std::vector<AttributeSpec> network_fault_attributes() {
  return declared_attributes(network_rows());
}

PerformFault network_fault(const Fields& fields, NetworkFault::Kind kind) {
  if (!fields.has("group")) {
    throw LaunchError("it is not said between which processes", fields.where(),
                      "group=\"camera driver\": these processes and all others, or those of from=\"…\"",
                      Finding::kMissingAttribute);
  }
  check_settings(network_rows(), fields);
  check_range(fields, "by");
  if (kind == NetworkFault::Kind::kDelay && !fields.has("by")) {
    throw LaunchError("it is not said how late the packets are", fields.where(), "by=\"0.2\": seconds",
                      Finding::kMissingAttribute);
  }
  if (kind == NetworkFault::Kind::kLose && !fields.has("share")) {
    throw LaunchError("it is not said how much gets lost", fields.where(), "share=\"0.2\": one packet in five",
                      Finding::kMissingAttribute);
  }
  return [&fields, kind](const std::string&, Scope& scope) {
    const NetworkRanges ranges = perform_network(fields, kind, scope);
    return FaultRanges{identity_of(ranges), ranges.share.is_random() || ranges.by.is_random(),
                       [ranges](const FaultDraw& draw) { return draw_of(ranges, draw); }};
  };
}

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
#include "actions/test/network_fault.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "actions/test/expectation_fields.hpp"

namespace launch {

namespace {

std::vector<Template> group_of(const Fields& fields) {
  if (!fields.has("group")) {
    throw LaunchError("it is not said between which processes", fields.where(),
                      "group=\"camera driver\": these processes and all others, or those of from=\"…\"",
                      Finding::kMissingAttribute);
  }
  return fields.words("group");
}

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

}  // namespace

std::string NetworkFaultRanges::identity() const {
  return fmt::format("network {} {} from {} {}..{} {}..{}", static_cast<int>(fault.kind),
                     fmt::join(names_of_members(fault.group), " "), fmt::join(names_of_members(fault.from), " "),
                     share.from, share.to, by.from, by.to);
}

NetworkFault NetworkFaultRanges::draw(const FaultDraw& draw) const {
  NetworkFault drawn = fault;
  drawn.share = draw.number("share", share);
  drawn.by = as_duration(draw.number("by", by));
  constexpr double kSeeds = 1e15;
  drawn.seed = draw.whole("packets", {0, kSeeds});
  return drawn;
}

std::vector<AttributeSpec> NetworkFaultFields::attributes() {
  return {{"group", AttributeType::kWords, false, "",
           "with partition, lose and delay: names of processes, between which and others the network suffers", true},
          {"from", AttributeType::kWords, false, "all others", "with group: the names of those others", true},
          {"share", AttributeType::kText, false, "",
           "with lose: the part of the packets that gets lost, from 0 to 1, or a range", true}};
}

NetworkFaultFields::NetworkFaultFields(const Fields& fields, NetworkFault::Kind kind)
    : kind_(kind),
      where_(fields.where()),
      group_(group_of(fields)),
      from_(fields.optional_words("from").value_or(std::vector<Template>())),
      share_(RangeField::of(fields, "share")),
      by_(RangeField::of(fields, "by")) {
  if (kind_ == NetworkFault::Kind::kDelay && !by_) {
    throw LaunchError("it is not said how late the packets are", fields.where(), "by=\"0.2\": seconds",
                      Finding::kMissingAttribute);
  }
  if (kind_ == NetworkFault::Kind::kLose && !share_) {
    throw LaunchError("it is not said how much gets lost", fields.where(), "share=\"0.2\": one packet in five",
                      Finding::kMissingAttribute);
  }
}

NetworkFaultRanges NetworkFaultFields::perform(Scope& scope) const {
  NetworkFaultRanges ranges;
  ranges.fault.kind = kind_;
  ranges.fault.group = members(group_, scope);
  ranges.fault.from = members(from_, scope);
  if (ranges.fault.group.empty()) {
    throw LaunchError("the group has no process", where_, {}, Finding::kWrongValue);
  }
  for (const NetworkFault::Member& other : ranges.fault.from) {
    const auto same = [&](const NetworkFault::Member& member) { return member.name == other.name; };
    if (std::any_of(ranges.fault.group.begin(), ranges.fault.group.end(), same)) {
      throw LaunchError(fmt::format("'{}' is on both sides", other.name), other.where, {}, Finding::kExclusive);
    }
  }
  ranges.share = share_ ? share_->perform(scope) : NumberRange{1, 1};
  if (ranges.share.to > 1) {
    throw LaunchError(fmt::format("a share is at most 1, got {:g}", ranges.share.to), share_->where(), {},
                      Finding::kWrongValue);
  }
  ranges.by = by_ ? by_->perform(scope) : NumberRange{};
  return ranges;
}

}  // namespace launch

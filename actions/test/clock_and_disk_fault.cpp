// SPDX-License-Identifier: Apache-2.0
// <fault clock="…" do="stop|skew|jump">: what it does to simulated time, and <fault path="…" do="fill_disk">: to a
// disk.
#include <fmt/format.h>

#include <filesystem>

#include "actions/process/resource_settings.hpp"
#include "actions/test/fault_kinds.hpp"
#include "actions/values/range_field.hpp"

namespace launch {

namespace {

struct ClockRanges {
  NumberRange rate = {1, 1};
  NumberRange by = {};
};

const std::vector<Setting<ClockRanges>>& clock_rows() {
  static const std::vector<Setting<ClockRanges>> rows = {
      {.attribute = {"clock", AttributeType::kText, false, "",
                     "with stop, skew and jump: the name of a <clock>, whose time suffers", true}},
      range_row({"rate", AttributeType::kText, false, "", "with skew: so many times its rate, or a range", true},
                &ClockRanges::rate)};
  return rows;
}

ClockRanges perform_clock(const Fields& fields, ClockFault::Kind kind, Scope& scope) {
  ClockRanges ranges;
  perform_settings(clock_rows(), fields, scope, ranges);
  if (ranges.rate.from <= 0) {
    throw LaunchError("the time can't run at rate 0", fields.text("rate").where(), "do=\"stop\" lets it stand still",
                      Finding::kWrongValue);
  }
  if (kind == ClockFault::Kind::kJump) {
    ranges.by = perform_range(fields, "by", scope, RangeOf::kNumbers);
  }
  return ranges;
}

const std::vector<Setting<DiskFault>>& disk_rows() {
  static const std::vector<Setting<DiskFault>> rows = {
      {.attribute = {"path", AttributeType::kText, false, "the log directory",
                     "with fill_disk: a directory, whose disk is full", true},
       .perform =
           [](const Fields& fields, Scope& scope, DiskFault& fault) {
             const Template& given = fields.text("path");
             fault.where = given.where();
             const std::string path = given.perform(scope);
             if (path.empty()) {
               throw LaunchError("the path of the disk is empty", fault.where, {}, Finding::kWrongValue);
             }
             fault.directory = std::filesystem::absolute(path).lexically_normal().string();
           }},
      {.attribute = {"free", AttributeType::kText, false, "nothing",
                     "with fill_disk: for what there is room nevertheless, in bytes, or with K, M or G", true},
       .perform =
           [](const Fields& fields, Scope& scope, DiskFault& fault) {
             fault.free = parse_bytes(fields.text("free").perform(scope), fields.text("free").where());
           },
       .checks_literal = true}};
  return rows;
}

std::string as_written(const Fields& fields, const char* attribute) {
  return fields.has(attribute) ? fields.text(attribute).describe() : "";
}

}  // namespace

std::vector<AttributeSpec> clock_fault_attributes() {
  return declared_attributes(clock_rows());
}

PerformFault clock_fault(const Fields& fields, ClockFault::Kind kind) {
  const bool jumps = kind == ClockFault::Kind::kJump;
  check_settings(clock_rows(), fields);
  if (jumps) {
    check_range(fields, "by", RangeOf::kNumbers);
  }
  if (!fields.has("clock")) {
    throw LaunchError("it is not said which clock", fields.where(), "clock=\"clock\": the name of a <clock>",
                      Finding::kMissingAttribute);
  }
  if (kind == ClockFault::Kind::kSkew && !fields.has("rate")) {
    throw LaunchError("it is not said how fast the time is", fields.where(), "rate=\"0.5\": half as fast",
                      Finding::kMissingAttribute);
  }
  if (jumps && !fields.has("by")) {
    throw LaunchError("it is not said how far the time jumps", fields.where(), "by=\"-2.5\": back, in seconds",
                      Finding::kMissingAttribute);
  }
  if (jumps && fields.has("for")) {
    throw LaunchError("for does not go with do=\"jump\": a jump is over at once", fields.where("for"), {},
                      Finding::kExclusive);
  }
  return [&fields, kind](const std::string& clock, Scope& scope) {
    const auto [rate, by] = perform_clock(fields, kind, scope);
    return FaultRanges{
        fmt::format("{} clock {} {}..{} {}..{}", clock, static_cast<int>(kind), rate.from, rate.to, by.from, by.to),
        rate.is_random() || by.is_random(), [kind, rates = rate, jumps_by = by](const FaultDraw& draw) {
          return ClockFault{kind, draw.number("rate", rates), draw.number("by", jumps_by)};
        }};
  };
}

std::vector<AttributeSpec> disk_fault_attributes() {
  return declared_attributes(disk_rows());
}

PerformFault disk_fault(const Fields& fields) {
  check_settings(disk_rows(), fields);
  return [&fields](const std::string&, Scope& scope) {
    DiskFault fault;
    fault.where = fields.where();
    perform_settings(disk_rows(), fields, scope, fault);
    // Each run has directories of its own, so draws know the path as it is written.
    return FaultRanges{fmt::format("disk {} {}", as_written(fields, "path"), as_written(fields, "free")), false,
                       [fault](const FaultDraw&) { return fault; }};
  };
}

}  // namespace launch

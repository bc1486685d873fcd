// SPDX-License-Identifier: Apache-2.0
#include "actions/test/clock_fault.hpp"

#include <fmt/format.h>

#include "actions/test/expectation_fields.hpp"

namespace launch {

std::string ClockFaultRanges::identity() const {
  return fmt::format("clock {} {}..{} {}..{}", static_cast<int>(kind), rate.from, rate.to, by.from, by.to);
}

ClockFault ClockFaultRanges::draw(const FaultDraw& draw) const {
  return {kind, draw.number("rate", rate), draw.number("by", by)};
}

std::vector<AttributeSpec> ClockFaultFields::attributes() {
  return {{"clock", AttributeType::kText, false, "",
           "with stop, skew and jump: the name of a <clock>, whose time suffers", true},
          {"rate", AttributeType::kText, false, "", "with skew: so many times its rate, or a range", true}};
}

ClockFaultFields::ClockFaultFields(const Fields& fields, ClockFault::Kind kind)
    : kind_(kind),
      rate_(RangeField::of(fields, "rate")),
      by_(kind == ClockFault::Kind::kJump ? RangeField::of(fields, "by", false, true) : std::nullopt) {
  if (!fields.has("clock")) {
    throw LaunchError("it is not said which clock", fields.where(), "clock=\"clock\": the name of a <clock>",
                      Finding::kMissingAttribute);
  }
  if (kind_ == ClockFault::Kind::kSkew && !rate_) {
    throw LaunchError("it is not said how fast the time is", fields.where(), "rate=\"0.5\": half as fast",
                      Finding::kMissingAttribute);
  }
  if (kind_ == ClockFault::Kind::kJump && !by_) {
    throw LaunchError("it is not said how far the time jumps", fields.where(), "by=\"-2.5\": back, in seconds",
                      Finding::kMissingAttribute);
  }
  if (kind_ == ClockFault::Kind::kJump && fields.has("for")) {
    throw LaunchError("for does not go with do=\"jump\": a jump is over at once", fields.where("for"), {},
                      Finding::kExclusive);
  }
}

ClockFaultRanges ClockFaultFields::perform(Scope& scope) const {
  ClockFaultRanges ranges;
  ranges.kind = kind_;
  ranges.rate = rate_ ? rate_->perform(scope) : NumberRange{1, 1};
  if (rate_ && ranges.rate.from <= 0) {
    throw LaunchError("the time can't run at rate 0", rate_->where(), "do=\"stop\" lets it stand still",
                      Finding::kWrongValue);
  }
  ranges.by = by_ ? by_->perform(scope) : NumberRange{};
  return ranges;
}

}  // namespace launch

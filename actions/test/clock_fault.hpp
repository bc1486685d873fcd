// SPDX-License-Identifier: Apache-2.0
// The attributes of a <fault> of simulated time: do="stop|skew|jump" clock="…".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actions/values/range_field.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/fault_draw.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What the attributes are in a scope, before anything is drawn.
struct ClockFaultRanges {
  ClockFault::Kind kind = ClockFault::Kind::kStop;
  NumberRange rate;
  NumberRange by;

  std::string identity() const;
  bool is_random() const { return rate.is_random() || by.is_random(); }
  ClockFault draw(const FaultDraw& draw) const;
};

class ClockFaultFields {
 public:
  // The attributes of the ActionType that other faults don't have.
  static std::vector<AttributeSpec> attributes();

  // Throws LaunchError when attributes don't go together.
  ClockFaultFields(const Fields& fields, ClockFault::Kind kind);

  // Throws LaunchError.
  ClockFaultRanges perform(Scope& scope) const;

 private:
  ClockFault::Kind kind_;
  std::optional<RangeField> rate_;
  std::optional<RangeField> by_;
};

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
// The attributes of a <fault> of the network between processes: do="partition|lose|delay" group="…".
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
struct NetworkFaultRanges {
  NetworkFault fault;
  NumberRange share;
  NumberRange by;

  std::string identity() const;
  bool is_random() const { return share.is_random() || by.is_random(); }
  NetworkFault draw(const FaultDraw& draw) const;
};

class NetworkFaultFields {
 public:
  // The attributes of the ActionType that are not those of faults of messages.
  static std::vector<AttributeSpec> attributes();

  // Throws LaunchError when attributes don't go together.
  NetworkFaultFields(const Fields& fields, NetworkFault::Kind kind);

  // Throws LaunchError.
  NetworkFaultRanges perform(Scope& scope) const;

 private:
  NetworkFault::Kind kind_;
  SourceRange where_;
  std::vector<Template> group_;
  std::vector<Template> from_;
  std::optional<RangeField> share_;
  std::optional<RangeField> by_;
};

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
// The attributes that conditions on the running system have in common.
#pragma once

#include "actions/process/handler_action.hpp"

namespace launch {

using HandledCondition = Handled<OnCondition>;
using ConditionRow = Setting<HandledCondition>;

// A time with its unit, at least so long.
Duration perform_time_with_unit(const char* attribute, const Fields& fields, Scope& scope, Duration least);

// The time that the condition looks back on.
ConditionRow window_row(const char* attribute, bool required, const char* fallback, const char* help);

// The rows that every condition has, behind its own.
HandlerRows<OnCondition> with_common_rows(HandlerRows<OnCondition> rows);

}  // namespace launch

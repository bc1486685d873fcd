// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

std::string domain_name(lttng_domain_type domain) {
  return domain == LTTNG_DOMAIN_KERNEL ? "kernel" : "ust";
}

}  // namespace tracing

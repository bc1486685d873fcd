// SPDX-License-Identifier: Apache-2.0
// Names of context fields ("vpid", "perf:thread:cycles", "$app.provider:type") and what LTTng and perf_event_open(2)
// call them.
#pragma once

#include <lttng/domain.h>
#include <lttng/event.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

struct PerfCounter {
  std::string name;  // as it appears in the trace's field name
  std::uint32_t type = 0;
  std::uint64_t config = 0;
};

// "cycles", "L1-dcache-load-misses", "raw:r1C7:NAME". Nothing when there is no such counter.
std::optional<PerfCounter> find_perf_counter(const std::string& name);

// The names that exist in a domain, without perf counters and application contexts.
std::vector<std::string> context_field_names(lttng_domain_type domain);

// One context field, ready for lttng_add_context(). Owns the strings that the C structure points to.
class ContextField {
 public:
  // Throws TraceError, with a suggestion, for a name that is unknown or does not exist in this domain.
  ContextField(const std::string& name, lttng_domain_type domain);
  ContextField(const ContextField&) = delete;
  ContextField& operator=(const ContextField&) = delete;

  lttng_event_context* get() { return &context_; }

 private:
  void set_known_field(const std::string& name, lttng_domain_type domain);
  void set_perf_counter(const std::string& name, lttng_domain_type domain);
  void set_application_context(const std::string& name);

  lttng_event_context context_{};
  std::string application_provider_;
  std::string application_type_;
};

}  // namespace tracing

// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/process_account.hpp"

namespace tracing {
namespace {

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

}  // namespace

double ProcessAccount::processor_share(double ns_per_event) const {
  return ratio(tracing_seconds(ns_per_event), seconds);
}

double ProcessAccount::own_share(double ns_per_event) const {
  return ratio(tracing_seconds(ns_per_event), cpu_seconds);
}

double ProcessAccount::ns_per_callback(double ns_per_event) const {
  return ratio(static_cast<double>(events) * ns_per_event, static_cast<double>(callbacks));
}

}  // namespace tracing

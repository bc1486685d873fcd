// SPDX-License-Identifier: Apache-2.0
#include "launch_trace/typed_view.hpp"

#include <string_view>
#include <unordered_map>

#include "tracing/decode/cpp_api/access.hpp"
#include "tracing/decode/reader/struct_fields.hpp"

namespace launch_trace {

namespace {

template <class Struct>
void set_view_of(KnownClass& known, const tracing::Event& event) {
  known.view = &view_of<Struct>;
  // The caller sees in the struct what is not there.
  known.view_places = tracing::field_places<Struct>(event, [](const std::string&) {});
}

using SetView = void (*)(KnownClass&, const tracing::Event&);

const std::unordered_map<std::string_view, SetView>& views() {
#define LAUNCH_TRACE_VIEW(provider_, name_, struct_, ...) {provider_::struct_::kName, set_view_of<provider_::struct_>},
  static const std::unordered_map<std::string_view, SetView> views{
      TRACETOOLS_EVENT_TABLE(LAUNCH_TRACE_VIEW, ros2) TRACETOOLS_EXT_EVENT_TABLE(LAUNCH_TRACE_VIEW, ros2_ext)
          LAUNCH_EVENT_TABLE(LAUNCH_TRACE_VIEW, launch)};
#undef LAUNCH_TRACE_VIEW
  return views;
}

}  // namespace

void set_view(KnownClass& known, const tracing::Event& event) {
  const auto found = views().find(known.name);
  if (found != views().end()) {
    found->second(known, event);
  }
}

template <class Struct>
bool read(const Event& event, Struct& fields) {
  const KnownClass& known = Access::known(event);
  if (known.view != &view_of<Struct>) {
    return false;
  }
  tracing::read_fields(Access::event(event), known.view_places, fields);
  return true;
}

#define LAUNCH_TRACE_READ(provider_, name_, struct_, ...) template bool read(const Event&, provider_::struct_&);
TRACETOOLS_EVENT_TABLE(LAUNCH_TRACE_READ, ros2)
TRACETOOLS_EXT_EVENT_TABLE(LAUNCH_TRACE_READ, ros2_ext)
LAUNCH_EVENT_TABLE(LAUNCH_TRACE_READ, launch)
#undef LAUNCH_TRACE_READ

}  // namespace launch_trace

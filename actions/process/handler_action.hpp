// SPDX-License-Identifier: Apache-2.0
// An action that handles an event: its rows, and what it leaves.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "actions/row_action.hpp"

namespace launch {

// What a handler is evaluated to.
template <typename Event>
struct Handled {
  Event event = {};
  EventHandler handler = {};
};

template <typename Event>
using HandlerRows = std::vector<Setting<Handled<Event>>>;

template <typename Event>
Setting<Handled<Event>> process_row() {
  return {.attribute = {"process", AttributeType::kText, false, "every process", "name of the process or of its node"},
          .perform = [](const Fields& fields, Scope& scope, Handled<Event>& handled) {
            handled.handler.process = fields.text("process").perform(scope);
            if (handled.handler.process.empty()) {
              throw LaunchError("the name of the process is empty", fields.text("process").where(),
                                "leave the attribute out to mean every process");
            }
          }};
}

template <typename Event>
Setting<Handled<Event>> once_row() {
  return {.attribute = {"once", AttributeType::kBoolean, false, "false", "true: only the first time"},
          .place = place_of(&Handled<Event>::handler, &EventHandler::once)};
}

template <typename Event>
Setting<Handled<Event>> handler_name_row() {
  return {.attribute = {"name", AttributeType::kText, false, "", "name of the handler, for unregister_event_handler"},
          .place = place_of(&Handled<Event>::handler, &EventHandler::name)};
}

template <typename Event>
ActionType handler_of(std::string tag, std::string help, HandlerRows<Event> rows,
                      void (*check)(const Fields&) = nullptr,
                      void (*finish)(const Fields&, LaunchContext&, Handled<Event>&) = nullptr) {
  for (Setting<Handled<Event>>& row : rows) {
    row.attribute.extension = true;
  }
  return action_of<Handled<Event>>(
      {.tag = std::move(tag), .help = std::move(help), .holds_actions = true, .extension = true}, std::move(rows),
      [finish](const Fields& fields, LaunchContext& context, Handled<Event>& handled) {
        if (finish != nullptr) {
          finish(fields, context, handled);
        }
        EventHandler& handler = handled.handler;
        handler.event = std::move(handled.event);
        handler.actions = fields.actions();
        handler.scope = context.scope();
        handler.where = fields.where();
        context.requests().handlers.push_back(std::move(handler));
      },
      check);
}

}  // namespace launch

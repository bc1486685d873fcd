// SPDX-License-Identifier: Apache-2.0
// An action that its rows tell (launcher/language/setting.hpp): they declare its attributes, and each visit evaluates
// them. What is left to the action is what it does with the values.
#pragma once

#include <functional>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

template <typename Values>
class RowAction : public Action {
 public:
  struct Parts {
    std::vector<Setting<Values>> rows;
    std::function<void(const Fields&, LaunchContext&, Values&)> execute;
    void (*check)(const Fields&);
    bool holds_actions;
  };

  RowAction(Fields fields, std::shared_ptr<const Parts> parts)
      : Action(fields.where(), fields.condition()), fields_(std::move(fields)), parts_(std::move(parts)) {
    check_settings(parts_->rows, fields_);
    if (parts_->check != nullptr) {
      parts_->check(fields_);
    }
  }

  Introspection introspect() const override {
    return parts_->holds_actions ? Introspection{.children = &fields_.actions(), .children_may_not_run = true}
                                 : Introspection{};
  }

 protected:
  void execute(LaunchContext& context) const override {
    Values values{};
    perform_settings(parts_->rows, fields_, context.scope(), values);
    parts_->execute(fields_, context, values);
  }

 private:
  Fields fields_;
  std::shared_ptr<const Parts> parts_;
};

// The values of an action that reads its fields itself.
struct NoValues {};

// The declaration of such an action. Its attributes are those of the rows, and then those that `declared` has. `check`
// throws LaunchError when attributes don't go together. The actions that it holds may not be visited at all.
template <typename Values>
ActionType action_of(ActionType declared, std::vector<Setting<Values>> rows,
                     std::function<void(const Fields&, LaunchContext&, Values&)> execute,
                     void (*check)(const Fields&) = nullptr) {
  std::vector<AttributeSpec> attributes = declared_attributes(rows);
  std::move(declared.attributes.begin(), declared.attributes.end(), std::back_inserter(attributes));
  declared.attributes = std::move(attributes);
  using Parts = typename RowAction<Values>::Parts;
  const auto parts =
      std::make_shared<const Parts>(Parts{std::move(rows), std::move(execute), check, declared.holds_actions});
  declared.make = [parts](Fields fields) { return std::make_shared<RowAction<Values>>(std::move(fields), parts); };
  return declared;
}

}  // namespace launch

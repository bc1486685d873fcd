// SPDX-License-Identifier: Apache-2.0
// The attributes that <executable> and <node> share: how a process runs, where its output goes, when it runs again.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "actions/process/depends_on.hpp"
#include "actions/process/resource_fields.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class ProcessFields {
 public:
  // Declarations of the common attributes and items, for an ActionType.
  static std::vector<AttributeSpec> attributes();
  static std::vector<ItemSpec> items();

  explicit ProcessFields(const Fields& fields);

  // Fills everything of the spec but its argv and its name, which must be set before, and asks the context to start the
  // process. The launch prefix is put in front of argv. An empty name becomes the base name of argv[0].
  void request(LaunchContext& context, ProcessSpec spec) const;

 private:
  std::vector<std::string> launch_prefix(Scope& scope, const std::string& program) const;
  RespawnPolicy respawn(Scope& scope) const;
  std::string crash_directory(Scope& scope) const;  // empty: none
  Environment environment(Scope& scope) const;
  OutputRouting output(LaunchContext& context) const;
  bool emulate_tty(Scope& scope) const;
  bool terminal_input(Scope& scope) const;
  Duration timeout(Scope& scope, const std::optional<NumberField>& given, const std::string& configuration) const;

  SourceRange where_;
  std::optional<Template> working_directory_;
  std::optional<Template> launch_prefix_;
  std::optional<Template> output_;
  std::optional<Template> stdout_;
  std::optional<Template> stderr_;
  std::optional<Template> respawn_;
  std::optional<NumberField> respawn_delay_;
  std::optional<NumberField> respawn_max_retries_;
  std::optional<NumberField> respawn_backoff_;
  std::optional<NumberField> respawn_max_delay_;
  SourceRange respawn_backoff_where_;
  std::optional<Template> allowed_exits_;
  std::optional<Template> crash_directory_;
  BooleanField required_;
  SourceRange required_where_;
  bool shutdown_on_exit_ = false;
  BooleanField shell_;
  BooleanField emulate_tty_;
  std::optional<Template> stdin_;
  BooleanField traced_;
  BooleanField leave_running_;
  std::optional<NumberField> sigterm_timeout_;
  std::optional<NumberField> sigkill_timeout_;
  std::vector<std::pair<Template, Template>> environment_;
  BooleanField clean_environment_;
  ResourceFields resources_;
  std::vector<DependsOn> dependencies_;
};

}  // namespace launch

// SPDX-License-Identifier: Apache-2.0
// The Python of a launch that a script has started: it is the script's own process. All objects, functions and handlers
// stay there; the launcher calls them over a socket.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/python/script/script_link.hpp"
#include "launcher/python/script/script_values.hpp"

namespace launch {

class ScriptRuntime : public python::Runtime {
 public:
  // Throws std::system_error.
  explicit ScriptRuntime(const ScriptOrder& order) : link_(order) {}

  void show_tracebacks() override { shows_tracebacks_ = true; }
  void report_deaths(int) override {}  // Python is the program of the user
  std::optional<python::SyntaxError> syntax_error(const std::string&) override { return std::nullopt; }
  std::string evaluate(const std::string& expression, const std::string& modules) override;
  std::vector<python::Entity> load(const std::string& path, const std::string& text, python::Host& host) override;
  std::optional<std::vector<python::Entity>> make_action(const python::Element& element, python::Host& host) override;
  std::optional<python::Text> make_substitution(const std::string& name, const std::vector<python::Argument>& arguments,
                                                const python::Place& where, python::Host& host) override;
  python::ExposedNames exposed_names(bool of_actions, python::Host& host) override;
  python::Pause step_coroutines(python::Host& host) override;
  void cancel_coroutines(python::Host& host) override;

 private:
  using Json = nlohmann::json;
  class Object;

  // The value of a call, for instance {"call", "load"}. Throws python::Error, also when the script has ended.
  Json call(Json request, python::Host* host);
  Json wait_for_value(python::Host* host);
  // The answer to what the script asks of the host.
  Json answer(const Json& question, python::Host* host);
  Json ask_host(const Json& question, python::Host& host);
  [[noreturn]] void fail(const Json& error);
  std::vector<python::Entity> entities(const Json& json);
  MakeScriptObject make_object();

  ScriptLink link_;
  bool shows_tracebacks_ = false;
  bool has_ended_ = false;
  int depth_ = 0;                             // of calls in calls
  std::vector<std::int64_t> dropped_;         // numbers of objects that nobody holds any more
  std::vector<std::exception_ptr> failures_;  // of the host, in the outermost call
};

}  // namespace launch

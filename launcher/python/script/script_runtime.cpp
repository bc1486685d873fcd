// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/script/script_runtime.hpp"

#include <stdexcept>
#include <utility>

namespace launch {

// A Python object of the script, by its number.
class ScriptRuntime::Object : public python::Object {
 public:
  Object(ScriptRuntime& runtime, std::int64_t number) : runtime_(runtime), number_(number) {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() override { runtime_.dropped_.push_back(number_); }

  std::string perform(python::Host& host) override { return call("perform", &host).get<std::string>(); }
  std::string describe() override { return call("describe", nullptr).get<std::string>(); }
  std::vector<python::Entity> execute(python::Host& host) override {
    // The end of the script has been told already. What its handlers would do at the end of the launch is left out.
    return runtime_.has_ended_ ? std::vector<python::Entity>() : runtime_.entities(call("execute", &host));
  }
  std::optional<std::string> function() override {
    const Json name = call("function", nullptr);
    return name.is_null() ? std::nullopt : std::optional(name.get<std::string>());
  }
  void start(python::Host& host) override { call("start", &host); }

 private:
  Json call(const char* what, python::Host* host) { return runtime_.call({{"call", what}, {"object", number_}}, host); }

  ScriptRuntime& runtime_;
  std::int64_t number_;
};

std::string ScriptRuntime::evaluate(const std::string& expression, const std::string& modules) {
  return call({{"call", "evaluate"}, {"expression", expression}, {"modules", modules}}, nullptr).get<std::string>();
}

std::vector<python::Entity> ScriptRuntime::load(const std::string& path, const std::string& text, python::Host& host) {
  return entities(call({{"call", "load"}, {"path", path}, {"text", text}}, &host));
}

std::optional<std::vector<python::Entity>> ScriptRuntime::make_action(const python::Element& element,
                                                                      python::Host& host) {
  const Json made = call({{"call", "make_action"}, {"element", write_element(element)}}, &host);
  return made.is_null() ? std::nullopt : std::optional(entities(made));
}

std::optional<python::Text> ScriptRuntime::make_substitution(const std::string& name,
                                                             const std::vector<python::Argument>& arguments,
                                                             const python::Place& where, python::Host& host) {
  const Json made = call({{"call", "make_substitution"},
                          {"name", name},
                          {"arguments", write_arguments(arguments)},
                          {"place", write_place(where)}},
                         &host);
  return made.is_null() ? std::nullopt : std::optional(read_text(made, make_object()));
}

python::ExposedNames ScriptRuntime::exposed_names(bool of_actions, python::Host& host) {
  const Json found = call({{"call", "exposed_names"}, {"of_actions", of_actions}}, &host);
  return {found.at(0).get<std::vector<std::string>>(), found.at(1).get<std::string>()};
}

python::Pause ScriptRuntime::step_coroutines(python::Host& host) {
  link_.take_wishes();
  if (has_ended_) {
    return {};
  }
  const Json state = call({{"call", "step"}}, &host);
  return {state.at(0).get<std::size_t>(), state.at(1).get<std::size_t>(), link_.descriptor(), std::nullopt};
}

void ScriptRuntime::cancel_coroutines(python::Host& host) {
  if (!has_ended_) {
    call({{"call", "cancel"}}, &host);
  }
}

ScriptRuntime::Json ScriptRuntime::call(Json request, python::Host* host) {
  request["drop"] = std::exchange(dropped_, {});
  request["tracebacks"] = shows_tracebacks_;
  ++depth_;
  const auto leave = [this] {
    if (--depth_ == 0) {
      failures_.clear();
    }
  };
  try {
    link_.send(request);
    Json value = wait_for_value(host);
    leave();
    return value;
  } catch (const python::Error&) {
    leave();
    throw;
  } catch (const std::exception& error) {
    has_ended_ = true;
    leave();
    throw python::Error(error.what(), {}, {}, {}, nullptr);
  }
}

ScriptRuntime::Json ScriptRuntime::wait_for_value(python::Host* host) {
  for (;;) {
    Json message = link_.receive();
    if (message.contains("host")) {
      link_.send(answer(message, host));
      continue;
    }
    if (const auto error = message.find("error"); error != message.end()) {
      fail(*error);
    }
    return std::move(message.at("value"));
  }
}

ScriptRuntime::Json ScriptRuntime::answer(const Json& question, python::Host* host) {
  try {
    if (host == nullptr) {
      throw std::runtime_error("no launch is running here");
    }
    return {{"value", ask_host(question, *host)}};
  } catch (const std::exception& error) {
    failures_.push_back(std::current_exception());
    return {{"failure", failures_.size() - 1}, {"what", error.what()}};
  }
}

ScriptRuntime::Json ScriptRuntime::ask_host(const Json& question, python::Host& host) {
  const auto text_of = [&question](const char* key) { return question.at(key).get<std::string>(); };
  const auto variables = [&]() -> python::Host::Variables& {
    return question.at("environment").get<bool>() ? host.environment() : host.configurations();
  };
  const std::string what = text_of("host");
  if (what == "perform") {
    const python::Text text = read_text(question.at("text"), make_object());
    const Json& configurations = question.at("configurations");
    if (configurations.is_null()) {
      return host.perform(text);
    }
    auto own = configurations.get<python::Host::Variables>();
    return host.perform(text, own);
  }
  if (what == "get") {
    const auto found = variables().find(text_of("name"));
    return found == variables().end() ? Json(nullptr) : Json(found->second);
  }
  if (what == "names") {
    Json names = Json::array();
    for (const auto& [name, value] : variables()) {
      names.push_back(name);
    }
    return names;
  }
  if (what == "set") {
    variables().insert_or_assign(text_of("name"), text_of("value"));
  } else if (what == "erase") {
    variables().erase(text_of("name"));
  } else if (what == "log_directory") {
    return host.log_directory();
  } else if (what == "message") {
    host.message(text_of("level"), text_of("logger"), text_of("text"));
  } else if (what == "visit") {
    host.visit(entities(question.at("entities")));
  } else if (what == "run_coroutine") {
    host.run_coroutine(make_object()(question.at("object").get<std::int64_t>()));
  } else if (what == "push") {
    host.push(question.at("environment").get<bool>());
  } else if (what == "pop") {
    host.pop(question.at("environment").get<bool>());
  } else {
    throw std::runtime_error("the launcher knows no call '" + what +
                             "'; it is of another version than the script's packages");
  }
  return nullptr;
}

void ScriptRuntime::fail(const Json& error) {
  std::exception_ptr cause;
  if (const auto number = error.find("failure"); number != error.end() && number->is_number()) {
    const auto index = number->get<std::size_t>();
    cause = index < failures_.size() ? failures_[index] : nullptr;
  }
  throw python::Error(error.at("message").get<std::string>(), read_place(error.at("place")),
                      error.at("help").get<std::string>(), error.at("traceback").get<std::string>(), std::move(cause));
}

std::vector<python::Entity> ScriptRuntime::entities(const Json& json) {
  return read_entities(json, make_object());
}

MakeScriptObject ScriptRuntime::make_object() {
  return [this](std::int64_t number) { return std::make_shared<Object>(*this, number); };
}

}  // namespace launch

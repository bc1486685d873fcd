// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_client.hpp"

#include <algorithm>
#include <string_view>

#include "parameter/parameter_service_names.hpp"
#include "rclcpp/create_client.hpp"

namespace rclcpp {

namespace {

namespace srv = rcl_interfaces::srv;
namespace names = parameter_service_names;

// Sends the request. `convert` turns the response into the future's value.
template <typename ResultT, typename ServiceT, typename ConvertT>
std::shared_future<ResultT> call(Client<ServiceT>& client, std::shared_ptr<typename ServiceT::Request> request,
                                 ConvertT convert, std::function<void(std::shared_future<ResultT>)> callback) {
  auto promise = std::make_shared<std::promise<ResultT>>();
  std::shared_future<ResultT> result = promise->get_future().share();
  client.async_send_request(request, [promise, result, convert = std::move(convert),
                                      callback = std::move(callback)](typename Client<ServiceT>::SharedFuture future) {
    promise->set_value(convert(*future.get()));
    if (callback) {
      callback(result);
    }
  });
  return result;
}

std::vector<rcl_interfaces::msg::Parameter> to_messages(const std::vector<Parameter>& parameters) {
  std::vector<rcl_interfaces::msg::Parameter> messages;
  std::transform(parameters.begin(), parameters.end(), std::back_inserter(messages),
                 [](const Parameter& parameter) { return parameter.to_parameter_msg(); });
  return messages;
}

}  // namespace

AsyncParametersClient::AsyncParametersClient(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                                             node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                                             node_interfaces::NodeServicesInterface::SharedPtr node_services,
                                             const std::string& remote_node_name, const QoS& qos,
                                             CallbackGroup::SharedPtr group)
    : node_base_(std::move(node_base)), node_topics_(std::move(node_topics)) {
  const std::string remote = remote_node_name.empty() ? node_base_->get_name() : remote_node_name;
  const auto connect = [&]<typename ServiceT>(std::shared_ptr<Client<ServiceT>>& client, const char* name) {
    client = create_client<ServiceT>(node_base_, node_services, names::of(remote, name), qos, group);
  };
  connect(get_, names::kGetParameters);
  connect(get_types_, names::kGetParameterTypes);
  connect(set_, names::kSetParameters);
  connect(set_atomically_, names::kSetParametersAtomically);
  connect(describe_, names::kDescribeParameters);
  connect(list_, names::kListParameters);
  const std::string_view service = list_->get_service_name();
  remote_node_name_ = service.substr(0, service.rfind('/'));
}

std::shared_future<std::vector<Parameter>> AsyncParametersClient::get_parameters(
    const std::vector<std::string>& names, Callback<std::vector<Parameter>> callback) {
  auto request = std::make_shared<srv::GetParameters::Request>();
  request->names = names;
  const auto convert = [names](const srv::GetParameters::Response& response) {
    std::vector<Parameter> parameters;
    for (size_t i = 0; i < std::min(names.size(), response.values.size()); ++i) {
      parameters.emplace_back(names[i], ParameterValue(response.values[i]));
    }
    return parameters;
  };
  return call<std::vector<Parameter>>(*get_, request, convert, std::move(callback));
}

std::shared_future<std::vector<AsyncParametersClient::Descriptor>> AsyncParametersClient::describe_parameters(
    const std::vector<std::string>& names, Callback<std::vector<Descriptor>> callback) {
  auto request = std::make_shared<srv::DescribeParameters::Request>();
  request->names = names;
  const auto convert = [](const srv::DescribeParameters::Response& response) { return response.descriptors; };
  return call<std::vector<Descriptor>>(*describe_, request, convert, std::move(callback));
}

std::shared_future<std::vector<ParameterType>> AsyncParametersClient::get_parameter_types(
    const std::vector<std::string>& names, Callback<std::vector<ParameterType>> callback) {
  auto request = std::make_shared<srv::GetParameterTypes::Request>();
  request->names = names;
  const auto convert = [](const srv::GetParameterTypes::Response& response) {
    std::vector<ParameterType> types;
    std::transform(response.types.begin(), response.types.end(), std::back_inserter(types),
                   [](uint8_t type) { return static_cast<ParameterType>(type); });
    return types;
  };
  return call<std::vector<ParameterType>>(*get_types_, request, convert, std::move(callback));
}

std::shared_future<std::vector<AsyncParametersClient::SetResult>> AsyncParametersClient::set_parameters(
    const std::vector<Parameter>& parameters, Callback<std::vector<SetResult>> callback) {
  auto request = std::make_shared<srv::SetParameters::Request>();
  request->parameters = to_messages(parameters);
  const auto convert = [](const srv::SetParameters::Response& response) { return response.results; };
  return call<std::vector<SetResult>>(*set_, request, convert, std::move(callback));
}

std::shared_future<AsyncParametersClient::SetResult> AsyncParametersClient::set_parameters_atomically(
    const std::vector<Parameter>& parameters, Callback<SetResult> callback) {
  auto request = std::make_shared<srv::SetParametersAtomically::Request>();
  request->parameters = to_messages(parameters);
  const auto convert = [](const srv::SetParametersAtomically::Response& response) { return response.result; };
  return call<SetResult>(*set_atomically_, request, convert, std::move(callback));
}

std::shared_future<std::vector<AsyncParametersClient::SetResult>> AsyncParametersClient::delete_parameters(
    const std::vector<std::string>& names) {
  std::vector<Parameter> parameters;
  std::transform(names.begin(), names.end(), std::back_inserter(parameters),
                 [](const std::string& name) { return Parameter(name); });
  return set_parameters(parameters);
}

std::shared_future<std::vector<AsyncParametersClient::SetResult>> AsyncParametersClient::load_parameters(
    const std::string& yaml_filename) {
  return load_parameters(parameter_map_from_yaml_file(yaml_filename, remote_node_name_.c_str()));
}

std::shared_future<std::vector<AsyncParametersClient::SetResult>> AsyncParametersClient::load_parameters(
    const ParameterMap& parameter_map) {
  const std::vector<Parameter> parameters = parameters_from_map(parameter_map, remote_node_name_.c_str());
  if (parameters.empty()) {
    throw exceptions::InvalidParametersException("there are no parameters for node '" + remote_node_name_ + "'");
  }
  return set_parameters(parameters);
}

std::shared_future<AsyncParametersClient::ListResult> AsyncParametersClient::list_parameters(
    const std::vector<std::string>& prefixes, uint64_t depth, Callback<ListResult> callback) {
  auto request = std::make_shared<srv::ListParameters::Request>();
  request->prefixes = prefixes;
  request->depth = depth;
  const auto convert = [](const srv::ListParameters::Response& response) { return response.result; };
  return call<ListResult>(*list_, request, convert, std::move(callback));
}

std::vector<ClientBase::SharedPtr> AsyncParametersClient::clients() const {
  return {get_, get_types_, set_, set_atomically_, describe_, list_};
}

bool AsyncParametersClient::service_is_ready() const {
  const auto all = clients();
  return std::all_of(all.begin(), all.end(), [](const auto& client) { return client->service_is_ready(); });
}

bool AsyncParametersClient::wait_for_service_nanoseconds(std::chrono::nanoseconds timeout) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + timeout;
  const auto all = clients();
  return std::all_of(all.begin(), all.end(), [&](const auto& client) {
    if (timeout < std::chrono::nanoseconds::zero()) {
      return client->wait_for_service();
    }
    return client->wait_for_service(std::max<steady_clock::duration>(deadline - steady_clock::now(), {}));
  });
}

bool SyncParametersClient::has_parameter(const std::string& name) {
  const std::vector<std::string> found = list_parameters({name}, 1).names;
  return std::find(found.begin(), found.end(), name) != found.end();
}

}  // namespace rclcpp

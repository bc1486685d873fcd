// SPDX-License-Identifier: Apache-2.0
// What is decided before a launch is asked; tests/e2e/remote has the rest.
#include "programs/serve/service.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "programs/serve/page/page.hpp"

namespace {

using namespace launch::serve;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kServiceToken = "a-token-that-nobody-guesses";

class ServiceTest : public testing::Test {
 protected:
  static HttpRequest request(const std::string& method, const std::string& path, const std::string& body = "") {
    HttpRequest made;
    made.method = method;
    made.path = path;
    made.body = body;
    made.client = "192.168.1.5";
    made.header = {{"host", "127.0.0.1:7411"}, {"authorization", "Bearer " + kServiceToken}};
    if (method == "POST") {
      made.header["content-type"] = "application/json; charset=utf-8";
    }
    return made;
  }
  // "409 text of the error"
  std::string error(const HttpRequest& asked) {
    const HttpAnswer answer = service_.answer(asked);
    return std::to_string(answer.status) + " " + nlohmann::json::parse(answer.body)["error"].get<std::string>();
  }
  static std::string header_of(const HttpAnswer& answer, const std::string& wanted) {
    for (const auto& [name, value] : answer.header) {
      if (name == wanted) {
        return value;
      }
    }
    return "";
  }

  Access access_{{.token = kServiceToken, .hosts = {}, .tls = false, .allow_control = false}};
  std::vector<std::string> log_;
  Service service_{access_, {}, -1, [this](const std::string& line) { log_.push_back(line); }};
};

TEST_F(ServiceTest, RefusesWhoDoesNotKnowTheToken) {
  HttpRequest unknown = request("GET", "/api/launches");
  unknown.header.erase("authorization");
  EXPECT_EQ(error(unknown), "401 the token is missing or wrong");
  EXPECT_EQ(header_of(service_.answer(unknown), "WWW-Authenticate"), "Bearer");
  EXPECT_THAT(log_, IsEmpty());
  unknown.header["authorization"] = "Bearer wrong";
  EXPECT_EQ(error(unknown), "401 the token is missing or wrong");
  EXPECT_THAT(log_, ElementsAre("wrong token from 192.168.1.5"));
  for (const char* const path : {"/api/launches/1", "/api/launches/1/events", "/nothing", "/logout"}) {
    unknown.path = path;
    EXPECT_EQ(error(unknown), "401 the token is missing or wrong") << path;
  }
  unknown.header["host"] = "evil.example";
  EXPECT_EQ(error(unknown), "421 this service is not asked for by this name");
}

TEST_F(ServiceTest, ShowsOnlyUnlessItMaySteer) {
  for (const char* const what : {"stop", "start", "restart", "signal", "shutdown", "of a later version"}) {
    EXPECT_EQ(error(request("POST", "/api/launches/1", nlohmann::json{{"do", what}}.dump())),
              "403 this service only shows launches");
  }
  EXPECT_THAT(log_, IsEmpty());
}

TEST_F(ServiceTest, TakesRequestsThatAreJson) {
  const std::string refused = "400 a request is a JSON object with the text 'do', and others as docs/control.md says";
  for (const char* const body :
       {"", "x", "[]", "1", "{}", R"({"do": 1})", R"({"do": null})", R"({"processes": []})",
        R"({"do": "ps", "processes": "x"})", R"({"do": "ps", "processes": [1]})", R"({"do": "ps", "signal": 9})",
        R"({"do": "ps", "groups": "x"})", R"({"do": "scale", "count": {"a": 1}})", R"({"do": "ps", "version": "1"})",
        R"({"do": "ps", "version": 1.5})", "{\"do\": \"\xff\"}"}) {
    EXPECT_EQ(error(request("POST", "/api/launches/1", body)), refused) << body;
  }
  const std::string deep(30'000, '[');
  EXPECT_EQ(error(request("POST", "/api/launches/1", deep)), refused);
  EXPECT_EQ(error(request("POST", "/api/launches/1",
                          R"({"do": "ps", "processes": )" + deep + std::string(30'000, ']') + "}")),
            refused);
  HttpRequest form = request("POST", "/api/launches/1", R"({"do": "ps"})");
  form.header["content-type"] = "text/plain";  // a page of another site could send it without being asked
  EXPECT_EQ(error(form), "415 a request is JSON");
  EXPECT_EQ(error(request("POST", "/api/launches/1", R"({"do": "events"})")), "400 'events' has an address of its own");
}

TEST_F(ServiceTest, KnowsItsAddressesAndMethods) {
  EXPECT_EQ(error(request("GET", "/nothing")), "404 there is nothing at this address");
  EXPECT_EQ(error(request("GET", "/api/launches/1/x")), "404 there is nothing at this address");
  EXPECT_EQ(error(request("GET", "/api/launchesx")), "404 there is nothing at this address");
  EXPECT_EQ(error(request("POST", "/")), "405 this address takes GET only");
  EXPECT_EQ(error(request("GET", "/logout")), "405 this address takes POST only");
  EXPECT_EQ(error(request("DELETE", "/api/launches")), "405 this address takes GET only");
  EXPECT_EQ(error(request("PUT", "/api/launches/1")), "405 this address takes GET, POST only");
  for (const char* const number : {"", "0", "-1", "x", "1x", "99999999999999999999", "1%0a"}) {
    EXPECT_THAT(error(request("GET", std::string("/api/launches/") + number)), HasSubstr("404 launch ")) << number;
  }
}

TEST_F(ServiceTest, ALoginGivesASessionThatALogoutEnds) {
  HttpRequest login = request("POST", "/login", "token=" + kServiceToken);
  login.header.erase("authorization");
  login.header["content-type"] = "application/x-www-form-urlencoded";
  login.header["origin"] = "http://127.0.0.1:7411";
  const HttpAnswer done = service_.answer(login);
  EXPECT_EQ(done.status, 303);
  EXPECT_EQ(header_of(done, "Location"), "/");
  const std::string cookie = header_of(done, "Set-Cookie");
  EXPECT_THAT(cookie, HasSubstr("; HttpOnly; SameSite=Strict"));
  EXPECT_THAT(cookie, Not(HasSubstr(kServiceToken)));

  HttpRequest page = request("GET", "/");
  page.header.erase("authorization");
  EXPECT_EQ(service_.answer(page).status, 401);
  EXPECT_THAT(service_.answer(page).body, HasSubstr("<form class=\"panel\" method=\"post\" action=\"/login\">"));
  page.cookies["launch-7411"] = cookie.substr(12, 64);
  EXPECT_EQ(service_.answer(page).status, 200);
  HttpRequest logout = page;
  logout.method = "POST";
  logout.path = "/logout";
  EXPECT_EQ(service_.answer(logout).status, 403) << "it does not say its origin";
  logout.header["origin"] = "http://127.0.0.1:7411";
  EXPECT_EQ(service_.answer(logout).status, 303);
  EXPECT_EQ(service_.answer(page).status, 401);

  login.body = "token=wrong";
  EXPECT_EQ(service_.answer(login).status, 401);
  EXPECT_THAT(service_.answer(login).body, HasSubstr("This is not the token."));
  EXPECT_EQ(header_of(service_.answer(login), "Set-Cookie"), "");
  login.header["origin"] = "http://evil.example";
  EXPECT_EQ(service_.answer(login).status, 403);
}

TEST_F(ServiceTest, APageRunsNothingButItsOwnScript) {
  const HttpAnswer first = service_.answer(request("GET", "/"));
  const HttpAnswer second = service_.answer(request("GET", "/"));
  const std::string policy = header_of(first, "Content-Security-Policy");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'; script-src 'nonce-"));
  EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  EXPECT_NE(policy, header_of(second, "Content-Security-Policy")) << "a nonce is for one answer";
  const std::size_t at = policy.find("nonce-") + 6;
  const std::string nonce = policy.substr(at, policy.find('\'', at) - at);
  EXPECT_EQ(nonce.size(), 32U);
  EXPECT_THAT(first.body, HasSubstr("<script nonce=\"" + nonce + "\">"));
  EXPECT_THAT(first.body, HasSubstr("<style nonce=\"" + nonce + "\">"));
  EXPECT_THAT(first.body, Not(HasSubstr("{nonce}")));
}

TEST(PageTest, NeedsNothingFromElsewhere) {
  for (const std::string_view page : {kPage, kLoginPage, kWrongTokenPage}) {
    const std::string text(page);
    EXPECT_THAT(text, Not(HasSubstr("/*s")));  // a place that was not filled
    EXPECT_THAT(text, Not(HasSubstr("innerHTML")));
    EXPECT_THAT(text, Not(HasSubstr(" src=")));
    EXPECT_THAT(text, Not(HasSubstr("@import")));
    EXPECT_THAT(text, Not(HasSubstr("url(")));
    EXPECT_THAT(text, Not(HasSubstr(" style=")));
    EXPECT_THAT(text, Not(HasSubstr(" onclick")));
  }
}

TEST(FormTest, FieldsAreDecoded) {
  EXPECT_EQ(form_field("token=a%2Bb+c%3d", "token"), "a+b c=");
  EXPECT_EQ(form_field("x=1&token=2&token=3", "token"), "2");
  EXPECT_EQ(form_field("mytoken=1&token2=2", "token"), "");
  EXPECT_EQ(form_field("token=%", "token"), "%");
  EXPECT_EQ(form_field("token=%4", "token"), "%4");
  EXPECT_EQ(form_field("token=%zz%00", "token"), std::string("%zz\0", 4));
  EXPECT_EQ(form_field("token", "token"), "");
  EXPECT_EQ(form_field("", "token"), "");
  EXPECT_EQ(form_field("&&=&token=1", "token"), "1");
}

}  // namespace

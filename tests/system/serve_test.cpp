// Owns the claims about the server as a process: the protocol end to end, clients side by side, clients that misbehave.
#include <random>

#include "sim/eval/drive_model.h"
#include "sim/scene/scene_io.h"
#include "tests/system/server.h"

namespace beltlife::system_test {
namespace {

using Json = nlohmann::json;
using Serve = InServedFolder;

std::string type_of(const HttpReply& reply) { return reply.json().value(Json::json_pointer("/error/type"), ""); }
std::string message_of(const HttpReply& reply) { return reply.json().value(Json::json_pointer("/error/message"), ""); }

/// What the simulator itself answers, in this process.
std::vector<double> simulated(const fs::path& drive, double friction, double x_mm, const Arguments& settings = {}) {
  const PointModel model = drive_model(read_scene(drive, settings).scene, {"belt.friction_front", "pulley.driven.x_mm"},
                                       {"fast.pulley.driven.hub_load_n.mean", "slow.pulley.driven.hub_load_n.max"}, {});
  return model({Point{friction, x_mm}}, {}).at(0).values;
}

TEST_F(Serve, AnswersItsWholeProtocolWithTheSimulatorsNumbers) {
  start(served(""));
  EXPECT_EQ(http("GET", "/Info").json(), (Json{{"protocolVersion", 1.0}, {"models", {"beltlife"}}}));
  const std::string name = R"({"name": "beltlife"})";
  EXPECT_EQ(http("POST", "/InputSizes", name).json(), (Json{{"inputSizes", {2}}}));
  EXPECT_EQ(http("POST", "/OutputSizes", name).json(), (Json{{"outputSizes", {2}}}));
  EXPECT_TRUE(http("POST", "/ModelInfo", name).json()["support"]["Evaluate"]);
  for (const char* path : {"/Gradient", "/ApplyJacobian", "/ApplyHessian"}) {
    const HttpReply reply = http("POST", path, name);
    EXPECT_EQ(reply.status, 400);
    EXPECT_EQ(type_of(reply), "UnsupportedFeature") << reply.body;
  }
  const HttpReply plain = evaluate(0.6, 500), finer = evaluate(0.6, 500, {{"settings", {"belt.elements=72"}}});
  EXPECT_EQ(plain.status, 200);
  EXPECT_NE(plain.head.find("application/json"), plain.head.npos);
  EXPECT_EQ(plain.json(), (Json{{"output", {simulated(folder / "drive.toml", 0.6, 500)}}}));
  EXPECT_EQ(finer.json(), (Json{{"output", {simulated(folder / "drive.toml", 0.6, 500, {"belt.elements=72"})}}}));
  EXPECT_NE(plain.body, finer.body);
  EXPECT_EQ(evaluate(0.6, 500).body, plain.body) << "again";
  EXPECT_EQ(stop(), 0);
  EXPECT_NE(text_of(folder / "said").find("[1] pulley.driven.x_mm, from 50 to 600"), std::string::npos);
}

TEST_F(Serve, AnswersErrorsInTheProtocolsForm) {
  start("step_budget = 12000\n" + served(""));
  const auto expect = [](const HttpReply& reply, int status, const std::string& type, const std::string& words) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(type_of(reply), type) << reply.body;
    EXPECT_NE(message_of(reply).find(words), std::string::npos) << reply.body;
  };
  expect(http("POST", "/Evaluate", "rubbish"), 400, "InvalidInput", "no JSON");
  expect(http("POST", "/Evaluate", std::string(100000, '[')), 400, "InvalidInput", "nested deeper");
  expect(http("POST", "/Evaluate", R"({"name": "other", "input": [[0.6, 500]]})"), 400, "ModelNotFound", "'other'");
  expect(http("POST", "/Evaluate", R"({"name": "beltlife", "input": [[0.6]]})"), 400, "InvalidInput", "2 numbers");
  expect(evaluate(0.1, 500), 400, "InvalidInput", "belt.friction_front");
  expect(evaluate(0.6, 60), 400, "InvalidInput", "infeasible: ");
  expect(evaluate(0.6, 500, {{"settings", {"belt.ribs=3"}}}), 400, "InvalidInput", "not to be set by requests");
  expect(evaluate(0.6, 500, {{"settings", {"belt.elements=0"}}}), 400, "InvalidInput", "belt.elements");
  expect(http("GET", "/"), 404, "UnsupportedFeature", "there is no /");
  expect(http("GET", "/Evaluate"), 405, "UnsupportedFeature", "allowed: POST");
  expect(http("DELETE", "/Info"), 405, "UnsupportedFeature", "allowed: GET");
  EXPECT_EQ(evaluate(0.6, 500).status, 200);
  EXPECT_EQ(stop(SIGINT), 0);

  start("step_budget = 100\n" + served(""));
  expect(evaluate(0.6, 500), 500, "EvaluationError", "timed_out: ");
}

TEST_F(Serve, GivesClientsSideBySideTheAnswersOfOneAfterAnother) {
  start(served("gather_ms = 50\n"), {"--threads", "2"});
  const auto x_of = [](int i) { return 480.0 + i; };
  std::vector<std::string> together(24);
  std::vector<std::thread> clients;
  for (int c = 0; c < 8; ++c)
    clients.emplace_back([&, c] {
      for (int i = c; i < 24; i += 8) together[static_cast<std::size_t>(i)] = evaluate(0.6, x_of(i)).body;
    });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(stop(), 0);
  const std::string said = text_of(folder / "said");
  const auto at = said.find("stopped after ");
  ASSERT_NE(at, said.npos) << said;
  EXPECT_LT(std::stoi(said.substr(at + 14)), 24) << "batches of evaluations: nobody was gathered";

  start(served(""), {"--threads", "1"});
  for (int i = 23; i >= 0; --i) EXPECT_EQ(evaluate(0.6, x_of(i)).body, together[static_cast<std::size_t>(i)]) << i;
}

TEST_F(Serve, CutsSlowClientsOffAndAnswersOthersMeanwhile) {
  start(served("request_timeout_s = 0.5\nconnections = 4\n"));
  const Socket silent(port()), slow(port()), half(port());
  half.send("POST /Evaluate HTTP/1.1\r\nContent-Length: 1000\r\n\r\n{\"name\"");
  std::string drip = "GET /Info HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(200, 'x');
  std::thread dripping([&] {
    for (const char c : drip) {
      slow.send(std::string(1, c));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));  // 2.4 s in all, never silent for half a second
    }
  });
  EXPECT_EQ(http("GET", "/Info").status, 200) << "while the others are under way";
  for (const Socket* socket : {&silent, &half, &slow}) {
    const HttpReply reply = reply_of(socket->all(10));
    EXPECT_EQ(reply.status, 408) << reply.body;
    EXPECT_NE(message_of(reply).find("0.5 s"), std::string::npos) << reply.body;
  }
  dripping.join();
  EXPECT_EQ(http("GET", "/Info").status, 200);
}

TEST_F(Serve, RefusesWhatIsTooLongOrNotAsItShouldBeAndGoesOn) {
  start(served("max_body_bytes = 4096\n"));
  const auto raw = [&](const std::string& text) {
    const Socket socket(port());
    socket.send(text);
    socket.end();
    return reply_of(socket.all());
  };
  const std::string post = "POST /Evaluate HTTP/1.1\r\n";
  EXPECT_EQ(http("POST", "/Evaluate", std::string(5000, ' ')).status, 413);
  EXPECT_EQ(raw(post + "Content-Length: 99999999999999999999999\r\n\r\n").status, 413);
  EXPECT_EQ(raw(post + "Content-Length: -5\r\n\r\n").status, 400);
  EXPECT_EQ(raw(post + "\r\n").status, 411);
  EXPECT_EQ(raw(post + "Content-Encoding: gzip\r\nContent-Length: 5\r\n\r\n12345").status, 415);
  EXPECT_EQ(raw(post + "Content-Type: multipart/form-data; boundary=b\r\nContent-Length: 5\r\n\r\n--b--").status, 415);
  std::string chunks = post + "Transfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 100; ++i) chunks += "40\r\n" + std::string(64, ' ') + "\r\n";
  EXPECT_EQ(raw(chunks + "0\r\n\r\n").status, 413);
  EXPECT_EQ(raw(post + "X: " + std::string(100000, 'x')).status, 431) << "a head that never ends";
  EXPECT_EQ(raw("GET /" + std::string(9000, 'x') + " HTTP/1.1\r\n\r\n").status, 414);
  EXPECT_EQ(raw("GET /Info HTTP/1.1\r\nRange: bytes=" + std::string(8000, ',') + "\r\n\r\n").status / 100, 4);
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {  // bytes that are no HTTP, some of which go on as if they were
    std::string noise = i % 3 == 0 ? "" : i % 3 == 1 ? "GET " : post;
    for (int k = 0; k < 300; ++k) noise += static_cast<char>(random());
    raw(noise + (i % 2 ? "\r\n\r\n" : ""));
  }
  EXPECT_EQ(http("GET", "/Info").status, 200);
  EXPECT_EQ(stop(), 0);
}

TEST_F(Serve, OutlivesClientsThatLeaveAndTurnsAwayWhomItCannotServe) {
  start(served("connections = 2\nrequest_timeout_s = 3\n"));
  // Two are served and four wait: those that leave and the one who does not all get in.
  for (int i = 0; i < 3; ++i) Socket(port()).send(request_text("POST", "/Evaluate", evaluation(0.6, 500 + i)));
  HttpReply reply = evaluate(0.6, 500);
  EXPECT_EQ(reply.status, 200) << "after three that did not wait for their answers" << reply.body;
  std::vector<std::unique_ptr<Socket>> crowd;
  for (int i = 0; i < 12; ++i) crowd.push_back(std::make_unique<Socket>(port()));
  int away = 0;
  for (const auto& socket : crowd) away += reply_of(socket->all(0.2)).status == 503;
  EXPECT_GE(away, 4) << "six are told at once, or fewer if those before them are cut off meanwhile";
  EXPECT_LE(away, 8) << "or more while one who left is still being served";
  crowd.clear();
  reply = {};
  for (int i = 0; i < 100 && reply.status != 200; ++i) {  // until the server has seen that they are gone
    reply = evaluate(0.6, 500);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(reply.status, 200) << reply.body;
}

TEST_F(Serve, EndsOnASignalWithWhatIsUnderWayAnsweredOrRefused) {
  start(served("request_timeout_s = 30\n"), {"--set", "profile.hold_s=1"});
  const Socket idle(port()), first(port()), second(port());
  first.send(request_text("POST", "/Evaluate", evaluation(0.6, 500)));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  second.send(request_text("POST", "/Evaluate", evaluation(0.6, 501)));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(stop(SIGTERM), 0);
  for (const Socket* socket : {&first, &second}) {
    const HttpReply reply = reply_of(socket->all());
    EXPECT_TRUE(reply.status == 200 || (reply.status == 503 && message_of(reply).find("stopping") != std::string::npos))
        << reply.status << reply.body;
  }
  EXPECT_EQ(reply_of(idle.all()).status, 503);
  EXPECT_FALSE(Socket(port()).is_open()) << "the port is closed";
}

TEST_F(Serve, RefusesFilesAndAddressesThatCannotBeServed) {
  const auto refused = [&](const std::string& file, const std::string& words, const Arguments& more = {}) {
    write("bad.toml", file);
    const Answer a = run(Arguments{"serve", "bad.toml", "--port", "0"} + more);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.err.find(words), std::string::npos) << a.err;
  };
  refused("scene = \"drive.toml\"\nquantities = [\"log10_life_h\"]\n", "the model has no input");
  refused("scene = \"drive.toml\"\n[[parameter]]\npath = \"belt.friction_front\"\n", "the model has no output");
  refused(served("prot = 1\n"), "did you mean 'port'?");
  refused(served("name = \"\"\n"), "server.name: is empty");
  refused(served(""), "cannot listen on port 0 of 192.0.2.1", {"--address", "192.0.2.1"});
  start(served(""));
  write("again.toml", served(""));
  const Answer second = run({"serve", "again.toml", "--port", std::to_string(port())});
  EXPECT_EQ(second.code, 2) << "two servers on one port would take turns";
  EXPECT_NE(second.err.find("cannot listen"), std::string::npos) << second.err;
}

TEST_F(Serve, SaysInOneLineWhereItIsAndByJsonWhatItServes) {
  start(served(""), {"--quiet"});
  EXPECT_EQ(printed, "http://127.0.0.1:" + std::to_string(port()));
  EXPECT_EQ(stop(), 0) << "ready to be stopped once the line is out";
  EXPECT_EQ(text_of(folder / "said").find("input vector"), std::string::npos);
  start(served(""), {"--quiet", "--json"});
  const Json j = Json::parse(printed, nullptr, false);
  EXPECT_EQ(j["model"], "beltlife");
  const Json second{{"path", "pulley.driven.x_mm"}, {"lower", 50}, {"upper", 600}};
  EXPECT_EQ(j["parameters"][1], second) << printed;
  EXPECT_EQ(j["quantities"].size(), 2u);
  EXPECT_EQ(j["settings"], Json::array({"belt.elements"})) << printed;
}

TEST_F(Serve, WarnsWhenOtherMachinesAreLetIn) {
  start(served(""), {"--quiet", "--address", "0.0.0.0"});
  EXPECT_EQ(http("GET", "/Info").status, 200);
  EXPECT_NE(text_of(folder / "said").find("no authentication"), std::string::npos);
}

TEST_F(Serve, ServesOtherProgramsToo) {
  write_model("model.sh", R"(printf "{\"y\": %.17g}\n", x * x)");
  start(
      "quantities = [\"y\"]\n[command]\nrun = [\"./model.sh\"]\n[[parameter]]\npath = \"x\"\n"
      "[server]\nname = \"square\"\n");
  EXPECT_EQ(http("POST", "/Evaluate", R"({"name": "square", "input": [[3]]})").body, R"({"output":[[9.0]]})");
}

}  // namespace
}  // namespace beltlife::system_test

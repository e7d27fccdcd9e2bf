// The command serve: see serve_command.h.
#include "results/server/serve_command.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "results/course/shared_options.h"
#include "results/course/study_run.h"
#include "results/server/evaluation_queue.h"
#include "results/server/http_listener.h"
#include "results/server/server_spec.h"

namespace beltlife {
namespace {

struct ServeOptions : CommonOptions {
  std::string file;
  std::optional<int> port;  ///< --port, in place of the file's
  std::string address;      ///< --address, empty: the file's
};

// The second Ctrl-C ends the program as usual.
extern "C" void on_serve_signal(int number) {
  request_stop();
  std::signal(number, SIG_DFL);
}

bool is_loopback(const std::string& address) {
  in_addr four{};
  if (inet_pton(AF_INET, address.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24 == 127;
  return address == "::1" || address == "localhost";
}

void apply_flags(ServerSpec& server, const ServeOptions& o) {
  if (o.port) server.port = *o.port;
  if (!o.address.empty()) server.address = o.address;
}

/// Adds what is wrong with what is served; `problem` has been loaded.
void check_served(const ServerSpec& server, const LoadedProblem& problem, ReadLog& log) {
  const auto complain = [&](const SpecPath& path, const std::string& what, const std::string& allowed) {
    if (!log.is_faulty(path.place)) log.add(path, log.line(path.place), what, allowed);
  };
  const SpecPath root, table = root.child("server");
  if (problem.spec.parameter.empty())
    complain(root.child("parameter"), "missing: the model has no input", "at least one [[parameter]]");
  if (problem.spec.quantities.empty())
    complain(root.child("quantities"), "missing: the model has no output", "names that beltlife check --json lists");
  if (server.name.empty()) complain(table.child("name"), "is empty", "a name");
  if (server.address.empty()) complain(table.child("address"), "is empty", "an address of this machine");
  if (problem.spec.command && !server.settings.empty())
    complain(table.child("settings"), "the study has no scene whose fields could be set", "no settings");
}

/// Why a scene does not take settings; empty if it does.
std::string refusal_of(SceneSpec scene, const std::vector<std::string>& settings) {
  try {
    for (const std::string& setting : settings) set_field(scene, setting);
    validate(scene);
    return "";
  } catch (const BadInput& bad) {
    const Problem& p = bad.problems().front();
    return p.key + ": " + p.what + (p.allowed.empty() ? "" : " (allowed: " + p.allowed + ")");
  }
}

ServedModel served(const ServerSpec& server, const LoadedProblem& problem, EvaluationQueue& queue) {
  ServedModel model;
  model.name = server.name;
  model.parameters = problem.spec.parameter;
  model.quantities = problem.spec.quantities;
  model.settings = server.settings;
  if (problem.scene)
    model.refusal = [&problem](const std::vector<std::string>& settings) {
      return refusal_of(problem.scene->file.scene, settings);
    };
  model.evaluate = [&queue](const Point& point) { return queue.evaluate(point); };
  return model;
}

void say_what_is_served(const ServedModel& model) {
  std::string words = fmt::format("model {}: input vector\n", model.name);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const ParameterSpec& p = model.parameters[i];
    words +=
        fmt::format("  [{}] {}, from {} to {}\n", i, p.path, p.lower.value_or(-INFINITY), p.upper.value_or(INFINITY));
  }
  words += "output vector\n";
  for (std::size_t i = 0; i < model.quantities.size(); ++i) words += fmt::format("  [{}] {}\n", i, model.quantities[i]);
  if (!model.settings.empty()) words += fmt::format("requests may set {}\n", fmt::join(model.settings, ", "));
  fmt::print(stderr, "{}Ctrl-C stops\n", words);
}

/// What a script wants to know, in one line: the protocol itself has no names for inputs and outputs.
std::string description(const std::string& url, const ServedModel& model) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const ParameterSpec& p : model.parameters) {
    parameters.push_back({{"path", p.path}});
    if (p.lower) parameters.back()["lower"] = *p.lower;
    if (p.upper) parameters.back()["upper"] = *p.upper;
  }
  return nlohmann::json{{"url", url},
                        {"model", model.name},
                        {"parameters", parameters},
                        {"quantities", model.quantities},
                        {"settings", model.settings}}
      .dump();
}

/// Serves until there is a request to stop.
void serve(HttpListener& listener, EvaluationQueue& queue) {
  std::thread serving([&] { listener.run(); });
  while (!stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  queue.close();
  listener.stop();
  serving.join();
}

int run_serve(const ServeOptions& o) {
  auto input = read_study<ServeSpec>(o.file);
  apply_flags(input.spec.server, o);
  const ServerSpec& server = input.spec.server;
  const LoadedProblem problem = load_problem(
      input.spec.problem, input.path, [](const Model&) { return std::vector<std::string>(); }, o, input.log);
  check_served(server, problem, input.log);
  throw_problems(std::move(input.log.problems));

  std::vector<std::string> columns = problem.spec.paths();
  if (!server.settings.empty()) columns.insert(columns.begin(), std::string(settings_column));
  EvaluationQueue queue([&] { return model_of(problem, columns, problem.spec.quantities, {.threads = o.threads}); },
                        {.gather = std::chrono::duration<double, std::milli>(server.gather_ms),
                         .remembered = static_cast<std::size_t>(server.remembered_points)});
  const UmBridge bridge(served(server, problem, queue));
  HttpListener listener(
      {.body_bytes = static_cast<std::size_t>(server.max_body_bytes),
       .request_s = server.request_timeout_s,
       .connections = server.connections,
       .waiting = 2 * server.connections},
      [&](auto method, auto path) { return bridge.refuse(method, path); },
      [&](auto method, auto path, auto body) { return bridge.answer(method, path, body); });
  const int port = listener.open(server.address, server.port);
  if (port == 0)
    throw BadInput({Problem{input.path.string(), 0, "server.port",
                            fmt::format("cannot listen on port {} of {}", server.port, server.address),
                            "a free port, 0 for any, and an address of this machine"}});
  if (!is_loopback(server.address))
    fmt::print(stderr,
               "warning: {} is open to other machines, and there is no authentication: whoever reaches it can run "
               "this model\n",
               server.address);
  if (!o.quiet) say_what_is_served(served(server, problem, queue));
  const bool six = server.address.find(':') != std::string::npos;
  const std::string url = fmt::format("http://{}{}{}:{}", six ? "[" : "", server.address, six ? "]" : "", port);
  std::signal(SIGINT, on_serve_signal);  // before the line that says that we are ready, even to be stopped
  std::signal(SIGTERM, on_serve_signal);
  fmt::print("{}\n", o.json ? description(url, served(server, problem, queue)) : url);
  std::fflush(stdout);
  serve(listener, queue);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (!o.quiet) fmt::print(stderr, "stopped after {} batches of evaluations\n", queue.batches());
  return 0;
}

}  // namespace

void add_serve_command(CommandLine& line) {
  auto o = std::make_shared<ServeOptions>();
  Command command =
      line.command("serve", "answer other programs over UM-Bridge (HTTP and JSON): parameters in, quantities out");
  common_flags(command, *o);
  threads_flag(command, o->threads, "points");
  command.input("study", o->file, "study file (TOML)")
      .whole("--port", o->port, {0, 65535}, "port to listen on, instead of the file's; 0: the system chooses one")
      .text("--address", o->address, "A", "address to listen on, instead of the file's (127.0.0.1)")
      .prints("--fields", reference_of<ServeSpec>, "print the reference of the file's fields as Markdown")
      .footer(
          "Examples:\n"
          "  beltlife serve results/examples/serve_small.toml\n"
          "  curl -d '{\"name\": \"beltlife\", \"input\": [[0.6, 600]]}' http://127.0.0.1:4242/Evaluate\n"
          "Ctrl-C stops it. Fields of the file: --fields; protocol, errors and limits: results/server/README.md.")
      .runs(o, run_serve);
}

}  // namespace beltlife

// Owns the table [server] of a study file that is served: where, and within which limits.
#pragma once

#include <string>
#include <vector>

#include "sim/eval/problem_spec.h"

namespace beltlife {

struct ServerSpec {
  std::string name = "beltlife";
  std::string address = "127.0.0.1";
  int port = 4242;
  std::vector<std::string> settings;
  int max_body_bytes = 1 << 20;
  double request_timeout_s = 10;
  int connections = 64;
  double gather_ms = 5;
  int remembered_points = 10000;

  template <class V>
  void visit(V& v) {
    v("name", name, any_text, "the model's name, by which clients ask for it");
    v("address", address, any_text,
      "address to listen on; others than this machine's own 127.0.0.1 let anybody in who can reach it");
    v("port", port, within(0, 65535), "0: the system chooses a free one, which is printed");
    v("settings", settings, any_text,
      "fields of the scene by path that a request may set by its config; empty: none. Other fields than the parameters "
      "stay as the scene has them");
    v("max_body_bytes", max_body_bytes, within(1024, 1 << 30), "longest body of a request");
    v("request_timeout_s", request_timeout_s, within(0.05, 3600),
      "a request that has not come in whole by then is cut off; evaluations have no limit but step_budget");
    v("connections", connections, within(1, 512), "clients served at once; twice as many further ones wait");
    v("gather_ms", gather_ms, within(0, 10000),
      "how long a batch waits for clients that were there lately; a lone client never waits");
    v("remembered_points", remembered_points, within(1, 100000000),
      "points after which what was simulated is forgotten, to bound memory");
  }
};

/// A study file that is served.
struct ServeSpec {
  ProblemSpec problem;
  ServerSpec server;

  template <class V>
  void visit(V& v) {
    problem.visit(v);
    v("server", server, any_text, "where and how it is served");
  }
};

}  // namespace beltlife

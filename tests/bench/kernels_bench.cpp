// Owns the benchmarks of single kernels and of whole steps on the baseline drive in motion.
//
// Counters: per_node_evaluation is what one force evaluation costs a belt node; for whole steps it holds everything
// a step does, divided by its evaluations (two in the thesis' scheme, one in symplectic Euler).
#include <benchmark/benchmark.h>

#include <bit>
#include <cstdio>

#include "sim/contact_search.h"
#include "sim/run.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

Model baseline(int elements, Scheme scheme) {
  const std::vector<std::string> settings{"belt.elements=" + std::to_string(elements),
                                          "solver.scheme=" + std::string(enum_name(scheme))};
  return compile(read_scene(BELTLIFE_SCENES "/baseline.toml", settings).scene);
}

/// The baseline a few ms after a brisk start: every contact, anchor and gear is at work.
struct Moving {
  Model model;
  SpeedProfile profile;
  Simulator simulator;

  Moving(int elements, Scheme scheme, double step)
      : model(baseline(elements, scheme)),
        profile({0, 0.005}, {0, 20}, harmonics_of(*model.scene.driver)),
        simulator(model, profile, scheme, step) {
    while (simulator.time() < 0.006) simulator.advance();
  }
};

void count(benchmark::State& state, int nodes, int evaluations) {
  state.counters["per_node_evaluation"] =  // an inverted rate: printed as a time
      benchmark::Counter(nodes * evaluations,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void kernel(benchmark::State& state, Kernel k) {
  Moving drive(512, Scheme::symplectic_euler, 3e-7);
  State now = drive.simulator.state();
  Work work = drive.simulator.work();
  Evaluation e{drive.model, drive.profile, now.q, now, work, {0.006, 0, 0, true}};
  for (auto _ : state) {
    k.apply(e);
    benchmark::ClobberMemory();
  }
  count(state, drive.model.belt.nodes, 1);
}

void search(benchmark::State& state) {
  Moving drive(512, Scheme::symplectic_euler, 3e-7);
  State now = drive.simulator.state();
  Work work = drive.simulator.work();
  for (auto _ : state) {
    find_contacts(drive.model, 3e-7, now, work);
    benchmark::ClobberMemory();
  }
  // Once in so many steps; this counter is the cost of one search.
  state.counters["per_node"] = benchmark::Counter(
      drive.model.belt.nodes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void step(benchmark::State& state, Scheme scheme, int elements, double step_s) {
  Moving drive(elements, scheme, step_s > 0 ? step_s : run_step(baseline(elements, scheme)));
  for (auto _ : state) drive.simulator.advance();
  count(state, elements, scheme == Scheme::thesis ? 2 : 1);
  state.counters["step"] = drive.simulator.step();
  state.counters["per_simulated_second"] = benchmark::Counter(
      drive.simulator.step(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Not a time: a fingerprint of the state after 20 ms, to be equal on every instruction set.
void bits(benchmark::State& state) {
  std::uint64_t print = 14695981039346656037ULL;
  for (auto _ : state) {
    Moving drive(512, Scheme::thesis, 3e-7);
    while (drive.simulator.time() < 0.02) drive.simulator.advance();
    const Coordinates& q = drive.simulator.state().q;
    for (const NodeArray* a : {&q.x, &q.y, &q.vx, &q.vy})
      for (int i = 0; i < a->size(); ++i) print = (print ^ std::bit_cast<std::uint64_t>((*a)[i])) * 1099511628211ULL;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(print));
  state.SetLabel(text);
}

const bool registered = [] {
  for (const Kernel& k : force_program(baseline(512, Scheme::symplectic_euler)))
    benchmark::RegisterBenchmark((std::string("kernel/") + k.name).c_str(), kernel, k);
  benchmark::RegisterBenchmark("contact search", search);
  benchmark::RegisterBenchmark("step/thesis, 513 elements, 3e-7 s", step, Scheme::thesis, 513, 3e-7);
  benchmark::RegisterBenchmark("step/thesis, 512 elements, 3e-7 s", step, Scheme::thesis, 512, 3e-7);
  benchmark::RegisterBenchmark("step/thesis, 512 elements, stable step", step, Scheme::thesis, 512, 0.0);
  benchmark::RegisterBenchmark("step/symplectic_euler, 513 elements, 3e-7 s", step, Scheme::symplectic_euler, 513,
                               3e-7);
  benchmark::RegisterBenchmark("step/symplectic_euler, 512 elements, stable step", step, Scheme::symplectic_euler, 512,
                               0.0);
  benchmark::RegisterBenchmark("bits after 20 ms", bits)->Iterations(1);
  return true;
}();

}  // namespace
}  // namespace beltlife

// The simulator shell around the schemes: see scheme.h.
#include <chrono>
#include <stdexcept>

#include "sim/contact_search.h"
#include "sim/schemes/scheme.h"

namespace beltlife {

Simulator::Simulator(const Model& model, const SpeedProfile& profile, Scheme scheme, double step)
    : model_(model),
      profile_(profile),
      scheme_(scheme == Scheme::thesis ? advance_thesis : advance_symplectic_euler),
      step_(step),
      state_(model.initial),
      work_(make_work(model)),
      program_(force_program(model)) {
  if (scheme == Scheme::linearly_implicit) throw std::logic_error("a LaneSimulator runs the linearly implicit scheme");
  if (scheme == Scheme::thesis) {
    predicted_ = model.initial.q;
    first_fx_ = NodeArray(model.belt.nodes);
    first_fy_ = NodeArray(model.belt.nodes);
    first_torque_.resize(model.bodies);
  }
  prescribe(state_.q, 0);
}

void Simulator::restore(const State& state) {
  state_ = state;
  work_ = make_work(model_);
}

void Simulator::advance() {
  if (model_.pulleys > 0 && state_.step >= state_.refresh_step) find_contacts(model_, step_, state_, work_);
  scheme_(*this);
  ++state_.step;
}

void Simulator::profile_kernels(bool on) {
  timing_ = on;
  times_.clear();
  for (const Kernel& k : program_) times_.push_back({k.name, 0, 0});
}

void Simulator::evaluate(Coordinates& q, const Pass& pass) {
  Evaluation e{model_, profile_, q, state_, work_, pass};
  if (!timing_) {
    for (const Kernel& k : program_) k.apply(e);
    return;
  }
  auto last = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < program_.size(); ++i) {
    program_[i].apply(e);
    const auto now = std::chrono::steady_clock::now();
    times_[i].seconds += std::chrono::duration<double>(now - last).count();
    ++times_[i].calls;
    last = now;
  }
}

void Simulator::prescribe(Coordinates& q, double time) const {
  if (model_.prescribed()) q.speed[model_.driver.body] = model_.sense[model_.driver.body] * profile_.speed(time);
}

}  // namespace beltlife

// Owns the small drives that the verification tests make in code, and how they are run and read.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "sim/run.h"
#include "sim/scene/scene_io.h"

namespace beltlife::drives {

inline constexpr double pi = std::numbers::pi;

inline SceneSpec shipped(const std::string& name) {
  return read_scene(std::string(BELTLIFE_SCENES) + "/" + name + ".toml").scene;
}

/// The thesis drive's belt without bending, on smooth numbers; give it a length.
inline BeltSpec belt(int elements) {
  BeltSpec b;
  b.elements = elements;
  b.axial_stiffness_n = 140563;
  b.axial_damping_n_s = 1;
  b.mass_kg_per_m = 0.4;
  b.ribs = 8;
  b.friction_front = b.friction_back = 0.6;
  return b;
}

inline PulleySpec pulley(std::string name, double x_mm, double y_mm, double diameter_mm) {
  PulleySpec p;
  p.name = std::move(name);
  p.x_mm = x_mm;
  p.y_mm = y_mm;
  p.pitch_diameter_mm = diameter_mm;
  p.inertia_kg_m2 = 0.003;
  return p;
}

/// Two pulleys on a horizontal line; "driver" has a given speed, "driven" is free. Counterclockwise, so that the upper
/// span runs from driven to driver and the lower one from driver to driven.
inline SceneSpec two_pulleys(int elements, double distance_mm, double driver_mm, double driven_mm,
                             double pretension_n) {
  SceneSpec scene;
  scene.rotation = Rotation::counterclockwise;
  scene.belt = belt(elements);
  scene.belt.pretension_n = pretension_n;
  scene.pulley = {pulley("driver", 0, 0, driver_mm), pulley("driven", distance_mm, 0, driven_mm)};
  scene.driver.emplace();
  scene.driver->body = "driver";
  return scene;
}

/// A free ring of belt about the origin.
inline SceneSpec ring(int elements, double length_mm, double speed_rad_s) {
  SceneSpec scene;
  scene.rotation = Rotation::counterclockwise;
  scene.belt = belt(elements);
  scene.belt.unstretched_length_mm = length_mm;
  scene.ring.emplace();
  scene.ring->speed_rad_s = speed_rad_s;
  return scene;
}

/// Speed of the driven body: rest, a ramp over [0, ramp_s], then constant.
inline SpeedProfile ramp(double rad_s, double ramp_s) { return SpeedProfile({0, ramp_s}, {0, rad_s}); }

/// The explicit scheme that a Simulator of this scene takes: the scene's, or symplectic Euler for the implicit one.
inline Scheme explicit_scheme(const SceneSpec& scene) {
  return scene.solver.scheme == Scheme::linearly_implicit ? Scheme::symplectic_euler : scene.solver.scheme;
}

/// A drive in motion: the model, its profile and the simulator that refers to both.
struct Drive {
  explicit Drive(const SceneSpec& scene, SpeedProfile given = {})
      : model(compile(scene)),
        profile(std::move(given)),
        simulator(model, profile, explicit_scheme(scene),
                  scene.solver.step_s.value_or(stable_step(model, explicit_scheme(scene)))) {}
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  /// Advances to a time and calls `each` after every `stride` steps.
  template <class Each>
  void run_to(double seconds, int stride, Each each) {
    while (simulator.time() < seconds) {
      for (int i = 0; i < stride; ++i) simulator.advance();
      each();
    }
  }
  void run_to(double seconds) {
    run_to(seconds, 16, [] {});
  }

  const Work& work() const { return simulator.work(); }
  Coordinates& q() { return simulator.state().q; }

  Model model;
  SpeedProfile profile;
  Simulator simulator;
};

/// Mean of what is added.
struct Mean {
  double sum = 0;
  int count = 0;
  void add(double x) {
    sum += x;
    ++count;
  }
  double value() const { return sum / count; }
};

/// Frequency of a signal from its rising zero crossings, each interpolated between two samples.
struct Crossings {
  double last_time = 0, last_value = 0, first = -1, latest = 0;
  int count = 0;
  void add(double time, double value) {
    if (time > 0 && last_value < 0 && value >= 0) {
      latest = last_time - last_value * (time - last_time) / (value - last_value);
      if (first < 0)
        first = latest;
      else
        ++count;
    }
    last_time = time;
    last_value = value;
  }
  double frequency() const { return count / (latest - first); }
};

/// Prints a measured value beside its closed form and records it with the test.
inline void report(const std::string& what, double measured, double closed_form) {
  std::printf("    %-58s measured %.8g, closed form %.8g, off by %.2g %%\n", what.c_str(), measured, closed_form,
              100 * (measured / closed_form - 1));
}

}  // namespace beltlife::drives

// Owns the scene as a person wrote it: one Spec struct per TOML table, each with the one list of its fields.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/field.h"

namespace beltlife {

enum class Side { front, back };
template <>
struct EnumNames<Side> {
  static constexpr std::array<std::string_view, 2> names{"front", "back"};
};

enum class Rotation { clockwise, counterclockwise };
template <>
struct EnumNames<Rotation> {
  static constexpr std::array<std::string_view, 2> names{"clockwise", "counterclockwise"};
};

enum class Control { prescribed, pid };
template <>
struct EnumNames<Control> {
  static constexpr std::array<std::string_view, 2> names{"prescribed", "pid"};
};

enum class Scheme { thesis, symplectic_euler, linearly_implicit };
template <>
struct EnumNames<Scheme> {
  static constexpr std::array<std::string_view, 3> names{"thesis", "symplectic_euler", "linearly_implicit"};
};

/// Which of the recorded contact forces the stresses use: the mean over passes of the largest 1000 Hz sample, the
/// mean of the resolved maxima (of every step, or every 5e-6 s), or the 99th percentile of the resolved maxima.
enum class PassForce { sampled, resolved, percentile_99 };
template <>
struct EnumNames<PassForce> {
  static constexpr std::array<std::string_view, 3> names{"sampled", "resolved", "percentile_99"};
};

struct BeltSpec {
  int elements = 512;
  std::optional<double> unstretched_length_mm;
  std::optional<double> effective_length_mm;
  std::optional<double> measuring_tension_n;
  std::optional<double> effective_line_differential_mm;
  std::optional<double> pretension_n;
  std::optional<bool> balanced_as_placed;
  std::optional<std::vector<double>> length_catalogue_mm;
  double axial_stiffness_n = 0;
  double axial_damping_n_s = 0;
  double bending_stiffness_n_m2 = 0;
  double bending_damping_n_m2_s = 0;
  double mass_kg_per_m = 0;
  int ribs = 0;
  double rib_pitch_mm = 3.56;
  double friction_front = 0;
  double friction_back = 0;

  template <class V>
  void visit(V& v) {
    v("elements", elements, within(16, 20000), "number of belt elements (and of nodes)");
    v("unstretched_length_mm", unstretched_length_mm, above(0, 1e5),
      "belt length along the cord without tension; give exactly one of this, effective_length_mm, pretension_n, "
      "balanced_as_placed");
    v("effective_length_mm", effective_length_mm, above(0, 1e5),
      "belt length as catalogues state it (ISO 9981); along the cord it is 2 pi effective_line_differential_mm longer");
    v("measuring_tension_n", measuring_tension_n, within(0, 1e5),
      "tension of either strand at which effective_length_mm is measured: half the standard's measuring force");
    v("effective_line_differential_mm", effective_line_differential_mm, within(0, 100),
      "b_e, distance of the cord from the effective diameter (ISO 9981); needed where an effective value is given");
    v("pretension_n", pretension_n, above(0, 1e6),
      "wanted tension at rest; the unstretched length is solved for, or, beside another statement of the length, "
      "tensioner.spring_torque_n_m");
    v("balanced_as_placed", balanced_as_placed, any_text,
      "true: the tensioner is at rest where its pulley is placed; the unstretched length is solved for");
    v("length_catalogue_mm", length_catalogue_mm, above(0, 1e5),
      "unstretched lengths that can be had, for a spring torque that is solved for: taken is the one nearest to that "
      "of "
      "an arm at rest as placed");
    v("axial_stiffness_n", axial_stiffness_n, required(above(0, 1e9)), "EA, force per unit strain (thesis 2.28)");
    v("axial_damping_n_s", axial_damping_n_s, within(0, 1e6), "CA, force per unit strain rate (thesis 2.28)");
    v("bending_stiffness_n_m2", bending_stiffness_n_m2, within(0, 1e4), "EI (thesis 2.29)");
    v("bending_damping_n_m2_s", bending_damping_n_m2_s, within(0, 1e2), "CI (thesis 2.29)");
    v("mass_kg_per_m", mass_kg_per_m, required(above(0, 100)), "belt mass per unstretched length");
    v("ribs", ribs, required(within(1, 100)), "number of ribs");
    v("rib_pitch_mm", rib_pitch_mm, above(0, 100), "rib pitch; ribs x pitch is the belt width");
    v("friction_front", friction_front, required(within(0, 10)), "Coulomb coefficient, ribbed side");
    v("friction_back", friction_back, required(within(0, 10)), "Coulomb coefficient, flat side");
  }
};

struct ContactSpec {
  double stiffness_n_per_m3 = 1e10;
  double damping_n_s_per_m3 = 4e5;
  double separation_factor = 0;
  double friction_stiffness_n_per_m3 = 5e9;
  double friction_speed_m_s = 0.02;
  double anchor_share = 0.9;

  template <class V>
  void visit(V& v) {
    v("stiffness_n_per_m3", stiffness_n_per_m3, above(0, 1e15), "k_p, penalty stiffness per unit area (thesis 2.24)");
    v("damping_n_s_per_m3", damping_n_s_per_m3, within(0, 1e10), "c_p, penalty damping per unit area (thesis 2.24)");
    v("separation_factor", separation_factor, within(0, 1),
      "s_p, share of c_p that acts while separating (thesis 2.24)");
    v("friction_stiffness_n_per_m3", friction_stiffness_n_per_m3, above(0, 1e15),
      "k_t, anchor spring stiffness per unit area (thesis 2.3.2)");
    v("friction_speed_m_s", friction_speed_m_s, above(0, 10),
      "v_s, slip speed at which the velocity element saturates");
    v("anchor_share", anchor_share, within(0, 1), "beta, share of the friction limit carried by the anchor spring");
  }
};

struct PulleySpec {
  std::string name;
  double x_mm = 0;
  double y_mm = 0;
  std::optional<double> pitch_diameter_mm;
  std::optional<double> effective_diameter_mm;
  Side side = Side::front;
  double inertia_kg_m2 = 0;
  double mass_kg = 0;
  std::optional<double> friction;
  bool locked = false;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among pulleys and bodies");
    v("x_mm", x_mm, required(within(-1e5, 1e5)),
      "centre; of the tensioner pulley: where the scene places it, unless tensioner.arm_angle_deg does");
    v("y_mm", y_mm, required(within(-1e5, 1e5)), "centre");
    v("pitch_diameter_mm", pitch_diameter_mm, above(0, 1e5),
      "twice the contact radius, on both belt sides; give exactly one of this, effective_diameter_mm");
    v("effective_diameter_mm", effective_diameter_mm, above(0, 1e5),
      "of a front-side pulley, as catalogues state it (ISO 9981); the pitch diameter is 2 "
      "effective_line_differential_mm larger");
    v("side", side, required_text, "belt side that touches the pulley: front is ribbed");
    v("inertia_kg_m2", inertia_kg_m2, required(above(0, 1e4)), "about its own axis");
    v("mass_kg", mass_kg, within(0, 1e4), "matters on the tensioner arm only");
    v("friction", friction, within(0, 10), "Coulomb coefficient of this pulley, instead of the belt side's");
    v("locked", locked, any_text, "true: the pulley cannot turn");
  }
};

struct TensionerSpec {
  std::string pulley;
  double pivot_x_mm = 0;
  double pivot_y_mm = 0;
  double mass_kg = 0;
  double inertia_kg_m2 = 0;
  double cg_distance_mm = 0;
  std::optional<double> arm_angle_deg;
  std::optional<double> arm_length_mm;
  std::optional<double> spring_torque_n_m;
  double spring_rate_n_m_per_rad = 0;
  double damping_n_m_s_per_rad = 0;
  double friction_torque_n_m = 0;
  double friction_stiffness_n_m_per_rad = 3e4;
  std::optional<double> damping_shortening_n_m_s_per_rad;
  std::optional<double> friction_torque_shortening_n_m;
  std::optional<double> stop_lengthening_deg;
  std::optional<double> stop_shortening_deg;
  double stop_stiffness_n_m_per_rad = 3e4;
  double stop_damping_n_m_s_per_rad = 10;
  bool locked = false;

  template <class V>
  void visit(V& v) {
    v("pulley", pulley, required_text, "name of the pulley that rides on the arm");
    v("pivot_x_mm", pivot_x_mm, required(within(-1e5, 1e5)), "arm pivot");
    v("pivot_y_mm", pivot_y_mm, required(within(-1e5, 1e5)), "arm pivot");
    v("mass_kg", mass_kg, required(within(0, 1e4)), "arm without its pulley");
    v("inertia_kg_m2", inertia_kg_m2, required(within(0, 1e4)), "arm about its centre of gravity, without its pulley");
    v("cg_distance_mm", cg_distance_mm, within(-1e4, 1e4), "centre of gravity from the pivot toward the pulley");
    v("arm_angle_deg", arm_angle_deg, within(-720, 720),
      "direction from the pivot to the centre of the arm's pulley, counterclockwise from +x; with arm_length_mm it "
      "places that pulley, whose own x_mm and y_mm then say nothing");
    v("arm_length_mm", arm_length_mm, above(0, 1e5),
      "distance from the pivot to the centre of the arm's pulley; beside arm_angle_deg only");
    v("spring_torque_n_m", spring_torque_n_m, within(0, 1e5),
      "at the placed position, in the sense that lengthens the belt path; absent: solved for belt.pretension_n, which "
      "then stands beside one of balanced_as_placed, unstretched_length_mm, effective_length_mm, length_catalogue_mm");
    v("spring_rate_n_m_per_rad", spring_rate_n_m_per_rad, within(0, 1e6),
      "added torque per rotation in the sense that shortens the belt path");
    v("damping_n_m_s_per_rad", damping_n_m_s_per_rad, within(0, 1e4), "viscous damping at the pivot");
    v("friction_torque_n_m", friction_torque_n_m, within(0, 1e5), "dry friction at the pivot");
    v("friction_stiffness_n_m_per_rad", friction_stiffness_n_m_per_rad, above(0, 1e9),
      "stiffness of the anchor spring through which the dry friction sticks");
    v("damping_shortening_n_m_s_per_rad", damping_shortening_n_m_s_per_rad, within(0, 1e4),
      "viscous damping while the arm turns so that the belt path shortens; absent: the same both ways");
    v("friction_torque_shortening_n_m", friction_torque_shortening_n_m, within(0, 1e5),
      "dry friction against turning so that the belt path shortens; absent: the same both ways");
    v("stop_lengthening_deg", stop_lengthening_deg, within(0, 180),
      "rotation from the placed position, in the sense that lengthens the belt path, to a stop; absent: no stop");
    v("stop_shortening_deg", stop_shortening_deg, within(0, 180),
      "rotation from the placed position, in the sense that shortens the belt path, to a stop; absent: no stop");
    v("stop_stiffness_n_m_per_rad", stop_stiffness_n_m_per_rad, above(0, 1e9), "stiffness of the arm's stops");
    v("stop_damping_n_m_s_per_rad", stop_damping_n_m_s_per_rad, within(0, 1e6),
      "damping of the arm's stops while the arm touches them; a stop never pulls");
    v("locked", locked, any_text, "true: the arm cannot turn; it stays at its balance");
  }
};

struct BodySpec {
  std::string name;
  double inertia_kg_m2 = 0;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among pulleys and bodies");
    v("inertia_kg_m2", inertia_kg_m2, required(above(0, 1e4)), "about its own axis");
  }
};

struct TorsionalSpringSpec {
  std::string name;
  std::string from;
  std::string to;
  double stiffness_n_m_per_rad = 0;
  double damping_n_m_s_per_rad = 0;
  bool one_way = false;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among torsional springs");
    v("from", from, required_text, "pulley or body at one end");
    v("to", to, required_text, "pulley or body at the other end");
    v("stiffness_n_m_per_rad", stiffness_n_m_per_rad, required(above(0, 1e12)), "torsional stiffness");
    v("damping_n_m_s_per_rad", damping_n_m_s_per_rad, within(0, 1e9), "torsional damping");
    v("one_way", one_way, any_text,
      "true: behind an overrunning clutch; drives `to` in the running sense only, and lets it run ahead of `from`");
  }
};

struct GearPairSpec {
  std::string name;
  std::string pinion;
  std::string gear;
  int pinion_teeth = 0;
  int gear_teeth = 0;
  double module_mm = 0;
  double stiffness_n_per_m = 0;
  double damping_n_s_per_m = 0;
  double backlash_mm = 0;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among gear pairs");
    v("pinion", pinion, required_text, "pulley or body that carries the pinion");
    v("gear", gear, required_text, "pulley or body that carries the gear");
    v("pinion_teeth", pinion_teeth, required(within(1, 10000)), "number of teeth");
    v("gear_teeth", gear_teeth, required(within(1, 10000)), "number of teeth");
    v("module_mm", module_mm, required(above(0, 1000)), "pitch radius is module x teeth / 2");
    v("stiffness_n_per_m", stiffness_n_per_m, required(above(0, 1e15)), "tooth stiffness along the line of action");
    v("damping_n_s_per_m", damping_n_s_per_m, within(0, 1e12), "tooth damping along the line of action");
    v("backlash_mm", backlash_mm, within(0, 100), "total backlash");
  }
};

struct TorqueSpec {
  std::string name;
  std::string body;
  std::vector<double> speeds_rpm;
  std::vector<double> torques_n_m;
  std::optional<std::string> referred_to;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among torques");
    v("body", body, required_text, "pulley or body on which the torque acts, and whose speed the table is over");
    v("speeds_rpm", speeds_rpm, required(within(0, 1e6)),
      "increasing; linear between entries, held above the last, linear to zero below the first, zero for speeds <= 0");
    v("torques_n_m", torques_n_m, required(within(-1e6, 1e6)),
      "positive pushes the body in its direction of motion, negative is a load");
    v("referred_to", referred_to, any_text,
      "pulley or body at whose speed the torques are stated; the body receives them times the speed ratio");
  }
};

struct HarmonicSpec {
  std::string name;
  double order = 0;
  double phase_rad = 0;
  std::vector<double> speeds_rpm;
  std::vector<double> amplitudes_rpm;

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among harmonics");
    v("order", order, required(above(0, 100)), "cycles per revolution of the driven body");
    v("phase_rad", phase_rad, within(-100, 100), "speed is mean + amplitude cos(order x angle + phase)");
    v("speeds_rpm", speeds_rpm, required(within(0, 1e6)),
      "increasing mean speeds of the table; held above the last, proportional to speed below the first");
    v("amplitudes_rpm", amplitudes_rpm, required(within(0, 1e5)), "amplitude at each speed");
  }
};

struct DriverSpec {
  std::string body;
  Control control = Control::prescribed;
  double speed_gain_n_m_s_per_rad = 335;
  double angle_gain_n_m_per_rad = 4.5e5;
  double phase_rad = 0;
  double ripple_scale = 1;
  std::optional<std::string> speed_csv;
  std::vector<HarmonicSpec> harmonic;

  template <class V>
  void visit(V& v) {
    v("body", body, required_text, "pulley or body whose speed is given: the crank");
    v("control", control, any_text, "prescribed: the speed is imposed; pid: a torque follows it");
    v("speed_gain_n_m_s_per_rad", speed_gain_n_m_s_per_rad, within(0, 1e9), "pid: torque per speed error");
    v("angle_gain_n_m_per_rad", angle_gain_n_m_per_rad, within(0, 1e12), "pid: torque per angle error");
    v("phase_rad", phase_rad, within(-100, 100), "added to the driven body's nominal angle: shifts all harmonics");
    v("ripple_scale", ripple_scale, within(0, 100), "multiplies every harmonic's amplitude");
    v("speed_csv", speed_csv, any_text,
      "measured profile, columns time_s, speed_rpm; replaces mean speed and harmonics; relative to the scene file");
    v("harmonic", harmonic, any_text, "speed ripple by order of rotation");
  }
};

/// What an operating range changes of a drive beside its speed. It changes how the drive runs, not what it is: parts,
/// mesh, length of the belt and balance at rest are those of the drive as it was built. The default is the base
/// condition: of a drive at rest, and of a run that belongs to no single range.
struct DriveCondition {
  double torque_factor = 1;

  template <class V>
  void visit(V& v) {
    v("torque_factor", torque_factor, within(0, 100), "multiplies every torque table");
  }
  friend bool operator==(const DriveCondition&, const DriveCondition&) = default;
};

struct RangeSpec {
  std::string name;
  double crank_rpm = 0;
  double duty_share = 0;
  DriveCondition condition = {};  ///< stands in no scene file; programs that embed the simulator set it

  template <class V>
  void visit(V& v) {
    v("name", name, required_text, "unique among ranges");
    v("crank_rpm", crank_rpm, required(within(0, 1e5)), "mean speed of the driven body");
    v("duty_share", duty_share, within(0, 1), "share of the duty cycle; shares of all ranges sum to 1");
  }
};

struct ProfileSpec {
  double settle_s = 0.3;
  double ramp_s = 0.7;
  double hold_s = 3;
  double transition_s = 0.2;
  double evaluate_s = 1;
  std::optional<double> settled_within = std::nullopt;

  template <class V>
  void visit(V& v) {
    v("settle_s", settle_s, within(0, 1000), "at rest, so that the drive finds its static position");
    v("ramp_s", ramp_s, above(0, 1000), "from rest to the first range");
    v("hold_s", hold_s, above(0, 10000), "each range");
    v("transition_s", transition_s, above(0, 1000), "from range to range");
    v("evaluate_s", evaluate_s, above(0, 10000), "last part of each hold that is evaluated; at most hold_s");
    v("settled_within", settled_within, within(1e-6, 1),
      "a range run alone ends once two consecutive stretches of evaluate_s of its hold agree within this (tensions, "
      "speeds, torques, slip, largest order), and the later one is evaluated; the whole profile in one piece goes on; "
      "absent: to the end");
  }
};

/// A start, an acceleration, a stop: what `simulate` runs instead of the ranges of a scene that has it.
struct EventSpec {
  std::vector<double> times_s;
  std::vector<double> speeds_rpm;

  template <class V>
  void visit(V& v) {
    v("times_s", times_s, required(within(0, 1e3)),
      "increasing from 0, when profile.settle_s and, if the first speed is not 0, profile.ramp_s and profile.hold_s "
      "are "
      "over");
    v("speeds_rpm", speeds_rpm, required(within(0, 1e5)),
      "mean speed of the driven body at each time, straight between them");
  }
};

struct FatigueSpec {
  double rubber_modulus_mpa = 7;
  double cord_to_rib_tip_mm = 3.5;
  double flank_height_mm = 2.5;
  double flank_angle_deg = 20;
  double strength_mpa = 10;
  double exponent = -0.068;
  PassForce pass_force = PassForce::sampled;

  template <class V>
  void visit(V& v) {
    v("rubber_modulus_mpa", rubber_modulus_mpa, above(0, 1e5), "E of the rib rubber (thesis 5.2)");
    v("cord_to_rib_tip_mm", cord_to_rib_tip_mm, above(0, 100), "y (thesis 5.5)");
    v("flank_height_mm", flank_height_mm, above(0, 100), "h_r (thesis 5.11)");
    v("flank_angle_deg", flank_angle_deg, above(0, 89), "theta, half the rib wedge angle (thesis 5.9)");
    v("strength_mpa", strength_mpa, above(0, 1e5), "sigma_f, fatigue strength coefficient");
    v("exponent", exponent, within(-10, -1e-3), "b, fatigue strength exponent");
    v("pass_force", pass_force, any_text, "which contact force per pass the stresses use");
  }
};

struct SolverSpec {
  Scheme scheme = Scheme::linearly_implicit;
  std::optional<double> step_s;
  double sample_rate_hz = 1000;

  template <class V>
  void visit(V& v) {
    v("scheme", scheme, any_text, "time integrator; linearly_implicit needs a multiple of 8 elements");
    v("step_s", step_s, above(0, 1e-2),
      "time step; absent: the step predicted for this scheme (stability, or accuracy of linearly_implicit)");
    v("sample_rate_hz", sample_rate_hz, above(0, 1e5),
      "rate of the recorded channels and of the sampled contact forces");
  }
};

/// The two outputs that are compared with measurements.
struct OutputSpec {
  std::string body;
  std::optional<std::string> spring;

  template <class V>
  void visit(V& v) {
    v("body", body, required_text, "pulley or body whose speed is the output");
    v("spring", spring, any_text,
      "torsional spring whose torque is the output; absent: the torque of the body, a pulley, on the belt");
  }
};

/// A belt without pulleys: a ring spinning freely about the origin.
struct RingSpec {
  double speed_rad_s = 0;

  template <class V>
  void visit(V& v) {
    v("speed_rad_s", speed_rad_s, required(within(-1e5, 1e5)), "angular speed of the ring, counterclockwise positive");
  }
};

struct SceneSpec {
  int format = 1;
  std::string title;
  Rotation rotation = Rotation::clockwise;
  BeltSpec belt;
  ContactSpec contact;
  std::vector<PulleySpec> pulley;
  std::optional<TensionerSpec> tensioner;
  std::vector<BodySpec> body;
  std::vector<TorsionalSpringSpec> torsional_spring;
  std::vector<GearPairSpec> gear_pair;
  std::vector<TorqueSpec> torque;
  std::optional<DriverSpec> driver;
  std::optional<OutputSpec> output;
  std::optional<RingSpec> ring;
  std::vector<RangeSpec> range;
  ProfileSpec profile;
  std::optional<EventSpec> event;
  FatigueSpec fatigue;
  SolverSpec solver;

  template <class V>
  void visit(V& v) {
    v("format", format, required(within(1, 1)), "version of the scene format");
    v("title", title, any_text, "one line for people");
    v("rotation", rotation, any_text, "sense in which front-side pulleys turn");
    v("belt", belt, required_text, "the belt");
    v("contact", contact, any_text, "belt-pulley contact and friction law");
    v("pulley", pulley, any_text, "pulleys in the order in which the belt passes them, in either direction");
    v("tensioner", tensioner, any_text, "rotary tensioner");
    v("body", body, any_text, "further rotating bodies");
    v("torsional_spring", torsional_spring, any_text, "spring-damper between two pulleys or bodies");
    v("gear_pair", gear_pair, any_text, "gear mesh between two pulleys or bodies");
    v("torque", torque, any_text, "table of torque against speed at a pulley or body");
    v("driver", driver, any_text, "the pulley or body whose speed is given");
    v("output", output, any_text, "what is compared with measurements");
    v("ring", ring, any_text, "a belt without pulleys");
    v("range", range, any_text, "operating ranges");
    v("profile", profile, any_text, "timing of a run");
    v("event", event, any_text, "a start, an acceleration or a stop, run instead of the ranges in one piece");
    v("fatigue", fatigue, any_text, "rib geometry and material");
    v("solver", solver, any_text, "integration and recording");
  }
};

}  // namespace beltlife

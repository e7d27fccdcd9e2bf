// Owns the compiled drive: constant flat numbers in SI units that the kernels read, shared by all threads.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "sim/route/arm_stops.h"
#include "sim/route/layout.h"
#include "sim/scene/scene.h"
#include "sim/speed_profile.h"
#include "sim/state.h"

namespace beltlife {

struct BeltModel {
  int nodes = 0;
  double element_length = 0;      ///< l0, m, unstretched
  double node_mass = 0;           ///< m, kg
  double unstretched_length = 0;  ///< L0, m
  double axial_stiffness = 0;     ///< EA, N
  double axial_damping = 0;       ///< CA, N s
  double bending_stiffness = 0;   ///< EI, N m^2
  double bending_damping = 0;     ///< CI, N m^2 s
};

/// Contact constants of one node, that is per unit-area constants times l0 x belt width.
struct ContactModel {
  double stiffness = 0;           ///< A k_p, N/m
  double damping = 0;             ///< A c_p, N s/m, approaching
  double separation_damping = 0;  ///< A s_p c_p, N s/m, separating
  double friction_stiffness = 0;  ///< A k_t, N/m
  double friction_speed = 0;      ///< v_s, m/s
  double anchor_share = 0;        ///< beta
};

struct TorsionalSpring {
  int from = 0, to = 0;  ///< bodies
  double stiffness = 0;  ///< N m/rad
  double damping = 0;    ///< N m s/rad
  bool one_way = false;  ///< behind an overrunning clutch
  double sense = 1;      ///< running sense of both ends
};

struct GearPair {
  int pinion = 0, gear = 0;  ///< bodies
  double pinion_radius = 0,
         gear_radius = 0;             ///< m; signed by the bodies' running senses, so that delta = r1 th1 - r2 th2
  double stiffness = 0, damping = 0;  ///< N/m, N s/m
  double half_backlash = 0;           ///< b/2, m
};

struct TorqueTable {
  int body = 0;
  double factor = 1;  ///< speed ratio of the body that the torques are stated at to that they act on; the condition's
  Table1 torque;      ///< N m over the body's speed in rad/s, in its running sense
};

struct TensionerModel {
  int pulley = -1;  ///< -1: the drive has none
  double pivot_x = 0, pivot_y = 0;
  double arm_x = 0, arm_y = 0;    ///< pivot to pulley centre at angle 0, m
  double inertia = 0;             ///< arm with its pulley's mass about the pivot, kg m^2
  double spring_torque = 0;       ///< at angle 0, counterclockwise positive, N m
  double spring_rate = 0;         ///< N m/rad; torque = spring_torque - spring_rate x angle
  double damping = 0;             ///< N m s/rad
  double friction_torque = 0;     ///< N m
  double friction_stiffness = 0;  ///< N m/rad
  bool locked = false;
  double lengthening = 1;          ///< +1 where turning counterclockwise lengthens the belt path, else -1
  bool directional = false;        ///< the two below act while the path shortens, those above while it lengthens
  double damping_shortening = 0;   ///< N m s/rad
  double friction_shortening = 0;  ///< N m
  ArmStops stops;

  /// Viscous damping of an arm that turns at this rate, and dry friction against turning in this sense.
  double damping_at(double rate) const { return directional && lengthening * rate < 0 ? damping_shortening : damping; }
  double friction_against(double sense) const {
    return directional && lengthening * sense < 0 ? friction_shortening : friction_torque;
  }
};

struct DriverModel {
  int body = -1;  ///< -1: nothing is driven
  Control control = Control::prescribed;
  double speed_gain = 0;  ///< N m s/rad
  double angle_gain = 0;  ///< N m/rad
};

/// Bodies 0 .. pulleys-1 are the pulleys in scene order, the further bodies follow. Angles and speeds are
/// counterclockwise positive; `sense` is +1 or -1 so that sense x speed is positive in normal running.
///
/// A model is of one condition. Those of a drive's ranges are in range_models.h; who is given a model and a range or a
/// plan sees to it that the conditions are the same.
struct Model {
  SceneSpec scene;           ///< what this was compiled from
  DriveCondition condition;  ///< what it was compiled for
  StaticState statics;
  BeltModel belt;
  ContactModel contact;
  TensionerModel tensioner;
  DriverModel driver;

  int pulleys = 0;
  std::vector<double> pulley_x, pulley_y;  ///< centres, m; of the tensioner pulley: at angle 0
  std::vector<double> pulley_radius;       ///< m
  std::vector<double> pulley_friction;     ///< Coulomb coefficient

  int bodies = 0;
  std::vector<std::string> body_name;
  std::vector<double> inertia;          ///< kg m^2
  std::vector<double> inverse_inertia;  ///< 0 where the speed is given or the pulley is locked
  std::vector<double> sense;
  std::vector<double> speed_ratio;  ///< |speed| at a belt speed of 1 m/s without slip, rad/m

  std::vector<int> train;  ///< 0: reached from the belt over shafts and gears; others count from 1

  std::vector<TorsionalSpring> springs;
  std::vector<GearPair> gears;
  std::vector<TorqueTable> torques;

  State initial;  ///< at rest in static balance

  /// Whether some torsional spring overruns.
  bool has_one_way() const {
    return std::any_of(springs.begin(), springs.end(), [](const TorsionalSpring& s) { return s.one_way; });
  }
  bool prescribed() const { return driver.body >= 0 && driver.control == Control::prescribed; }
};

/// Index of a pulley or body by name, -1 if there is none.
int body_index(const Model& model, std::string_view name);

/// Compiles a valid scene, for the base condition or another. Throws BadInput for a layout that cannot be built.
Model compile(const SceneSpec& scene, std::string_view file = "scene");
Model compile(const SceneSpec& scene, const DriveCondition& condition, std::string_view file = "scene");

/// The drive of a model in another condition, to the bit what compile() makes of its scene, without solving for the
/// balance at rest again.
Model in_condition(const Model& model, const DriveCondition& condition);

/// Throws std::logic_error for a model of another condition.
void require_condition(const Model& model, const DriveCondition& condition);

}  // namespace beltlife

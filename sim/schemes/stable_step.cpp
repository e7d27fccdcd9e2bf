// Predicted step of each scheme, mode by mode: see scheme.h.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/kernels/contact_law.h"
#include "sim/schemes/scheme.h"

namespace beltlife {
namespace {

constexpr double margin = 0.9;  // of the shortest limit: the modes couple on curved belt

// Tension (N) that the drive is expected to see: static, plus what the torque tables put through the belt, plus
// centrifugal, at the fastest range.
double expected_tension(const Model& m) {
  double most = std::max(m.statics.balance.tension, 0.0);
  if (m.driver.body < 0) return most;
  for (const auto& range : m.scene.range) {
    const double v = range.crank_rpm * std::numbers::pi / 30 / m.speed_ratio[m.driver.body];
    if (v <= 0) continue;
    double power = 0;
    for (const auto& t : m.torques) {
      const double speed = v * m.speed_ratio[t.body];
      power += std::abs(t.factor * t.torque(speed) * speed);
    }
    most = std::max(most, std::max(m.statics.balance.tension, 0.0) + power / v + m.scene.belt.mass_kg_per_m * v * v);
  }
  return most;
}

// Bending damping presses a belt that enters curvature harder than T l0/R: 2.6 to 4.5 times, measured between k_p 1e10
// and 5.6e10.
double expected_normal_force(const Model& m, int pulley) {
  const double peak = m.belt.bending_damping > 0 ? 3.0 : 1.5;
  return peak * expected_tension(m) * m.belt.element_length / m.pulley_radius[pulley];
}

void add_pair(std::vector<StepLimit>& out, const std::string& name, double k, double c, double mobility) {
  out.push_back({name, "mode (k, c) x (1/J1 + 1/J2)", mode_limit(k * mobility, c * mobility)});
}

// The linearly implicit scheme was never seen to blow up; it loses accuracy. What it must resolve is how a node meets a
// pulley, a quarter of a period at w^2 = A kp/m: within h w = 0.6 the entry peaks of normal force stay within 1 to 2 %
// (kp 1e10 to 1e11, 256 to 2000 elements). Past h w = 2 of the friction anchor a node slides where it should stick, and
// nothing diverges. A belt without pulleys has its axial wave to resolve.
std::vector<StepLimit> accuracy_limits(const Model& m) {
  if (m.pulleys == 0)
    return {{"axial belt wave", "h w = 0.6, w^2 = 4 EA/(l0 m)",
             0.6 / std::sqrt(4 * m.belt.axial_stiffness / (m.belt.element_length * m.belt.node_mass))}};
  std::vector<StepLimit> out{
      {"belt entry (accuracy)", "h w = 0.6, w^2 = A kp/m", 0.6 / std::sqrt(m.contact.stiffness / m.belt.node_mass)},
      {"friction anchor (accuracy)", "h w = 0.9, w^2 = A kt/m",
       0.9 / std::sqrt(m.contact.friction_stiffness / m.belt.node_mass)}};
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.limit_s < b.limit_s; });
  return out;
}

}  // namespace

// With d = h c and z = h w: the semi-implicit scheme's z^2 - (2 - d - z^2) z + (1 - d) = 0 has both roots in the unit
// circle while z^2 + 2 d <= 4. The trapezoidal predictor-corrector, which puts corrected velocities into the positions,
// has determinant D = 1 - z^2/2 - d B/2 + z^2 B/4 and 1 + D - trace = z^2 B/2 with B = 2 - z^2/2 - d: the same limit.
double mode_limit(double w2, double c) { return 4 / (c + std::sqrt(c * c + 4 * w2)); }

double axial_damping_rate(const Model& m) {
  return 4 * m.belt.axial_damping / (m.belt.element_length * m.belt.node_mass);
}

double friction_damping_rate(const Model& m, double friction, double normal_force) {
  return contact_law::steepest_rate(m.contact, friction, normal_force, m.belt.node_mass);
}

std::vector<StepLimit> step_limits(const Model& m, Scheme scheme) {
  if (scheme == Scheme::linearly_implicit) return accuracy_limits(m);
  std::vector<StepLimit> out;
  const BeltModel& b = m.belt;
  const double mass = b.node_mass, l = b.element_length;
  double slope = 0;
  for (int p = 0; p < m.pulleys; ++p)
    slope = std::max(slope, friction_damping_rate(m, m.pulley_friction[p], expected_normal_force(m, p)));
  out.push_back({m.pulleys > 0 ? "axial belt wave and damping, friction slope" : "axial belt wave and damping",
                 "w^2 = 4 EA/(l0 m), c = 4 CA/(l0 m) + mu Fn (1-beta)/(vs m)",
                 mode_limit(4 * b.axial_stiffness / (l * mass), axial_damping_rate(m) + slope)});
  if (b.bending_damping > 0 || b.bending_stiffness > 0)
    out.push_back(
        {"bending", "w^2 = 16 EI/(l0^3 m), c = 16 CI/(l0^3 m)",
         mode_limit(16 * b.bending_stiffness / (l * l * l * mass), 16 * b.bending_damping / (l * l * l * mass))});
  if (m.pulleys > 0) {
    out.push_back({"contact penalty", "w^2 = A kp/m, c = A cp/m",
                   mode_limit(m.contact.stiffness / mass, m.contact.damping / mass)});
    // Along the surface the axial damping acts on a sticking node too.
    out.push_back({"friction anchor", "w^2 = A kt/m, c = 4 CA/(l0 m)",
                   mode_limit(m.contact.friction_stiffness / mass, axial_damping_rate(m))});
  }
  for (std::size_t i = 0; i < m.springs.size(); ++i) {
    const auto& s = m.springs[i];
    add_pair(out, "torsional spring " + m.scene.torsional_spring[i].name, s.stiffness, s.damping,
             m.inverse_inertia[s.from] + m.inverse_inertia[s.to]);
  }
  for (std::size_t i = 0; i < m.gears.size(); ++i) {
    const auto& g = m.gears[i];
    add_pair(out, "gear pair " + m.scene.gear_pair[i].name, g.stiffness, g.damping,
             g.pinion_radius * g.pinion_radius * m.inverse_inertia[g.pinion] +
                 g.gear_radius * g.gear_radius * m.inverse_inertia[g.gear]);
  }
  if (const TensionerModel& t = m.tensioner; t.pulley >= 0 && !t.locked) {
    const double k = t.spring_rate + t.friction_stiffness, c = std::max(t.damping_at(1), t.damping_at(-1));
    out.push_back(
        {"tensioner arm", "w^2 = (rate + friction anchor)/J, c = damping/J", mode_limit(k / t.inertia, c / t.inertia)});
    if (t.stops.any())
      out.push_back({"tensioner arm on a stop", "w^2 = (rate + friction anchor + stop)/J, c = (damping + stop)/J",
                     mode_limit((k + t.stops.stiffness) / t.inertia, (c + t.stops.damping) / t.inertia)});
  }
  if (m.driver.body >= 0 && !m.prescribed())
    out.push_back({"pid driver", "w^2 = angle gain/J, c = speed gain/J",
                   mode_limit(m.driver.angle_gain * m.inverse_inertia[m.driver.body],
                              m.driver.speed_gain * m.inverse_inertia[m.driver.body])});
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& c) { return a.limit_s < c.limit_s; });
  return out;
}

double stable_step(const Model& m, Scheme scheme) { return margin * step_limits(m, scheme).front().limit_s; }

}  // namespace beltlife

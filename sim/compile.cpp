// Scene -> Model: every derived number is born here.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sim/model.h"
#include "sim/scene/pitch_line.h"
#include "sim/scene/pulley_place.h"
#include "sim/scene/scene_io.h"

namespace beltlife {
namespace {

BeltModel compile_belt(const BeltSpec& spec, double unstretched_length) {
  BeltModel b;
  b.nodes = spec.elements;
  b.unstretched_length = unstretched_length;
  b.element_length = unstretched_length / spec.elements;
  b.node_mass = spec.mass_kg_per_m * b.element_length;
  b.axial_stiffness = spec.axial_stiffness_n;
  b.axial_damping = spec.axial_damping_n_s;
  b.bending_stiffness = spec.bending_stiffness_n_m2;
  b.bending_damping = spec.bending_damping_n_m2_s;
  return b;
}

ContactModel compile_contact(const ContactSpec& spec, const BeltSpec& belt, double element_length) {
  const double area = element_length * belt.ribs * belt.rib_pitch_mm * 1e-3;  // thesis 2.24: A of one node
  ContactModel c;
  c.stiffness = area * spec.stiffness_n_per_m3;
  c.damping = area * spec.damping_n_s_per_m3;
  c.separation_damping = spec.separation_factor * c.damping;
  c.friction_stiffness = area * spec.friction_stiffness_n_per_m3;
  c.friction_speed = spec.friction_speed_m_s;
  c.anchor_share = spec.anchor_share;
  return c;
}

void compile_pulleys(Model& m) {
  const double rotation = m.scene.rotation == Rotation::counterclockwise ? 1 : -1;
  m.pulleys = static_cast<int>(m.scene.pulley.size());
  for (const auto& p : m.scene.pulley) {
    const bool front = p.side == Side::front;
    const PulleyPlace place = pulley_place(m.scene, p);
    m.pulley_x.push_back(place.x_mm * 1e-3);
    m.pulley_y.push_back(place.y_mm * 1e-3);
    m.pulley_radius.push_back(pitch_diameter_mm(m.scene, p) * 5e-4);
    m.pulley_friction.push_back(p.friction.value_or(front ? m.scene.belt.friction_front : m.scene.belt.friction_back));
    m.body_name.push_back(p.name);
    m.inertia.push_back(p.inertia_kg_m2);
    m.inverse_inertia.push_back(p.locked ? 0 : 1 / p.inertia_kg_m2);
    m.sense.push_back(front ? rotation : -rotation);
    m.speed_ratio.push_back(1 / m.pulley_radius.back());
  }
}

// Links turn their ends at a fixed ratio, in the same or in opposite senses.
struct Link {
  int from, to;
  double ratio;  // |speed of `to`| / |speed of `from`|
  double sense;  // +1 same, -1 opposite
  std::string name, key;
};

void spread(Model& m, const std::vector<Link>& links) {
  for (int pass = 0; pass < m.bodies; ++pass)
    for (const auto& l : links) {
      if (m.sense[l.from] != 0 && m.sense[l.to] == 0) {
        m.sense[l.to] = l.sense * m.sense[l.from];
        m.speed_ratio[l.to] = m.speed_ratio[l.from] * l.ratio;
        m.train[l.to] = m.train[l.from];
      } else if (m.sense[l.from] == 0 && m.sense[l.to] != 0) {
        m.sense[l.from] = l.sense * m.sense[l.to];
        m.speed_ratio[l.from] = m.speed_ratio[l.to] / l.ratio;
        m.train[l.from] = m.train[l.to];
      }
    }
}

void compile_bodies(Model& m, std::string_view file) {
  for (const auto& b : m.scene.body) {
    m.body_name.push_back(b.name);
    m.inertia.push_back(b.inertia_kg_m2);
    m.inverse_inertia.push_back(1 / b.inertia_kg_m2);
  }
  m.bodies = static_cast<int>(m.body_name.size());
  std::vector<Link> links;
  for (const auto& s : m.scene.torsional_spring)
    links.push_back({body_index(m, s.from), body_index(m, s.to), 1, 1, "torsional spring " + s.name,
                     "torsional_spring." + s.name + ".from"});
  for (const auto& g : m.scene.gear_pair)
    links.push_back({body_index(m, g.pinion), body_index(m, g.gear), double(g.pinion_teeth) / g.gear_teeth, -1,
                     "gear pair " + g.name, "gear_pair." + g.name + ".pinion"});
  // Senses and speed ratios spread from the pulleys over the links; a train that no pulley reaches turns as the drive
  // does at its first body.
  m.sense.resize(m.bodies, 0);
  m.speed_ratio.resize(m.bodies, 0);
  m.train.resize(m.bodies, 0);
  spread(m, links);
  int train = 0;
  for (int b = 0; b < m.bodies; ++b)
    if (m.sense[b] == 0) {
      m.sense[b] = m.scene.rotation == Rotation::counterclockwise ? 1 : -1;
      m.speed_ratio[b] = 1;
      m.train[b] = ++train;
      spread(m, links);
    }
  for (const auto& l : links)
    if (m.sense[l.to] != l.sense * m.sense[l.from])
      throw BadInput({Problem{std::string(file), 0, l.key,
                              fmt::format("{} joins {} and {}, which the rest of the drive turns in {} senses", l.name,
                                          m.body_name[l.from], m.body_name[l.to], l.sense > 0 ? "opposite" : "equal"),
                              "ends that turn alike for a spring, opposite for gears"}});
}

void compile_train(Model& m, std::string_view file) {
  for (const auto& s : m.scene.torsional_spring)
    m.springs.push_back({body_index(m, s.from), body_index(m, s.to), s.stiffness_n_m_per_rad, s.damping_n_m_s_per_rad,
                         s.one_way, m.sense[body_index(m, s.from)]});
  for (const auto& g : m.scene.gear_pair) {
    const int pinion = body_index(m, g.pinion), gear = body_index(m, g.gear);
    const double half_module = g.module_mm * 5e-4;
    m.gears.push_back({pinion, gear, m.sense[pinion] * half_module * g.pinion_teeth,
                       m.sense[gear] * half_module * g.gear_teeth, g.stiffness_n_per_m, g.damping_n_s_per_m,
                       g.backlash_mm * 5e-4});
  }
  for (const auto& t : m.scene.torque) {
    const int body = body_index(m, t.body);
    TorqueTable table{body, 1, {t.speeds_rpm, t.torques_n_m}};
    for (double& x : table.torque.x) x *= std::numbers::pi / 30;
    if (t.referred_to && m.train[body_index(m, *t.referred_to)] != m.train[body])
      throw BadInput(
          {Problem{std::string(file), 0, "torque." + t.name + ".referred_to",
                   fmt::format("{} is not connected to {}, so there is no speed ratio", *t.referred_to, t.body),
                   "a body connected by belt, shafts or gears"}});
    if (t.referred_to) table.factor = m.speed_ratio[body_index(m, *t.referred_to)] / m.speed_ratio[body];
    table.factor *= m.condition.torque_factor;
    m.torques.push_back(std::move(table));
  }
}

// The scene of a model states all its numbers: where the pulley on the arm is placed, and a torque that was solved for
// in place of the pretension that asked for it. Compiled again it is the same drive.
void fill_in(SceneSpec& scene, const StaticState& statics) {
  for (PulleySpec& p : scene.pulley) {
    const PulleyPlace place = pulley_place(scene, p);
    p.x_mm = place.x_mm;
    p.y_mm = place.y_mm;
  }
  if (!scene.tensioner || scene.tensioner->spring_torque_n_m) return;
  scene.tensioner->spring_torque_n_m = statics.spring_torque;
  scene.belt.pretension_n.reset();
  if (!scene.belt.length_catalogue_mm) return;
  scene.belt.length_catalogue_mm.reset();
  scene.belt.unstretched_length_mm = 1e3 * statics.unstretched_length;
}

void compile_tensioner(Model& m) {
  if (!m.scene.tensioner) return;
  const TensionerSpec& s = *m.scene.tensioner;
  TensionerModel& t = m.tensioner;
  t.pulley = body_index(m, s.pulley);
  t.pivot_x = s.pivot_x_mm * 1e-3;
  t.pivot_y = s.pivot_y_mm * 1e-3;
  t.arm_x = m.pulley_x[t.pulley] - t.pivot_x;
  t.arm_y = m.pulley_y[t.pulley] - t.pivot_y;
  const double cg = s.cg_distance_mm * 1e-3;
  t.inertia = s.inertia_kg_m2 + s.mass_kg * cg * cg +
              m.scene.pulley[t.pulley].mass_kg * (t.arm_x * t.arm_x + t.arm_y * t.arm_y);
  t.spring_torque = m.statics.placed.length_per_arm_angle > 0 ? m.statics.spring_torque : -m.statics.spring_torque;
  t.spring_rate = s.spring_rate_n_m_per_rad;
  t.damping = s.damping_n_m_s_per_rad;
  t.friction_torque = s.friction_torque_n_m;
  t.friction_stiffness = s.friction_stiffness_n_m_per_rad;
  t.locked = s.locked;
  t.lengthening = m.statics.placed.length_per_arm_angle > 0 ? 1 : -1;
  t.directional = s.damping_shortening_n_m_s_per_rad || s.friction_torque_shortening_n_m;
  t.damping_shortening = s.damping_shortening_n_m_s_per_rad.value_or(t.damping);
  t.friction_shortening = s.friction_torque_shortening_n_m.value_or(t.friction_torque);
  t.stops = arm_stops_of(s, t.lengthening);
}

Coordinates at_rest(const Model& m) {
  const int n = m.belt.nodes;
  Coordinates q{NodeArray(n), NodeArray(n), NodeArray(n), NodeArray(n), {}, {}};
  q.angle.assign(m.bodies, 0.0);
  q.speed.assign(m.bodies, 0.0);
  return q;
}

// Nodes at equal distances along the static path, sunk into the pulleys as deep as the tension presses them:
// T l0 / R = A k_p d.
void place_on_route(Model& m) {
  const Layout& rest = m.statics.balance;
  std::vector<double> sink;
  for (int p = 0; p < m.pulleys; ++p)
    sink.push_back(std::max(rest.tension, 0.0) * m.belt.element_length / (m.pulley_radius[p] * m.contact.stiffness));
  Coordinates& q = m.initial.q;
  for (int i = 0; i < m.belt.nodes; ++i) {
    int circle = -1;
    const Vec2 p = point_at(rest.route, rest.route.length * i / m.belt.nodes, sink, circle);
    q.x[i] = p.x;
    q.y[i] = p.y;
  }
  q.arm_angle = rest.arm_angle;
}

// A polygon turning at w is in equilibrium where m w^2 r = 2 T sin(pi/N) with r = l / (2 sin(pi/N)).
void place_ring(Model& m) {
  const double w = m.scene.ring->speed_rad_s, s = std::sin(std::numbers::pi / m.belt.nodes);
  const double soft = m.belt.node_mass * w * w * m.belt.element_length / (4 * s * s * m.belt.axial_stiffness);
  const double radius = m.belt.element_length / (1 - soft) / (2 * s);
  Coordinates& q = m.initial.q;
  for (int i = 0; i < m.belt.nodes; ++i) {
    const double a = 2 * std::numbers::pi * i / m.belt.nodes;
    q.x[i] = radius * std::cos(a);
    q.y[i] = radius * std::sin(a);
    q.vx[i] = -w * q.y[i];
    q.vy[i] = w * q.x[i];
  }
}

void check_ring(const Model& m, std::string_view file) {
  const double w = m.scene.ring->speed_rad_s, s = std::sin(std::numbers::pi / m.belt.nodes);
  if (m.belt.node_mass * w * w * m.belt.element_length >= 4 * s * s * m.belt.axial_stiffness)
    throw BadInput(
        {Problem{std::string(file), 0, "ring.speed_rad_s", "the ring would stretch without limit", "a lower speed"}});
}

// All that follows from the scene as filled in and from its balance at rest.
Model assemble(SceneSpec scene, StaticState statics, const DriveCondition& condition, std::string_view file) {
  Model m;
  m.scene = std::move(scene);
  m.condition = condition;
  m.statics = std::move(statics);
  m.belt = compile_belt(m.scene.belt, m.statics.unstretched_length);
  m.contact = compile_contact(m.scene.contact, m.scene.belt, m.belt.element_length);
  compile_pulleys(m);
  compile_bodies(m, file);
  compile_train(m, file);
  compile_tensioner(m);
  if (const auto& driver = m.scene.driver) {
    m.driver = {body_index(m, driver->body), driver->control, driver->speed_gain_n_m_s_per_rad,
                driver->angle_gain_n_m_per_rad};
    if (m.prescribed()) m.inverse_inertia[m.driver.body] = 0;
  }
  m.initial.q = at_rest(m);
  m.initial.anchor = NodeArray(m.belt.nodes);
  if (m.has_one_way()) m.initial.free_wheel.assign(m.springs.size(), 0.0);
  m.initial.near.assign(m.belt.nodes, -1);
  if (m.scene.ring) {
    check_ring(m, file);
    place_ring(m);
  } else {
    place_on_route(m);
  }
  return m;
}

}  // namespace

int body_index(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.body_name.size(); ++i)
    if (model.body_name[i] == name) return static_cast<int>(i);
  return -1;
}

Model compile(const SceneSpec& scene, std::string_view file) { return compile(scene, DriveCondition{}, file); }

Model compile(const SceneSpec& scene, const DriveCondition& condition, std::string_view file) {
  SceneSpec filled = scene;
  StaticState statics;
  if (scene.ring)
    statics.unstretched_length = *unstretched_length_mm(scene.belt) * 1e-3;
  else
    statics = solve_statics(scene, file);
  fill_in(filled, statics);
  return assemble(std::move(filled), std::move(statics), condition, file);
}

Model in_condition(const Model& model, const DriveCondition& condition) {
  return assemble(model.scene, model.statics, condition, "scene");
}

void require_condition(const Model& model, const DriveCondition& condition) {
  if (model.condition != condition)
    throw std::logic_error("the model is of another condition than what is asked of it");
}

}  // namespace beltlife

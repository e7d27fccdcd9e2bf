// Linearised drive, assembled as a sum of quadratic forms: see linear_drive.h.
//
// Belt: linear bars along the path, a coordinate u (travel along the scene's pulley order) at each joint. On a free
// span a bar of unstretched length l0 has EA/l0 and CA/l0 and its consistent mass. Two effects join arc and pulley:
//   tangential  the friction anchors, k_t x width a metre, pull on w = u - turn R theta
//   radial      tension T sinks the arc by T/(R k_p width), which lengthens it by the share 1/(R^2 k_p width) of T, so
//               that an arc has 1/EA_arc = 1/EA + 1/(R^2 k_p width)
// A bar of length l on such a bed decays over b = sqrt(EA_arc/(k_t width)) and has, exactly,
//   2 V = EA_arc/b [(w1 - w2)^2 / sinh(l/b) + (w1^2 + w2^2) tanh(l/2b)]
//
// Arm: the pulley centre moves by c' a radian. The ends of the bars beside it move along by t c', the arc as a whole by
// c', and the two spans swing as straight lines. Geometric stiffness, with tensions less rho v^2 and r from pivot to
// centre, is the rate at which t_in c' T_in - t_out c' T_out changes:
//   T_in [(n_in c')^2 / L_in - t_in r] + T_out [(n_out c')^2 / L_out + t_out r]
// which for equal tensions is T d2L/dphi2.
#include "sim/modes/linear_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace beltlife {
namespace {

// A linear combination of coordinates; row -1 is one that does not move.
using Form = std::vector<std::pair<int, double>>;

Form operator+(Form a, const Form& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Form operator-(Form a, const Form& b) {
  for (const auto& [row, factor] : b) a.emplace_back(row, -factor);
  return a;
}

double dot(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

// matrix += weight form form^T
void add(Eigen::MatrixXd& matrix, const Form& form, double weight) {
  for (const auto& [i, a] : form)
    for (const auto& [j, b] : form)
      if (i >= 0 && j >= 0) matrix(i, j) += weight * a * b;
}

// matrix += weight (a b^T + b a^T)
void add_product(Eigen::MatrixXd& matrix, const Form& a, const Form& b, double weight) {
  for (const auto& [i, x] : a)
    for (const auto& [j, y] : b)
      if (i >= 0 && j >= 0) {
        matrix(i, j) += weight * x * y;
        matrix(j, i) += weight * x * y;
      }
}

// Linear between two joints: integral of weight x^2 over a piece, `weight` being that of the whole piece.
void add_consistent(Eigen::MatrixXd& matrix, const Form& a, const Form& b, double weight) {
  add(matrix, a + b, weight / 6);
  add(matrix, a, weight / 6);
  add(matrix, b, weight / 6);
}

int pieces(double length, double longest) { return std::max(1, static_cast<int>(std::ceil(length / longest))); }

class Assembly {
 public:
  Assembly(const Model& m, const OperatingPoint& loop, ArmState arm, const LinearOptions& options)
      : m_(m), loop_(loop), options_(options) {
    number_rows(arm);
    bodies();
    links();
    for (int p = 0; p < m_.pulleys; ++p) {
      arc(p);
      span(p);
    }
    if (d_.arm_row >= 0) arm_itself(arm);
  }
  LinearDrive take() { return std::move(d_); }

 private:
  void number_rows(ArmState arm) {
    int rows = 0;
    for (int b = 0; b < m_.bodies; ++b) d_.body_row.push_back(m_.inverse_inertia[b] > 0 ? rows++ : -1);
    if (arm == ArmState::free || arm == ArmState::stuck) d_.arm_row = rows++;
    d_.belt_row = rows;
    for (int p = 0; p < m_.pulleys; ++p) {
      arc_pieces_.push_back(pieces(arc_length(p), options_.piece));
      span_pieces_.push_back(pieces(loop_.route.spans[p].length, options_.piece));
      arc_row_.push_back(rows);
      if (!gripped(p)) rows += arc_pieces_[p] + 1;
      span_row_.push_back(rows);
      rows += span_pieces_[p] - 1;
    }
    d_.mass = d_.stiffness = d_.damping = Eigen::MatrixXd::Zero(rows, rows);
    if (m_.tensioner.pulley >= 0) {
      const Circle& c = loop_.route.circles[m_.tensioner.pulley];
      r_ = {c.x - m_.tensioner.pivot_x, c.y - m_.tensioner.pivot_y};
    }
  }

  void bodies() {
    for (int b = 0; b < m_.bodies; ++b) add(d_.mass, {{d_.body_row[b], 1.0}}, m_.inertia[b]);
    const DriverModel& driver = m_.driver;
    if (driver.body < 0 || driver.control != Control::pid) return;
    add(d_.stiffness, {{d_.body_row[driver.body], 1.0}}, driver.angle_gain);
    add(d_.damping, {{d_.body_row[driver.body], 1.0}}, driver.speed_gain);
  }

  void links() {
    for (std::size_t i = 0; i < m_.springs.size(); ++i) {
      if (loop_.released[i]) continue;
      const TorsionalSpring& s = m_.springs[i];
      const Form twist{{d_.body_row[s.from], 1.0}, {d_.body_row[s.to], -1.0}};
      add(d_.stiffness, twist, s.stiffness);
      add(d_.damping, twist, s.damping);
    }
    for (std::size_t i = 0; i < m_.gears.size(); ++i) {
      if (!loop_.gear_engaged[i]) continue;
      const GearPair& g = m_.gears[i];
      const Form approach{{d_.body_row[g.pinion], g.pinion_radius}, {d_.body_row[g.gear], -g.gear_radius}};
      add(d_.stiffness, approach, g.stiffness);
      add(d_.damping, approach, g.damping);
    }
  }

  double arc_length(int p) const { return loop_.route.wrap[p] * loop_.route.circles[p].radius; }
  double stretch(double tension) const { return 1 + tension / m_.belt.axial_stiffness; }
  double mass_of(double length, double tension) const {
    return m_.scene.belt.mass_kg_per_m * length / stretch(tension);
  }

  // Where the belt must skid (on a locked pulley of a running drive, or without friction) nothing holds it.
  bool skids(int p) const { return m_.pulley_friction[p] == 0 || (m_.scene.pulley[p].locked && loop_.belt_speed != 0); }
  // The belt goes with the pulley's surface and needs no coordinates of its own.
  bool gripped(int p) const { return !options_.contact_compliance && !skids(p); }
  Form surface(int p) const {
    const Circle& c = loop_.route.circles[p];
    return {{d_.body_row[p], c.turn * c.radius}};
  }
  // Travel of the belt at joint i of an arc, 0 .. arc_pieces.
  Form on_arc(int p, int i) const { return gripped(p) ? surface(p) : Form{{arc_row_[p] + i, 1.0}}; }

  // How far a pulley's centre moves along a direction when the arm turns by a radian; 0 for all but the arm's pulley.
  double centre_along(int pulley, const Vec2& direction) const {
    return pulley == m_.tensioner.pulley ? cross(r_, direction) : 0;
  }
  Form arm_times(double factor) const { return {{d_.arm_row, factor}}; }

  void arc(int p) {
    const Circle& circle = loop_.route.circles[p];
    const int n = arc_pieces_[p], before = (p + m_.pulleys - 1) % m_.pulleys;
    const double length = arc_length(p) / n, tension = 0.5 * (loop_.tension[p] + loop_.tension[before]);
    const double l0 = length / stretch(tension), mass = mass_of(length, tension);

    double ea = m_.belt.axial_stiffness, decay = 1;
    if (options_.contact_compliance) {
      const double radial = m_.contact.stiffness / m_.belt.element_length;
      ea = 1 / (1 / ea + 1 / (circle.radius * circle.radius * radial));
      decay = std::sqrt(ea * m_.belt.element_length / m_.contact.friction_stiffness);
    }
    const Form pulley = surface(p);
    const Vec2 from = loop_.route.spans[before].to;
    double ex = from.x - circle.x, ey = from.y - circle.y;  // centre to the piece's begin
    const double cos = std::cos(loop_.route.wrap[p] / n), sin = circle.turn * std::sin(loop_.route.wrap[p] / n);
    for (int i = 0; i < n; ++i) {
      const Form a = on_arc(p, i), b = on_arc(p, i + 1);
      if (skids(p)) {
        add(d_.stiffness, b - a, ea / l0);
      } else if (!gripped(p)) {
        const double x = l0 / decay;
        add(d_.stiffness, b - a, ea / decay / std::sinh(x));
        for (const Form& end : {a, b}) add(d_.stiffness, end - pulley, ea / decay * std::tanh(0.5 * x));
      }
      add(d_.damping, b - a, m_.belt.axial_damping / l0);
      add_consistent(d_.mass, a, b, mass);
      const Vec2 chord{(cos - 1) * ex - sin * ey, sin * ex + (cos - 1) * ey};
      if (d_.arm_row >= 0 && p == m_.tensioner.pulley) {
        const double share = 0.5 * mass / length * centre_along(p, chord);
        add_product(d_.mass, a + b, arm_times(1), share);
        add(d_.mass, arm_times(1), mass * dot(r_, r_));
      }
      ex += chord.x;
      ey += chord.y;
    }
  }

  void span(int p) {
    const Span& s = loop_.route.spans[p];
    const int n = span_pieces_[p], next = (p + 1) % m_.pulleys;
    const double length = s.length / n, tension = loop_.tension[p], l0 = length / stretch(tension);
    const auto joint = [&](int i) -> Form {
      if (i == 0) return on_arc(p, arc_pieces_[p]) + arm_times(centre_along(p, s.direction));
      if (i == n) return on_arc(next, 0) + arm_times(centre_along(next, s.direction));
      return {{span_row_[p] + i - 1, 1.0}};
    };
    for (int i = 0; i < n; ++i) {
      const Form a = joint(i), b = joint(i + 1);
      add(d_.stiffness, b - a, m_.belt.axial_stiffness / l0);
      add(d_.damping, b - a, m_.belt.axial_damping / l0);
      add_consistent(d_.mass, a, b, mass_of(length, tension));
    }
    const Vec2 normal{-s.direction.y, s.direction.x};
    const double mass = mass_of(s.length, tension);
    for (const int end : {p, next}) add(d_.mass, arm_times(centre_along(end, normal)), mass / 3);
  }

  void arm_itself(ArmState arm) {
    const TensionerModel& t = m_.tensioner;
    const int out = t.pulley, in = (out + m_.pulleys - 1) % m_.pulleys;
    double stiffness = t.spring_rate + (loop_.on_stop ? t.stops.stiffness : 0);
    for (const int k : {in, out}) {
      const Span& s = loop_.route.spans[k];
      const double swing = cross(r_, Vec2{-s.direction.y, s.direction.x});
      stiffness += (loop_.tension[k] - loop_.centrifugal) *
                   (swing * swing / s.length + (k == out ? 1 : -1) * dot(s.direction, r_));
    }
    if (arm == ArmState::stuck) stiffness += t.friction_stiffness;
    add(d_.stiffness, arm_times(1), stiffness);
    // A small vibration goes as long one way as the other.
    const double damping = 0.5 * (t.damping_at(-1) + t.damping_at(1)) + (loop_.on_stop ? t.stops.damping : 0);
    add(d_.damping, arm_times(1), damping);
    add(d_.mass, arm_times(1), t.inertia);
  }

  const Model& m_;
  const OperatingPoint& loop_;
  const LinearOptions& options_;
  LinearDrive d_;
  std::vector<int> arc_pieces_, span_pieces_, arc_row_, span_row_;
  Vec2 r_;  // pivot to centre of the arm's pulley
};

}  // namespace

std::string_view name_of(ArmState arm) {
  switch (arm) {
    case ArmState::free:
      return "free";
    case ArmState::stuck:
      return "stuck";
    case ArmState::locked:
      return "locked";
    case ArmState::none:
      break;
  }
  return "none";
}

std::vector<ArmState> arm_states(const Model& m) {
  if (m.tensioner.pulley < 0) return {ArmState::none};
  if (m.tensioner.locked) return {ArmState::locked};
  if (m.tensioner.friction_against(-1) == 0 && m.tensioner.friction_against(1) == 0) return {ArmState::free};
  return {ArmState::free, ArmState::stuck};
}

LinearDrive linearise(const Model& model, const OperatingPoint& loop, ArmState arm, const LinearOptions& options) {
  return Assembly(model, loop, arm, options).take();
}

}  // namespace beltlife

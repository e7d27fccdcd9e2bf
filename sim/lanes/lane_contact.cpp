// Contact and friction in lanes (thesis 2.24-2.27), with the tangents that the implicit step needs: see lane_belt.h.
//
// The law is that of sim/kernels/contact.cpp. Averaged over the step as lane_elements.cpp says, the normal force gets
// the part of the penetration's acceleration that is not the node's own: -v_t^2/r, of a node that runs round the
// centre. Friction limits and the saturating element take the velocity at t_n, extrapolated with the previous step's
// change.
#include <cmath>

#include "sim/kernels/kernel.h"
#include "sim/lanes/lane_belt.h"

namespace beltlife {
namespace {

constexpr int row_of_loads = sizeof(LaneLoads) / sizeof(double);

template <bool Peaks>
[[gnu::always_inline]] inline void contact_rows(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                                const double* speeds, const double* changes, const double* x,
                                                const double* y, const double* vx, const double* vy, const double* dvx,
                                                const double* dvy, double* anchor, double* fx, double* fy,
                                                double* normal_x, double* normal_y, double* distance, double* normal,
                                                double* tangential, double* normal_tangent, double* tangential_tangent,
                                                double* lag, double* tangential_now, double* creep) {
  const double quarter = 0.25 * h * h, half = 0.5 * h;
  for (const ContactBlock* block = blocks; block < blocks + count; ++block) {
    const LanePulleys& p = block->of;
    const int* pulley = block->pulley;
    LaneNumber speed, change;
    BELTLIFE_EACH_LANE(k) {
      speed[k] = speeds[pulley[k] * lanes + k];
      change[k] = changes[pulley[k] * lanes + k];
    }
    for (int j = block->begin; j < block->end; ++j) {
      const int o = j * lanes;
      BELTLIFE_EACH_LANE(k) {
        const int i = o + k;
        const double dx = x[i] - p.x[k], dy = y[i] - p.y[k];
        const double rvx = vx[i] - p.vx[k], rvy = vy[i] - p.vy[k];
        const double r = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / r;
        const double nx = dx * inverse, ny = dy * inverse;
        const double d = p.radius[k] - r;
        const double vn = rvx * nx + rvy * ny, round = rvy * nx - rvx * ny;
        const double ahead_n = 0.5 * (dvx[i] * nx + dvy[i] * ny), ahead_t = 0.5 * (dvy[i] * nx - dvx[i] * ny);
        const double damping = vn + ahead_n <= 0 ? c.damping[k] : c.separation_damping[k];
        // The pressing force at t_n, extrapolated, decides whether there is contact and what friction can carry.
        const double pressed = c.stiffness[k] * d - damping * (vn + ahead_n);
        const double fn_limit = d > 0 ? (pressed > 0 ? pressed : 0.0) : 0.0;
        const double on = fn_limit > 0 ? 1.0 : 0.0;
        const double bulge = on * quarter * c.stiffness[k] * round * round * inverse;
        const double fn = on * (c.stiffness[k] * d - damping * vn) - bulge;
        const double vt = round - speed[k] * r;
        const double vt_now = vt + ahead_t - 0.5 * change[k] * r;
        const double trial = anchor[i] + h * vt;
        const double spring = c.friction_stiffness[k] * trial, limit = p.anchor_limit[k] * fn_limit;
        const double high = spring < limit ? spring : limit;
        const double fs = high > -limit ? high : -limit;
        // The saturating element as a damper with its secant slope at the velocity expected: implicit whether creeping
        // or sliding, so that a light node cannot jump across the slope and back. Weights between 1/2 (slope slow
        // beside the step) and 1, as the exact decay of z = h slope/m has.
        const double size = vt_now > 0 ? vt_now : -vt_now;
        const double pace = size > c.friction_speed[k] ? size : c.friction_speed[k];
        // slope = most/pace, z = h slope/m, weight = 1/2 + 1/2 z/(z + 6), by one division.
        const double most = p.velocity_limit[k] * fn_limit, still = 6.0 * c.mass[k] * pace + h * most;
        const double inverse_both = 1.0 / (pace * still);
        const double slope = most * (still * inverse_both);
        const double weight = 0.5 + 0.5 * h * most * (pace * inverse_both);
        const double fv = slope * (vt - weight * change[k] * r);
        const double ft = -(fs + fv);
        anchor[i] = fs * c.inverse_friction_stiffness[k];
        fx[i] += fn * nx - ft * ny;
        fy[i] += fn * ny + ft * nx;
        normal_x[i] = nx;
        normal_y[i] = ny;
        distance[i] = r;
        normal[i] = fn;
        tangential[i] = ft;
        if (Peaks) {
          lag[i] = bulge;
          tangential_now[i] = -(fs + slope * (vt - 0.5 * change[k] * r));
          creep[i] = slope;
        }
        normal_tangent[i] = on * (quarter * c.stiffness[k] + half * damping);
        tangential_tangent[i] = (fs == spring ? on * quarter * c.friction_stiffness[k] : 0.0) + weight * h * slope;
      }
    }
  }
}

template <bool Peaks>
[[gnu::always_inline]] inline void reaction_rows(const ContactBlock* blocks, int count, double inverse_step,
                                                 const double* dvx, const double* dvy, const double* normal_x,
                                                 const double* normal_y, const double* distance,
                                                 const double* normal_tangent, const double* tangential_tangent,
                                                 const LaneNumber& averaging, const double* lag,
                                                 const double* tangential_now, const double* creep, double* normal,
                                                 double* tangential, double* normal_last, double* normal_before,
                                                 double* normal_peak, double* tangential_peak, double* loads) {
  for (const ContactBlock* block = blocks; block < blocks + count; ++block) {
    const int* pulley = block->pulley;
    LaneNumber load_x, load_y, moment;
    BELTLIFE_EACH_LANE(k) {
      const double* from = loads + pulley[k] * row_of_loads + k;
      load_x[k] = from[0];
      load_y[k] = from[lanes];
      moment[k] = from[2 * lanes];
    }
    for (int j = block->begin; j < block->end; ++j) {
      const int o = j * lanes;
      BELTLIFE_EACH_LANE(k) {
        const int i = o + k;
        const double nx = normal_x[i], ny = normal_y[i];
        const double fn = normal[i] - inverse_step * normal_tangent[i] * (dvx[i] * nx + dvy[i] * ny);
        const double ft = tangential[i] - inverse_step * tangential_tangent[i] * (dvy[i] * nx - dvx[i] * ny);
        normal[i] = fn;
        tangential[i] = ft;
        if (Peaks) {
          // The force at t_n itself, without the averaging over the step; the parabola through three of them has the
          // peak.
          const double now =
              fn + lag[i] + averaging[k] * (normal_tangent[i] > 0 ? 1.0 : 0.0) * (dvx[i] * nx + dvy[i] * ny);
          const double last = normal_last[i], before = normal_before[i];
          const double bend = 2 * last - before - now, slope = now - before;
          const double top = last + (bend > 0 && slope < bend && slope > -bend ? 0.125 * slope * slope / bend : 0.0);
          normal_before[i] = last;
          normal_last[i] = now;
          normal_peak[i] = normal_peak[i] > top ? normal_peak[i] : top;
          const double ft_now = tangential_now[i] - 0.5 * creep[i] * (dvy[i] * nx - dvx[i] * ny);
          const double size = ft_now > 0 ? ft_now : -ft_now;
          tangential_peak[i] = tangential_peak[i] > size ? tangential_peak[i] : size;
        }
        load_x[k] -= fn * nx - ft * ny;
        load_y[k] -= fn * ny + ft * nx;
        moment[k] -= ft * distance[i];
      }
    }
    BELTLIFE_EACH_LANE(k) {
      double* to = loads + pulley[k] * row_of_loads + k;
      to[0] = load_x[k];
      to[lanes] = load_y[k];
      to[2 * lanes] = moment[k];
    }
  }
}

BELTLIFE_VECTOR void contact_plain(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                   const double* speeds, const double* changes, const double* x, const double* y,
                                   const double* vx, const double* vy, const double* dvx, const double* dvy,
                                   double* anchor, double* fx, double* fy, double* normal_x, double* normal_y,
                                   double* distance, double* normal, double* tangential, double* normal_tangent,
                                   double* tangential_tangent, double* lag, double* tangential_now, double* creep) {
  contact_rows<false>(blocks, count, h, c, speeds, changes, x, y, vx, vy, dvx, dvy, anchor, fx, fy, normal_x, normal_y,
                      distance, normal, tangential, normal_tangent, tangential_tangent, lag, tangential_now, creep);
}

BELTLIFE_VECTOR void contact_peaks(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                   const double* speeds, const double* changes, const double* x, const double* y,
                                   const double* vx, const double* vy, const double* dvx, const double* dvy,
                                   double* anchor, double* fx, double* fy, double* normal_x, double* normal_y,
                                   double* distance, double* normal, double* tangential, double* normal_tangent,
                                   double* tangential_tangent, double* lag, double* tangential_now, double* creep) {
  contact_rows<true>(blocks, count, h, c, speeds, changes, x, y, vx, vy, dvx, dvy, anchor, fx, fy, normal_x, normal_y,
                     distance, normal, tangential, normal_tangent, tangential_tangent, lag, tangential_now, creep);
}

BELTLIFE_VECTOR void reaction_plain(const ContactBlock* blocks, int count, double inverse_step, const double* dvx,
                                    const double* dvy, const double* normal_x, const double* normal_y,
                                    const double* distance, const double* normal_tangent,
                                    const double* tangential_tangent, const LaneNumber& averaging, const double* lag,
                                    const double* tangential_now, const double* creep, double* normal,
                                    double* tangential, double* normal_last, double* normal_before, double* normal_peak,
                                    double* tangential_peak, double* loads) {
  reaction_rows<false>(blocks, count, inverse_step, dvx, dvy, normal_x, normal_y, distance, normal_tangent,
                       tangential_tangent, averaging, lag, tangential_now, creep, normal, tangential, normal_last,
                       normal_before, normal_peak, tangential_peak, loads);
}

BELTLIFE_VECTOR void reaction_peaks(const ContactBlock* blocks, int count, double inverse_step, const double* dvx,
                                    const double* dvy, const double* normal_x, const double* normal_y,
                                    const double* distance, const double* normal_tangent,
                                    const double* tangential_tangent, const LaneNumber& averaging, const double* lag,
                                    const double* tangential_now, const double* creep, double* normal,
                                    double* tangential, double* normal_last, double* normal_before, double* normal_peak,
                                    double* tangential_peak, double* loads) {
  reaction_rows<true>(blocks, count, inverse_step, dvx, dvy, normal_x, normal_y, distance, normal_tangent,
                      tangential_tangent, averaging, lag, tangential_now, creep, normal, tangential, normal_last,
                      normal_before, normal_peak, tangential_peak, loads);
}

}  // namespace

void lane_contact(LaneBelt& b, const LaneNumber* speeds, const LaneNumber* changes) {
  (b.peaks ? contact_peaks : contact_plain)(
      b.blocks.data(), static_cast<int>(b.blocks.size()), b.step, b.law, speeds->of, changes->of, b.x.data(),
      b.y.data(), b.vx.data(), b.vy.data(), b.dvx.data(), b.dvy.data(), b.anchor.data(), b.fx.data(), b.fy.data(),
      b.normal_x.data(), b.normal_y.data(), b.distance.data(), b.normal.data(), b.tangential.data(),
      b.normal_tangent.data(), b.tangential_tangent.data(), b.lag.data(), b.tangential_now.data(), b.creep.data());
}

void lane_reactions(LaneBelt& b, LaneLoads* loads) {
  LaneNumber averaging;
  for (int k = 0; k < lanes; ++k) averaging[k] = 0.25 * b.step * b.law.stiffness[k];
  (b.peaks ? reaction_peaks : reaction_plain)(
      b.blocks.data(), static_cast<int>(b.blocks.size()), 1 / b.step, b.dvx.data(), b.dvy.data(), b.normal_x.data(),
      b.normal_y.data(), b.distance.data(), b.normal_tangent.data(), b.tangential_tangent.data(), averaging,
      b.lag.data(), b.tangential_now.data(), b.creep.data(), b.normal.data(), b.tangential.data(), b.normal_last.data(),
      b.normal_before.data(), b.normal_peak.data(), b.tangential_peak.data(), loads->x.of);
}

}  // namespace beltlife

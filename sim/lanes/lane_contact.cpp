// Contact and friction in lanes (thesis 2.24-2.27), with the tangents that the implicit step needs: see lane_belt.h.
//
// The law stands in sim/kernels/contact_law.h. Averaged over the step as lane_elements.cpp says, the normal force gets
// the part of the penetration's acceleration that is not the node's own: -v_t^2/r, of a node that runs round the
// centre. Friction limits and the saturating element take the velocity at t_n, extrapolated with the previous step's
// change.
#include <cmath>

#include "sim/kernels/contact_law.h"
#include "sim/kernels/kernel.h"
#include "sim/lanes/lane_belt.h"

namespace beltlife {
namespace {

constexpr int row_of_loads = sizeof(LaneLoads) / sizeof(double);

/// Rows of the belt that contact reads and writes; each is a row a node in LaneBelt, by the same name.
struct ContactRows {
  const double *x, *y, *vx, *vy, *dvx, *dvy;
  double *anchor, *fx, *fy, *normal_x, *normal_y, *distance, *normal, *tangential;
  double *normal_tangent, *tangential_tangent;
  double *lag, *tangential_now, *creep;  ///< with peaks alone
};

/// Rows that the reactions on the pulleys read and write, once the step's change of velocity is known.
struct ReactionRows {
  const double *dvx, *dvy, *normal_x, *normal_y, *distance, *normal_tangent, *tangential_tangent;
  const double *lag, *tangential_now, *creep;  ///< with peaks alone
  double *normal, *tangential;
  double *normal_last, *normal_before, *normal_peak, *tangential_peak;  ///< with peaks alone
  double* loads;                                                        ///< LaneLoads by pulley
};

template <bool Peaks>
[[gnu::always_inline]] inline void contact_rows(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                                const double* speeds, const double* changes, const ContactRows& rows) {
  const double quarter = 0.25 * h * h;
  const ContactRows a = rows;
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
        const double dx = a.x[i] - p.x[k], dy = a.y[i] - p.y[k];
        const double rvx = a.vx[i] - p.vx[k], rvy = a.vy[i] - p.vy[k];
        const double r = std::sqrt(dx * dx + dy * dy), inverse = 1.0 / r;
        const double nx = dx * inverse, ny = dy * inverse;
        const double d = p.radius[k] - r;
        const double vn = rvx * nx + rvy * ny, round = rvy * nx - rvx * ny;
        const double ahead_n = 0.5 * (a.dvx[i] * nx + a.dvy[i] * ny), ahead_t = 0.5 * (a.dvy[i] * nx - a.dvx[i] * ny);
        const double rate = -(vn + ahead_n);
        const double damping = contact_law::damping(c.damping[k], c.separation_damping[k], rate);
        // The pressing force at t_n, extrapolated, decides whether there is contact and what friction can carry.
        const double fn_limit = contact_law::normal_force(c.stiffness[k], damping, d, rate);
        const double on = fn_limit > 0 ? 1.0 : 0.0;
        const double bulge = on * quarter * c.stiffness[k] * round * round * inverse;
        const double fn = on * (c.stiffness[k] * d - damping * vn) - bulge;
        const double vt = round - speed[k] * r;
        const double vt_now = vt + ahead_t - 0.5 * change[k] * r;
        const double spring = c.friction_stiffness[k] * (a.anchor[i] + h * vt);
        const double fs = contact_law::anchor_force(spring, p.anchor_limit[k] * fn_limit);
        const contact_law::SecantDamper damper =
            contact_law::secant_damper(p.velocity_limit[k] * fn_limit, vt_now, c.friction_speed[k], c.mass[k], h);
        const double fv = damper.slope * (vt - damper.weight * change[k] * r);
        const double ft = -(fs + fv);
        a.anchor[i] = fs * c.inverse_friction_stiffness[k];
        a.fx[i] += fn * nx - ft * ny;
        a.fy[i] += fn * ny + ft * nx;
        a.normal_x[i] = nx;
        a.normal_y[i] = ny;
        a.distance[i] = r;
        a.normal[i] = fn;
        a.tangential[i] = ft;
        if (Peaks) {
          a.lag[i] = bulge;
          a.tangential_now[i] = -(fs + damper.slope * (vt - 0.5 * change[k] * r));
          a.creep[i] = damper.slope;
        }
        a.normal_tangent[i] = on * contact_law::normal_tangent(c.stiffness[k], damping, h);
        a.tangential_tangent[i] =
            (fs == spring ? on * contact_law::sticking_tangent(c.friction_stiffness[k], h) : 0.0) +
            damper.weight * h * damper.slope;
      }
    }
  }
}

template <bool Peaks>
[[gnu::always_inline]] inline void reaction_rows(const ContactBlock* blocks, int count, double inverse_step,
                                                 const LaneNumber& averaging, const ReactionRows& rows) {
  const ReactionRows a = rows;
  for (const ContactBlock* block = blocks; block < blocks + count; ++block) {
    const int* pulley = block->pulley;
    LaneNumber load_x, load_y, moment;
    BELTLIFE_EACH_LANE(k) {
      const double* from = a.loads + pulley[k] * row_of_loads + k;
      load_x[k] = from[0];
      load_y[k] = from[lanes];
      moment[k] = from[2 * lanes];
    }
    for (int j = block->begin; j < block->end; ++j) {
      const int o = j * lanes;
      BELTLIFE_EACH_LANE(k) {
        const int i = o + k;
        const double nx = a.normal_x[i], ny = a.normal_y[i];
        const double fn = a.normal[i] - inverse_step * a.normal_tangent[i] * (a.dvx[i] * nx + a.dvy[i] * ny);
        const double ft = a.tangential[i] - inverse_step * a.tangential_tangent[i] * (a.dvy[i] * nx - a.dvx[i] * ny);
        a.normal[i] = fn;
        a.tangential[i] = ft;
        if (Peaks) {
          // The force at t_n itself, without the averaging over the step; the parabola through three of them has the
          // peak.
          const double now =
              fn + a.lag[i] + averaging[k] * (a.normal_tangent[i] > 0 ? 1.0 : 0.0) * (a.dvx[i] * nx + a.dvy[i] * ny);
          const double last = a.normal_last[i], before = a.normal_before[i];
          const double bend = 2 * last - before - now, slope = now - before;
          const double top = last + (bend > 0 && slope < bend && slope > -bend ? 0.125 * slope * slope / bend : 0.0);
          a.normal_before[i] = last;
          a.normal_last[i] = now;
          a.normal_peak[i] = a.normal_peak[i] > top ? a.normal_peak[i] : top;
          const double ft_now = a.tangential_now[i] - 0.5 * a.creep[i] * (a.dvy[i] * nx - a.dvx[i] * ny);
          const double size = ft_now > 0 ? ft_now : -ft_now;
          a.tangential_peak[i] = a.tangential_peak[i] > size ? a.tangential_peak[i] : size;
        }
        load_x[k] -= fn * nx - ft * ny;
        load_y[k] -= fn * ny + ft * nx;
        moment[k] -= ft * a.distance[i];
      }
    }
    BELTLIFE_EACH_LANE(k) {
      double* to = a.loads + pulley[k] * row_of_loads + k;
      to[0] = load_x[k];
      to[lanes] = load_y[k];
      to[2 * lanes] = moment[k];
    }
  }
}

BELTLIFE_VECTOR void contact_plain(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                   const double* speeds, const double* changes, const ContactRows& rows) {
  contact_rows<false>(blocks, count, h, c, speeds, changes, rows);
}

BELTLIFE_VECTOR void contact_peaks(const ContactBlock* blocks, int count, double h, const ContactLaw& c,
                                   const double* speeds, const double* changes, const ContactRows& rows) {
  contact_rows<true>(blocks, count, h, c, speeds, changes, rows);
}

BELTLIFE_VECTOR void reaction_plain(const ContactBlock* blocks, int count, double inverse_step,
                                    const LaneNumber& averaging, const ReactionRows& rows) {
  reaction_rows<false>(blocks, count, inverse_step, averaging, rows);
}

BELTLIFE_VECTOR void reaction_peaks(const ContactBlock* blocks, int count, double inverse_step,
                                    const LaneNumber& averaging, const ReactionRows& rows) {
  reaction_rows<true>(blocks, count, inverse_step, averaging, rows);
}

}  // namespace

void lane_contact(LaneBelt& b, const LaneNumber* speeds, const LaneNumber* changes) {
  const ContactRows rows{b.x.data(),
                         b.y.data(),
                         b.vx.data(),
                         b.vy.data(),
                         b.dvx.data(),
                         b.dvy.data(),
                         b.anchor.data(),
                         b.fx.data(),
                         b.fy.data(),
                         b.normal_x.data(),
                         b.normal_y.data(),
                         b.distance.data(),
                         b.normal.data(),
                         b.tangential.data(),
                         b.normal_tangent.data(),
                         b.tangential_tangent.data(),
                         b.lag.data(),
                         b.tangential_now.data(),
                         b.creep.data()};
  (b.peaks ? contact_peaks : contact_plain)(b.blocks.data(), static_cast<int>(b.blocks.size()), b.step, b.law,
                                            speeds->of, changes->of, rows);
}

void lane_reactions(LaneBelt& b, LaneLoads* loads) {
  LaneNumber averaging;
  for (int k = 0; k < lanes; ++k) averaging[k] = 0.25 * b.step * b.law.stiffness[k];
  const ReactionRows rows{b.dvx.data(),
                          b.dvy.data(),
                          b.normal_x.data(),
                          b.normal_y.data(),
                          b.distance.data(),
                          b.normal_tangent.data(),
                          b.tangential_tangent.data(),
                          b.lag.data(),
                          b.tangential_now.data(),
                          b.creep.data(),
                          b.normal.data(),
                          b.tangential.data(),
                          b.normal_last.data(),
                          b.normal_before.data(),
                          b.normal_peak.data(),
                          b.tangential_peak.data(),
                          loads->x.of};
  (b.peaks ? reaction_peaks : reaction_plain)(b.blocks.data(), static_cast<int>(b.blocks.size()), 1 / b.step, averaging,
                                              rows);
}

}  // namespace beltlife

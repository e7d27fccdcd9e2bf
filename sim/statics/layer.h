// Owns the boundary layer of a pass over one pulley: how a belt with bending damping lands on and leaves soft contact.
#pragma once

namespace beltlife {

/// A pass over one pulley in the units of its layer d = (CI v/T')^(1/3): lengths along the belt d, offsets d^2/R,
/// curvature 1/R, power CI v^2/(d R^2), which is the loss on a pulley that holds the belt rigidly.
struct PassLayer {
  double offset_in = 0.5;    ///< how far outside the pulley's surface the line of the entering span passes
  double offset_out = -0.5;  ///< likewise of the leaving span; the difference is the whole loss
  double loss() const { return offset_in - offset_out; }
  double excess = 1.0 / 6;  ///< belt length beyond tangents and arc, in d^3/R^2
  double peak = 1;          ///< largest contact pressure, of T'/R
  bool converged = true;    ///< false: the numbers are those of the rigid pulley
};

/// `softness` T'/(k_p w d^2), w the belt's width; `arc` R x wrap / d. Contact damping is left out.
PassLayer pass_layer(double softness, double arc);

}  // namespace beltlife

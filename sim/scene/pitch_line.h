// Owns the way from effective to pitch values (ISO 9981): pulley diameters and belt length along the belt's cord.
#pragma once

#include <algorithm>
#include <numbers>
#include <optional>

#include "sim/scene/scene.h"

namespace beltlife {

/// Diameter (mm) on which the cord runs: as given, or effective diameter + 2 b_e. For a scene that has been checked.
inline double pitch_diameter_mm(const SceneSpec& scene, const PulleySpec& pulley) {
  if (pulley.pitch_diameter_mm) return *pulley.pitch_diameter_mm;
  return pulley.effective_diameter_mm.value_or(0) + 2 * scene.belt.effective_line_differential_mm.value_or(0);
}

/// Belt length (mm) along the cord without tension, where the scene gives one: unstretched, or effective length
/// + 2 pi b_e less the stretch under the tension with which the effective length was measured.
inline std::optional<double> unstretched_length_mm(const BeltSpec& belt) {
  if (belt.unstretched_length_mm) return belt.unstretched_length_mm;
  if (!belt.effective_length_mm) return {};
  const double pitch =
      *belt.effective_length_mm + 2 * std::numbers::pi * belt.effective_line_differential_mm.value_or(0);
  return pitch / (1 + belt.measuring_tension_n.value_or(0) / belt.axial_stiffness_n);
}

/// Whether any pulley is stated by its effective diameter, so that tables show both.
inline bool has_effective_diameters(const SceneSpec& scene) {
  return std::any_of(scene.pulley.begin(), scene.pulley.end(),
                     [](const PulleySpec& p) { return p.effective_diameter_mm.has_value(); });
}

}  // namespace beltlife

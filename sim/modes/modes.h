// Owns the natural frequencies of a drive: rotational modes with their shapes, and the free spans as travelling
// strings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/modes/linear_options.h"
#include "sim/modes/operating_point.h"

namespace beltlife {

/// Who moves: shares of a mode's kinetic energy, which sum to 1.
struct EnergyShares {
  std::vector<double> body;  ///< per body
  double arm = 0;
  double belt = 0;
};

/// One rotational mode without damping. The shape is scaled so that its largest entry is 1, and in one measure for all:
/// the belt travel to which a turn amounts. A body's turn in rad is shape x speed_ratio (rad/m) x its running sense,
/// the arm's turn is shape / (distance from pivot to pulley centre).
struct Mode {
  double frequency_hz = 0;
  std::vector<double> body_shape;  ///< per body; 0 for one that does not vibrate
  double arm_shape = 0;            ///< of the tensioner pulley's centre, positive counterclockwise
  EnergyShares energy;
};

/// A vibration of the drive with its viscous dampers: a pair of complex eigenvalues. Dampers so strong that they all
/// but clutch two bodies together make these other modes than the undamped ones, so that they are counted on their own.
struct DampedMode {
  double frequency_hz = 0;   ///< of the decaying vibration, Im / 2 pi
  double damping_ratio = 0;  ///< -Re / modulus
  EnergyShares energy;
};

struct ArmModes {
  ArmState arm = ArmState::none;
  std::vector<Mode> modes;         ///< lowest first; a mode at 0 Hz turns freely
  std::vector<DampedMode> damped;  ///< lowest first; without those damped so much (ratio 0.71) that they have no peak
};

/// First two transverse frequencies of a free span: a string with fixed ends through which the belt travels,
/// f_n = n (c^2 - v^2) / (2 L c).
struct SpanModes {
  std::string name;
  double length = 0;                     ///< L, m
  double tension = 0;                    ///< N, centrifugal part included
  double wave_speed = 0;                 ///< c = sqrt(tension / mass per stretched length), m/s
  std::array<double, 2> frequency_hz{};  ///< 0 where the span is slack or the belt outruns its own waves
};

/// Everything at one operating point.
struct Modes {
  RangeSpec range;
  OperatingPoint loop;         ///< about which the drive is linearised
  std::vector<ArmModes> arms;  ///< one entry a state of the tensioner arm
  std::vector<SpanModes> spans;
};

struct ModesOptions {
  double highest_hz = 1000;  ///< rotational modes above are left out
  int damped_basis = 40;     ///< undamped modes, lowest first, that the damped ones are made of
  LinearOptions linear;
};

/// Nothing (no arms, no spans) for a scene without pulleys. The model is of the range's condition; else
/// std::logic_error is thrown.
Modes solve_modes(const Model& model, const RangeSpec& range, const ModesOptions& options = {});

/// The bodies, arm or belt that hold most of a mode's kinetic energy, e.g. "turbine 62 %, arm 20 %".
std::string describe(const Model& model, const EnergyShares& energy);

}  // namespace beltlife

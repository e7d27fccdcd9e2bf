// Owns the spelling, unit and description of every name in an HDF5 result file; README.md documents them.
#pragma once

#include <array>
#include <string_view>

#include "sim/record.h"

namespace beltlife::names {

/// A dataset with the attributes that it carries.
struct Dataset {
  std::string_view name;
  std::string_view unit;
  std::string_view about;
};

inline constexpr int format = 1;

// Groups. RUN counts from 0; RANGE and PULLEY are the scene's names, CHANNEL a recorded channel's.
inline constexpr std::string_view runs = "/runs";      // /runs/RUN
inline constexpr std::string_view ranges = "/ranges";  // /ranges/RANGE
inline constexpr std::string_view life = "/life";      // /life/RANGE
inline constexpr std::string_view statics = "/statics";
inline constexpr std::string_view take_up = "/statics/take_up";
inline constexpr std::string_view statics_ranges = "/statics/ranges";  // /statics/ranges/RANGE
inline constexpr std::string_view spans = "/spans";                    // below one of them, like the following
inline constexpr std::string_view pulleys = "/pulleys";
inline constexpr std::string_view modes = "/modes";
inline constexpr std::string_view modes_ranges = "/modes/ranges";  // /modes/ranges/RANGE
inline constexpr std::string_view damped = "/damped";              // below one of them, like the following
inline constexpr std::string_view undamped = "/undamped";
inline constexpr std::string_view transverse_modes = "/transverse";
inline constexpr std::string_view energy_shares = "/energy_share";  // below damped and undamped; one BODY a dataset
inline constexpr std::string_view shapes = "/shape";                // below undamped; one BODY a dataset
inline constexpr std::string_view map = "/modes/map";               // one CURVE a dataset
inline constexpr std::string_view crossings = "/modes/crossings";
inline constexpr std::string_view trace = "/trace";    // below a run
inline constexpr std::string_view passes = "/passes";  // below a range, like the following
inline constexpr std::string_view energy = "/energy";
inline constexpr std::string_view element = "/element";
inline constexpr std::string_view spectra = "/spectra";
inline constexpr std::string_view loop = "/loop";
inline constexpr std::string_view frames = "/frames";
inline constexpr std::string_view sweep = "/sweep";
inline constexpr std::string_view sweep_amplitude = "/amplitude";  // below it, one CHANNEL a dataset
inline constexpr std::string_view sweep_modes = "/map";            // likewise, one CURVE a dataset
inline constexpr std::string_view sweep_crossings = "/crossings";
inline constexpr std::string_view event = "/event";

// Attributes.
inline constexpr std::string_view root_format = "format";
inline constexpr std::string_view root_program = "program";
inline constexpr std::string_view root_version = "version";
inline constexpr std::string_view root_command_line = "command_line";
inline constexpr std::string_view root_scene_path = "scene_path";
inline constexpr std::string_view root_scene_text = "scene_text";
inline constexpr std::string_view root_compiler = "compiler";
inline constexpr std::string_view root_revision = "revision";
inline constexpr std::string_view root_scheme = "scheme";
inline constexpr std::string_view root_elements = "elements";
inline constexpr std::string_view run_state = "state";
inline constexpr std::string_view run_failed_at_s = "failed_at_s";
inline constexpr std::string_view run_failed_element = "failed_element";
inline constexpr std::string_view run_where = "where";
inline constexpr std::string_view run_cause = "cause";
inline constexpr std::string_view run_advice = "advice";
inline constexpr std::string_view run_simulated_s = "simulated_s";
inline constexpr std::string_view run_wall_s = "wall_s";
inline constexpr std::string_view run_step_s = "step_s";
inline constexpr std::string_view run_steps = "steps";
inline constexpr std::string_view run_settling_change = "settling_change";
inline constexpr std::string_view run_friction_overdamped_s = "friction_overdamped_s";
inline constexpr std::string_view name = "name";
inline constexpr std::string_view range_run = "run";
inline constexpr std::string_view range_crank_rpm = "crank_rpm";
inline constexpr std::string_view range_begin_s = "begin_s";
inline constexpr std::string_view range_end_s = "end_s";
inline constexpr std::string_view range_complete = "complete";
inline constexpr std::string_view range_first_sample = "first_sample";
inline constexpr std::string_view range_last_sample = "last_sample";
inline constexpr std::string_view range_pulleys = "pulleys";
inline constexpr std::string_view duty_share = "duty_share";
inline constexpr std::string_view passes_unsampled = "unsampled";
inline constexpr std::string_view energy_relative_residual = "relative_residual";
inline constexpr std::string_view life_h = "life_h";
inline constexpr std::string_view life_log10_life_h = "log10_life_h";
inline constexpr std::string_view life_error = "error";
inline constexpr std::string_view life_cycles = "cycles";
inline constexpr std::string_view damage_share = "damage_share";

inline constexpr std::string_view estimated_life_h = "estimated_life_h";
inline constexpr std::string_view estimated_log10_life_h = "estimated_log10_life_h";
inline constexpr std::string_view estimated_error = "estimated_error";
inline constexpr std::string_view error = "error";
inline constexpr std::string_view belt_speed_m_s = "belt_speed_m_s";
inline constexpr std::string_view centrifugal_n = "centrifugal_n";
inline constexpr std::string_view driver_power_w = "driver_power_w";
inline constexpr std::string_view torque_table_power_w = "torque_table_power_w";
inline constexpr std::string_view loss_w = "loss_w";
inline constexpr std::string_view arm_angle_rad = "arm_angle_rad";
inline constexpr std::string_view arm_angle_low_rad = "arm_angle_low_rad";
inline constexpr std::string_view arm_angle_high_rad = "arm_angle_high_rad";
inline constexpr std::string_view balanced = "balanced";
inline constexpr std::string_view slack = "slack";
inline constexpr std::string_view instead = "instead";
inline constexpr std::string_view remarks = "remarks";
inline constexpr std::string_view curve_arm = "arm";
inline constexpr std::string_view curve_damping_ratio = "damping_ratio";

inline constexpr std::string_view sweep_from = "from_rpm";
inline constexpr std::string_view sweep_to = "to_rpm";
inline constexpr std::string_view sweep_seconds = "seconds";
inline constexpr std::string_view sweep_window = "window_revolutions";

// Datasets.
inline constexpr Dataset time{"time_s", "s", "time since the start of the run"};

inline constexpr Dataset normal_resolved{
    "normal_resolved_n", "N",
    "largest normal force on one element of each pass, of all steps (explicit: every 5e-6 s)"};
inline constexpr Dataset tangential_resolved{
    "tangential_resolved_n", "N",
    "largest friction force (absolute) of each pass, of all steps (explicit: every 5e-6 s)"};
inline constexpr Dataset normal_sampled{"normal_sampled_n", "N",
                                        "largest normal force of each pass that a sample caught, among the samples"};
inline constexpr Dataset tangential_sampled{"tangential_sampled_n", "N",
                                            "largest friction force (absolute) of each pass that a sample caught"};

/// What each mechanism of the energy account stands for, in the order of `Energy`; the names are `energy_names`.
inline constexpr std::array<std::string_view, energy_names.size()> energy_about{
    "work of whatever imposes the driven body's speed, positive into the drive",
    "work of the torque tables, positive into the drive",
    "dissipated by axial damping of the belt",
    "dissipated by bending damping of the belt",
    "dissipated by normal contact",
    "dissipated by friction between belt and pulleys",
    "dissipated by torsional dampers",
    "dissipated by gear meshes",
    "dissipated by the tensioner's viscous damping",
    "dissipated by the tensioner's dry friction",
    "change of kinetic and elastic energy over the window"};
inline constexpr Dataset residual{"residual", "J", "work - losses - change of stored energy: what is unaccounted for"};
inline constexpr Dataset throughput{"throughput", "J", "sum of the positive works and of what the stores gave up"};

inline constexpr Dataset element_normal{"normal_n", "N", "normal force on the element"};
inline constexpr Dataset element_tangential{"tangential_n", "N", "friction force on the element"};
inline constexpr Dataset element_tension{"tension_n", "N", "belt tension in the element"};
inline constexpr Dataset element_pulley{"pulley", "", "pulley in contact, by position in `pulleys`; -1 on a span"};

inline constexpr Dataset loop_x{"x_m", "m", "position of each belt node"};
inline constexpr Dataset loop_y{"y_m", "m", "position of each belt node"};
inline constexpr Dataset loop_tension{"tension_n", "N", "tension of the element that begins at the node"};

inline constexpr Dataset frame_x{"x_m", "m", "position of each belt node, to 2^-20 m; a row a frame, a column a node"};
inline constexpr Dataset frame_y{"y_m", "m", "position of each belt node, likewise"};
inline constexpr Dataset frame_tension{"tension_n", "N", "tension of the element that begins at the node, to 2^-6 N"};
inline constexpr Dataset frame_angle{"pulley_angle_rad", "rad",
                                     "turn of each pulley since the start of the run, counterclockwise, to 2^-16 rad"};
inline constexpr Dataset frame_centre_x{"pulley_x_m", "m", "centre of each pulley; the tensioner's moves"};
inline constexpr Dataset frame_centre_y{"pulley_y_m", "m", "centre of each pulley; the tensioner's moves"};

inline constexpr Dataset frequency{"frequency_hz", "Hz", "frequency of each bin of the amplitude spectra beside it"};

inline constexpr Dataset life_pulley{"pulley", "", "name of the pulley to which each row of the other columns belongs"};
inline constexpr Dataset axial_mean{"axial_mean_mpa", "MPa", "mean axial stress (thesis 5.3)"};
inline constexpr Dataset axial_alternating{"axial_alternating_mpa", "MPa", "alternating axial stress (thesis 5.4)"};
inline constexpr Dataset bending{"bending_mpa", "MPa", "bending stress at the rib tip, + in tension (thesis 5.5)"};
inline constexpr Dataset transverse{"transverse_mpa", "MPa", "transverse stress, - in compression (thesis 5.11)"};
inline constexpr Dataset shear{"shear_mpa", "MPa", "shear stress on the flanks (thesis 5.16)"};
inline constexpr Dataset sigma_m{"sigma_m_mpa", "MPa", "equivalent mean stress (thesis 5.19)"};
inline constexpr Dataset sigma_a{"sigma_a_mpa", "MPa", "equivalent alternating stress (thesis 5.20)"};
inline constexpr Dataset cycles{"cycles", "", "passes to failure of this pulley alone (thesis 6.4)"};
inline constexpr Dataset pulley_damage{"damage_share", "", "share of the range's damage done by this pulley"};

inline constexpr Dataset take_up_position{"position", "", "which position of the arm each row is about"};
inline constexpr Dataset take_up_arm{"arm_angle_rad", "rad",
                                     "angle of the arm, counterclockwise from where the scene places it"};
inline constexpr Dataset take_up_path{"path_length_m", "m", "belt path along the pulleys' contact radii"};
inline constexpr Dataset take_up_unstretched{"unstretched_length_m", "m", "belt that is at rest with the arm there"};
inline constexpr Dataset take_up_tension{"tension_n", "N", "with which the spring balances the arm there"};
inline constexpr Dataset take_up_ended_by{"ended_by", "", "what ends the arm's reach here; empty within it"};

inline constexpr Dataset span_of_row{"span", "", "name of the span to which each row of the other columns belongs"};
inline constexpr Dataset span_tension{"tension_n", "N", "tension with its centrifugal part, the arm free of friction"};
inline constexpr Dataset span_tension_low{"tension_low_n", "N", "lowest between the arm's two friction limits"};
inline constexpr Dataset span_tension_high{"tension_high_n", "N", "highest between the arm's two friction limits"};

inline constexpr Dataset pulley_speed{"speed_rpm", "r/min", "speed in the running sense, creep included"};
inline constexpr Dataset pulley_torque{"torque_n_m", "N m", "of the belt on the pulley, in the running sense"};
inline constexpr Dataset pulley_wrap{"wrap_deg", "deg", "geometric wrap"};
inline constexpr Dataset hub_load{"hub_load_n", "N", "force of the belt on the pulley, magnitude"};
inline constexpr Dataset hub_load_low{"hub_load_low_n", "N", "lowest between the arm's two friction limits"};
inline constexpr Dataset hub_load_high{"hub_load_high_n", "N", "highest between the arm's two friction limits"};
inline constexpr Dataset hub_direction{"hub_direction_deg", "deg", "of the hub load, counterclockwise from x"};
inline constexpr Dataset slip_safety{
    "slip_safety", "", "friction times wrap over what the torque takes; below 1 the belt slips; NaN without torque"};
inline constexpr Dataset bending_loss{"bending_loss_w", "W", "bending loss, the belt sinking into its contact"};
inline constexpr Dataset rigid_bending_loss{"rigid_bending_loss_w", "W", "bending loss in closed form, rigid contact"};
inline constexpr Dataset creep_loss{"creep_loss_w", "W", "loss by creep, where the tension changes"};
inline constexpr Dataset estimated_sigma_m{"estimated_sigma_m_mpa", "MPa",
                                           "equivalent mean stress (thesis 5.19) estimated from steady tensions"};
inline constexpr Dataset estimated_sigma_a{"estimated_sigma_a_mpa", "MPa",
                                           "equivalent alternating stress (thesis 5.20), likewise"};
inline constexpr Dataset estimated_cycles{"estimated_cycles", "", "passes to failure of this pulley alone, likewise"};
inline constexpr Dataset estimated_damage{"estimated_damage_share", "", "share of the range's damage, likewise"};

inline constexpr Dataset mode_arm{"arm", "", "tensioner arm of each row: free, stuck by friction, locked, or none"};
inline constexpr Dataset mode_frequency{"frequency_hz", "Hz", "natural frequency"};
inline constexpr Dataset mode_damping{"damping_ratio", "", "of critical damping, by the viscous dampers"};
inline constexpr Dataset mode_moving{"moving", "", "who holds most of the kinetic energy, in words"};
inline constexpr Dataset mode_arm_energy{"arm_energy_share", "", "share of the kinetic energy in the tensioner arm"};
inline constexpr Dataset mode_belt_energy{"belt_energy_share", "", "share of the kinetic energy in the belt"};
inline constexpr Dataset mode_arm_shape{"arm_shape", "", "travel of the tensioner pulley's centre, largest entry is 1"};
inline constexpr Dataset body_energy{"BODY", "", "share of the kinetic energy in this body, one entry a mode"};
inline constexpr Dataset body_shape{"BODY", "",
                                    "turn of this body as belt travel, one entry a mode; a mode's largest entry is 1"};
inline constexpr Dataset span_length{"length_m", "m", "free length of the span"};
inline constexpr Dataset span_tension_estimate{"tension_n", "N",
                                               "tension at the operating point, centrifugal part included"};
inline constexpr Dataset span_wave_speed{"wave_speed_m_s", "m/s", "speed of transverse waves on the belt"};
inline constexpr Dataset span_first{"first_hz", "Hz", "first transverse natural frequency, the belt travelling"};
inline constexpr Dataset span_second{"second_hz", "Hz", "second transverse natural frequency"};

inline constexpr Dataset map_speed{"crank_rpm", "r/min", "speed of the driven body to which the curves belong"};
inline constexpr Dataset map_curve{"CURVE", "Hz", "natural frequency at each crank_rpm"};
inline constexpr Dataset crossing_order{"order", "", "cycles per revolution of the driven body"};
inline constexpr Dataset crossing_speed{"crank_rpm", "r/min", "where the order meets the natural frequency"};
inline constexpr Dataset crossing_mode{"mode", "", "name of the curve in the map"};
inline constexpr Dataset crossing_near{"near", "", "range within 5 % of the speed; empty: none"};

inline constexpr Dataset sweep_speed{"crank_rpm", "r/min",
                                     "mean speed of the driven body in the middle of each window"};
inline constexpr Dataset sweep_order{"order", "", "cycles per revolution of the driven body"};
inline constexpr std::string_view sweep_amplitude_about =
    "amplitude of each order (row) at each place of the sweep (column); NaN above half the sampling rate";

// Study files (study_file.h). PARAMETER and QUANTITY are the study's names, what is below /answer the driver's.
inline constexpr std::string_view study = "study";  // value of root_kind; a result file of a run has no such attribute
inline constexpr std::string_view root_kind = "kind";
inline constexpr std::string_view root_driver = "driver";
inline constexpr std::string_view root_study_path = "study_path";
inline constexpr std::string_view root_study_text = "study_text";
inline constexpr std::string_view root_lanes = "lanes";
inline constexpr std::string_view points = "/points";
inline constexpr std::string_view parameters = "/points/parameters";  // /points/parameters/PARAMETER
inline constexpr std::string_view quantities = "/points/quantities";  // /points/quantities/QUANTITY
inline constexpr std::string_view answer = "/answer";
inline constexpr Dataset point_number{"number", "", "from 0, in the order in which the driver asked for the points"};
inline constexpr Dataset point_state{"state", "", "ok, infeasible, diverged, timed_out or failed"};
inline constexpr Dataset point_reason{"reason", "", "why a point is not ok, in words; empty if it is"};
inline constexpr Dataset point_processor_s{"processor_s", "s", "processor time that the point took"};

// Marks of JSON in groups (json_group.h).
inline constexpr std::string_view json_table = "table";
inline constexpr std::string_view json_list = "list";
inline constexpr std::string_view json_text = "json";

}  // namespace beltlife::names

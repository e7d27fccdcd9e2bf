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
inline constexpr std::string_view trace = "/trace";    // below a run
inline constexpr std::string_view passes = "/passes";  // below a range, like the following
inline constexpr std::string_view energy = "/energy";
inline constexpr std::string_view element = "/element";
inline constexpr std::string_view spectra = "/spectra";
inline constexpr std::string_view loop = "/loop";

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

// Datasets.
inline constexpr Dataset time{"time_s", "s", "time since the start of the run"};

inline constexpr Dataset normal_resolved{
    "normal_resolved_n", "N", "largest normal force on one element of each pass, among observations 5e-6 s apart"};
inline constexpr Dataset tangential_resolved{
    "tangential_resolved_n", "N", "largest friction force (absolute) of each pass, among observations 5e-6 s apart"};
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

}  // namespace beltlife::names

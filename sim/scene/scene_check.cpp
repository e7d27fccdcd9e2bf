// Owns the checks of a scene as a whole: names, references, tables, belt length, duty cycle.
#include "sim/scene/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/pulley_place.h"
#include "sim/scene/spec_path.h"

namespace beltlife {
namespace {

bool is_plain_name(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !name.empty() && name.find_first_not_of(letters) == name.npos;
}

/// The names that a reference may use. `known` is false while a name could not be read: then nothing is missing for
/// sure.
struct Names {
  std::vector<std::string> names;
  std::string kind;  ///< in words
  bool known = true;

  bool has(std::string_view name) const { return std::find(names.begin(), names.end(), name) != names.end(); }
};

class SceneCheck {
 public:
  SceneCheck(const SceneSpec& scene, ReadLog& log) : scene_(scene), log_(log) {}

  void run() {
    check_limits();
    check_names();
    check_diameters();
    check_bodies();
    check_connections();
    check_tables();
    check_belt();
    check_driver_and_ranges();
    check_event();
  }

 private:
  void complain(const SpecPath& path, std::string what, std::string allowed = {}) {
    if (log_.is_faulty(path.place)) return;
    log_.problems.push_back({log_.file, log_.line(path.place), path.shown, std::move(what), std::move(allowed)});
  }

  /// The fields' own limits once more: a scene made in code has not been through the reader.
  void check_limits() {
    SceneSpec copy = scene_;  // visit() is not const
    for_each_leaf(copy, [&]<class T>(const SpecPath& path, T& value, const Rule& rule) {
      const auto check = [&](double number, const SpecPath& where) {
        Faults faults;
        check_number(number, rule, faults);
        for (const Fault& fault : faults) complain(where, fault.what, fault.allowed);
      };
      if constexpr (std::same_as<T, double> || std::same_as<T, int>) {
        check(value, path);
      } else if constexpr (std::same_as<T, std::optional<double>>) {
        if (value) check(*value, path);
      } else if constexpr (std::same_as<T, std::vector<double>>) {
        for (std::size_t i = 0; i < value.size(); ++i) check(value[i], {path.element(i).shown, path.place});
      } else if constexpr (std::same_as<T, std::optional<std::vector<double>>>) {
        for (std::size_t i = 0; value && i < value->size(); ++i)
          check((*value)[i], {path.element(i).shown, path.place});
      }
    });
  }

  /// Adds the names of one list and complains of names that paths could not spell or that are taken.
  template <class Spec>
  void collect(const std::vector<Spec>& list, const SpecPath& list_path, Names& names) {
    if (log_.is_faulty(list_path.place)) names.known = false;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const SpecPath path = list_path.element(i, list[i].name).child("name");
      if (log_.is_faulty(path.place)) {
        names.known = false;
        continue;
      }
      if (!is_plain_name(list[i].name)) {
        complain(path, fmt::format("'{}' cannot be used in paths", list[i].name), "letters, digits, _ and -");
      } else if (names.has(list[i].name)) {
        complain(path, fmt::format("there is another {} of this name", names.kind), "a unique name");
      }
      names.names.push_back(list[i].name);
    }
  }

  void check_names() {
    collect(scene_.pulley, {"pulley", "pulley"}, pulleys_);
    bodies_ = pulleys_;
    bodies_.kind = "pulley or body";
    collect(scene_.body, {"body", "body"}, bodies_);
    collect(scene_.torsional_spring, {"torsional_spring", "torsional_spring"}, springs_);
    Names gears{.names = {}, .kind = "gear pair"};
    collect(scene_.gear_pair, {"gear_pair", "gear_pair"}, gears);
    Names torques{.names = {}, .kind = "torque"};
    collect(scene_.torque, {"torque", "torque"}, torques);
    Names ranges{.names = {}, .kind = "range"};
    collect(scene_.range, {"range", "range"}, ranges);
    Names harmonics{.names = {}, .kind = "harmonic"};
    if (scene_.driver) collect(scene_.driver->harmonic, {"driver.harmonic", "driver.harmonic"}, harmonics);
  }

  void refer(const SpecPath& path, const std::string& name, const Names& names) {
    if (!names.known || names.has(name)) return;
    complain(path, fmt::format("there is no {} '{}'{}", names.kind, name, did_you_mean(name, names.names)),
             names.names.empty() ? fmt::format("the name of a {}, of which there are none", names.kind)
                                 : joined(names.names));
  }

  const PulleySpec* pulley(std::string_view name) const {
    for (const PulleySpec& pulley : scene_.pulley) {
      if (pulley.name == name) return &pulley;
    }
    return nullptr;
  }

  void check_diameters() {
    const SpecPath belt = SpecPath{}.child("belt");
    const SpecPath line = belt.child("effective_line_differential_mm");
    std::string user;  // the first field that needs it
    if (scene_.belt.effective_length_mm) user = belt.child("effective_length_mm").shown;
    for (std::size_t i = 0; i < scene_.pulley.size(); ++i) {
      const PulleySpec& p = scene_.pulley[i];
      const SpecPath path = SpecPath{}.child("pulley").element(i, p.name);
      const SpecPath pitch = path.child("pitch_diameter_mm"), effective = path.child("effective_diameter_mm");
      if (p.effective_diameter_mm && user.empty()) user = effective.shown;
      if (log_.is_faulty(pitch.place) || log_.is_faulty(effective.place)) continue;
      if (!p.pitch_diameter_mm && !p.effective_diameter_mm) {
        complain(pitch, "missing key", "exactly one of pitch_diameter_mm, effective_diameter_mm");
      } else if (p.pitch_diameter_mm && p.effective_diameter_mm) {
        complain(effective, "pitch_diameter_mm is given too", "exactly one of the two");
      } else if (p.effective_diameter_mm && p.side == Side::back && !log_.is_faulty(path.child("side").place)) {
        complain(effective, "a pulley on the belt's back has no effective diameter",
                 "pitch_diameter_mm: the outside diameter plus twice the distance from the back to the cord");
      }
    }
    if (!user.empty() && !scene_.belt.effective_line_differential_mm) {
      complain(line, fmt::format("missing key: {} is an effective value", user),
               "for the PK section 2, or pitch values");
    }
  }

  void check_bodies() {
    if (const auto& tensioner = scene_.tensioner) {
      const SpecPath path = SpecPath{}.child("tensioner");
      refer(path.child("pulley"), tensioner->pulley, pulleys_);
      const PulleySpec* rider = pulley(tensioner->pulley);
      const SpecPath angle = path.child("arm_angle_deg"), reach = path.child("arm_length_mm");
      if (tensioner->arm_angle_deg.has_value() != tensioner->arm_length_mm.has_value() &&
          !log_.is_faulty(angle.place) && !log_.is_faulty(reach.place)) {
        complain(tensioner->arm_angle_deg ? reach : angle, "missing key",
                 "both of arm_angle_deg, arm_length_mm, or neither");
      }
      const PulleyPlace place = rider ? pulley_place(scene_, *rider) : PulleyPlace{};
      if (rider && place.x_mm == tensioner->pivot_x_mm && place.y_mm == tensioner->pivot_y_mm) {
        complain(path.child("pivot_x_mm"), "the pivot is the centre of the arm's pulley", "an arm that has a length");
      }
      const bool inert = tensioner->inertia_kg_m2 > 0 || (rider && rider->mass_kg > 0) ||
                         (tensioner->mass_kg > 0 && tensioner->cg_distance_mm != 0);
      if (rider && !inert) {
        complain(path.child("inertia_kg_m2"), "the arm has no inertia about its pivot",
                 "inertia, or mass of arm or pulley");
      }
    }
    if (const auto& output = scene_.output) {
      const SpecPath path = SpecPath{}.child("output");
      const bool any_body = output->spring || log_.is_faulty(path.child("spring").place);
      refer(path.child("body"), output->body, any_body ? bodies_ : pulleys_);
      if (output->spring) refer(path.child("spring"), *output->spring, springs_);
    }
  }

  void check_ends(const SpecPath& path, std::string_view from_key, const std::string& from, std::string_view to_key,
                  const std::string& to) {
    refer(path.child(from_key), from, bodies_);
    refer(path.child(to_key), to, bodies_);
    if (from == to && !log_.is_faulty(path.child(from_key).place)) {
      complain(path.child(to_key), fmt::format("'{}' is at both ends", to), "two different pulleys or bodies");
    }
  }

  void check_connections() {
    for (std::size_t i = 0; i < scene_.torsional_spring.size(); ++i) {
      const auto& spring = scene_.torsional_spring[i];
      const SpecPath path = SpecPath{}.child("torsional_spring").element(i, spring.name);
      check_ends(path, "from", spring.from, "to", spring.to);
    }
    for (std::size_t i = 0; i < scene_.gear_pair.size(); ++i) {
      const auto& pair = scene_.gear_pair[i];
      const SpecPath path = SpecPath{}.child("gear_pair").element(i, pair.name);
      check_ends(path, "pinion", pair.pinion, "gear", pair.gear);
    }
  }

  void check_table(const SpecPath& path, const std::vector<double>& speeds, std::string_view values_key,
                   std::size_t values) {
    const SpecPath speeds_path = path.child("speeds_rpm");
    if (log_.is_faulty(speeds_path.place)) return;
    if (speeds.empty()) complain(speeds_path, "has no entries", "at least one");
    if (speeds.size() != values) {
      complain(path.child(values_key), fmt::format("has {} entries, speeds_rpm has {}", values, speeds.size()),
               "lists of one length");
    }
    for (std::size_t i = 1; i < speeds.size(); ++i) {
      if (speeds[i] > speeds[i - 1]) continue;
      complain({speeds_path.element(i).shown, speeds_path.place},
               fmt::format("{} does not exceed the entry before, {}", speeds[i], speeds[i - 1]), "increasing speeds");
    }
  }

  void check_tables() {
    for (std::size_t i = 0; i < scene_.torque.size(); ++i) {
      const auto& torque = scene_.torque[i];
      const SpecPath path = SpecPath{}.child("torque").element(i, torque.name);
      refer(path.child("body"), torque.body, bodies_);
      if (torque.referred_to) refer(path.child("referred_to"), *torque.referred_to, bodies_);
      check_table(path, torque.speeds_rpm, "torques_n_m", torque.torques_n_m.size());
    }
    if (!scene_.driver) return;
    for (std::size_t i = 0; i < scene_.driver->harmonic.size(); ++i) {
      const auto& harmonic = scene_.driver->harmonic[i];
      const SpecPath path = SpecPath{}.child("driver").child("harmonic").element(i, harmonic.name);
      check_table(path, harmonic.speeds_rpm, "amplitudes_rpm", harmonic.amplitudes_rpm.size());
    }
  }

  /// The linearly implicit scheme cuts the belt into eight equal arcs.
  void check_lanes() {
    constexpr int arcs = 8, least = 48;
    const int n = scene_.belt.elements;
    if (scene_.solver.scheme != Scheme::linearly_implicit || (n % arcs == 0 && n >= least)) return;
    const int below = std::max(n / arcs * arcs, least), above = std::max((n / arcs + 1) * arcs, least);
    complain(SpecPath{}.child("belt").child("elements"),
             fmt::format("the scheme linearly_implicit takes a multiple of {}, at least {}, not {}", arcs, least, n),
             below == above ? fmt::format("{}, or another solver.scheme", below)
                            : fmt::format("{} or {}, or another solver.scheme", below, above));
  }

  void check_belt() {
    check_lanes();
    const SpecPath belt = SpecPath{}.child("belt");
    const SpecPath length = belt.child("unstretched_length_mm");
    const SpecPath effective = belt.child("effective_length_mm");
    const SpecPath pretension = belt.child("pretension_n");
    const SpecPath balanced = belt.child("balanced_as_placed");
    const bool is_balanced = scene_.belt.balanced_as_placed.value_or(false);  // false says no more than absence
    const bool readable = !log_.is_faulty(length.place) && !log_.is_faulty(effective.place) &&
                          !log_.is_faulty(pretension.place) && !log_.is_faulty(balanced.place);
    const bool has_length = scene_.belt.unstretched_length_mm || scene_.belt.effective_length_mm;
    const int given = scene_.belt.unstretched_length_mm.has_value() + scene_.belt.effective_length_mm.has_value() +
                      scene_.belt.pretension_n.has_value() + is_balanced;
    const bool torque_is_open = scene_.tensioner && !scene_.tensioner->spring_torque_n_m;
    if (torque_is_open || log_.is_faulty("tensioner") || log_.is_faulty("tensioner.spring_torque_n_m")) {
      if (readable && torque_is_open) check_open_torque();
    } else {
      if (readable && given != 1) {
        complain(length, fmt::format("{} of four ways to state the belt's length are given", given),
                 "exactly one of unstretched_length_mm, effective_length_mm, pretension_n, balanced_as_placed = true" +
                     std::string(scene_.tensioner && scene_.belt.pretension_n && given == 2
                                     ? "; or both, without tensioner.spring_torque_n_m, which is then solved for"
                                     : ""));
      }
      if (scene_.belt.length_catalogue_mm) {
        complain(belt.child("length_catalogue_mm"), "there is no spring torque to solve for",
                 "a [tensioner] without spring_torque_n_m, and pretension_n");
      }
    }
    if (scene_.belt.measuring_tension_n && readable && !scene_.belt.effective_length_mm) {
      complain(belt.child("measuring_tension_n"), "there is no effective length that was measured with it",
               "effective_length_mm beside it");
    }
    if (is_balanced && !scene_.tensioner && !log_.is_faulty("tensioner")) {
      complain(balanced, "needs a tensioner, and there is none", "a [tensioner], or the length or tension of the belt");
    }
    const SpecPath pulleys = SpecPath{}.child("pulley");
    if (!scene_.ring && !log_.is_faulty("ring") && scene_.pulley.size() < 2) {
      complain(pulleys, fmt::format("{} pulleys carry no belt", scene_.pulley.size()), "at least 2, or a [ring]");
    }
    if (!scene_.ring) return;
    if (!scene_.pulley.empty()) complain(pulleys, "a scene with [ring] has no pulleys", "no [[pulley]]");
    if (readable && given == 1 && !has_length) {
      complain(is_balanced ? balanced : pretension, "a [ring] has no pulleys to fit", "unstretched_length_mm");
    }
  }

  /// Without the spring's torque the pretension is given, and one statement of where the arm rests with it.
  void check_open_torque() {
    if (log_.is_faulty("tensioner.spring_torque_n_m") || log_.is_faulty("belt.length_catalogue_mm")) return;
    const BeltSpec& b = scene_.belt;
    const SpecPath belt = SpecPath{}.child("belt"), torque = SpecPath{}.child("tensioner").child("spring_torque_n_m");
    constexpr std::string_view ways =
        "exactly one of balanced_as_placed = true, unstretched_length_mm, effective_length_mm, length_catalogue_mm";
    const int given = b.balanced_as_placed.value_or(false) + b.unstretched_length_mm.has_value() +
                      b.effective_length_mm.has_value() + b.length_catalogue_mm.has_value();
    if (!b.pretension_n) {
      complain(torque, "missing key",
               fmt::format("number from 0 to 100000; or belt.pretension_n for which to solve it, beside {}", ways));
    } else if (given == 0) {
      complain(torque, "missing key: belt.pretension_n alone does not say where the arm rests",
               fmt::format("number from 0 to 100000, or {} in [belt]", ways));
    } else if (given > 1) {
      complain(belt.child("unstretched_length_mm"),
               fmt::format("{} of four ways to say where the arm rests are given", given), std::string(ways));
    }
    if (b.length_catalogue_mm && b.length_catalogue_mm->empty()) {
      complain(belt.child("length_catalogue_mm"), "has no entries", "at least one length");
    }
  }

  void check_driver_and_ranges() {
    if (const auto& driver = scene_.driver) {
      const SpecPath body = SpecPath{}.child("driver").child("body");
      refer(body, driver->body, bodies_);
      const PulleySpec* driven = pulley(driver->body);
      if (driven && driven->locked) {
        complain(body, fmt::format("pulley '{}' is locked", driver->body), "a pulley or body that can turn");
      }
    } else if (!scene_.range.empty() && !log_.is_faulty("driver")) {
      complain(SpecPath{"driver", "range[0]"}, "ranges need a driver, and there is none", "a table [driver]");
    }
    double sum = 0;
    bool readable = true;
    bool any = false;
    for (std::size_t i = 0; i < scene_.range.size(); ++i) {
      sum += scene_.range[i].duty_share;
      any = any || scene_.range[i].duty_share != 0;
      readable = readable && !log_.is_faulty(SpecPath{}.child("range").element(i).child("duty_share").place);
    }
    constexpr double tolerance = 1e-9;  // shares are typed as decimals: only rounding is forgiven
    if (any && readable && !(std::abs(sum - 1) <= tolerance)) {
      complain({"range", "range[0]"}, fmt::format("the duty shares sum to {}", sum), "1, or no shares at all");
    }
    const SpecPath evaluate = SpecPath{}.child("profile").child("evaluate_s");
    if (scene_.profile.evaluate_s > scene_.profile.hold_s && !log_.is_faulty("profile.hold_s")) {
      complain(evaluate,
               fmt::format("{} s is longer than the hold of {} s", scene_.profile.evaluate_s, scene_.profile.hold_s),
               "at most hold_s");
    }
    if (scene_.profile.settled_within && scene_.profile.evaluate_s <= scene_.profile.hold_s &&
        !log_.is_faulty("profile.hold_s") && !log_.is_faulty("profile.evaluate_s") &&
        2 * scene_.profile.evaluate_s > scene_.profile.hold_s * (1 + 1e-9)) {
      complain(SpecPath{}.child("profile").child("settled_within"),
               fmt::format("the hold of {} s has no two stretches of {} s to compare", scene_.profile.hold_s,
                           scene_.profile.evaluate_s),
               "an evaluate_s of at most half of hold_s");
    }
    const double samples = scene_.profile.evaluate_s * scene_.solver.sample_rate_hz;
    if (samples < 8 && !log_.is_faulty("profile.evaluate_s") && !log_.is_faulty("solver.sample_rate_hz")) {
      complain(evaluate,
               fmt::format("{} s hold {:.3g} samples at {} Hz", scene_.profile.evaluate_s, samples,
                           scene_.solver.sample_rate_hz),
               "at least 8 samples");
    }
  }

  void check_event() {
    if (!scene_.event) return;
    const SpecPath path = SpecPath{}.child("event");
    const SpecPath times = path.child("times_s"), speeds = path.child("speeds_rpm");
    const auto& t = scene_.event->times_s;
    if (!scene_.driver && !log_.is_faulty("driver"))
      complain(path, "an event needs a driver, and there is none", "a table [driver]");
    if (scene_.driver && scene_.driver->speed_csv)
      complain(path, "driver.speed_csv is given too", "one of the two: either says how fast the driven body turns");
    if (log_.is_faulty(times.place)) return;
    if (t.size() < 2) complain(times, fmt::format("has {} entries", t.size()), "at least two, the first 0");
    if (!log_.is_faulty(speeds.place) && scene_.event->speeds_rpm.size() != t.size())
      complain(speeds, fmt::format("has {} entries, times_s has {}", scene_.event->speeds_rpm.size(), t.size()),
               "lists of one length");
    if (!t.empty() && t.front() != 0) complain(times, fmt::format("starts at {} s", t.front()), "a first entry of 0");
    for (std::size_t i = 1; i < t.size(); ++i)
      if (!(t[i] > t[i - 1]))
        complain({times.element(i).shown, times.place},
                 fmt::format("{} does not exceed the entry before, {}", t[i], t[i - 1]), "increasing times");
  }

  const SceneSpec& scene_;
  ReadLog& log_;
  Names pulleys_{.names = {}, .kind = "pulley"};
  Names bodies_;
  Names springs_{.names = {}, .kind = "torsional spring"};
};

}  // namespace

void check_scene(const SceneSpec& scene, ReadLog& log) { SceneCheck(scene, log).run(); }

}  // namespace beltlife

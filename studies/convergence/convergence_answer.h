// Owns what a study of kind convergence answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/answer/answer_shape.h"

namespace beltlife {

/// The largest error of a group of quantities, and whose it is.
struct GroupError {
  double error = not_known;
  std::string quantity;

  template <class V>
  void visit(V& v) {
    v("error", error, "", "relative; of lives in decades of log10, where 0.01 counts as 1 %");
    v("quantity", quantity, "", "whose error it is");
  }
};
using GroupErrors = std::map<std::string, GroupError>;

struct SettingAnswer {
  std::string name, scheme;
  int elements = 0;
  double step_s = not_known, steps = not_known, evaluations = not_known, processor_s = not_known,
         simulated_s_per_s = not_known;
  std::optional<GroupErrors> errors, step_errors;
  std::optional<std::string> failure;

  template <class V>
  void visit(V& v) {
    v("name", name, "", "scheme, elements and step in words");
    v("scheme", scheme, "", "time integrator");
    v("elements", elements, "", "belt elements");
    v("step_s", step_s, "s", "time step");
    v("steps", steps, "", "steps over all ranges");
    v("evaluations", evaluations, "", "force evaluations over all ranges");
    v("processor_s", processor_s, "s", "processor time on one thread, median of the repeats");
    v("simulated_s_per_s", simulated_s_per_s, "", "simulated time by processor time");
    v("errors", errors, "", "by group, against the reference; absent after a failure");
    v("step_errors", step_errors, "", "by group, against the explicit run on the same mesh");
    v("failure", failure, "", "why the setting did not run to its end");
  }
};

struct QuantityReference {
  std::string group;
  double reference = not_known, band = not_known, noise = not_known;

  template <class V>
  void visit(V& v) {
    v("group", group, "", "group with which it is judged");
    v("reference", reference, unit_of_its_name, "value of the reference");
    v("band", band, unit_of_its_name, "how far the reference itself may be off");
    v("noise", noise, unit_of_its_name, "standard deviation over crank phases");
  }
};

struct ObservedOrders {
  std::optional<double> step, mesh;

  template <class V>
  void visit(V& v) {
    v("step", step, "", "order in the time step");
    v("mesh", mesh, "", "order in the element length");
  }
};

struct CheapestSetting {
  std::string setting;
  double processor_s = not_known;

  template <class V>
  void visit(V& v) {
    v("setting", setting, "", "its name");
    v("processor_s", processor_s, "s", "its processor time");
  }
};

struct ConvergenceAnswer : DriverAnswer {
  std::string processor;
  double simulated_s = not_known;
  std::vector<std::string> groups, not_judged;
  std::optional<std::string> reference;
  std::optional<GroupErrors> reference_band, noise_floor;
  std::map<std::string, QuantityReference> quantities;
  std::vector<SettingAnswer> settings;
  std::map<std::string, std::map<std::string, ObservedOrders>> orders;
  std::map<std::string, std::map<std::string, OrNull<CheapestSetting>>> cheapest;

  template <class V>
  void visit(V& v) {
    v("processor", processor, "", "on which times were measured");
    v("simulated_s", simulated_s, "s", "simulated by every setting");
    v("groups", groups, "", "groups of quantities that are judged together");
    v("not_judged", not_judged, "", "quantities of which a tenth or more is noise");
    v("reference", reference, "", "setting that all others are measured against");
    v("reference_band", reference_band, "", "by group: how far the reference itself may be off");
    v("noise_floor", noise_floor, "", "by group: scatter between crank phases");
    v("quantities", quantities, "", "reference by quantity");
    v("settings", settings, "", "every scheme, mesh and step");
    v("orders", orders, "", "observed orders by group and scheme");
    v("cheapest", cheapest, "",
      "by group (all: of all together) and by bound: the cheapest setting within; null: none");
    DriverAnswer::visit(v);
  }
};

}  // namespace beltlife

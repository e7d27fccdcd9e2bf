// Owns nonlinear regression problems of the NIST Statistical Reference Datasets: models, starts, certified answers.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/nist_strd_data.h"

namespace beltlife::nist {

/// NIST's own classes.
enum class Difficulty { lower, average, higher };

/// One problem with its certified answer. Its certified squares are what the certified parameters leave.
struct Problem {
  std::string name;
  Difficulty difficulty = Difficulty::lower;
  double (*model)(const std::vector<double>& b, double x, double x2) = nullptr;
  std::vector<double> x, x2;  ///< x2: the second predictor; empty without one
  std::vector<double> y;
  std::vector<double> starts[2];             ///< far, near
  std::vector<double> certified, deviation;  ///< of the parameters
  double squares = 0;                        ///< residual sum of squares

  double predicted(const std::vector<double>& b, std::size_t k) const {
    return model(b, x[k], x2.empty() ? 0.0 : x2[k]);
  }
};

using Parameters = const std::vector<double>&;

inline double saturation(Parameters b, double x, double) { return b[0] * (1 - std::exp(-b[1] * x)); }
inline double misra1b(Parameters b, double x, double) { return b[0] * (1 - std::pow(1 + b[1] * x / 2, -2)); }
inline double misra1c(Parameters b, double x, double) { return b[0] * (1 - std::pow(1 + 2 * b[1] * x, -0.5)); }
inline double misra1d(Parameters b, double x, double) { return b[0] * b[1] * x / (1 + b[1] * x); }
inline double chwirut(Parameters b, double x, double) { return std::exp(-b[0] * x) / (b[1] + b[2] * x); }
inline double lanczos(Parameters b, double x, double) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-b[3] * x) + b[4] * std::exp(-b[5] * x);
}
inline double danwood(Parameters b, double x, double) { return b[0] * std::pow(x, b[1]); }
inline double kirby2(Parameters b, double x, double) {
  return (b[0] + x * (b[1] + x * b[2])) / (1 + x * (b[3] + x * b[4]));
}
inline double nelson(Parameters b, double weeks, double celsius) {
  return b[0] - b[1] * weeks * std::exp(-b[2] * celsius);
}
inline double mgh17(Parameters b, double x, double) {
  return b[0] + b[1] * std::exp(-b[3] * x) + b[2] * std::exp(-b[4] * x);
}
inline double roszman1(Parameters b, double x, double) {
  return b[0] - b[1] * x - std::atan(b[2] / (x - b[3])) / std::numbers::pi;
}
inline double enso(Parameters b, double x, double) {
  const auto wave = [x](double period, double c, double s) {
    return c * std::cos(2 * std::numbers::pi * x / period) + s * std::sin(2 * std::numbers::pi * x / period);
  };
  return b[0] + wave(12, b[1], b[2]) + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8]);
}
inline double mgh09(Parameters b, double x, double) { return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]); }
inline double thurber(Parameters b, double x, double) {
  return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1 + x * (b[4] + x * (b[5] + x * b[6])));
}
inline double rat42(Parameters b, double x, double) { return b[0] / (1 + std::exp(b[1] - b[2] * x)); }
inline double mgh10(Parameters b, double x, double) { return b[0] * std::exp(b[1] / (x + b[2])); }
inline double eckerle4(Parameters b, double x, double) {
  const double z = (x - b[2]) / b[1];
  return b[0] / b[1] * std::exp(-0.5 * z * z);
}
inline double rat43(Parameters b, double x, double) {
  return b[0] * std::pow(1 + std::exp(b[1] - b[2] * x), -1 / b[3]);
}
inline double bennett5(Parameters b, double x, double) { return b[0] * std::pow(b[1] + x, -1 / b[2]); }

/// Logarithms of Nelson's strengths: what NIST's model predicts.
inline std::vector<double> nelson_y() {
  std::vector<double> y;
  for (double strength : nelson_strength) y.push_back(std::log(strength));
  return y;
}
inline std::vector<double> nelson_x(bool second) {
  std::vector<double> x;
  for (double weeks : {1, 2, 4, 8, 16, 32, 48, 64})
    for (double celsius : {180, 225, 250, 275})
      for (int specimen = 0; specimen < 4; ++specimen) x.push_back(second ? celsius : weeks);
  return x;
}

/// In NIST's order, from lower to higher difficulty.
inline std::vector<Problem> problems() {
  using enum Difficulty;
  return {
      {"Misra1a",
       lower,
       saturation,
       misra_x,
       {},
       misra_y,
       {{500, 0.0001}, {250, 0.0005}},
       {2.3894212918E+02, 5.5015643181E-04},
       {2.7070075241E+00, 7.2668688436E-06},
       1.2455138894E-01},
      {"Chwirut2",
       lower,
       chwirut,
       chwirut2_x,
       {},
       chwirut2_y,
       {{0.1, 0.01, 0.02}, {0.15, 0.008, 0.010}},
       {1.6657666537E-01, 5.1653291286E-03, 1.2150007096E-02},
       {3.8303286810E-02, 6.6621605126E-04, 1.5304234767E-03},
       5.1304802941E+02},
      {"Lanczos3",
       lower,
       lanczos,
       lanczos_x,
       {},
       lanczos3_y,
       {{1.2, 0.3, 5.6, 5.5, 6.5, 7.6}, {0.5, 0.7, 3.6, 4.2, 4, 6.3}},
       {8.6816414977E-02, 9.5498101505E-01, 8.4400777463E-01, 2.9515951832E+00, 1.5825685901E+00, 4.9863565084E+00},
       {1.7197908859E-02, 9.7041624475E-02, 4.1488663282E-02, 1.0766312506E-01, 5.8371576281E-02, 3.4436403035E-02},
       1.6117193594E-08},
      {"DanWood",
       lower,
       danwood,
       danwood_x,
       {},
       danwood_y,
       {{1, 5}, {0.7, 4}},
       {7.6886226176E-01, 3.8604055871E+00},
       {1.8281973860E-02, 5.1726610913E-02},
       4.3173084083E-03},
      {"Misra1b",
       lower,
       misra1b,
       misra_x,
       {},
       misra_y,
       {{500, 0.0001}, {300, 0.0002}},
       {3.3799746163E+02, 3.9039091287E-04},
       {3.1643950207E+00, 4.2547321834E-06},
       7.5464681533E-02},
      {"Kirby2",
       average,
       kirby2,
       kirby2_x,
       {},
       kirby2_y,
       {{2, -0.1, 0.003, -0.001, 0.00001}, {1.5, -0.15, 0.0025, -0.0015, 0.00002}},
       {1.6745063063E+00, -1.3927397867E-01, 2.5961181191E-03, -1.7241811870E-03, 2.1664802578E-05},
       {8.7989634338E-02, 4.1182041386E-03, 4.1856520458E-05, 5.8931897355E-05, 2.0129761919E-07},
       3.9050739624E+00},
      {"Nelson",
       average,
       nelson,
       nelson_x(false),
       nelson_x(true),
       nelson_y(),
       {{2, 0.0001, -0.01}, {2.5, 0.000000005, -0.05}},
       {2.5906836021E+00, 5.6177717026E-09, -5.7701013174E-02},
       {1.9149996413E-02, 6.1124096540E-09, 3.9572366543E-03},
       3.7976833176E+00},
      {"MGH17",
       average,
       mgh17,
       row(0, 10, 33),
       {},
       mgh17_y,
       {{50, 150, -100, 1, 2}, {0.5, 1.5, -1, 0.01, 0.02}},
       {3.7541005211E-01, 1.9358469127E+00, -1.4646871366E+00, 1.2867534640E-02, 2.2122699662E-02},
       {2.0723153551E-03, 2.2031669222E-01, 2.2175707739E-01, 4.4861358114E-04, 8.9471996575E-04},
       5.4648946975E-05},
      {"Lanczos1",
       average,
       lanczos,
       lanczos_x,
       {},
       lanczos1_y,
       {{1.2, 0.3, 5.6, 5.5, 6.5, 7.6}, {0.5, 0.7, 3.6, 4.2, 4, 6.3}},
       {9.5100000027E-02, 1.0000000001E+00, 8.6070000013E-01, 3.0000000002E+00, 1.5575999998E+00, 5.0000000001E+00},
       {5.3347304234E-11, 2.7473038179E-10, 1.3576062225E-10, 3.3308253069E-10, 1.8815731448E-10, 1.1057500538E-10},
       1.4307867721E-25},
      {"Lanczos2",
       average,
       lanczos,
       lanczos_x,
       {},
       lanczos2_y,
       {{1.2, 0.3, 5.6, 5.5, 6.5, 7.6}, {0.5, 0.7, 3.6, 4.2, 4, 6.3}},
       {9.6251029939E-02, 1.0057332849E+00, 8.6424689056E-01, 3.0078283915E+00, 1.5529016879E+00, 5.0028798100E+00},
       {6.6770575477E-04, 3.3989646176E-03, 1.7185846685E-03, 4.1707005856E-03, 2.3744381417E-03, 1.3958787284E-03},
       2.2299428125E-11},
      {"Misra1c",
       average,
       misra1c,
       misra_x,
       {},
       misra_y,
       {{500, 0.0001}, {600, 0.0002}},
       {6.3642725809E+02, 2.0813627256E-04},
       {4.6638326572E+00, 1.7728423155E-06},
       4.0966836971E-02},
      {"Misra1d",
       average,
       misra1d,
       misra_x,
       {},
       misra_y,
       {{500, 0.0001}, {450, 0.0003}},
       {4.3736970754E+02, 3.0227324449E-04},
       {3.6489174345E+00, 2.9334354479E-06},
       5.6419295283E-02},
      {"Roszman1",
       average,
       roszman1,
       roszman1_x,
       {},
       roszman1_y,
       {{0.1, -0.00001, 1000, -100}, {0.2, -0.000005, 1200, -150}},
       {2.0196866396E-01, -6.1953516256E-06, 1.2044556708E+03, -1.8134269537E+02},
       {1.9172666023E-02, 3.2058931691E-06, 7.4050983057E+01, 4.9573513849E+01},
       4.9484847331E-04},
      {"ENSO",
       average,
       enso,
       row(1, 1, 168),
       {},
       enso_y,
       {{11, 3, 0.5, 40, -0.7, -1.3, 25, -0.3, 1.4}, {10, 3, 0.5, 44, -1.5, 0.5, 26, -0.1, 1.5}},
       {1.0510749193E+01, 3.0762128085E+00, 5.3280138227E-01, 4.4311088700E+01, -1.6231428586E+00, 5.2554493756E-01,
        2.6887614440E+01, 2.1232288488E-01, 1.4966870418E+00},
       {1.7488832467E-01, 2.4310052139E-01, 2.4354686618E-01, 9.4408025976E-01, 2.8078369611E-01, 4.8073701119E-01,
        4.1612939130E-01, 5.1460022911E-01, 2.5434468893E-01},
       7.8853978668E+02},
      {"MGH09",
       higher,
       mgh09,
       mgh09_x,
       {},
       mgh09_y,
       {{25, 39, 41.5, 39}, {0.25, 0.39, 0.415, 0.39}},
       {1.9280693458E-01, 1.9128232873E-01, 1.2305650693E-01, 1.3606233068E-01},
       {1.1435312227E-02, 1.9633220911E-01, 8.0842031232E-02, 9.0025542308E-02},
       3.0750560385E-04},
      {"Thurber",
       higher,
       thurber,
       thurber_x,
       {},
       thurber_y,
       {{1000, 1000, 400, 40, 0.7, 0.3, 0.03}, {1300, 1500, 500, 75, 1, 0.4, 0.05}},
       {1.2881396800E+03, 1.4910792535E+03, 5.8323836877E+02, 7.5416644291E+01, 9.6629502864E-01, 3.9797285797E-01,
        4.9727297349E-02},
       {4.6647963344E+00, 3.9571156086E+01, 2.8698696102E+01, 5.5675370270E+00, 3.1333340687E-02, 1.4984928198E-02,
        6.5842344623E-03},
       5.6427082397E+03},
      {"BoxBOD",
       higher,
       saturation,
       boxbod_x,
       {},
       boxbod_y,
       {{1, 1}, {100, 0.75}},
       {2.1380940889E+02, 5.4723748542E-01},
       {1.2354515176E+01, 1.0455993237E-01},
       1.1680088766E+03},
      {"Rat42",
       higher,
       rat42,
       rat42_x,
       {},
       rat42_y,
       {{100, 1, 0.1}, {75, 2.5, 0.07}},
       {7.2462237576E+01, 2.6180768402E+00, 6.7359200066E-02},
       {1.7340283401E+00, 8.8295217536E-02, 3.4465663377E-03},
       8.0565229338E+00},
      {"MGH10",
       higher,
       mgh10,
       row(50, 5, 16),
       {},
       mgh10_y,
       {{2, 400000, 25000}, {0.02, 4000, 250}},
       {5.6096364710E-03, 6.1813463463E+03, 3.4522363462E+02},
       {1.5687892471E-04, 2.3309021107E+01, 7.8486103508E-01},
       8.7945855171E+01},
      {"Eckerle4",
       higher,
       eckerle4,
       eckerle4_x,
       {},
       eckerle4_y,
       {{1, 10, 500}, {1.5, 5, 450}},
       {1.5543827178E+00, 4.0888321754E+00, 4.5154121844E+02},
       {1.5408051163E-02, 4.6803020753E-02, 4.6800518816E-02},
       1.4635887487E-03},
      {"Rat43",
       higher,
       rat43,
       row(1, 1, 15),
       {},
       rat43_y,
       {{100, 10, 1, 1}, {700, 5, 0.75, 1.3}},
       {6.9964151270E+02, 5.2771253025E+00, 7.5962938329E-01, 1.2792483859E+00},
       {1.6302297817E+01, 2.0828735829E+00, 1.9566123451E-01, 6.8761936385E-01},
       8.7864049080E+03},
      {"Bennett5",
       higher,
       bennett5,
       bennett5_x,
       {},
       bennett5_y,
       {{-2000, 50, 0.8}, {-1500, 45, 0.85}},
       {-2.5235058043E+03, 4.6736564644E+01, 9.3218483193E-01},
       {2.9715175411E+02, 1.2448871856E+00, 2.0272299378E-02},
       5.2404744073E-04},
  };
}

}  // namespace beltlife::nist

// Owns the arithmetic of the energy account.
#include "sim/record.h"

#include <algorithm>

namespace beltlife {

namespace {
constexpr auto first_loss = static_cast<std::size_t>(Energy::lost_belt_axial);
constexpr auto end_of_losses = static_cast<std::size_t>(Energy::stored);
}  // namespace

double EnergyAccount::residual() const {
  double left = -(*this)[Energy::stored];
  for (std::size_t i = 0; i < first_loss; ++i) left += joule[i];
  for (std::size_t i = first_loss; i < end_of_losses; ++i) left -= joule[i];
  return left;
}

double EnergyAccount::throughput() const {
  double in = std::max(0.0, -(*this)[Energy::stored]);
  for (std::size_t i = 0; i < first_loss; ++i)
    if (joule[i] > 0) in += joule[i];
  return in;
}

double EnergyAccount::relative_residual() const {
  constexpr double nothing = 1e-3;  // J: a drive at rest or coasting without loss has nothing to account for
  const double in = throughput();
  return in > nothing ? residual() / in : 0;
}

}  // namespace beltlife

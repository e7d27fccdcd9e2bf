// The group of an energy account: see energy_group.h.
#include "results/store/energy_group.h"

#include "results/store/file_paths.h"

namespace beltlife {

void put_energy(Hdf5Image& file, const std::string& at, const EnergyAccount& account) {
  file.group(at, "energy account of the window");
  file.attribute(at, names::energy_relative_residual, account.relative_residual());
  for (std::size_t i = 0; i < energy_names.size(); ++i)
    file.scalar(join(at, energy_names[i]), account.joule[i], "J", names::energy_about[i]);
  file.scalar(join(at, names::residual.name), account.residual(), names::residual.unit, names::residual.about);
  file.scalar(join(at, names::throughput.name), account.throughput(), names::throughput.unit, names::throughput.about);
}

EnergyAccount read_energy(const Hdf5Source& file, const std::string& at) {
  EnergyAccount account;
  for (std::size_t i = 0; i < energy_names.size(); ++i) account.joule[i] = file.number(join(at, energy_names[i]));
  return account;
}

}  // namespace beltlife

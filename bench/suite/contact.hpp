#pragma once
// Steps of the contact model, in the cases in which grains come to rest.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cases.hpp"
#include "clca/store/table.hpp"

namespace clca::bench {

/// Resolution and restitution of `preview` are for a quick look.
enum class ContactSetting : std::uint8_t { defaults, preview };

struct ContactMeasurement {
  Case a_case = Case::settling;
  ContactSetting setting = ContactSetting::defaults;
  std::size_t particles = 0;
  std::uint64_t steps = 0;
  std::uint64_t moved = 0;
  bool at_rest = false;
  std::vector<double> seconds = {};  ///< a step, processor time of each run, ascending
};

/// Both settings, on one thread: settling and collapse only. At least two runs each, and more
/// until they have taken `seconds`; each ends after `max_updates` (particles x steps), at least
/// 100 steps.
std::vector<ContactMeasurement> measure_contact(Case a_case, const grains::State& start,
                                                double seconds, std::uint64_t max_updates);

/// A row for each measurement.
store::Table contact_table(const std::vector<ContactMeasurement>& measurements);
/// A row for each measurement, in Markdown.
std::string markdown(const std::vector<ContactMeasurement>& measurements);

}  // namespace clca::bench

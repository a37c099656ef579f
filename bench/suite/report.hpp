#pragma once
// Measurements as tables and as text.

#include <string>
#include <vector>

#include "clca/store/table.hpp"
#include "machine.hpp"
#include "measurement.hpp"

namespace clca::bench {

/// A row for each measurement.
store::Table automaton_table(const std::vector<Measurement>& measurements);
/// A row for each measurement and share of moving particles.
store::Table share_table(const std::vector<Measurement>& measurements);
/// A row for each measurement in which particles moved: how long it took, what it has to touch, and
/// how long the machine needs for that.
store::Table limit_table(const std::vector<Measurement>& measurements, const Machine& machine);

/// A row for each measurement, in Markdown.
std::string markdown(const std::vector<Measurement>& measurements);
std::string markdown(const Machine& machine, int threads);

}  // namespace clca::bench

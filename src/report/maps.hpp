#pragma once
// Which maps the tables of a run allow. Each function adds figures as HTML.

#include <string>
#include <vector>

#include "report/tables.hpp"

namespace clca::report {

/// Means over the windows of each stage, of fields.csv.
void add_field_maps(std::vector<std::string>& figures, const Tables& tables);
/// convection-STAGE.csv.
void add_convection_maps(std::vector<std::string>& figures, const Tables& tables);
/// contacts-STAGE.csv, between the centres of particles in loads-STAGE.csv.
void add_force_maps(std::vector<std::string>& figures, const Tables& tables);

}  // namespace clca::report

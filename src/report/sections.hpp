#pragma once
// The parts of the page, each as HTML; empty where there is nothing to show.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "clca/store/summary.hpp"
#include "report/tables.hpp"

namespace clca::report {

/// A table of the measures, a row for each, a column for each stage.
std::string measures_html(const store::RunSummary& summary);

/// The tables of walls as they are.
std::string walls_html(const Tables& tables);

/// Pictures at the end of the stages, and those to step through: `most` or, without it, as many as
/// leave the page below some 20 MB.
std::string frames_html(const std::filesystem::path& run, const store::RunSummary& summary,
                        std::optional<std::size_t> most, Warnings& warnings);

}  // namespace clca::report

#pragma once
// The sections of the page as HTML; empty if there is nothing to show.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "clca/store/summary.hpp"
#include "report/folder.hpp"

namespace clca::report {

/// A table of the measures, a row for each, a column for each stage.
std::string measures_html(const store::RunSummary& summary);

/// The tables of walls, unchanged.
std::string walls_html(const std::filesystem::path& run, const store::RunSummary& summary,
                       Warnings& warnings);

/// The figures of `clca plot` as SVG; without gnuplot a warning.
std::string figures_html(const std::filesystem::path& run, Warnings& warnings);

/// Pictures at the end of the stages, and those to step through: `most` or, without it, as many as
/// leave the page below some 20 MB.
std::string frames_html(const std::filesystem::path& run, const store::RunSummary& summary,
                        std::optional<std::size_t> most, Warnings& warnings);

}  // namespace clca::report

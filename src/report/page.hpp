#pragma once
// The page as a whole.

#include <optional>
#include <string>
#include <vector>

#include "clca/store/summary.hpp"
#include "report/tables.hpp"

namespace clca::report {

/// What the page is made of. Parts that are empty are left out.
struct Page {
  std::string title;       ///< of the scene
  std::string scene_text;  ///< scene.yaml
  std::string frames;      ///< HTML, as what follows
  std::string measures;
  std::string walls;
  std::string charts;
  std::string maps;
  std::vector<std::string> files;  ///< tables that lie beside the page
};

std::string to_html(const Page& page, const store::RunSummary& summary, const Warnings& warnings);

}  // namespace clca::report

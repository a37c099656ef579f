#pragma once
// The complete page.

#include <optional>
#include <string>
#include <vector>

#include "clca/store/summary.hpp"
#include "report/folder.hpp"

namespace clca::report {

/// The parts of the page. Empty parts are left out.
struct Page {
  std::string title;       ///< of the scene
  std::string scene_text;  ///< scene.yaml
  std::string frames;      ///< HTML, as what follows
  std::string measures;
  std::string walls;
  std::string figures;
  std::vector<std::string> files;  ///< tables that lie beside the page
};

std::string to_html(const Page& page, const store::RunSummary& summary, const Warnings& warnings);

}  // namespace clca::report

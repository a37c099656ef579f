#pragma once
// The complete page.

#include <string>
#include <utility>
#include <vector>

#include "report/folder.hpp"

namespace clca::report {

/// A part of the page with its own heading.
struct Section {
  const char* id = "";
  const char* name = "";
  std::string content = {};  ///< HTML; left out if empty
};

struct Page {
  std::string title;                                            ///< of the scene
  std::string kind;                                             ///< of run, in words
  std::string status;                                           ///< `done` or another
  std::string scene;                                            ///< its name
  std::vector<std::pair<const char*, std::string>> facts = {};  ///< name and HTML
  std::vector<Section> sections = {};
};

std::string to_html(const Page& page, const Warnings& warnings);

}  // namespace clca::report

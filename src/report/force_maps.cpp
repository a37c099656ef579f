// Maps of the contacts: lines between the centres of particles that overlap.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "report/map.hpp"
#include "report/maps.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMostLines = 4000;

using Centres = std::map<std::string, std::pair<double, double>>;

/// Of the particles that bear a load, by id.
Centres centres_of(const RunTable& loads) {
  Centres centres;
  const std::vector<std::string>* ids = loads.cells().find("id");
  const auto x = loads.numbers("x");
  const auto y = loads.numbers("y");
  for (std::size_t row = 0; ids != nullptr && x && y && row < ids->size(); ++row) {
    if (std::isfinite((*x)[row]) && std::isfinite((*y)[row])) {
      centres[(*ids)[row]] = {(*x)[row], (*y)[row]};
    }
  }
  return centres;
}

/// Across the seam of a periodic box a pair is near, but its centres are not.
bool is_across_seam(const Line& line, double width) {
  return std::abs(line.x1 - line.x0) > width / 2;
}

/// Of the box, as the profile of the stage has it; without one, no pair is taken for one across the
/// seam.
double width_of(const Tables& tables, const std::string& stage) {
  const auto profile = tables.find("profile-" + stage);
  const auto x = profile ? profile->numbers("x") : std::nullopt;
  return x && !x->empty() ? x->back() : std::numeric_limits<double>::infinity();
}

/// What a table of contacts says of how strong they are.
struct Strength {
  const char* column;
  const char* title;
};

Strength strength_of(const RunTable& contacts) {
  return contacts.numbers("normal_force") ? Strength{"normal_force", "grain weights"}
                                          : Strength{"sites", "sites of overlap"};
}

/// From centre to centre, or where the other is a wall, to the place where they meet.
std::vector<Line> contact_lines(const RunTable& contacts, const Centres& centres, double width) {
  std::vector<Line> lines;
  const std::vector<std::string>* first = contacts.cells().find("first");
  const std::vector<std::string>* second = contacts.cells().find("second");
  const auto x = contacts.numbers("x");
  const auto y = contacts.numbers("y");
  const auto strength = contacts.numbers(strength_of(contacts).column);
  if (first == nullptr || second == nullptr || !x || !y || !strength) {
    return lines;
  }
  for (std::size_t row = 0; row < first->size(); ++row) {
    const auto from = centres.find((*first)[row]);
    const auto to = centres.find((*second)[row]);
    // Contacts that are gone, and known by their mean only, have no place.
    const bool is_there = (*strength)[row] > 0 && std::isfinite((*strength)[row]) &&
                          std::isfinite((*x)[row]) && std::isfinite((*y)[row]);
    if (!is_there || from == centres.end()) {
      continue;
    }
    const auto end = to == centres.end() ? std::pair((*x)[row], (*y)[row]) : to->second;
    const Line line = {from->second.first, from->second.second, end.first, end.second,
                       (*strength)[row]};
    if (!is_across_seam(line, width)) {
      lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace

void add_force_maps(std::vector<std::string>& figures, const Tables& tables) {
  const std::vector<RunTable> loads = tables.find_all("loads");
  for (const RunTable& contacts : tables.find_all("contacts")) {
    const auto load = std::find_if(loads.begin(), loads.end(), [&](const RunTable& one) {
      return one.label() == contacts.label();
    });
    if (load == loads.end()) {
      continue;
    }
    Map map = {
        .title = "Contacts at the end of stage " + contacts.label(),
        .line_title = strength_of(contacts).title,
        .lines = contact_lines(contacts, centres_of(*load), width_of(tables, contacts.label()))};
    std::sort(map.lines.begin(), map.lines.end(),
              [](const Line& a, const Line& b) { return a.weight > b.weight; });
    map.lines.resize(std::min(map.lines.size(), kMostLines));
    figures.push_back(to_html(map));
  }
}

}  // namespace clca::report

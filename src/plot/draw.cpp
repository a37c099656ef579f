#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "clca/plot/plot.hpp"
#include "clca/process/data_folder.hpp"
#include "clca/process/program.hpp"
#include "clca/text/input_error.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

Json to_json(const Limits& limits) {
  return {number_or_null(limits.first), number_or_null(limits.second)};
}

Json to_json(const Choice& choice) {
  return {{"x", choice.x},
          {"y", choice.y},
          {"over", choice.over},
          {"y2", choice.y2},
          {"log", choice.log},
          {"stages", choice.stages},
          {"first", number_or_null(choice.first)},
          {"last", number_or_null(choice.last)},
          {"filling", choice.filling},
          {"mean", choice.mean}};
}

Json to_json(const Appearance& look) {
  return {{"format", look.format},
          {"in_mm", look.in_mm},
          {"width", look.width},
          {"height", number_or_null(look.height)},
          {"x_limits", to_json(look.x_limits)},
          {"y_limits", to_json(look.y_limits)}};
}

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The last line: what Python says before, such as a traceback, is not for users.
std::string last_line(const std::vector<std::uint8_t>& bytes) {
  std::string_view text = as_text(bytes);
  text = text.substr(0, text.find_last_not_of('\n') + 1);
  return std::string(text.substr(text.rfind('\n') + 1));
}

/// What Python writes: for each picture a line of JSON, then its bytes.
std::pair<std::vector<Picture>, std::vector<std::string>> parsed(
    const std::vector<std::uint8_t>& bytes) {
  std::pair<std::vector<Picture>, std::vector<std::string>> result;
  auto at = bytes.begin();
  while (at != bytes.end()) {
    const auto end = std::find(at, bytes.end(), '\n');
    const Json head = Json::parse(at, end);
    at = end == bytes.end() ? end : end + 1;
    if (head.contains("warning")) {
      result.second.push_back(head["warning"]);
      continue;
    }
    const auto size = head.at("bytes").get<std::size_t>();
    if (size > static_cast<std::size_t>(bytes.end() - at)) {
      throw PlotError("Python leaves no whole picture");
    }
    const auto next = at + static_cast<std::ptrdiff_t>(size);
    result.first.push_back({.name = head.at("name"),
                            .about = head.at("about"),
                            .format = head.at("format"),
                            .bytes = {at, next}});
    at = next;
  }
  return result;
}

std::pair<std::vector<Picture>, std::vector<std::string>> drawn(const fs::path& folder,
                                                                const Json& options,
                                                                const std::atomic<int>* stop) {
  constexpr int kWrong = 2;
  const fs::path package = process::data_folder("python");
  const fs::path python = process::python();
  std::error_code unknown;
  if (!fs::exists(package / "clca/__main__.py", unknown)) {
    throw PlotError(fmt::format("no Python package of clca in {}", package.string()));
  }
  try {
    const process::OutputCapture out;
    const process::OutputCapture err;
    // Python looks for modules in the folder where it is started first.
    const int code = process::Program({python.string(), "-m", "clca", "plot",
                                       options.dump(-1, ' ', false, Json::error_handler_t::replace),
                                       fs::absolute(folder).string()},
                                      {.folder = package, .out = &out, .err = &err, .stop = stop})
                         .wait();
    if (code != 0) {
      const std::string line = last_line(err.bytes());
      if (code == kWrong) {
        throw text::InputError(line);
      }
      throw PlotError(fmt::format("{} fails with exit code {}: {}", python.string(), code, line));
    }
    return parsed(out.bytes());
  } catch (const process::StoppedError&) {
    throw;
  } catch (const process::ProcessError& error) {
    throw PlotError(error.what());
  } catch (const Json::exception&) {
    throw PlotError(fmt::format("{} answers what clca does not understand", python.string()));
  }
}

}  // namespace

std::vector<Picture> pictures(const fs::path& folder, const std::vector<std::string>& only,
                              const Choice& choice, const Appearance& appearance,
                              const std::atomic<int>* stop) {
  return drawn(folder, {{"only", only}, {"choice", to_json(choice)}, {"look", to_json(appearance)}},
               stop)
      .first;
}

std::pair<std::vector<Picture>, std::vector<std::string>> pictures_of_page(
    const fs::path& folder, const Appearance& appearance, std::size_t most) {
  return drawn(folder,
               {{"choice", to_json(Choice())}, {"look", to_json(appearance)}, {"report", most}},
               nullptr);
}

}  // namespace clca::plot

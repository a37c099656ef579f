#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>

#include "clca/image/png.hpp"
#include "clca/store/file.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kUsualBytes = 14 << 20;          // of pictures: 19 MiB of page, in base64
constexpr std::uintmax_t kMaxRequestedBytes = 192 << 20;  // where a number of pictures is asked for
constexpr std::size_t kMaxStageEnds = 12;
constexpr std::size_t kMaxAgain = 12;

struct Picture {
  fs::path file;
  std::uint64_t step = 0;
  std::uintmax_t bytes = 0;
  std::size_t end_of = 0;  ///< 1 + number of the stage that ends with it, 0: of none
};

/// NAME-000120.png
std::optional<std::uint64_t> step_in(const std::string& name) {
  constexpr std::string_view kEnding = ".png";
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos || !name.ends_with(kEnding)) {
    return std::nullopt;
  }
  const char* end = name.data() + name.size() - kEnding.size();
  std::uint64_t step = 0;
  const auto [stop, error] = std::from_chars(name.data() + dash + 1, end, step);
  return stop == end && error == std::errc() ? std::optional(step) : std::nullopt;
}

/// By their steps.
std::vector<Picture> pictures_in(const fs::path& folder) {
  std::vector<Picture> pictures;
  for (const std::string& name : file_names(folder)) {
    std::error_code error;
    const auto step = step_in(name);
    const std::uintmax_t bytes = fs::file_size(folder / name, error);
    if (step && !error) {
      pictures.push_back({.file = folder / name, .step = *step, .bytes = bytes});
    }
  }
  std::stable_sort(pictures.begin(), pictures.end(),
                   [](const Picture& a, const Picture& b) { return a.step < b.step; });
  return pictures;
}

/// The last step of each stage.
std::vector<std::uint64_t> stage_ends(const store::RunSummary& summary) {
  std::vector<std::uint64_t> ends;
  std::uint64_t step = 0;
  for (const store::StageSummary& stage : summary.stages) {
    step += stage.steps;
    ends.push_back(step);
  }
  return ends;
}

/// The last picture of each stage, at most kMaxStageEnds.
std::vector<Picture> end_pictures(const std::vector<Picture>& all,
                                  const std::vector<std::uint64_t>& ends) {
  std::vector<Picture> last;
  for (const std::size_t stage : evenly(ends.size(), kMaxStageEnds)) {
    for (const Picture& picture : all) {
      if (picture.step == ends[stage]) {
        last.push_back(picture);
        last.back().end_of = stage + 1;
        break;
      }
    }
  }
  return last;
}

std::uintmax_t bytes_of(const std::vector<Picture>& all, const std::vector<std::size_t>& chosen) {
  std::uintmax_t sum = 0;
  for (const std::size_t number : chosen) {
    sum += all[number].bytes;
  }
  return sum;
}

/// Evenly selected pictures with at most `bytes` in total.
std::vector<std::size_t> chosen_pictures(const std::vector<Picture>& all, std::size_t most,
                                         std::uintmax_t bytes) {
  std::size_t count = std::min(all.size(), most);
  std::vector<std::size_t> chosen = evenly(all.size(), count);
  while (count > 0 && bytes_of(all, chosen) > bytes) {
    const double part = static_cast<double>(bytes) / static_cast<double>(bytes_of(all, chosen));
    count = std::min(count - 1, static_cast<std::size_t>(static_cast<double>(count) * part));
    chosen = evenly(all.size(), count);
  }
  return chosen;
}

struct Png {
  std::vector<std::uint8_t> bytes;
  image::PixelBox size;
};

/// Throws StoreError if it is no PNG.
Png read_png(const fs::path& file) {
  std::vector<std::uint8_t> bytes = store::read_whole(file, store::kMaxPictureBytes);
  const std::optional<image::PixelBox> size = image::png_size(bytes);
  if (!size) {
    throw store::StoreError(fmt::format("{} is left out: it is no PNG", file.string()));
  }
  return {std::move(bytes), *size};
}

std::string data_url(const std::vector<std::uint8_t>& bytes) {
  return "data:image/png;base64," + base64(bytes);
}

/// Writes the pictures of a run. Unreadable ones are left out with a warning.
class Writer {
 public:
  Writer(const store::RunSummary& summary, Warnings& warnings)
      : summary_(summary), warnings_(warnings), ends_(stage_ends(summary)) {}

  const std::vector<std::uint64_t>& ends() const { return ends_; }

  /// One of render/.
  void add_again(std::string& html, const Picture& picture) {
    try {
      const Png png = read_png(picture.file);
      html += fmt::format(
          R"(<figure><img src="{}" width="{}" height="{}" alt="Picture drawn again, {}"><figcaption>{}</figcaption></figure>
)",
          data_url(png.bytes), png.size.width, png.size.height, escaped(when(picture.step)),
          escaped(when(picture.step)));
    } catch (const store::StoreError& error) {
      warnings_.add(error.what());
    }
  }

  void add_end(std::string& html, const Picture& picture) {
    try {
      const Png png = read_png(picture.file);
      const std::string stage = escaped(summary_.stages[picture.end_of - 1].name);
      html += fmt::format(
          R"(<figure><img id="end-{0}" src="{1}" width="{2}" height="{3}" alt="Picture of the particles at the end of stage {4}, {5}"><figcaption>End of <b>{4}</b>, {5}</figcaption></figure>
)",
          picture.end_of, data_url(png.bytes), png.size.width, png.size.height, stage,
          escaped(when(picture.step)));
      shown_.push_back(picture.step);
    } catch (const store::StoreError& error) {
      warnings_.add(error.what());
    }
  }

  /// An entry of the picture list for the page script.
  void add_frame(std::string& list, const Picture& picture, const std::vector<Picture>& ends) {
    nlohmann::json entry = {{"step", picture.step}, {"stage", stage_at(picture.step)}};
    if (summary_.units) {
      entry["time"] = summary_.units->time_text(picture.step);
    }
    const auto end = std::find_if(ends.begin(), ends.end(), [&](const Picture& last) {
      return last.step == picture.step &&
             std::find(shown_.begin(), shown_.end(), last.step) != shown_.end();
    });
    try {
      if (end != ends.end()) {
        entry["same"] = fmt::format("end-{}", end->end_of);
      } else {
        entry["image"] = data_url(read_png(picture.file).bytes);
      }
    } catch (const store::StoreError& error) {
      warnings_.add(error.what());
      return;
    }
    list += (count_ == 0 ? "" : ",\n") + json_for_html(entry);
    ++count_;
  }

  std::size_t count() const { return count_; }

 private:
  /// `step 120`, with its time where it has one.
  std::string when(std::uint64_t step) const {
    const std::string time =
        summary_.units ? fmt::format(", t = {}", summary_.units->time_text(step)) : "";
    return fmt::format("step {}{}", whole(step), time);
  }

  std::string stage_at(std::uint64_t step) const {
    const auto end = std::lower_bound(ends_.begin(), ends_.end(), step);
    return end == ends_.end() ? std::string()
                              : summary_.stages[static_cast<std::size_t>(end - ends_.begin())].name;
  }

  /// File text must not close the element around the list.
  static std::string json_for_html(const nlohmann::json& value) {
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
      text.replace(at, 1, "\\u003c");
    }
    return text;
  }

  const store::RunSummary& summary_;
  Warnings& warnings_;
  std::vector<std::uint64_t> ends_;
  std::vector<std::uint64_t> shown_;
  std::size_t count_ = 0;
};

/// What `clca render` has left in a run folder: the MIME types of movies, and of pictures that
/// browsers show.
constexpr auto kMediaTypes =
    std::to_array<std::pair<std::string_view, std::string_view>>({{".mp4", "video/mp4"},
                                                                  {".webm", "video/webm"},
                                                                  {".webp", "image/webp"},
                                                                  {".gif", "image/gif"},
                                                                  {".png", "image/png"}});

/// Movies and sheets in the folder itself, each at most half of what is left of the `budget`,
/// bytes.
std::string movies_html(const fs::path& run, std::uintmax_t& budget, Warnings& warnings) {
  std::string html;
  for (const std::string& name : file_names(run)) {
    const auto* type = std::find_if(kMediaTypes.begin(), kMediaTypes.end(),
                                    [&](const auto& media) { return name.ends_with(media.first); });
    if (type == kMediaTypes.end()) {
      continue;
    }
    try {
      const auto bytes = store::read_whole(run / name, static_cast<double>(budget) / 2);
      budget -= bytes.size();
      const std::string url = fmt::format("data:{};base64,{}", type->second, base64(bytes));
      const std::string what =
          type->second.starts_with("video")
              ? fmt::format(R"(<video controls="" loop="" muted="" src="{}"></video>)", url)
              : fmt::format(R"(<img src="{}" alt="{}">)", url, escaped(name));
      html += fmt::format(
          "<figure class=\"movie\">{}<figcaption><code>{}</code></figcaption></figure>\n", what,
          escaped(name));
    } catch (const store::StoreError& error) {
      warnings.add(error.what());
    }
  }
  return html.empty() ? html : "<h3>Movies and sheets</h3>\n" + html;
}

std::string note(std::size_t shown, std::size_t total, bool is_asked) {
  if (shown == total) {
    return fmt::format("All {} pictures of the run.", total);
  }
  return fmt::format("{} of {} pictures, evenly chosen{}; all are in <code>frames/</code>.", shown,
                     total, is_asked ? "" : " to keep this page below some 20 MB");
}

/// Pictures of render/, at most half of what is left of the `budget`, bytes.
std::string again_html(const fs::path& run, Writer& writer, std::uintmax_t& budget) {
  const std::vector<Picture> all = pictures_in(run / "render");
  const std::vector<std::size_t> chosen = chosen_pictures(all, kMaxAgain, budget / 2);
  if (all.empty()) {
    return {};
  }
  std::string pictures;
  for (const std::size_t number : chosen) {
    writer.add_again(pictures, all[number]);
  }
  budget -= bytes_of(all, chosen);
  const std::string which =
      chosen.size() == all.size()
          ? fmt::format("All {} pictures", all.size())
          : fmt::format("{} of {} pictures, evenly chosen,", chosen.size(), all.size());
  return fmt::format(R"(<h3>Drawn again</h3>
<p class="note">{} of <code>render/</code>.</p>
<div class="ends">
{}</div>
)",
                     which, pictures);
}

/// The pictures of the run itself.
std::string player_html(const fs::path& run, std::optional<std::size_t> most, std::uintmax_t budget,
                        Writer& writer) {
  const std::vector<Picture> all = pictures_in(run / "frames");
  if (all.empty()) {
    return {};
  }
  std::string ends_text;
  std::vector<Picture> ends = end_pictures(all, writer.ends());
  std::erase_if(ends, [&](const Picture& picture) {
    const bool is_too_large = picture.bytes > budget;
    budget -= is_too_large ? 0 : picture.bytes;
    return is_too_large;
  });
  for (const Picture& picture : ends) {
    writer.add_end(ends_text, picture);
  }
  std::string list;
  for (const std::size_t number : chosen_pictures(all, most.value_or(all.size()), budget)) {
    writer.add_frame(list, all[number], ends);
  }
  return fmt::format(
      R"(<div class="player" id="player" hidden>
<img id="frame" alt="">
<div class="controls"><button type="button" id="play">Play</button><input type="range" id="slider" min="0" value="0" step="1" aria-label="Picture" aria-describedby="frame-note"><output id="frame-label" for="slider"></output></div>
<p class="note" id="frame-note">{} Arrow keys step, the space bar plays.</p></div>
<noscript><p class="note">Stepping through the pictures needs scripts.</p></noscript>
<h3>At the end of each stage</h3>
<div class="ends">
{}</div>
<script type="application/json" id="frames">[{}]</script>
)",
      note(writer.count(), all.size(), most.has_value()), ends_text, list);
}

}  // namespace

std::string frames_html(const fs::path& run, const store::RunSummary& summary,
                        std::optional<std::size_t> most, Warnings& warnings) {
  std::uintmax_t budget = most ? kMaxRequestedBytes : kUsualBytes;
  Writer writer(summary, warnings);
  const std::string movies = movies_html(run, budget, warnings);
  const std::string again = again_html(run, writer, budget);
  return player_html(run, most, budget, writer) + movies + again;
}

}  // namespace clca::report

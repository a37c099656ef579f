#include "clca/export/export.hpp"

#include <fmt/format.h>

#include "export/formats.hpp"

namespace clca::exports {

std::string_view ending(Format format) {
  switch (format) {
    case Format::vtp:
      return ".pvd";
    case Format::gsd:
      return ".gsd";
    case Format::xyz:
      return ".xyz";
    case Format::h5md:
      break;
  }
  return ".h5";
}

std::unique_ptr<Writer> writer(Format format, const store::OutputFile& file,
                               const scene::Scene& scene, const std::vector<grains::Kind>& kinds) {
  switch (format) {
    case Format::vtp:
      return std::make_unique<VtpWriter>(file, scene, kinds);
    case Format::gsd:
      return std::make_unique<GsdWriter>(file, scene, kinds);
    case Format::xyz:
      return std::make_unique<XyzWriter>(file, scene, kinds);
    case Format::h5md:
      break;
  }
  return std::make_unique<H5mdWriter>(file, scene, kinds);
}

std::vector<std::size_t> selected_frames(const std::vector<store::Trajectory::Frame>& frames,
                                         const FrameSelection& selection) {
  if (frames.empty()) {
    throw ExportError("the trajectory has no frames yet");
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& [step, stage, particles] = frames[i];
    if (step < selection.from.value_or(0) || step > selection.until.value_or(step)) {
      continue;
    }
    if (result.empty() || frames[result.back()].stage != stage ||
        step - frames[result.back()].step >= selection.every) {
      result.push_back(i);
    }
  }
  if (result.empty()) {
    throw ExportError(fmt::format("no frame at these steps; the trajectory goes from step {} to {}",
                                  frames.front().step, frames.back().step));
  }
  return result;
}

std::size_t write(const store::Trajectory& trajectory, const FrameSelection& selection,
                  Writer& writer, const std::atomic<int>& stop) {
  std::size_t written = 0;
  for (const std::size_t frame : selected_frames(trajectory.frames(), selection)) {
    if (stop.load() != 0) {
      break;
    }
    writer.add(trajectory.state(frame), trajectory.contact_frame(frame));
    ++written;
  }
  if (written > 0) {
    writer.finish();
  }
  return written;
}

}  // namespace clca::exports
